#include "models/heights/image.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/local_frame.h"
#include "models/heights/raster_file.h"
#include "sim/base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <new>
#include <utility>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

Dataset open(const path& file, const GdalSession& gdal) {
    constexpr std::array drivers = {"GTiff", "PNG", "JPEG", "BMP", "SGI", "TGA", static_cast<const char*>(nullptr)};
    constexpr unsigned flags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
    Dataset dataset(GDALOpenEx(file.c_str(), flags, drivers.data(), nullptr, nullptr));
    if (!dataset) {
        throw_unreadable(file, "an image",
            gdal.is_unknown_format() ? "another kind of file (GeoTIFF, PNG, JPEG, BMP, SGI and TGA are read)"
                                     : gdal.reason(file));
    }
    return dataset;
}

/// The bands that hold red, green and blue: one and the same for grey and palettes.
std::array<GDALRasterBandH, 3> colour_bands(const path& file, GDALDatasetH dataset) {
    const int count = GDALGetRasterCount(dataset);
    if (count < 1) { throw_unreadable(file, "an image", "no band"); }
    std::array<int, 3> numbers = {1, 1, 1};
    if (count >= 3) {
        numbers = {1, 2, 3};
        for (int band = 1; band <= count; ++band) {
            const int part = GDALGetRasterColorInterpretation(GDALGetRasterBand(dataset, band)) - GCI_RedBand;
            if (part >= 0 && part < 3) { numbers.at(static_cast<std::size_t>(part)) = band; }
        }
    }
    std::array<GDALRasterBandH, 3> bands{};
    for (std::size_t part = 0; part < 3; ++part) {
        bands.at(part) = GDALGetRasterBand(dataset, numbers.at(part));
        const GDALDataType type = GDALGetRasterDataType(bands.at(part));
        if (type != GDT_Byte) {
            throw_error_in(
                file, fmt::format("expected 8 bits a colour part (Byte), got {}", GDALGetDataTypeName(type)));
        }
    }
    return bands;
}

/// Reads a band into every fourth byte from `first` on.
void read_part(const path& file, GDALRasterBandH band, Image& image, int first, const GdalSession& gdal) {
    GDALRasterIOExtraArg how;
    INIT_RASTERIO_EXTRA_ARG(how);
    how.eResampleAlg = GDALGetRasterColorTable(band) != nullptr ? GRIORA_NearestNeighbour : GRIORA_Average;
    const CPLErr result =
        GDALRasterIOEx(band, GF_Read, 0, 0, GDALGetRasterBandXSize(band), GDALGetRasterBandYSize(band),
            image.rgba.data() + first, image.width, image.height, GDT_Byte, 4, GSpacing{4} * image.width, &how);
    if (result != CE_None || gdal.failed()) { throw_unreadable(file, "an image", gdal.reason(file)); }
}

/// Alpha: a pixel is there when any of its parts is.
void read_alpha(const path& file, const std::array<GDALRasterBandH, 3>& bands, Image& image, const GdalSession& gdal) {
    const int flags = GDALGetMaskFlags(bands[0]);
    if ((flags & GMF_ALL_VALID) != 0) { return; }
    read_part(file, GDALGetMaskBand(bands[0]), image, 3, gdal);
    if ((flags & GMF_NODATA) == 0 || bands[0] == bands[1]) { return; }
    Image other = image;
    for (std::size_t part = 1; part < 3; ++part) {
        read_part(file, GDALGetMaskBand(bands.at(part)), other, 3, gdal);
        for (std::size_t at = 3; at < image.rgba.size(); at += 4) {
            image.rgba[at] = std::max(image.rgba[at], other.rgba[at]);
        }
    }
}

