#include "visuals/landscape/land_cover.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::visuals::landscape {

namespace {

struct ColourStop {
    float height_m;
    glm::vec3 colour;
};

// Cover of level ground by height above the water, and what shows where it is steep.
constexpr std::array meadow_stops = {
    ColourStop{0.0F, {0.46F, 0.50F, 0.28F}},
    ColourStop{300.0F, {0.37F, 0.47F, 0.22F}},
    ColourStop{1100.0F, {0.36F, 0.43F, 0.23F}},
    ColourStop{1600.0F, {0.46F, 0.46F, 0.31F}},
    ColourStop{2000.0F, {0.52F, 0.50F, 0.45F}}};
constexpr glm::vec3 heath(0.40F, 0.38F, 0.24F);
constexpr glm::vec3 dry_grass(0.58F, 0.55F, 0.31F);
constexpr glm::vec3 forest(0.14F, 0.25F, 0.12F);
constexpr float tree_line_m = 1500.0F; ///< for which the stops are meant ...
constexpr float snow_line_m = 2350.0F; ///< ... and the line of lasting snow
constexpr std::array crops = {
    glm::vec3(0.66F, 0.58F, 0.33F),
    glm::vec3(0.33F, 0.46F, 0.19F),
    glm::vec3(0.45F, 0.52F, 0.25F),
    glm::vec3(0.47F, 0.37F, 0.25F)};
const glm::vec3 mean_crop = 0.25F * (crops[0] + crops[1] + crops[2] + crops[3]);
constexpr std::array arid_stops = {
    ColourStop{0.0F, {0.45F, 0.33F, 0.24F}},
    ColourStop{900.0F, {0.58F, 0.38F, 0.26F}},
    ColourStop{1300.0F, {0.66F, 0.44F, 0.30F}},
    ColourStop{1700.0F, {0.68F, 0.52F, 0.36F}},
    ColourStop{2050.0F, {0.60F, 0.54F, 0.36F}},
    ColourStop{2400.0F, {0.42F, 0.45F, 0.28F}}};
constexpr glm::vec3 temperate_rock(0.47F, 0.44F, 0.41F);
constexpr glm::vec3 scree(0.54F, 0.51F, 0.46F);
constexpr glm::vec3 shrubs(0.36F, 0.36F, 0.22F);
constexpr float shrub_share = 0.35F; ///< of ground where they grow
constexpr glm::vec3 hedge(0.19F, 0.29F, 0.13F);
constexpr scene::LandCover snow_on_ground{snow_colour, 0.03F};
constexpr float bare_rock_share = 0.78F; ///< of the brightness of dust, without it
constexpr float band_m = 85.0F;          ///< thickness of a stratum of arid rock ...
constexpr float ledge_m = 13.0F;         ///< ... of a layer within it ...
constexpr float bed_m = 3.5F;            ///< ... and of a bed within that
constexpr float field_m = 260.0F;        ///< east to west ...
constexpr float row_m = 180.0F;          ///< ... and south to north

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

} // namespace

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

namespace {

glm::vec3 stop_colour(std::span<const ColourStop> stops, float height_m) {
    for (std::size_t i = 1; i < stops.size(); ++i) {
        if (height_m < stops[i].height_m) {
            const float t =
                (height_m - stops[i - 1].height_m) / (stops[i].height_m - stops[i - 1].height_m);
            return glm::mix(stops[i - 1].colour, stops[i].colour, glm::clamp(t, 0.0F, 1.0F));
        }
    }
    return stops.back().colour;
}

/// How much is left of features `size_m` wide when seen through the footprint: all up to half
/// their size, nothing from their size on.
float visible_contrast(float size_m, float footprint_m) {
    return glm::clamp(2.0F - 2.0F * footprint_m / size_m, 0.0F, 1.0F);
}

} // namespace

SiteConditions site_conditions(const TerrainPoint& point, float footprint_m, float water_m) {
    const auto patchiness = [&](float size_m) {
        const float left = visible_contrast(size_m, footprint_m);
        return left > 0.0F ? left * patch_noise(point.east_m, point.north_m, size_m) : 0.0F;
    };
    return {
        point.east_m,
        point.north_m,
        point.height_m - water_m,
        1.0F - point.normal.z,
        footprint_m,
        0.6F * patchiness(740.0F) + 0.4F * patchiness(220.0F)};
}

