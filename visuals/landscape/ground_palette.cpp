#include "visuals/landscape/ground_palette.h"

#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

namespace octant::visuals::landscape {

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
    Stop{2000.0F, {0.52F, 0.50F, 0.45F}}};
constexpr glm::vec3 dry_grass(0.58F, 0.55F, 0.31F);
constexpr glm::vec3 forest(0.14F, 0.25F, 0.12F);
constexpr glm::vec3 snow(0.93F, 0.94F, 0.96F);
constexpr float tree_line_m = 1500.0F; ///< for which the stops are meant ...
constexpr float snow_line_m = 2350.0F; ///< ... and the line of lasting snow
constexpr std::array crops = {
    glm::vec3(0.66F, 0.58F, 0.33F),
    glm::vec3(0.33F, 0.46F, 0.19F),
    glm::vec3(0.45F, 0.52F, 0.25F),
    glm::vec3(0.47F, 0.37F, 0.25F)};
const glm::vec3 mean_crop = 0.25F * (crops[0] + crops[1] + crops[2] + crops[3]);
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

glm::vec3 level_cover(std::span<const Stop> stops, float height_m) {
    for (std::size_t i = 1; i < stops.size(); ++i) {
        if (height_m < stops[i].height_m) {
            const float t =
                (height_m - stops[i - 1].height_m) / (stops[i].height_m - stops[i - 1].height_m);
            return glm::mix(stops[i - 1].colour, stops[i].colour, glm::clamp(t, 0.0F, 1.0F));
        }
    }
    return stops.back().colour;
}

/// A place of ground before light falls on it.
struct Site {
    float east_m;      ///< of the field's south-west corner
    float north_m;     ///< of the field's south-west corner
    float height_m;    ///< above the water level
    float steepness;   ///< 1 - cosine of the slope
    float footprint_m; ///< what is smaller is seen as its mean
    float patches;     ///< noise in [-1, 1], features of some hundred metres
};

/// How much is left of features `size_m` wide when seen through the footprint: all up to half
/// their size, nothing from their size on.
float share_left(float size_m, float footprint_m) {
    return glm::clamp(2.0F - 2.0F * footprint_m / size_m, 0.0F, 1.0F);
}

Site site_of(const GroundPoint& point, float footprint_m, float water_m) {
    const auto patches = [&](float size_m) {
        const float left = share_left(size_m, footprint_m);
        return left > 0.0F ? left * patch_noise(point.east_m, point.north_m, size_m) : 0.0F;
    };
    return {
        point.east_m,
        point.north_m,
        point.height_m - water_m,
        1.0F - point.normal.z,
        footprint_m,
        0.6F * patches(740.0F) + 0.4F * patches(220.0F)};
}

/// Farmland: fields of 260 x 180 m in rows, each with its crop.
glm::vec3 field_crop(const Site& site) {
    const int row = cell_of(site.north_m, 180.0F);
    const float pick =
        lattice_noise(cell_of(site.east_m + 120.0F * lattice_noise(0, row), 260.0F), row);
    const glm::vec3 own = crops[static_cast<std::size_t>(pick * static_cast<float>(crops.size()))];
    return glm::mix(mean_crop, own, share_left(360.0F, site.footprint_m));
}

float small_patches(const Site& site, float size_m) {
    const float left = share_left(size_m, site.footprint_m);
    return left > 0.0F ? left * patch_noise(site.east_m, site.north_m, size_m) : 0.0F;
}

/// In [-1, 1].
float single_trees(const Site& site) {
    const float noise = lattice_noise(cell_of(site.east_m, 20.0F), cell_of(site.north_m, 20.0F));
    return share_left(80.0F, site.footprint_m) * (2.0F * noise - 1.0F);
}

/// The height at which the stops have what grows at a place's height in its climate.
float height_of_cover_m(float height_m, const nature::Climate& climate) {
    if (height_m < climate.tree_line_m) {
        return height_m * tree_line_m / std::max(climate.tree_line_m, 1.0F);
    }
    const float above = (height_m - climate.tree_line_m) /
                        std::max(climate.snow_line_m - climate.tree_line_m, 50.0F);
    return tree_line_m + above * (snow_line_m - tree_line_m);
}

