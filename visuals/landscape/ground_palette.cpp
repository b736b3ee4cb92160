#include "visuals/landscape/ground_palette.h"

#include "models/colour_vertex.h"
#include "sim/base/float4.h"
#include "sim/base/units.h"
#include "visuals/nature/climate.h"
#include "visuals/scene/land_cover_contrast.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace octant::visuals::landscape {

namespace {

/// A place of ground before light falls on it.
struct SiteConditions {
    /// East and north of the field's south-west corner.
    float east_m;
    float north_m;
    /// Above the water level.
    float height_m;
    /// 1 - cosine of the slope.
    float steepness;
    /// What is smaller is seen as its mean.
    float footprint_m;
    /// Noise in [-1, 1] with features of some hundred metres.
    float patchiness;
    /// Share of the summer that fields and woods need: 0 where only heath grows.
    float summer_share = 1.0F;
    /// As nature::Climate has it, less in high mountains.
    float dryness = 0.0F;
    /// How far steep ground is bare, in strata, as in deserts: 0..1. Half-dry climates have little else.
    float bareness = 0.0F;
};

/// What covers a place of temperate ground, shares 0..1.
struct LandCover {
    float below_tree_line = 0.0F;
    float farmland = 0.0F;
    float forest_share = 0.0F;
    float rock_share = 0.0F;
};

constexpr glm::vec3 snow_colour(0.93F, 0.94F, 0.96F);

/// The covers of ground for scene::LandCoverContrast, by their numbers: woods or shrubs, meadows or bare soil, rock and
/// snow.
constexpr float woods_code = 64.0F;
constexpr float meadow_code = 128.0F;
constexpr float rock_code = 192.0F;
constexpr float snow_code = 255.0F;

struct ColourStop {
    float height_m;
    glm::vec3 colour;
};

// Cover of level ground by height above the water, and what shows where it is steep.
constexpr std::array meadow_stops = {ColourStop{0.0F, {0.44F, 0.48F, 0.29F}}, ColourStop{300.0F, {0.37F, 0.47F, 0.22F}},
    ColourStop{1100.0F, {0.36F, 0.42F, 0.23F}}, ColourStop{1600.0F, {0.44F, 0.44F, 0.29F}},
    ColourStop{2000.0F, {0.49F, 0.475F, 0.38F}}};
constexpr glm::vec3 heath(0.40F, 0.38F, 0.24F);
constexpr glm::vec3 dry_grass(0.56F, 0.52F, 0.34F);
constexpr glm::vec3 steppe(0.60F, 0.54F, 0.37F); ///< grass of dry climates
constexpr glm::vec3 forest(0.14F, 0.25F, 0.12F);
constexpr float tree_line_m = 1500.0F; ///< for which the stops are meant ...
constexpr float snow_line_m = 2350.0F; ///< ... and the line of lasting snow
constexpr std::array crops = {glm::vec3(0.62F, 0.56F, 0.33F), glm::vec3(0.36F, 0.46F, 0.22F),
    glm::vec3(0.45F, 0.51F, 0.26F), glm::vec3(0.47F, 0.41F, 0.28F)};
const glm::vec3 mean_crop = 0.25F * (crops[0] + crops[1] + crops[2] + crops[3]);
constexpr std::array arid_stops = {ColourStop{0.0F, {0.46F, 0.36F, 0.26F}}, ColourStop{900.0F, {0.57F, 0.42F, 0.29F}},
    ColourStop{1300.0F, {0.64F, 0.48F, 0.33F}}, ColourStop{1700.0F, {0.67F, 0.54F, 0.38F}},
    ColourStop{2050.0F, {0.60F, 0.54F, 0.36F}}, ColourStop{2400.0F, {0.42F, 0.45F, 0.28F}}};
constexpr glm::vec3 temperate_rock(0.49F, 0.47F, 0.395F);
constexpr glm::vec3 scree(0.54F, 0.52F, 0.46F);
constexpr glm::vec3 shrubs(0.36F, 0.36F, 0.22F);
constexpr glm::vec3 chaparral(0.29F, 0.31F, 0.17F); ///< closed shrubs of half-dry climates
constexpr float shrub_share = 0.35F;                ///< of ground where they grow
constexpr glm::vec3 hedge(0.19F, 0.29F, 0.13F);
/// Patches of snow are thin at their borders: less bright than closed snow.
constexpr scene::LandCover snow_on_ground{glm::vec3(0.72F, 0.72F, 0.71F), 0.03F};
constexpr float bare_rock_share = 0.78F; ///< of the brightness of dust, without it
constexpr float band_m = 85.0F;          ///< thickness of a stratum of arid rock ...
constexpr float ledge_m = 13.0F;         ///< ... of a layer within it ...
constexpr float bed_m = 3.5F;            ///< ... and of a bed within that
constexpr float field_m = 260.0F;        ///< east to west ...
constexpr float row_m = 180.0F;          ///< ... and south to north

constexpr std::uint32_t column_factor = 0x9e3779b1U;
constexpr std::uint32_t row_factor = 0x85ebca77U;

/// Mixes whole numbers of a place, or of four, to 24 bits.
template <typename Bits>
Bits lattice_bits(Bits h) {
    h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
    h = (h ^ (h >> 12U)) * 0x297a2d39U;
    return (h ^ (h >> 15U)) >> 8U;
}

/// Whole-number noise in [0, 1): the same bits on every machine.
float lattice_noise(int column, int row) {
    const std::uint32_t h =
        static_cast<std::uint32_t>(column) * column_factor ^ static_cast<std::uint32_t>(row) * row_factor;
    return static_cast<float>(lattice_bits(h)) * (1.0F / 16777216.0F);
}

/// lattice_noise() of a place, of the one east of it, and of those north of both.
Float4 lattice_noises(int column, int row) {
    using Bits4 = std::uint32_t __attribute__((vector_size(16)));
    const std::uint32_t west = static_cast<std::uint32_t>(column) * column_factor;
    const std::uint32_t south = static_cast<std::uint32_t>(row) * row_factor;
    const std::uint32_t east = west + column_factor;
    const std::uint32_t north = south + row_factor;
    const auto bits =
        reinterpret_cast<Mask4>(lattice_bits(Bits4{west, east, west, east} ^ Bits4{south, south, north, north}));
    return __builtin_convertvector(bits, Float4) * splat4(1.0F / 16777216.0F);
}

/// The whole number at or below a number that is far from the ends of int: without the C library's function, which
/// costs more than all the rest of a cell's noise.
int floored(float number) {
    const int towards_zero = static_cast<int>(number);
    return towards_zero - (static_cast<float>(towards_zero) > number ? 1 : 0);
}

int cell_of(float at_m, float cell_m) { return floored(at_m / cell_m); }

/// Smooth noise in [-1, 1] whose features are `cell_m` wide.
float patch_noise(float east_m, float north_m, float cell_m) {
    const float x = east_m / cell_m;
    const float y = north_m / cell_m;
    const int i = floored(x);
    const int j = floored(y);
    const float u = x - static_cast<float>(i);
    const float v = y - static_cast<float>(j);
    const float su = u * u * (3.0F - 2.0F * u);
    const float sv = v * v * (3.0F - 2.0F * v);
    const Float4 parts = lattice_noises(i, j) * Float4{1.0F - su, su, 1.0F - su, su};
    return 2.0F * glm::mix(parts[0] + parts[1], parts[2] + parts[3], sv) - 1.0F;
}

glm::vec3 stop_colour(std::span<const ColourStop> stops, float height_m) {
    for (std::size_t i = 1; i < stops.size(); ++i) {
        if (height_m < stops[i].height_m) {
            const float t = (height_m - stops[i - 1].height_m) / (stops[i].height_m - stops[i - 1].height_m);
            return glm::mix(stops[i - 1].colour, stops[i].colour, glm::clamp(t, 0.0F, 1.0F));
        }
    }
    return stops.back().colour;
}

/// How much is left of features `size_m` wide when seen through the footprint: all up to half their size, nothing from
/// their size on.
float visible_contrast(float size_m, float footprint_m) {
    return glm::clamp(2.0F - 2.0F * footprint_m / size_m, 0.0F, 1.0F);
}

SiteConditions site_conditions(const TerrainPoint& point, float footprint_m, float water_m) {
    const auto patchiness = [&](float size_m) {
        const float left = visible_contrast(size_m, footprint_m);
        return left > 0.0F ? left * patch_noise(point.east_m, point.north_m, size_m) : 0.0F;
    };
    return {point.east_m, point.north_m, point.height_m - water_m, 1.0F - point.normal.z, footprint_m,
        0.6F * patchiness(740.0F) + 0.4F * patchiness(220.0F)};
}

/// How far a place lies from the border of its cell, as a share of the cell.
float distance_from_border(float at_m, float cell_m) {
    const float cells = at_m / cell_m;
    const float part = cells - static_cast<float>(floored(cells));
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
    const float drills =
        visible_contrast(24.0F, site.footprint_m) * (2.0F * distance_from_border(site.north_m, 12.0F) * 2.0F - 1.0F);
    glm::vec3 colour =
        glm::mix(mean_crop, own * (ripeness + 0.07F * drills), visible_contrast(100.0F, site.footprint_m));
    const float border_m =
        std::min(distance_from_border(east_m, field_m) * field_m, distance_from_border(site.north_m, row_m) * row_m);
    // As wide as can be seen, and as much fainter.
    const float half_width_m = std::max(3.0F, site.footprint_m);
    const float vegetated = (1.0F - glm::smoothstep(half_width_m, 2.0F * half_width_m, border_m)) *
                            (3.0F / half_width_m) * visible_contrast(40.0F, site.footprint_m);
    return glm::mix(colour, hedge, vegetated);
}

/// In [-1, 1].
float tree_speckle(const SiteConditions& site) {
    const float noise = lattice_noise(cell_of(site.east_m, 20.0F), cell_of(site.north_m, 20.0F));
    return visible_contrast(80.0F, site.footprint_m) * (2.0F * noise - 1.0F);
}

/// SiteConditions::summer_share of low ground in a climate, from the tree line: Koeppen's polar climates, whose summers
/// are too cool for trees, have it at sea level; fields are hardly seen where it is below some 800 m.
float summer_share_of(const nature::Climate& climate) { return glm::smoothstep(500.0F, 1100.0F, climate.tree_line_m); }

/// The height at which temperate ground has what grows at a place's height in its climate.
float temperate_height_m(float height_m, const nature::Climate& climate) {
    if (height_m < climate.tree_line_m) { return height_m * tree_line_m / std::max(climate.tree_line_m, 1.0F); }
    const float above = (height_m - climate.tree_line_m) / std::max(climate.snow_line_m - climate.tree_line_m, 50.0F);
    return tree_line_m + above * (snow_line_m - tree_line_m);
}

float patch_value(const SiteConditions& site, float size_m) {
    const float left = visible_contrast(size_m, site.footprint_m);
    return left > 0.0F ? left * patch_noise(site.east_m, site.north_m, size_m) : 0.0F;
}

/// How much of a place lies under snow: more on the shaded side and in hollows, where wind drops it, none where it is
/// too steep to hold. `open_sky`: nature::LightVisibility::sky, less in hollows.
float snow_share(const SiteConditions& site, const glm::vec3& normal, const nature::Climate& climate, float open_sky) {
    const float shaded_m = 400.0F * normal.y * climate.shaded_side;
    const float drifted_m = 900.0F * (1.0F - open_sky);
    const float height_m = site.height_m + shaded_m + drifted_m - climate.snow_line_m;
    constexpr float never_m = -700.0F; // the most that patches add is less
    if (height_m < never_m) { return 0.0F; }
    const float patches_m =
        150.0F * site.patchiness + 120.0F * patch_value(site, 90.0F) + 80.0F * patch_value(site, 28.0F);
    const float holds = 1.0F - glm::smoothstep(0.16F, 0.44F, site.steepness + 0.05F * site.patchiness);
    return glm::smoothstep(-350.0F, 250.0F, height_m + patches_m) * holds;
}

/// A tree line that is not drawn with a ruler.
float tree_line_height_m(const SiteConditions& site) {
    return std::max(site.height_m + 120.0F * site.patchiness, 0.0F);
}

/// What covers a place whose height is what temperate_height_m() gives. Noise that a share of zero would be multiplied
/// with is not computed: the same holds below.
LandCover land_cover(const SiteConditions& site) {
    LandCover cover;
    cover.below_tree_line =
        1.0F - glm::smoothstep(tree_line_m - 200.0F, tree_line_m + 200.0F, tree_line_height_m(site));
    const float level = 1.0F - glm::smoothstep(0.0010F, 0.0035F, site.steepness);
    const float moist = 1.0F - glm::smoothstep(0.35F, 0.65F, site.dryness);
    const float arable = site.summer_share * cover.below_tree_line * level * moist;
    if (arable > 0.0F) {
        cover.farmland =
            arable * glm::smoothstep(-0.15F, 0.05F, patch_noise(site.east_m, site.north_m + 1e5F, 1220.0F));
    }
    const float wild = 1.0F - cover.farmland;
    if (cover.below_tree_line > 0.0F && wild > 0.0F) {
        const float growth = site.patchiness + 0.5F * patch_value(site, 100.0F) + 5.0F * site.steepness - 0.12F -
                             0.55F * (1.0F - site.summer_share) - 0.7F * site.dryness;
        cover.forest_share = glm::smoothstep(0.0F, 0.16F, growth) * cover.below_tree_line * wild;
    }
    cover.rock_share = glm::smoothstep(glm::mix(0.14F, 0.07F, site.bareness), glm::mix(0.30F, 0.26F, site.bareness),
        site.steepness + 0.03F * site.patchiness);
    return cover;
}

/// Brighter and darker patches of several sizes, each as far as the footprint leaves it: about 1.
float mottling(const SiteConditions& site, float coarsest_m, float strength) {
    float sum = 0.0F;
    for (float size_m = coarsest_m; size_m > 2.0F; size_m *= 0.31F) { sum += patch_value(site, size_m); }
    return 1.0F + strength * sum;
}

/// How much of a place at the foot of steep ground is covered by loose stones, in streaks.
float scree_cover(const SiteConditions& site) {
    const float steep = glm::smoothstep(0.06F, 0.13F, site.steepness);
    if (steep <= 0.0F) { return 0.0F; }
    const float streaks = 0.5F * site.patchiness + 0.6F * patch_value(site, 45.0F) + 0.4F * patch_value(site, 14.0F);
    return steep * glm::smoothstep(-0.1F, 0.35F, streaks);
}

/// The share of a place that loose stones show, from scree_cover().
constexpr float scree_share = 0.6F;

/// Own colour of bare rock of dry climates, display values: layers by height above the water.
glm::vec3 strata_colour(const SiteConditions& site) {
    const float height_m = site.height_m + 12.0F * site.patchiness;
    const auto layer = [&](float thickness_m, int which) {
        return lattice_noise(cell_of(height_m, thickness_m), which);
    };
    // A footprint reaches as far down as the ground is steep.
    const float down_m = site.footprint_m * std::min(std::sqrt(2.0F * site.steepness), 1.0F);
    const float ledges = visible_contrast(2.0F * ledge_m, down_m) * (layer(ledge_m, 11) - 0.5F) +
                         visible_contrast(2.0F * bed_m, down_m) * (layer(bed_m, 13) - 0.5F);
    return glm::mix(glm::vec3(0.50F, 0.36F, 0.24F), glm::vec3(0.74F, 0.63F, 0.46F), layer(band_m, 7)) *
           (1.0F + 0.22F * ledges) * mottling(site, 40.0F, 0.07F);
}

/// The colour of temperate ground before light falls on it, display values. The height of the place is what
/// temperate_height_m() gives; `cover` and `stones` are what land_cover() and scree_cover() give, `strata` what
/// strata_colour() does.
glm::vec3 temperate_colour(const SiteConditions& site, const LandCover& cover, float stones, const glm::vec3& strata) {
    glm::vec3 colour(0.0F);
    if (cover.farmland < 1.0F) {
        const float dryness = 0.5F + 0.5F * patch_noise(site.east_m + 1e5F, site.north_m, 1660.0F);
        colour = glm::mix(
            stop_colour(meadow_stops, tree_line_height_m(site)), dry_grass, 0.45F * dryness * cover.below_tree_line);
        colour = glm::mix(colour, heath, 0.6F * (1.0F - site.summer_share));
        colour = glm::mix(colour, steppe, std::min(1.6F * site.dryness, 0.9F)) * mottling(site, 75.0F, 0.10F);
    }
    if (cover.farmland > 0.0F) { colour = glm::mix(colour, field_crop(site), cover.farmland); }
    if (cover.forest_share > 0.0F) {
        const glm::vec3 plants = glm::mix(forest, chaparral, std::min(2.0F * site.dryness, 1.0F));
        const glm::vec3 canopy = plants * (1.0F + 0.15F * tree_speckle(site)) * mottling(site, 110.0F, 0.14F);
        colour = glm::mix(colour, canopy, 0.9F * cover.forest_share);
    }
    if (stones > 0.0F) { colour = glm::mix(colour, scree * mottling(site, 20.0F, 0.10F), scree_share * stones); }
    if (cover.rock_share > 0.0F) {
        const glm::vec3 rock = temperate_rock * (1.0F + 0.10F * site.patchiness) * mottling(site, 60.0F, 0.13F);
        colour = glm::mix(colour, glm::mix(rock, strata, site.bareness), cover.rock_share);
    }
    return colour;
}

/// Share of desert ground that shrubs cover, 0..1.
float shrub_cover(const SiteConditions& site) {
    return glm::smoothstep(0.1F, 0.5F, site.patchiness + 0.6F * patch_value(site, 60.0F));
}

float arid_rock(const SiteConditions& site) { return glm::smoothstep(0.05F, 0.25F, site.steepness); }

/// Own colour of desert ground, display values; `strata`: strata_colour().
glm::vec3 arid_colour(const SiteConditions& site, const glm::vec3& strata) {
    const glm::vec3 level = stop_colour(arid_stops, site.height_m + 60.0F * site.patchiness);
    const glm::vec3 vegetated = glm::mix(level, shrubs, shrub_share * shrub_cover(site)) * mottling(site, 90.0F, 0.09F);
    return glm::mix(vegetated, strata, arid_rock(site)) * (1.0F + 0.10F * site.patchiness);
}

/// Own colour of ground on which nothing but this dust lies, display values: bare where it is steep.
glm::vec3 dust_colour(const SiteConditions& site, const glm::vec3& dust) {
    const glm::vec3 level = dust * mottling(site, 300.0F, 0.09F);
    const glm::vec3 rock = bare_rock_share * dust * mottling(site, 40.0F, 0.09F);
    return glm::mix(level, rock, arid_rock(site)) * (1.0F + 0.10F * site.patchiness);
}

/// Meadow and rock differ less in hue than where both are seen alone: above the tree line turf is nearly as grey as
/// rock, which by a green meadow's share would look pink.
std::array<scene::LandCover, scene::LandCoverContrast::covers> temperate_covers() {
    return {scene::LandCover{forest, 0.31F}, scene::LandCover{{0.385F, 0.425F, 0.285F}, 0.125F},
        scene::LandCover{{0.47F, 0.455F, 0.37F}, 0.185F}, snow_on_ground};
}

std::array<scene::LandCover, scene::LandCoverContrast::covers> arid_covers() {
    return {scene::LandCover{shrubs, 0.27F}, scene::LandCover{arid_stops[1].colour, 0.115F},
        scene::LandCover{arid_stops[2].colour, 0.185F}, snow_on_ground};
}

std::array<scene::LandCover, scene::LandCoverContrast::covers> dust_covers(const glm::vec3& dust) {
    return {scene::LandCover{dust, 0.05F}, scene::LandCover{dust, 0.09F},
        scene::LandCover{bare_rock_share * dust, 0.15F}, snow_on_ground};
}

/// What temperate_colour() is mixed of, as the number of a cover; at least woods_code. The next two do so for theirs.
float temperate_cover_code(const LandCover& cover, float stones) {
    const float vegetated = glm::mix(meadow_code, woods_code, cover.forest_share);
    return glm::mix(vegetated, rock_code, std::max(cover.rock_share, scree_share * stones));
}

float arid_cover_code(const SiteConditions& site) {
    const float vegetated = glm::mix(meadow_code, woods_code, shrub_share * shrub_cover(site));
    return glm::mix(vegetated, rock_code, arid_rock(site));
}

/// The same kinds of cover in climates of all dryness: a share of each.
std::array<scene::LandCover, scene::LandCoverContrast::covers> mixed_covers(float arid_share) {
    std::array<scene::LandCover, scene::LandCoverContrast::covers> covers = temperate_covers();
    const auto arid = arid_covers();
    for (std::size_t i = 0; i < covers.size(); ++i) {
        covers[i].colour = glm::mix(covers[i].colour, arid[i].colour, arid_share);
        covers[i].mottling = glm::mix(covers[i].mottling, arid[i].mottling, arid_share);
    }
    return covers;
}

/// The share of desert ground that a climate or place of some dryness shows; the rest is grass and shrubs.
float arid_share_of(float dryness) { return glm::smoothstep(0.5F, 0.95F, dryness); }

/// SiteConditions::bareness of a climate: of steppes on.
float bareness_of(float dryness) { return glm::smoothstep(0.40F, 0.52F, dryness); }

/// Mountains of half-dry climates have more rain than the plains around them; deserts stay dry.
float dryness_at(float height_m, float dryness) {
    const float wetter =
        0.6F * glm::smoothstep(2200.0F, 3400.0F, height_m) * (1.0F - glm::smoothstep(0.7F, 0.9F, dryness));
    return dryness * (1.0F - wetter);
}

float dust_cover_code(const SiteConditions& site) { return glm::mix(meadow_code, rock_code, arid_rock(site)); }

constexpr glm::vec3 water_colour(0.10F, 0.21F, 0.28F);
constexpr glm::vec3 shallow_water(0.27F, 0.40F, 0.36F);

} // namespace

