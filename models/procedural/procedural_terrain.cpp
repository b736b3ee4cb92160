// Source: ground in balance between uplift and stream power (see drainage.cpp), made from coarse to fine as in G.
// Cordonnier et al., Large Scale Terrain Generation from Tectonic Uplift and Fluvial Erosion, Computer Graphics Forum
// 35(2), 2016: the streams give the branching valleys, diffusion rounds the tops. Deviations: a regular grid with
// hashed receivers and warped sampling instead of an irregular mesh; valley floors are flattened by the height above
// the nearest stream.

#include "models/procedural/procedural_terrain.h"

#include "models/procedural/drainage.h"
#include "models/procedural/terrain_grid.h"
#include "models/procedural/terrain_noise.h"
#include "sim/base/thread_pool.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::procedural {

namespace {

/// The margin of the grid around the rotated field.
constexpr double margin_m = 1000.0;
constexpr double coarse_cell_m = 200.0;

std::vector<char> rim_of(const TerrainGrid& grid) {
    std::vector<char> rim(grid.values.size(), 0);
    for (int i = 0; i < grid.side; ++i) {
        rim[grid.index(i, 0)] = 1;
        rim[grid.index(i, grid.side - 1)] = 1;
        rim[grid.index(0, i)] = 1;
        rim[grid.index(grid.side - 1, i)] = 1;
    }
    return rim;
}

TerrainGrid first_ground(double extent_m, std::uint64_t seed) {
    const int side = std::clamp(static_cast<int>(extent_m / coarse_cell_m) + 1, 33, 513);
    TerrainGrid ground(side, extent_m / (side - 1));
    const FractalNoise lowland = {seed + 11, 7000.0, 3, 0.5};
    parallel_for_rows(side, [&](int row) {
        const RowPoints places = points_of_row(ground, row);
        const std::span<double> line = ground.row(row);
        lowland.at(places.x_m, places.y_m, line);
        for (double& value : line) { value = 130.0 + 120.0 * value; }
    });
    return ground;
}

/// Relative rate of uplift: ranges of hills and quiet basins between them.
std::vector<double> uplift_of(const TerrainGrid& ground, std::uint64_t seed) {
    const FractalNoise ranges = {seed + 23, 6500.0, 3, 0.45};
    std::vector<double> uplift(ground.values.size());
    parallel_for_rows(ground.side, [&](int row) {
        const RowPoints places = points_of_row(ground, row);
        const std::span<double> line(&uplift[ground.index(0, row)], places.x_m.size());
        ranges.at(places.x_m, places.y_m, line);
        for (double& value : line) { value = 0.22 + 0.95 * smooth_step(-0.35, 0.5, value); }
    });
    return uplift;
}

struct Level {
    int steps = 0;
    StreamPower power;
    double diffusion = 0.0;
};

void shape(TerrainGrid& ground, const Level& level, std::uint64_t seed) {
    const std::vector<char> rim = rim_of(ground);
    const std::vector<double> uplift = uplift_of(ground, seed);
    for (int step = 0; step < level.steps; ++step) {
        if (step % 8 == 0) { fill_pits(ground, rim); }
        const std::uint64_t turn = seed + 37 + static_cast<std::uint64_t>(step / 8);
        erode(ground, compute_drainage(ground, rim, turn), uplift, level.power);
        if (level.diffusion > 0.0) { diffuse(ground, level.diffusion); }
    }
}

/// Makes flat floors along streams: a height h above the nearest stream becomes about h - floor_m h / (h + 3 floor_m).
void flatten_floors(TerrainGrid& ground, std::uint64_t seed) {
    constexpr double stream_area_m2 = 6.0e5;
    const std::vector<char> rim = rim_of(ground);
    fill_pits(ground, rim);
    const Drainage water = compute_drainage(ground, rim, seed + 37);
    std::vector<double> stream_m(ground.values.size());
    const std::vector<double> old = ground.values;
    for (const int cell : water.upstream) {
        const auto i = static_cast<std::size_t>(cell);
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        const bool is_stream = receiver == i || water.area_m2[i] > stream_area_m2;
        stream_m[i] = is_stream ? old[i] : stream_m[receiver];
        const double above_m = std::max(0.0, old[i] - stream_m[i]);
        constexpr double floor_m = 14.0;
        ground.values[i] = old[i] - floor_m * above_m / (above_m + 2.0 * floor_m);
    }
}

} // namespace

heights::HeightField procedural_hills(const ProceduralTerrainOptions& options) {
    assert(options.size >= 2 && options.size <= 20000);
    assert(options.spacing_m > 0.0 && std::isfinite(options.spacing_m));
    const double field_m = (options.size - 1) * options.spacing_m;
    const double extent_m = upscale_factor * field_m + 2.0 * margin_m;
    const std::uint64_t seed = options.seed * 1000003U;
    TerrainGrid ground = first_ground(extent_m, seed);
    shape(ground, {44, {50.0, 58.0}, 0.0}, seed);
    ground = refined(ground, {seed + 61, 12.0 * ground.cell_m, 3});
    shape(ground, {16, {34.0, 58.0}, 0.09}, seed);
    if (ground.cell_m > 2.0 * options.spacing_m) {
        ground = refined(ground, {seed + 67, 10.0 * ground.cell_m, 3});
        shape(ground, {5, {22.0, 58.0}, 0.22}, seed);
    }
    flatten_floors(ground, seed);
    for (int i = 0; i < 4; ++i) { diffuse(ground, 0.15); }
    const DomainWarp warp = {seed + 41, 10.0 * ground.cell_m, 3};
    const FractalNoise detail = {seed + 47, 500.0, 5, 0.5};
    const auto size = static_cast<std::size_t>(options.size);
    std::vector<float> heights_m(size * size);
    parallel_for_rows(options.size, [&](int row) {
        RowPoints places(size);
        for (std::size_t column = 0; column < size; ++column) {
            const double east_m = static_cast<double>(column) * options.spacing_m - 0.5 * field_m;
            const double north_m = row * options.spacing_m - 0.5 * field_m;
            places.x_m[column] = 0.5 * extent_m + rotation_cos * east_m - rotation_sin * north_m;
            places.y_m[column] = 0.5 * extent_m + rotation_sin * east_m + rotation_cos * north_m;
        }
        std::vector<double> rough(size);
        detail.at(places.x_m, places.y_m, rough);
        warp.move(places.x_m, places.y_m, 1.0);
        float* const line = heights_m.data() + static_cast<std::size_t>(row) * size;
        for (std::size_t column = 0; column < size; ++column) {
            line[column] =
                static_cast<float>(ground.smooth_at(places.x_m[column], places.y_m[column]) + 9.0 * rough[column]);
        }
    });
    heights::HeightField field(options.size, options.size, options.spacing_m, std::move(heights_m));
    field.name = "hills";
    return field;
}

std::optional<heights::HeightField> procedural_terrain(std::string_view name, const ProceduralTerrainOptions& options) {
    if (name == "hills") { return procedural_hills(options); }
    if (name == "canyon") { return procedural_canyon(options); }
    return std::nullopt;
}

} // namespace octant::models::procedural
