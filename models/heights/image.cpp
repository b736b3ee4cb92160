#include "models/heights/image.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_inputs.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <new>
#include <numeric>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

Dataset open(const path& file, const GdalSession& gdal) {
    constexpr std::array drivers = {
        "GTiff", "PNG", "JPEG", "BMP", "SGI", "TGA", "GIF", "WEBP", static_cast<const char*>(nullptr)};
    constexpr unsigned flags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
    Dataset dataset(GDALOpenEx(file.c_str(), flags, drivers.data(), nullptr, nullptr));
    if (!dataset) {
        throw_unreadable(file, "an image",
            gdal.is_unknown_format() ? "another kind of file (GeoTIFF, PNG, JPEG, BMP, SGI, TGA, GIF and WebP are read)"
                                     : gdal.reason(file));
    }
    return dataset;
}

/// Whether the parts of a band's colours have 16 bits, of which all are used: in PNG files, whose specification says
/// so.
bool has_16_bits(GDALDatasetH dataset, GDALRasterBandH band) {
    const std::string_view driver = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
    return GDALGetRasterDataType(band) == GDT_UInt16 && driver == "PNG";
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
        if (type != GDT_Byte && !has_16_bits(dataset, bands.at(part))) {
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
    const bool is_deep = GDALGetRasterDataType(band) == GDT_UInt16;
    std::vector<std::uint16_t> deep(is_deep ? image.rgba.size() / 4 : 0);
    void* const to = is_deep ? static_cast<void*>(deep.data()) : image.rgba.data() + first;
    const GSpacing bytes = is_deep ? 2 : 4;
    const CPLErr result =
        GDALRasterIOEx(band, GF_Read, 0, 0, GDALGetRasterBandXSize(band), GDALGetRasterBandYSize(band), to, image.width,
            image.height, is_deep ? GDT_UInt16 : GDT_Byte, bytes, bytes * image.width, &how);
    if (result != CE_None || gdal.failed()) { throw_unreadable(file, "an image", gdal.reason(file)); }
    for (std::size_t i = 0; i < deep.size(); ++i) {
        constexpr unsigned steps = 257; // 65535 is as bright as 255
        image.rgba[4 * i + static_cast<std::size_t>(first)] = static_cast<std::uint8_t>((deep[i] + steps / 2) / steps);
    }
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

Image image_from(const path& file, int largest_px) {
    GdalSession gdal;
    const Dataset dataset = open(file, gdal);
    gdal.forget();
    const auto bands = colour_bands(file, dataset.get());
    const int width = GDALGetRasterXSize(dataset.get());
    const int height = GDALGetRasterYSize(dataset.get());
    const double shrink = std::max({width, height, largest_px}) / static_cast<double>(largest_px);
    Image image;
    image.name = file.filename().string();
    image.file_width = width;
    image.file_height = height;
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

Image read_image(const path& file, int largest_px) {
    check_local_file(file);
    try {
        return image_from(file, largest_px);
    } catch (const std::bad_alloc&) { throw_error_in(file, "expected an image that fits in memory, got a larger one"); }
}

Image image_from_bytes(const std::string& name, std::string_view bytes, int largest_px) {
    try {
        const MemoryFile file("octant-image", bytes);
        Image image = image_from(file.path(), largest_px);
        image.name = name;
        return image;
    } catch (const Error&) {
        throw_error_in(name, "expected an image that GDAL can read, got another file");
    } catch (const std::bad_alloc&) { throw_error_in(name, "expected an image that fits in memory, got a larger one"); }
}

namespace {

constexpr double max_error_px = 0.125;

struct CloseTransformer {
    void operator()(void* transformer) const { GDALDestroyTransformer(transformer); }
};

using Transformer = std::unique_ptr<void, CloseTransformer>;

struct DestroyOptions {
    void operator()(GDALWarpOptions* options) const { GDALDestroyWarpOptions(options); }
};

[[noreturn]] void error_unplaced(const Image& image, const GdalSession& gdal) {
    throw Error(fmt::format("{}: expected an image that can be brought into the ground's coordinate system, got {}",
        image.name, gdal.reason(image.name)));
}

/// The image's own memory as a data set of GDAL. The image must outlive it.
Dataset dataset_of(Image& image) {
    Dataset dataset(GDALCreate(GDALGetDriverByName("MEM"), "", image.width, image.height, 0, GDT_Byte, nullptr));
    for (int part = 0; part < 4; ++part) {
        const std::string memory = fmt::format(
            "DATAPOINTER={}", reinterpret_cast<std::uintptr_t>(image.rgba.data()) + static_cast<std::uintptr_t>(part));
        const std::string line = fmt::format("LINEOFFSET={}", std::int64_t{4} * image.width);
        std::array<char*, 4> options = {const_cast<char*>(memory.c_str()), const_cast<char*>("PIXELOFFSET=4"),
            const_cast<char*>(line.c_str()), nullptr};
        GDALAddBand(dataset.get(), GDT_Byte, options.data());
    }
    GDALSetGeoTransform(dataset.get(), image.transform.data());
    if (!image.wkt.empty()) { GDALSetProjection(dataset.get(), image.wkt.c_str()); }
    return dataset;
}

/// Metres a pixel of the image about covers in the system.
double pixel_m(const Image& image, const Dataset& source, const CoordinateSystem& system) {
    const Transformer transformer(
        GDALCreateGenImgProjTransformer(source.get(), image.wkt.c_str(), nullptr, system.wkt.c_str(), FALSE, 0.0, 0));
    std::array<double, 6> transform{};
    int width = 0;
    int height = 0;
    const bool known = transformer && GDALSuggestedWarpOutput(source.get(), GDALGenImgProjTransform, transformer.get(),
                                          transform.data(), &width, &height) == CE_None;
    return known ? transform[1] * system.unit_m : 0.0;
}

/// An empty image from edge to edge of the ground.
Image empty_over(const GroundArea& ground, const CoordinateSystem& system, int width, int height) {
    const glm::dvec2 half = ground.half_extent_m / system.unit_m;
    Image image;
    image.width = width;
    image.height = height;
    image.rgba.assign(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    image.wkt = system.wkt;
    image.transform = {
        system.centre_x - half.x, 2.0 * half.x / width, 0.0, system.centre_y + half.y, 0.0, -2.0 * half.y / height};
    return image;
}

void warp(const Image& image, const Dataset& from, Image& to, const GdalSession& gdal) {
    const Dataset target = dataset_of(to);
    const Transformer exact(
        GDALCreateGenImgProjTransformer(from.get(), image.wkt.c_str(), target.get(), to.wkt.c_str(), FALSE, 0.0, 0));
    if (!exact) { error_unplaced(image, gdal); }
    const Transformer near(GDALCreateApproxTransformer(GDALGenImgProjTransform, exact.get(), max_error_px));
    const std::unique_ptr<GDALWarpOptions, DestroyOptions> options(GDALCreateWarpOptions());
    options->hSrcDS = from.get();
    options->hDstDS = target.get();
    options->eResampleAlg = GRA_Bilinear;
    options->nBandCount = 3;
    options->panSrcBands = static_cast<int*>(CPLMalloc(3 * sizeof(int)));
    options->panDstBands = static_cast<int*>(CPLMalloc(3 * sizeof(int)));
    std::iota(options->panSrcBands, options->panSrcBands + 3, 1);
    std::iota(options->panDstBands, options->panDstBands + 3, 1);
    options->nSrcAlphaBand = 4;
    options->nDstAlphaBand = 4;
    options->pfnTransformer = GDALApproxTransform;
    options->pTransformerArg = near.get();
    const std::unique_ptr<void, void (*)(void*)> operation(
        GDALCreateWarpOperation(options.get()), [](void* o) { GDALDestroyWarpOperation(o); });
    const bool warped = operation && GDALChunkAndWarpImage(operation.get(), 0, 0, to.width, to.height) == CE_None;
    GDALFlushCache(target.get());
    if (!warped || gdal.failed()) { error_unplaced(image, gdal); }
}

/// Says how much of the ground the image leaves bare. Throws Error when it is all.
void note_cover(Image& laid, const Image& image, const GroundArea& ground) {
    std::size_t covered = 0;
    for (std::size_t at = 3; at < laid.rgba.size(); at += 4) { covered += laid.rgba[at] > 0 ? 1U : 0U; }
    const std::size_t pixels = laid.rgba.size() / 4;
    if (covered == 0) {
        throw Error(fmt::format(
            "{}: expected an image of the ground of {}, got one that lies elsewhere", image.name, ground.name));
    }
    laid.note = image.note;
    if (covered < pixels) {
        const double percent = 100.0 * static_cast<double>(covered) / static_cast<double>(pixels);
        laid.note +=
            fmt::format("{}{}: covers {:.3g} % of the ground", laid.note.empty() ? "" : "; ", image.name, percent);
    }
}

} // namespace

GroundArea area_of(const HeightField& field) {
    return {field.name, field.half_extent_m(), field.spacing_m(), field.system};
}

Image resampled_to_ground(Image image, const GroundArea& ground, int largest_px) {
    const bool placed = !image.wkt.empty();
    if (placed && !ground.system) {
        throw Error(
            fmt::format("{}: expected an image without a coordinate system over ground without one ({}), got one with",
                image.name, ground.name));
    }
    if (!placed && image.width <= largest_px && image.height <= largest_px) { return image; }
    GdalSession gdal;
    const CoordinateSystem system = placed ? *ground.system : CoordinateSystem{};
    const glm::dvec2 extent_m = 2.0 * ground.half_extent_m;
    if (!placed) { image.transform = empty_over(ground, system, image.width, image.height).transform; }
    const Dataset source = dataset_of(image);
    glm::dvec2 size(image.width, image.height);
    if (placed) {
        const double own_m = pixel_m(image, source, system);
        if (!(own_m > 0.0)) { error_unplaced(image, gdal); }
        size = extent_m / std::min(own_m, ground.spacing_m);
    }
    const auto limited = [largest_px](double side) {
        return static_cast<int>(std::clamp(std::round(side), 1.0, static_cast<double>(largest_px)));
    };
    Image laid = empty_over(ground, system, limited(size.x), limited(size.y));
    laid.name = image.name;
    warp(image, source, laid, gdal);
    note_cover(laid, image, ground);
    return laid;
}

} // namespace octant::models::heights