glm::vec3 direction_to_sun(const scene::AirSettings& settings) {
    const double azimuth_rad = rad_from_deg(settings.sun_azimuth_deg);
    const double elevation_rad = rad_from_deg(settings.sun_elevation_deg);
    return glm::vec3(glm::dvec3(std::cos(elevation_rad) * std::sin(azimuth_rad),
        std::cos(elevation_rad) * std::cos(azimuth_rad), std::sin(elevation_rad)));
}

nature::Daylight daylight_of(const scene::AirSettings& settings, const nature::Climate& climate) {
    return nature::Daylight({rad_from_deg(settings.sun_azimuth_deg), rad_from_deg(settings.sun_elevation_deg),
        settings.background, climate.has_dusty_air ? climate.dust : std::nullopt});
}

glm::vec3 illumination(const glm::vec3& normal, const nature::Daylight& day) {
    const float towards = std::max(glm::dot(normal, glm::vec3(day.to_sun())), 0.0F);
    return day.ambient() + day.sunlight() * towards;
}

bool same_colours(const scene::AirSettings& a, const scene::AirSettings& b) {
    return a.sun_azimuth_deg == b.sun_azimuth_deg && a.sun_elevation_deg == b.sun_elevation_deg &&
           a.relief_shadows == b.relief_shadows && a.water_level_m == b.water_level_m && a.palette == b.palette;
}

