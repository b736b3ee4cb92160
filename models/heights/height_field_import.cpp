#include "models/heights/height_field_import.h"

#include "models/heights/gdal_session.h"
#include "models/heights/height_raster.h"
#include "models/heights/height_source.h"
#include "models/heights/height_voids.h"
#include "models/heights/local_frame.h"
#include "sim/base/error.h"

#include <cassert>
#include <cmath>
#include <new>
#include <utility>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

HeightField field_from(const std::vector<path>& files, const ImportOptions& options) {
    HeightSource source(files, options);
    check_size(files.front(), source.columns(), source.rows(), max_import_samples);
    HeightGrid grid;
    grid.columns = source.columns();
    grid.rows = source.rows();
    grid.heights_m.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
    source.read(0, grid.heights_m);
    const long voids = fill_voids(grid);
    if (static_cast<std::size_t>(voids) == grid.heights_m.size()) {
        throw_error_in(files.front(), "expected at least one height, got only samples without data");
    }
    HeightField field(grid.columns, grid.rows, source.spacing_m(), std::move(grid.heights_m));
    field.name = source.name();
    field.place = source.place();
    field.system = source.system();
    field.filled_voids = voids;
    field.notes = source.notes();
    return field;
}

} // namespace

HeightField read_height_field(const path& file, const ImportOptions& options) {
    return read_height_field(std::vector<path>{file}, options);
}

HeightField read_height_field(const std::vector<path>& files, const ImportOptions& options) {
    assert(options.spacing_m > 0.0 && std::isfinite(options.spacing_m));
    assert(!options.height_scale || *options.height_scale > 0.0);
    try {
        return field_from(files, options);
    } catch (const std::bad_alloc&) {
        throw_error_in(files.front(), "expected a height field that fits in memory, got a larger one");
    }
}

void check_coordinate_system(const ImportOptions& options) {
    if (options.system && *options.system != local_metres_name) {
        const GdalSession gdal;
        coordinate_system_from_name(*options.system);
    }
}

} // namespace octant::models::heights