namespace {

/// How far a place lies from the border of its cell, as a share of the cell.
float distance_from_border(float at_m, float cell_m) {
    const float part = at_m / cell_m - std::floor(at_m / cell_m);
    return std::min(part, 1.0F - part);
}

/// Farmland: fields in rows, each with its crop in drills along it, and hedges between them.
glm::vec3 field_crop(const SiteConditions& site) {
    const int row = cell_of(site.north_m, row_m);
    const float east_m = site.east_m + 120.0F * lattice_noise(0, row);
    const int column = cell_of(east_m, field_m);
    const float pick = lattice_noise(column, row);
    const glm::vec3 own = crops[static_cast<std::size_t>(pick * static_cast<float>(crops.size()))];
    const float ripeness = 0.88F + 0.24F * lattice_noise(row, column);
    const float drills = visible_contrast(24.0F, site.footprint_m) *
                         (2.0F * distance_from_border(site.north_m, 12.0F) * 2.0F - 1.0F);
    glm::vec3 colour = glm::mix(
        mean_crop, own * (ripeness + 0.07F * drills), visible_contrast(360.0F, site.footprint_m));
    const float border_m =
        std::min(distance_from_border(east_m, field_m) * field_m, distance_from_border(site.north_m, row_m) * row_m);
    // As wide as can be seen, and as much fainter.
    const float half_width_m = std::max(3.0F, site.footprint_m);
    const float vegetated = (1.0F - glm::smoothstep(half_width_m, 2.0F * half_width_m, border_m)) *
                        (3.0F / half_width_m) * visible_contrast(40.0F, site.footprint_m);
    return glm::mix(colour, hedge, vegetated);
}

float patch_value(const SiteConditions& site, float size_m) {
    const float left = visible_contrast(size_m, site.footprint_m);
    return left > 0.0F ? left * patch_noise(site.east_m, site.north_m, size_m) : 0.0F;
}

/// In [-1, 1].
float tree_speckle(const SiteConditions& site) {
    const float noise = lattice_noise(cell_of(site.east_m, 20.0F), cell_of(site.north_m, 20.0F));
    return visible_contrast(80.0F, site.footprint_m) * (2.0F * noise - 1.0F);
}

} // namespace

/// By the tree line: Koeppen's polar climates, whose summers are too cool for trees, have it at the
/// sea; fields are hardly seen where it is below some 800 m.
float summer_share_of(const nature::Climate& climate) {
    return glm::smoothstep(500.0F, 1100.0F, climate.tree_line_m);
}

float temperate_height_m(float height_m, const nature::Climate& climate) {
    if (height_m < climate.tree_line_m) {
        return height_m * tree_line_m / std::max(climate.tree_line_m, 1.0F);
    }
    const float above = (height_m - climate.tree_line_m) /
                        std::max(climate.snow_line_m - climate.tree_line_m, 50.0F);
    return tree_line_m + above * (snow_line_m - tree_line_m);
}

float snow_share(const SiteConditions& site, const glm::vec3& normal, const nature::Climate& climate) {
    const float shaded_m = 400.0F * normal.y * climate.shaded_side;
    const float above_m = site.height_m + 150.0F * site.patchiness + shaded_m - climate.snow_line_m;
    const float holds = 1.0F - glm::smoothstep(0.20F, 0.42F, site.steepness + 0.05F * site.patchiness);
    return glm::smoothstep(-250.0F, 150.0F, above_m) * holds;
}

namespace {

/// A tree line that is not drawn with a ruler.
float tree_line_height_m(const SiteConditions& site) {
    return std::max(site.height_m + 120.0F * site.patchiness, 0.0F);
}

} // namespace

LandCover land_cover(const SiteConditions& site) {
    LandCover cover;
    cover.below_tree_line =
        1.0F - glm::smoothstep(tree_line_m - 200.0F, tree_line_m + 200.0F, tree_line_height_m(site));
    const float level = 1.0F - glm::smoothstep(0.0010F, 0.0035F, site.steepness);
    cover.farmland =
        site.summer_share * cover.below_tree_line * level *
        glm::smoothstep(-0.15F, 0.05F, patch_noise(site.east_m, site.north_m + 1e5F, 1220.0F));
    const float growth = site.patchiness + 0.5F * patch_value(site, 100.0F) + 5.0F * site.steepness -
                         0.12F - 0.55F * (1.0F - site.summer_share);
    cover.forest_share = glm::smoothstep(0.0F, 0.16F, growth) * cover.below_tree_line * (1.0F - cover.farmland);
    cover.rock_share = glm::smoothstep(0.14F, 0.30F, site.steepness + 0.03F * site.patchiness);
    return cover;
}

namespace {

/// Brighter and darker patches of several sizes, each as far as the footprint leaves it: about 1.
float mottling(const SiteConditions& site, float coarsest_m, float strength) {
    float sum = 0.0F;
    for (float size_m = coarsest_m; size_m > 2.0F; size_m *= 0.31F) {
        sum += patch_value(site, size_m);
    }
    return 1.0F + strength * sum;
}

/// How much of a place at the foot of steep ground is covered by loose stones, in streaks.
float scree_cover(const SiteConditions& site) {
    const float steep = glm::smoothstep(0.06F, 0.13F, site.steepness);
    const float streaks =
        0.5F * site.patchiness + 0.6F * patch_value(site, 45.0F) + 0.4F * patch_value(site, 14.0F);
    return steep * glm::smoothstep(-0.1F, 0.35F, streaks);
}

} // namespace