std::shared_ptr<const nature::ReliefShadows> make_relief_shadows(const terrain::GroundSamples& ground,
    const scene::AirSettings& settings, const nature::ReliefShadows* same_ground) {
    return settings.relief_shadows ? std::make_shared<const nature::ReliefShadows>(
                                         ground, glm::dvec3(direction_to_sun(settings)), same_ground)
                                   : nullptr;
}

nature::Climate climate_at(const std::optional<GeoPosition>& place) {
    if (!place) { return {}; }
    return place->ellipsoid.is_earth() ? nature::climate_of(place->latitude_deg, place->longitude_deg)
                                       : nature::extraterrestrial_climate(place->ellipsoid);
}

std::optional<double> water_level_of(const scene::AirSettings& settings, const nature::Climate& climate) {
    return climate.dust ? std::nullopt : std::optional(settings.water_level_m);
}

GroundPalette::GroundPalette(const scene::AirSettings& settings, const nature::Climate& climate,
    std::shared_ptr<const nature::ReliefShadows> terrain_shadows)
    : daylight_(daylight_of(settings)), climate_(climate), terrain_shadows_(std::move(terrain_shadows)),
      water_m_(static_cast<float>(settings.water_level_m)) {
    if (settings.palette && !climate_.dust) {
        climate_.dryness = settings.palette == scene::Palette::Arid ? 1.0F : 0.0F;
    }
}

