#include "visuals/scene/ground_colours.h"

#include "models/colour_vertex.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace octant::visuals::scene {

namespace {

struct Stop {
    float height_m;
    glm::vec3 colour;
};

// Cover of level ground by height above the water, and what shows where it is steep.
constexpr std::array meadow_stops = {
    Stop{0.0F, {0.46F, 0.50F, 0.28F}},
    Stop{300.0F, {0.37F, 0.47F, 0.22F}},
    Stop{1100.0F, {0.36F, 0.43F, 0.23F}},
    Stop{1600.0F, {0.46F, 0.46F, 0.31F}},
    Stop{2000.0F, {0.52F, 0.50F, 0.45F}},
    Stop{2350.0F, {0.93F, 0.94F, 0.96F}}};
constexpr glm::vec3 dry_grass(0.58F, 0.55F, 0.31F);
constexpr glm::vec3 forest(0.14F, 0.25F, 0.12F);
constexpr float tree_line_m = 1500.0F;
constexpr std::array crops = {
    glm::vec3(0.66F, 0.58F, 0.33F),
    glm::vec3(0.33F, 0.46F, 0.19F),
    glm::vec3(0.45F, 0.52F, 0.25F),
    glm::vec3(0.47F, 0.37F, 0.25F)};
constexpr std::array arid_stops = {
    Stop{0.0F, {0.45F, 0.33F, 0.24F}},
    Stop{900.0F, {0.58F, 0.38F, 0.26F}},
    Stop{1300.0F, {0.66F, 0.44F, 0.30F}},
    Stop{1700.0F, {0.68F, 0.52F, 0.36F}},
    Stop{2050.0F, {0.60F, 0.54F, 0.36F}},
    Stop{2400.0F, {0.42F, 0.45F, 0.28F}}};
constexpr glm::vec3 temperate_rock(0.47F, 0.44F, 0.41F);
constexpr glm::vec3 water_colour(0.17F, 0.31F, 0.42F);
constexpr float band_m = 85.0F; ///< thickness of a stratum of arid rock

/// Whole-number noise in [0, 1): the same bits on every machine.
float lattice_noise(int column, int row) {
    auto h = static_cast<std::uint32_t>(column) * 0x9e3779b1U ^
             static_cast<std::uint32_t>(row) * 0x85ebca77U;
    h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
    h = (h ^ (h >> 12U)) * 0x297a2d39U;
    return static_cast<float>((h ^ (h >> 15U)) >> 8U) * (1.0F / 16777216.0F);
}

int cell_of(float at_m, float cell_m) {
    return static_cast<int>(std::floor(at_m / cell_m));
}

/// Smooth noise in [-1, 1] whose features are `cell_m` wide.
float patch_noise(float east_m, float north_m, float cell_m) {
    const int i = cell_of(east_m, cell_m);
    const int j = cell_of(north_m, cell_m);
    const float u = east_m / cell_m - static_cast<float>(i);
    const float v = north_m / cell_m - static_cast<float>(j);
    const float su = u * u * (3.0F - 2.0F * u);
    const float sv = v * v * (3.0F - 2.0F * v);
    const float south = glm::mix(lattice_noise(i, j), lattice_noise(i + 1, j), su);
    const float north = glm::mix(lattice_noise(i, j + 1), lattice_noise(i + 1, j + 1), su);
    return 2.0F * glm::mix(south, north, sv) - 1.0F;
}

glm::vec3 cover(std::span<const Stop> stops, float height_m) {
    for (std::size_t i = 1; i < stops.size(); ++i) {
        if (height_m < stops[i].height_m) {
            const float t =
                (height_m - stops[i - 1].height_m) / (stops[i].height_m - stops[i - 1].height_m);
            return glm::mix(stops[i - 1].colour, stops[i].colour, glm::clamp(t, 0.0F, 1.0F));
        }
    }
    return stops.back().colour;
}

/// A sample of ground before light falls on it.
struct Site {
    float east_m;    ///< of the field's south-west corner
    float north_m;   ///< of the field's south-west corner
    float height_m;  ///< above the water level
    float steepness; ///< 1 - cosine of the slope
    float patches;   ///< noise in [-1, 1], features of some hundred metres
};

Site site_of(
    const models::HeightField& field, int column, int row, float steepness, float water_m) {
    const auto spacing_m = static_cast<float>(field.spacing_m());
    const float east_m = spacing_m * static_cast<float>(column);
    const float north_m = spacing_m * static_cast<float>(row);
    return {
        east_m,
        north_m,
        field.height_m(column, row) - water_m,
        steepness,
        0.6F * patch_noise(east_m, north_m, 740.0F) + 0.4F * patch_noise(east_m, north_m, 220.0F)};
}

/// Farmland: fields of 260 x 180 m in rows, each with its crop.
glm::vec3 field_crop(const Site& site) {
    const int row = cell_of(site.north_m, 180.0F);
    const float pick =
        lattice_noise(cell_of(site.east_m + 120.0F * lattice_noise(0, row), 260.0F), row);
    return crops[static_cast<std::size_t>(pick * static_cast<float>(crops.size()))];
}

glm::vec3 temperate(const Site& site) {
    // A tree line and a snow line that are not drawn with a ruler.
    const float height_m = std::max(site.height_m + 120.0F * site.patches, 0.0F);
    const float dryness = 0.5F + 0.5F * patch_noise(site.east_m + 1e5F, site.north_m, 1660.0F);
    const float below_trees =
        1.0F - glm::smoothstep(tree_line_m - 200.0F, tree_line_m + 200.0F, height_m);
    glm::vec3 colour =
        glm::mix(cover(meadow_stops, height_m), dry_grass, 0.45F * dryness * below_trees);
    const float level = 1.0F - glm::smoothstep(0.0010F, 0.0035F, site.steepness);
    const float farmed =
        level *
        glm::smoothstep(-0.15F, 0.05F, patch_noise(site.east_m, site.north_m + 1e5F, 1220.0F));
    colour = glm::mix(colour, field_crop(site), farmed * below_trees);
    const float growth = site.patches + 0.5F * patch_noise(site.east_m, site.north_m, 100.0F) +
                         5.0F * site.steepness - 0.12F;
    const float wooded = glm::smoothstep(0.0F, 0.16F, growth) * below_trees * (1.0F - farmed);
    colour = glm::mix(
        colour,
        forest * (0.85F +
                  0.3F * lattice_noise(cell_of(site.east_m, 20.0F), cell_of(site.north_m, 20.0F))),
        0.9F * wooded);
    const float bare = glm::smoothstep(0.14F, 0.30F, site.steepness + 0.03F * site.patches);
    return glm::mix(colour, temperate_rock * (1.0F + 0.10F * site.patches), bare);
}

glm::vec3 arid(const Site& site) {
    const glm::vec3 level = cover(arid_stops, site.height_m + 60.0F * site.patches);
    const float stratum = (site.height_m + 12.0F * site.patches) / band_m;
    const float layer = lattice_noise(static_cast<int>(std::floor(stratum)), 7);
    const glm::vec3 rock =
        glm::mix(glm::vec3(0.55F, 0.30F, 0.19F), glm::vec3(0.78F, 0.62F, 0.45F), layer);
    const float shrubs = glm::smoothstep(
        0.1F, 0.5F, site.patches + 0.6F * patch_noise(site.east_m, site.north_m, 60.0F));
    const glm::vec3 grown = glm::mix(level, glm::vec3(0.36F, 0.36F, 0.22F), 0.35F * shrubs);
    return glm::mix(grown, rock, glm::smoothstep(0.05F, 0.25F, site.steepness)) *
           (1.0F + 0.10F * site.patches);
}

} // namespace

