#include "models/heights/height_field_export.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/local_frame.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"

#include <array>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::heights {

namespace {

void set_system(GDALDatasetH dataset, const HeightField& field) {
    if (field.place) {
        GDALSetSpatialRef(dataset, local_coordinate_system(*field.place).get());
    } else {
        const OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
        OSRSetLocalCS(system, "metres east and north of the map centre");
        OSRSetLinearUnits(system, "metre", 1.0);
        GDALSetSpatialRef(dataset, system);
        OSRRelease(system);
    }
}

void set_frame(GDALDatasetH dataset, const HeightField& field) {
    const double spacing_m = field.spacing_m();
    std::array<double, 6> transform = {
        -0.5 * field.columns() * spacing_m, spacing_m, 0.0, 0.5 * field.rows() * spacing_m, 0.0, -spacing_m};
    GDALSetGeoTransform(dataset, transform.data());
    set_system(dataset, field);
    // A declared value for missing data, and one that no height equals, keeps -9999 a height.
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    GDALSetRasterNoDataValue(band, std::numeric_limits<double>::quiet_NaN());
    GDALSetRasterUnitType(band, "m");
}

bool write_lines(GDALDatasetH dataset, const HeightField& field) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    const int columns = field.columns();
    std::vector<float> line(static_cast<std::size_t>(columns));
    for (int row = field.rows() - 1; row >= 0; --row) {
        for (int column = 0; column < columns; ++column) {
            line[static_cast<std::size_t>(column)] = field.height_m(column, row);
        }
        const int y = field.rows() - 1 - row;
        const CPLErr result =
            GDALRasterIO(band, GF_Write, 0, y, columns, 1, line.data(), columns, 1, GDT_Float32, 0, 0);
        if (result != CE_None) { return false; }
    }
    return true;
}

} // namespace

void write_height_field(const std::filesystem::path& path, const HeightField& field) {
    const GdalSession gdal;
    const MemoryFile memory("height-field.tif");
    char** options = CSLSetNameValue(nullptr, "COMPRESS", "DEFLATE");
    options = CSLSetNameValue(options, "PREDICTOR", "3");
    options = CSLSetNameValue(options, "BIGTIFF", "IF_SAFER");
    Dataset dataset(GDALCreate(
        GDALGetDriverByName("GTiff"), memory.path().c_str(), field.columns(), field.rows(), 1, GDT_Float32, options));
    CSLDestroy(options);
    bool written = dataset != nullptr;
    if (written) {
        set_frame(dataset.get(), field);
        written = write_lines(dataset.get(), field);
        dataset.reset();
    }
    if (!written || gdal.failed()) { throw_error_in(path, "cannot be written: " + gdal.reason(memory.path())); }
    write_file(path, memory.bytes());
}

} // namespace octant::models::heights