GroundPalette::Cover GroundPalette::cover(const TerrainPoint& point, float footprint_m, float open_sky) const {
    if (is_water(point)) { return {glm::mix(water_colour, shallow_water, point.land_share), 0.0F}; }
    SiteConditions site = site_conditions(point, footprint_m, water_m_);
    if (climate_.dust) { return {dust_colour(site, *climate_.dust), dust_cover_code(site)}; }
    const float white = snow_share(site, point.normal, climate_, open_sky);
    site.dryness = dryness_at(site.height_m, climate_.dryness);
    site.bareness = bareness_of(climate_.dryness);
    const glm::vec3 strata = site.bareness > 0.0F ? strata_colour(site) : glm::vec3(0.0F);
    const float arid_share = arid_share_of(site.dryness);
    Cover bare;
    if (arid_share > 0.0F) { bare = {arid_colour(site, strata), arid_cover_code(site)}; }
    if (arid_share < 1.0F) {
        site.height_m = temperate_height_m(site.height_m, climate_);
        site.summer_share = summer_share_of(climate_);
        const LandCover cover = land_cover(site);
        const float stones = scree_cover(site);
        bare.albedo = glm::mix(temperate_colour(site, cover, stones, strata), bare.albedo, arid_share);
        bare.code = glm::mix(temperate_cover_code(cover, stones), bare.code, arid_share);
    }
    return {glm::mix(bare.albedo, snow_colour, white), glm::mix(bare.code, snow_code, white)};
}