glm::vec3 temperate_colour(const SiteConditions& site) {
    const LandCover cover = land_cover(site);
    const float dryness = 0.5F + 0.5F * patch_noise(site.east_m + 1e5F, site.north_m, 1660.0F);
    glm::vec3 colour = glm::mix(
        stop_colour(meadow_stops, tree_line_height_m(site)),
        dry_grass,
        0.45F * dryness * cover.below_tree_line);
    colour = glm::mix(colour, heath, 0.6F * (1.0F - site.summer_share)) * mottling(site, 75.0F, 0.10F);
    colour = glm::mix(colour, field_crop(site), cover.farmland);
    const glm::vec3 canopy =
        forest * (1.0F + 0.15F * tree_speckle(site)) * mottling(site, 110.0F, 0.14F);
    colour = glm::mix(colour, canopy, 0.9F * cover.forest_share);
    colour = glm::mix(colour, scree * mottling(site, 20.0F, 0.10F), 0.6F * scree_cover(site));
    const glm::vec3 rock = temperate_rock * (1.0F + 0.10F * site.patchiness);
    return glm::mix(colour, rock * mottling(site, 60.0F, 0.13F), cover.rock_share);
}

float shrub_cover(const SiteConditions& site) {
    return glm::smoothstep(0.1F, 0.5F, site.patchiness + 0.6F * patch_value(site, 60.0F));
}

namespace {

float arid_rock(const SiteConditions& site) {
    return glm::smoothstep(0.05F, 0.25F, site.steepness);
}

} // namespace

glm::vec3 arid_colour(const SiteConditions& site) {
    const glm::vec3 level = stop_colour(arid_stops, site.height_m + 60.0F * site.patchiness);
    const float height_m = site.height_m + 12.0F * site.patchiness;
    const auto layer = [&](float thickness_m, int which) {
        return lattice_noise(cell_of(height_m, thickness_m), which);
    };
    // A footprint reaches as far down as the ground is steep.
    const float down_m = site.footprint_m * std::min(std::sqrt(2.0F * site.steepness), 1.0F);
    const float ledges = visible_contrast(2.0F * ledge_m, down_m) * (layer(ledge_m, 11) - 0.5F) +
                         visible_contrast(2.0F * bed_m, down_m) * (layer(bed_m, 13) - 0.5F);
    const glm::vec3 rock =
        glm::mix(glm::vec3(0.55F, 0.30F, 0.19F), glm::vec3(0.78F, 0.62F, 0.45F), layer(band_m, 7)) *
        (1.0F + 0.22F * ledges) * mottling(site, 40.0F, 0.07F);
    const glm::vec3 vegetated =
        glm::mix(level, shrubs, shrub_share * shrub_cover(site)) * mottling(site, 90.0F, 0.09F);
    return glm::mix(vegetated, rock, arid_rock(site)) * (1.0F + 0.10F * site.patchiness);
}

glm::vec3 dust_colour(const SiteConditions& site, const glm::vec3& dust) {
    const glm::vec3 level = dust * mottling(site, 300.0F, 0.09F);
    const glm::vec3 rock = bare_rock_share * dust * mottling(site, 40.0F, 0.09F);
    return glm::mix(level, rock, arid_rock(site)) * (1.0F + 0.10F * site.patchiness);
}

std::array<scene::LandCover, scene::LandCoverContrast::covers> temperate_covers() {
    return {
        scene::LandCover{forest, 0.17F},
        scene::LandCover{meadow_stops[1].colour, 0.08F},
        scene::LandCover{{0.45F, 0.44F, 0.39F}, 0.15F},
        snow_on_ground};
}

std::array<scene::LandCover, scene::LandCoverContrast::covers> arid_covers() {
    return {
        scene::LandCover{shrubs, 0.15F},
        scene::LandCover{arid_stops[1].colour, 0.09F},
        scene::LandCover{arid_stops[2].colour, 0.15F},
        snow_on_ground};
}

std::array<scene::LandCover, scene::LandCoverContrast::covers> dust_covers(const glm::vec3& dust) {
    return {
        scene::LandCover{dust, 0.05F},
        scene::LandCover{dust, 0.09F},
        scene::LandCover{bare_rock_share * dust, 0.15F},
        snow_on_ground};
}

float temperate_cover_code(const SiteConditions& site) {
    const LandCover cover = land_cover(site);
    const float vegetated = glm::mix(meadow_code, woods_code, cover.forest_share);
    return glm::mix(vegetated, rock_code, std::max(cover.rock_share, 0.6F * scree_cover(site)));
}

float arid_cover_code(const SiteConditions& site) {
    const float vegetated = glm::mix(meadow_code, woods_code, shrub_share * shrub_cover(site));
    return glm::mix(vegetated, rock_code, arid_rock(site));
}

float dust_cover_code(const SiteConditions& site) {
    return glm::mix(meadow_code, rock_code, arid_rock(site));
}

} // namespace octant::visuals::landscape
