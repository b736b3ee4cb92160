#include "models/heights/height_field_import.h"

#include "models/heights/height_raster.h"
#include "models/heights/height_voids.h"
#include "models/heights/plain_pgm.h"
#include "sim/base/error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <new>
#include <ogr_srs_api.h>
#include <optional>
#include <utility>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

constexpr double square_tolerance = 1e-6;
constexpr double scale_tolerance = 0.01;

/// A field with square cells from a grid with cells of the given sides.
HeightField field_from(const path& file, HeightGrid grid, double step_east_m, double step_north_m) {
    double spacing_m = step_east_m;
    if (std::abs(step_east_m / step_north_m - 1.0) > square_tolerance) {
        spacing_m = std::sqrt(step_east_m * step_north_m);
        const double shorter_m =
            std::min((grid.columns - 1) * step_east_m, (grid.rows - 1) * step_north_m);
        if (shorter_m < spacing_m) {
            error_in(
                file,
                fmt::format(
                    "expected room for 2 x 2 square cells, got {} x {} samples of {:g} x {:g} m",
                    grid.columns,
                    grid.rows,
                    step_east_m,
                    step_north_m));
        }
        grid = squared(grid, step_east_m, step_north_m, spacing_m);
        check_import_size(file, grid.columns, grid.rows);
    }
    return {grid.columns, grid.rows, spacing_m, std::move(grid.heights_m)};
}

HeightField field_in_metres(const path& file, HeightGrid grid, const GridFrame& frame) {
    constexpr double coarsest_degrees = 0.02;
    const bool on_the_globe = std::abs(frame.west) <= 360.0 && std::abs(frame.south) <= 90.0;
    if (frame.step_east < coarsest_degrees && on_the_globe) {
        error_in(
            file,
            fmt::format(
                "expected a coordinate system, got none and cells of {:g}, which look like degrees",
                frame.step_east));
    }
    return field_from(file, std::move(grid), frame.step_east, frame.step_north);
}

HeightField field_about_centre(
    const path& file, const HeightGrid& grid, const std::optional<LocalFrame>& local) {
    auto result = local ? local->resampled(grid) : std::nullopt;
    if (!result) {
        error_in(
            file,
            "expected upright ground up to 1000 km wide and away from the poles, got ground that "
            "no local frame fits");
    }
    check_import_size(file, result->grid.columns, result->grid.rows);
    HeightField field(
        result->grid.columns,
        result->grid.rows,
        result->spacing_m,
        std::move(result->grid.heights_m));
    field.place = result->place;
    field.system = std::move(result->system);
    return field;
}

bool is_true_to_scale(const LocalFrame& local, double step_east_m, double step_north_m) {
    return std::abs(local.step_east_m() / step_east_m - 1.0) <= scale_tolerance &&
           std::abs(local.step_north_m() / step_north_m - 1.0) <= scale_tolerance;
}

HeightField field_from_system(const path& file, HeightRaster raster) {
    const GridFrame& frame = *raster.frame;
    const auto local =
        LocalFrame::around(raster.system, frame, raster.grid.columns, raster.grid.rows);
    if (OSRIsGeographic(raster.system) != 0) {
        return field_about_centre(file, raster.grid, local);
    }
    if (OSRIsProjected(raster.system) == 0 && OSRIsLocal(raster.system) == 0) {
        error_in(file, "expected a map projection or degrees, got another coordinate system");
    }
    const double unit_m = OSRGetLinearUnits(raster.system, nullptr);
    const double step_east_m = frame.step_east * unit_m;
    const double step_north_m = frame.step_north * unit_m;
    if (local && !is_true_to_scale(*local, step_east_m, step_north_m)) {
        return field_about_centre(file, raster.grid, local);
    }
    MapSystem system = map_system(raster.system, frame, raster.grid.columns, raster.grid.rows);
    HeightField field = field_from(file, std::move(raster.grid), step_east_m, step_north_m);
    field.system = std::move(system);
    if (local) {
        field.place = local->place();
    }
    return field;
}

HeightField field_from_raster(const path& file, const ImportOptions& options) {
    GdalSession gdal;
    HeightRaster raster = read_height_raster(file, options.height_scale, gdal);
    const long voids = fill_voids(raster.grid);
    if (static_cast<std::size_t>(voids) == raster.grid.heights_m.size()) {
        error_in(file, "expected at least one height, got only samples without data");
    }
    HeightField field =
        !raster.frame
            ? field_from(file, std::move(raster.grid), options.spacing_m, options.spacing_m)
        : raster.system == nullptr ? field_in_metres(file, std::move(raster.grid), *raster.frame)
                                   : field_from_system(file, std::move(raster));
    field.filled_voids = voids;
    return field;
}

HeightField field_from_plain_pgm(const path& file, const ImportOptions& options) {
    HeightGrid grid = read_plain_pgm(
        file, [&file](int columns, int rows) { check_import_size(file, columns, rows); });
    for (float& height : grid.heights_m) {
        const double height_m = static_cast<double>(height) * options.height_scale;
        check_height(file, height_m);
        height = static_cast<float>(height_m);
    }
    return field_from(file, std::move(grid), options.spacing_m, options.spacing_m);
}

} // namespace

HeightField read_height_field(const path& file, const ImportOptions& options) {
    assert(options.spacing_m > 0.0 && std::isfinite(options.spacing_m));
    assert(options.height_scale > 0.0 && std::isfinite(options.height_scale));
    check_local_file(file);
    try {
        HeightField field = is_plain_pgm(file) ? field_from_plain_pgm(file, options)
                                               : field_from_raster(file, options);
        field.name = file.filename().string();
        return field;
    } catch (const std::bad_alloc&) {
        error_in(file, "expected a height field that fits in memory, got a larger one");
    }
}

} // namespace octant::models::heights