glm::vec3 GroundPalette::albedo(const TerrainPoint& point, float footprint_m) const {
    return cover(point, footprint_m, visibility_at(point, footprint_m).sky).albedo;
}

glm::vec3 GroundPalette::light(const TerrainPoint& point, const nature::LightVisibility& left) const {
    const float towards = std::max(glm::dot(point.normal, glm::vec3(daylight_.to_sun())), 0.0F);
    return daylight_.ambient() * left.sky + daylight_.sunlight() * (towards * left.sun);
}

glm::vec3 GroundPalette::lit_colour(const TerrainPoint& point, float footprint_m) const {
    const nature::LightVisibility left = visibility_at(point, footprint_m);
    return cover(point, footprint_m, left.sky).albedo * light(point, left);
}

std::uint32_t GroundPalette::packed(const TerrainPoint& point, float footprint_m) const {
    const nature::LightVisibility left = visibility_at(point, footprint_m);
    const Cover own = cover(point, footprint_m, left.sky);
    const auto code = static_cast<std::uint32_t>(std::lround(own.code));
    return (models::packed_colour(own.albedo * light(point, left)) & 0x00ffffffU) | code << 24U;
}

float GroundPalette::cover_code(const TerrainPoint& point, float footprint_m) const {
    return cover(point, footprint_m, visibility_at(point, footprint_m).sky).code;
}

