#include "models/heights/image_on_ground.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <numeric>
#include <utility>

namespace octant::models::heights {

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
        throw Error(fmt::format("{}: expected an image without a coordinate system over ground without one ({}), got "
                                "one with",
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