/// How much of a place lies under snow: more on the shaded side, none where it is too steep to
/// hold.
float snow_cover(const Site& site, const glm::vec3& normal, const nature::Climate& climate) {
    const float shaded_m = 400.0F * normal.y * climate.poleward;
    const float above_m = site.height_m + 150.0F * site.patches + shaded_m - climate.snow_line_m;
    const float holds = 1.0F - glm::smoothstep(0.20F, 0.42F, site.steepness + 0.05F * site.patches);
    return glm::smoothstep(-250.0F, 150.0F, above_m) * holds;
}

/// What covers a place of temperate ground, shares 0..1.
struct Cover {
    float below_trees = 0.0F;
    float farmed = 0.0F;
    float wooded = 0.0F;
    float bare = 0.0F;
};

/// A tree line that is not drawn with a ruler.
float height_of_line_m(const Site& site) {
    return std::max(site.height_m + 120.0F * site.patches, 0.0F);
}

Cover cover_of(const Site& site) {
    Cover cover;
    cover.below_trees =
        1.0F - glm::smoothstep(tree_line_m - 200.0F, tree_line_m + 200.0F, height_of_line_m(site));
    const float level = 1.0F - glm::smoothstep(0.0010F, 0.0035F, site.steepness);
    cover.farmed =
        cover.below_trees * level *
        glm::smoothstep(-0.15F, 0.05F, patch_noise(site.east_m, site.north_m + 1e5F, 1220.0F));
    const float growth =
        site.patches + 0.5F * small_patches(site, 100.0F) + 5.0F * site.steepness - 0.12F;
    cover.wooded = glm::smoothstep(0.0F, 0.16F, growth) * cover.below_trees * (1.0F - cover.farmed);
    cover.bare = glm::smoothstep(0.14F, 0.30F, site.steepness + 0.03F * site.patches);
    return cover;
}

glm::vec3 temperate(const Site& site) {
    const Cover cover = cover_of(site);
    const float dryness = 0.5F + 0.5F * patch_noise(site.east_m + 1e5F, site.north_m, 1660.0F);
    glm::vec3 colour = glm::mix(
        level_cover(meadow_stops, height_of_line_m(site)),
        dry_grass,
        0.45F * dryness * cover.below_trees);
    colour = glm::mix(colour, field_crop(site), cover.farmed);
    colour = glm::mix(colour, forest * (1.0F + 0.15F * single_trees(site)), 0.9F * cover.wooded);
    return glm::mix(colour, temperate_rock * (1.0F + 0.10F * site.patches), cover.bare);
}

float shrubs_of(const Site& site) {
    return glm::smoothstep(0.1F, 0.5F, site.patches + 0.6F * small_patches(site, 60.0F));
}

glm::vec3 arid(const Site& site) {
    const glm::vec3 level = level_cover(arid_stops, site.height_m + 60.0F * site.patches);
    const float stratum = (site.height_m + 12.0F * site.patches) / band_m;
    const float layer = lattice_noise(static_cast<int>(std::floor(stratum)), 7);
    const glm::vec3 rock =
        glm::mix(glm::vec3(0.55F, 0.30F, 0.19F), glm::vec3(0.78F, 0.62F, 0.45F), layer);
    const glm::vec3 grown =
        glm::mix(level, glm::vec3(0.36F, 0.36F, 0.22F), 0.35F * shrubs_of(site));
    return glm::mix(grown, rock, glm::smoothstep(0.05F, 0.25F, site.steepness)) *
           (1.0F + 0.10F * site.patches);
}

} // namespace

glm::vec3 direction_to_sun(const scene::AirSettings& settings) {
    const double azimuth_rad = rad_from_deg(settings.sun_azimuth_deg);
    const double elevation_rad = rad_from_deg(settings.sun_elevation_deg);
    return glm::vec3(glm::dvec3(
        std::cos(elevation_rad) * std::sin(azimuth_rad),
        std::cos(elevation_rad) * std::cos(azimuth_rad),
        std::sin(elevation_rad)));
}

nature::Daylight daylight_of(const scene::AirSettings& settings) {
    return nature::Daylight(
        {rad_from_deg(settings.sun_azimuth_deg),
         rad_from_deg(settings.sun_elevation_deg),
         settings.background});
}

glm::vec3 light_on(const glm::vec3& normal, const nature::Daylight& day) {
    const float towards = std::max(glm::dot(normal, glm::vec3(day.to_sun())), 0.0F);
    return day.ambient() + day.sunlight() * towards;
}