scene::LandCoverContrast GroundPalette::contrast() const {
    const glm::dvec3& to_sun = daylight_.to_sun();
    return {climate_.dust ? dust_covers(*climate_.dust) : mixed_covers(arid_share_of(climate_.dryness)),
        scene::detail_pattern(std::atan2(to_sun.x, to_sun.y))};
}

bool GroundPalette::is_water(const TerrainPoint& point) const {
    return !climate_.dust && point.height_m <= water_m_ && 1.0F - point.normal.z < 1e-4F;
}

nature::SceneryDensity GroundPalette::scenery_density(const TerrainPoint& point, float footprint_m) const {
    nature::SceneryDensity scenery_density;
    const nature::LightVisibility left = visibility_at(point, footprint_m);
    scenery_density.sun = left.sun;
    SiteConditions site = site_conditions(point, footprint_m, water_m_);
    const float white = snow_share(site, point.normal, climate_, left.sky);
    if (climate_.dust || is_water(point) || site.steepness > 0.16F || white > 0.5F) { return scenery_density; }
    site.dryness = dryness_at(site.height_m, climate_.dryness);
    const float arid_share = arid_share_of(site.dryness);
    scenery_density.shrubs = arid_share * (0.12F + 0.35F * shrub_cover(site));
    if (arid_share >= 1.0F) { return scenery_density; }
    site.height_m = temperate_height_m(site.height_m, climate_);
    site.summer_share = summer_share_of(climate_);
    const LandCover cover = land_cover(site);
    const float plants =
        (1.0F - arid_share) *
        (0.85F * cover.forest_share + 0.02F * site.summer_share * cover.below_tree_line * (1.0F - cover.farmland));
    const float bushes = std::min(2.0F * site.dryness, 1.0F);
    scenery_density.shrubs += plants * bushes;
    const float trees = plants * (1.0F - bushes);
    const float conifers = glm::smoothstep(500.0F, 1100.0F, site.height_m + 300.0F * site.patchiness);
    scenery_density.conifers = trees * conifers;
    scenery_density.broadleaves = trees * (1.0F - conifers);
    const float village = patch_noise(site.east_m + 3e5F, site.north_m, 900.0F);
    scenery_density.houses = cover.farmland * (0.004F + 0.22F * glm::smoothstep(0.55F, 0.75F, village));
    return scenery_density;
}