glm::vec3 direction_to_sun(const Settings& settings) {
    const double azimuth_rad = rad_from_deg(settings.sun_azimuth_deg);
    const double elevation_rad = rad_from_deg(settings.sun_elevation_deg);
    return glm::vec3(glm::dvec3(
        std::cos(elevation_rad) * std::sin(azimuth_rad),
        std::cos(elevation_rad) * std::cos(azimuth_rad),
        std::sin(elevation_rad)));
}

float light_on(const glm::vec3& normal, const glm::vec3& to_sun) {
    return ambient_light + sun_light * std::max(glm::dot(normal, to_sun), 0.0F);
}

glm::vec3 own_ground_colour(
    const models::HeightField& field,
    int column,
    int row,
    const glm::vec3& normal,
    const Settings& settings) {
    const auto water_m = static_cast<float>(settings.water_level_m);
    const Site site = site_of(field, column, row, 1.0F - normal.z, water_m);
    if (site.height_m <= 0.0F && site.steepness < 1e-4F) {
        return water_colour;
    }
    return settings.palette == Palette::Arid ? arid(site) : temperate(site);
}

std::vector<std::uint32_t>
ground_colours(const models::HeightField& field, const Settings& settings) {
    const glm::vec3 sun = direction_to_sun(settings);
    std::vector<std::uint32_t> colours;
    colours.reserve(
        static_cast<std::size_t>(field.columns()) * static_cast<std::size_t>(field.rows()));
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const glm::vec3 normal = field.normal_at_sample(column, row);
            const glm::vec3 own = own_ground_colour(field, column, row, normal, settings);
            colours.push_back(models::packed_colour(own * light_on(normal, sun)));
        }
    }
    return colours;
}

glm::vec3 mean_colour(const std::vector<std::uint32_t>& colours) {
    std::array<std::uint64_t, 3> sums{};
    for (const std::uint32_t colour : colours) {
        sums[0] += colour & 0xffU;
        sums[1] += (colour >> 8U) & 0xffU;
        sums[2] += (colour >> 16U) & 0xffU;
    }
    const double scale =
        colours.empty() ? 0.0 : 1.0 / (255.0 * static_cast<double>(colours.size()));
    return glm::vec3(glm::dvec3(
        static_cast<double>(sums[0]) * scale,
        static_cast<double>(sums[1]) * scale,
        static_cast<double>(sums[2]) * scale));
}

} // namespace octant::visuals::scene