/// Replaces numbers of a palette by its colours.
void apply_palette(GDALColorTableH palette, Image& image) {
    std::array<std::array<std::uint8_t, 4>, 256> colours{};
    const int entries = std::min(GDALGetColorEntryCount(palette), 256);
    for (int i = 0; i < entries; ++i) {
        GDALColorEntry entry{};
        GDALGetColorEntryAsRGB(palette, i, &entry);
        colours.at(static_cast<std::size_t>(i)) = {static_cast<std::uint8_t>(entry.c1),
            static_cast<std::uint8_t>(entry.c2), static_cast<std::uint8_t>(entry.c3),
            static_cast<std::uint8_t>(entry.c4)};
    }
    for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
        const std::array<std::uint8_t, 4>& colour = colours.at(image.rgba[at]);
        const std::uint8_t there = image.rgba[at + 3];
        std::copy(colour.begin(), colour.end(), image.rgba.begin() + static_cast<long>(at));
        image.rgba[at + 3] = std::min(there, colour[3]);
    }
}

/// Where the file says that it lies, for the size at which it was read.
void place(GDALDatasetH dataset, Image& image) {
    std::array<double, 6> t{};
    const OGRSpatialReferenceH system = GDALGetSpatialRef(dataset);
    if (system == nullptr || GDALGetGeoTransform(dataset, t.data()) != CE_None) { return; }
    const double across = static_cast<double>(GDALGetRasterXSize(dataset)) / image.width;
    const double down = static_cast<double>(GDALGetRasterYSize(dataset)) / image.height;
    image.transform = {t[0], t[1] * across, t[2] * down, t[3], t[4] * across, t[5] * down};
    image.wkt = wkt_of(system);
}

Image image_from(const path& file) {
    GdalSession gdal;
    const Dataset dataset = open(file, gdal);
    gdal.forget();
    const auto bands = colour_bands(file, dataset.get());
    const int width = GDALGetRasterXSize(dataset.get());
    const int height = GDALGetRasterYSize(dataset.get());
    const double shrink = std::max({width, height, max_image_px}) / static_cast<double>(max_image_px);
    Image image;
    image.name = file.filename().string();
    image.width = std::max(static_cast<int>(std::lround(width / shrink)), 1);
    image.height = std::max(static_cast<int>(std::lround(height / shrink)), 1);
    if (shrink > 1.0) {
        image.note = fmt::format(
            "{}: {} x {} pixels were reduced to {} x {}", image.name, width, height, image.width, image.height);
    }
    image.rgba.assign(
        std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), 255);
    for (int part = 0; part < 3; ++part) {
        read_part(file, bands.at(static_cast<std::size_t>(part)), image, part, gdal);
    }
    read_alpha(file, bands, image, gdal);
    if (const GDALColorTableH palette = GDALGetRasterColorTable(bands[0])) { apply_palette(palette, image); }
    place(dataset.get(), image);
    for (const std::string& warning : gdal.warnings()) {
        image.note += fmt::format("{}{}: GDAL warns: {}", image.note.empty() ? "" : "; ", image.name, warning);
    }
    return image;
}

} // namespace

Image read_image(const path& file) {
    check_local_file(file);
    try {
        return image_from(file);
    } catch (const std::bad_alloc&) { throw_error_in(file, "expected an image that fits in memory, got a larger one"); }
}

Image image_from_bytes(const std::string& name, std::string_view bytes) {
    constexpr const char* place = "/vsimem/octant-image";
    VSILFILE* const file = VSIFileFromMemBuffer(place,
        reinterpret_cast<GByte*>(const_cast<char*>(bytes.data())), // only read
        bytes.size(), FALSE);
    if (file == nullptr) { throw_error_in(name, "expected an image that fits in memory, got a larger one"); }
    VSIFCloseL(file);
    const auto remove = [](const char* gone) { VSIUnlink(gone); };
    const std::unique_ptr<const char, decltype(remove)> there(place, remove);
    try {
        Image image = image_from(place);
        image.name = name;
        return image;
    } catch (const Error&) {
        throw_error_in(name, "expected an image that GDAL can read, got another file");
    } catch (const std::bad_alloc&) { throw_error_in(name, "expected an image that fits in memory, got a larger one"); }
}

} // namespace octant::models::heights
