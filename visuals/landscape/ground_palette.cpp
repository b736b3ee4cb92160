#include "visuals/landscape/ground_palette.h"

#include "models/colour_vertex.h"
#include "sim/base/units.h"
#include "visuals/landscape/land_cover.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace octant::visuals::landscape {

namespace {

constexpr glm::vec3 water_colour(0.10F, 0.21F, 0.28F);
constexpr glm::vec3 shallow_water(0.27F, 0.40F, 0.36F);

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

glm::vec3 illumination(const glm::vec3& normal, const nature::Daylight& day) {
    const float towards = std::max(glm::dot(normal, glm::vec3(day.to_sun())), 0.0F);
    return day.ambient() + day.sunlight() * towards;
}

bool same_colours(const scene::AirSettings& a, const scene::AirSettings& b) {
    return a.sun_azimuth_deg == b.sun_azimuth_deg && a.sun_elevation_deg == b.sun_elevation_deg &&
           a.relief_shadows == b.relief_shadows && a.water_level_m == b.water_level_m &&
           a.palette == b.palette;
}

std::shared_ptr<const nature::ReliefShadows>
make_relief_shadows(const terrain::GroundSamples& ground, const scene::AirSettings& settings) {
    return settings.relief_shadows ? std::make_shared<const nature::ReliefShadows>(
                                         ground, glm::dvec3(direction_to_sun(settings)))
                                   : nullptr;
}

nature::Climate climate_at(const std::optional<GeoPosition>& place) {
    if (!place) {
        return {};
    }
    return place->ellipsoid.is_earth()
               ? nature::climate_of(place->latitude_deg, place->longitude_deg)
               : nature::extraterrestrial_climate(place->ellipsoid);
}

GroundPalette::GroundPalette(
    const scene::AirSettings& settings,
    const nature::Climate& climate,
    std::shared_ptr<const nature::ReliefShadows> terrain_shadows)
    : daylight_(daylight_of(settings))
    , climate_(climate)
    , terrain_shadows_(std::move(terrain_shadows))
    , water_m_(static_cast<float>(settings.water_level_m)) {
    if (settings.palette) {
        climate_.arid = settings.palette == scene::Palette::Arid;
    }
}

glm::vec3 GroundPalette::albedo(const TerrainPoint& point, float footprint_m) const {
    SiteConditions site = site_conditions(point, footprint_m, water_m_);
    if (is_water(point)) {
        return glm::mix(water_colour, shallow_water, point.land_share);
    }
    if (climate_.dust) {
        return dust_colour(site, *climate_.dust);
    }
    const float white = snow_share(site, point.normal, climate_);
    if (climate_.arid) {
        return glm::mix(arid_colour(site), snow_colour, white);
    }
    site.height_m = temperate_height_m(site.height_m, climate_);
    site.summer_share = summer_share_of(climate_);
    return glm::mix(temperate_colour(site), snow_colour, white);
}

glm::vec3 GroundPalette::lit_colour(const TerrainPoint& point, float footprint_m) const {
    const nature::LightVisibility left = visibility_at(point, footprint_m);
    const float towards = std::max(glm::dot(point.normal, glm::vec3(daylight_.to_sun())), 0.0F);
    return albedo(point, footprint_m) *
           (daylight_.ambient() * left.sky + daylight_.sunlight() * (towards * left.sun));
}

std::uint32_t GroundPalette::packed(const TerrainPoint& point, float footprint_m) const {
    const auto number = static_cast<std::uint32_t>(std::lround(cover_code(point, footprint_m)));
    return (models::packed_colour(lit_colour(point, footprint_m)) & 0x00ffffffU) | number << 24U;
}

float GroundPalette::cover_code(const TerrainPoint& point, float footprint_m) const {
    if (is_water(point)) {
        return 0.0F;
    }
    SiteConditions site = site_conditions(point, footprint_m, water_m_);
    if (climate_.dust) {
        return dust_cover_code(site);
    }
    const float white = snow_share(site, point.normal, climate_);
    if (climate_.arid) {
        return glm::mix(arid_cover_code(site), snow_code, white);
    }
    site.height_m = temperate_height_m(site.height_m, climate_);
    site.summer_share = summer_share_of(climate_);
    return glm::mix(temperate_cover_code(site), snow_code, white);
}

scene::LandCoverContrast GroundPalette::contrast() const {
    if (climate_.dust) {
        return scene::LandCoverContrast(dust_covers(*climate_.dust));
    }
    return scene::LandCoverContrast(climate_.arid ? arid_covers() : temperate_covers());
}

bool GroundPalette::is_water(const TerrainPoint& point) const {
    return !climate_.dust && point.height_m <= water_m_ && 1.0F - point.normal.z < 1e-4F;
}

nature::SceneryDensity GroundPalette::scenery_density(const TerrainPoint& point, float footprint_m) const {
    nature::SceneryDensity scenery_density;
    scenery_density.sun = visibility_at(point, footprint_m).sun;
    SiteConditions site = site_conditions(point, footprint_m, water_m_);
    const float white = snow_share(site, point.normal, climate_);
    if (climate_.dust || is_water(point) || site.steepness > 0.16F || white > 0.5F) {
        return scenery_density;
    }
    if (climate_.arid) {
        scenery_density.shrubs = 0.12F + 0.35F * shrub_cover(site);
        return scenery_density;
    }
    site.height_m = temperate_height_m(site.height_m, climate_);
    site.summer_share = summer_share_of(climate_);
    const LandCover cover = land_cover(site);
    const float trees =
        0.85F * cover.forest_share + 0.02F * site.summer_share * cover.below_tree_line * (1.0F - cover.farmland);
    const float conifers = glm::smoothstep(500.0F, 1100.0F, site.height_m + 300.0F * site.patchiness);
    scenery_density.conifers = trees * conifers;
    scenery_density.broadleaves = trees * (1.0F - conifers);
    const float village = patch_noise(site.east_m + 3e5F, site.north_m, 900.0F);
    scenery_density.houses = cover.farmland * (0.004F + 0.22F * glm::smoothstep(0.55F, 0.75F, village));
    return scenery_density;
}

glm::vec3 GroundPalette::light_visibility(const TerrainPoint& point, float footprint_m) const {
    const nature::LightVisibility left = visibility_at(point, footprint_m);
    const float towards = std::max(glm::dot(point.normal, glm::vec3(daylight_.to_sun())), 0.0F);
    return (daylight_.ambient() * left.sky + daylight_.sunlight() * (towards * left.sun)) /
           glm::max(illumination(point.normal, daylight_), glm::vec3(1e-3F));
}

nature::LightVisibility GroundPalette::visibility_at(const TerrainPoint& point, float footprint_m) const {
    return terrain_shadows_ ? terrain_shadows_->at(point.east_m, point.north_m, footprint_m) : nature::LightVisibility();
}

} // namespace octant::visuals::landscape