glm::vec3 GroundPalette::light_visibility(const TerrainPoint& point, float footprint_m) const {
    return light(point, visibility_at(point, footprint_m)) /
           glm::max(illumination(point.normal, daylight_), glm::vec3(1e-3F));
}

nature::LightVisibility GroundPalette::visibility_at(const TerrainPoint& point, float footprint_m) const {
    return terrain_shadows_ ? terrain_shadows_->at(point.east_m, point.north_m, footprint_m)
                            : nature::LightVisibility();
}

TerrainPoint ground_point(const terrain::GroundSamples& ground, int column, int row, int step) {
    const int west = std::max(column - step, 0);
    const int east = std::min(column + step, ground.columns() - 1);
    const int south = std::max(row - step, 0);
    const int north = std::min(row + step, ground.rows() - 1);
    const double rise_east = ground.height_m(east, row) - ground.height_m(west, row);
    const double rise_north = ground.height_m(column, north) - ground.height_m(column, south);
    const glm::dvec3 normal(
        -rise_east / ((east - west) * ground.spacing_m()), -rise_north / ((north - south) * ground.spacing_m()), 1.0);
    const auto spacing_m = static_cast<float>(ground.spacing_m());
    return {spacing_m * static_cast<float>(column), spacing_m * static_cast<float>(row),
        static_cast<float>(ground.height_m(column, row)), glm::vec3(glm::normalize(normal))};
}