bool same_colours(const scene::AirSettings& a, const scene::AirSettings& b) {
    return a.sun_azimuth_deg == b.sun_azimuth_deg && a.sun_elevation_deg == b.sun_elevation_deg &&
           a.relief_shadows == b.relief_shadows && a.water_level_m == b.water_level_m &&
           a.palette == b.palette;
}

std::shared_ptr<const nature::ReliefLight>
relief_light(const terrain::GroundSamples& ground, const scene::AirSettings& settings) {
    return settings.relief_shadows ? std::make_shared<const nature::ReliefLight>(
                                         ground, glm::dvec3(direction_to_sun(settings)))
                                   : nullptr;
}

nature::Climate climate_at(const std::optional<models::heights::GeoPlace>& place) {
    return place ? nature::climate_of(place->latitude_deg, place->longitude_deg)
                 : nature::Climate();
}

GroundPalette::GroundPalette(
    const scene::AirSettings& settings,
    const nature::Climate& climate,
    std::shared_ptr<const nature::ReliefLight> relief)
    : daylight_(daylight_of(settings))
    , climate_(climate)
    , relief_(std::move(relief))
    , water_m_(static_cast<float>(settings.water_level_m)) {
    if (settings.palette) {
        climate_.arid = settings.palette == scene::Palette::Arid;
    }
}

glm::vec3 GroundPalette::own(const GroundPoint& point, float footprint_m) const {
    Site site = site_of(point, footprint_m, water_m_);
    if (is_water(point)) {
        return water_colour;
    }
    const float white = snow_cover(site, point.normal, climate_);
    if (climate_.arid) {
        return glm::mix(arid(site), snow, white);
    }
    site.height_m = height_of_cover_m(site.height_m, climate_);
    return glm::mix(temperate(site), snow, white);
}

glm::vec3 GroundPalette::lit(const GroundPoint& point, float footprint_m) const {
    const nature::LightLeft left = left_at(point, footprint_m);
    const float towards = std::max(glm::dot(point.normal, glm::vec3(daylight_.to_sun())), 0.0F);
    return own(point, footprint_m) *
           (daylight_.ambient() * left.sky + daylight_.sunlight() * (towards * left.sun));
}

bool GroundPalette::is_water(const GroundPoint& point) const {
    return point.height_m <= water_m_ && 1.0F - point.normal.z < 1e-4F;
}

nature::Growth GroundPalette::growth(const GroundPoint& point, float footprint_m) const {
    nature::Growth growth;
    growth.sun = left_at(point, footprint_m).sun;
    Site site = site_of(point, footprint_m, water_m_);
    const float white = snow_cover(site, point.normal, climate_);
    if (is_water(point) || site.steepness > 0.16F || white > 0.5F) {
        return growth;
    }
    if (climate_.arid) {
        growth.shrubs = 0.12F + 0.35F * shrubs_of(site);
        return growth;
    }
    site.height_m = height_of_cover_m(site.height_m, climate_);
    const Cover cover = cover_of(site);
    const float trees = 0.85F * cover.wooded + 0.02F * cover.below_trees * (1.0F - cover.farmed);
    const float conifers = glm::smoothstep(500.0F, 1100.0F, site.height_m + 300.0F * site.patches);
    growth.conifers = trees * conifers;
    growth.broadleaves = trees * (1.0F - conifers);
    const float village = patch_noise(site.east_m + 3e5F, site.north_m, 900.0F);
    growth.houses = cover.farmed * (0.004F + 0.22F * glm::smoothstep(0.55F, 0.75F, village));
    return growth;
}

glm::vec3 GroundPalette::light_left(const GroundPoint& point, float footprint_m) const {
    const nature::LightLeft left = left_at(point, footprint_m);
    const float towards = std::max(glm::dot(point.normal, glm::vec3(daylight_.to_sun())), 0.0F);
    return (daylight_.ambient() * left.sky + daylight_.sunlight() * (towards * left.sun)) /
           glm::max(light_on(point.normal, daylight_), glm::vec3(1e-3F));
}

nature::LightLeft GroundPalette::left_at(const GroundPoint& point, float footprint_m) const {
    return relief_ ? relief_->at(point.east_m, point.north_m, footprint_m) : nature::LightLeft();
}

} // namespace octant::visuals::landscape