std::vector<std::uint32_t> ground_colours(
    const models::heights::HeightField& field, const scene::AirSettings& settings) {
    const terrain::GroundSamples ground(field);
    const GroundPalette palette(settings, climate_at(field.place), make_relief_shadows(ground, settings));
    const auto spacing_m = static_cast<float>(field.spacing_m());
    std::vector<std::uint32_t> colours;
    colours.reserve(static_cast<std::size_t>(field.columns()) * static_cast<std::size_t>(field.rows()));
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const TerrainPoint point = ground_point(ground, column, row, 1);
            colours.push_back(models::packed_colour(palette.lit_colour(point, spacing_m)));
        }
    }
    return colours;
}

TerrainPoint nearest_point(const terrain::GroundSamples& ground, const glm::dvec2& at_m, double footprint_m) {
    const glm::dvec2 place = ground.grid_from_world(at_m.x, at_m.y);
    const int column = std::clamp(static_cast<int>(std::lround(place.x)), 0, ground.columns() - 1);
    const int row = std::clamp(static_cast<int>(std::lround(place.y)), 0, ground.rows() - 1);
    const int step = std::max(static_cast<int>(footprint_m / (2.0 * ground.spacing_m())), 1);
    return ground_point(ground, column, row, step);
}

glm::vec3 nearest_colour(
    const terrain::GroundSamples& ground, const GroundPalette& palette, const glm::dvec2& at_m, double footprint_m) {
    return palette.lit_colour(nearest_point(ground, at_m, footprint_m), static_cast<float>(footprint_m));
}

glm::vec3 mean_colour(const std::vector<std::uint32_t>& colours) {
    std::array<std::uint64_t, 3> sums{};
    for (const std::uint32_t colour : colours) {
        sums[0] += colour & 0xffU;
        sums[1] += (colour >> 8U) & 0xffU;
        sums[2] += (colour >> 16U) & 0xffU;
    }
    const double scale = colours.empty() ? 0.0 : 1.0 / (255.0 * static_cast<double>(colours.size()));
    return glm::vec3(glm::dvec3(static_cast<double>(sums[0]) * scale, static_cast<double>(sums[1]) * scale,
        static_cast<double>(sums[2]) * scale));
}

} // namespace octant::visuals::landscape
