#include "visuals/landscape/ground_palette.h"

#include "models/colour_vertex.h"
#include "sim/base/units.h"
#include "visuals/landscape/ground_cover.h"

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

nature::Climate climate_at(const std::optional<GeoPlace>& place) {
    if (!place) {
        return {};
    }
    return place->ellipsoid.is_earth()
               ? nature::climate_of(place->latitude_deg, place->longitude_deg)
               : nature::climate_elsewhere(place->ellipsoid);
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
        return glm::mix(water_colour, shallow_water, point.shore);
    }
    if (climate_.dust) {
        return dusty(site, *climate_.dust);
    }
    const float white = snow_cover(site, point.normal, climate_);
    if (climate_.arid) {
        return glm::mix(arid(site), snow_colour, white);
    }
    site.height_m = height_of_cover_m(site.height_m, climate_);
    site.summer = summer_of(climate_);
    return glm::mix(temperate(site), snow_colour, white);
}

glm::vec3 GroundPalette::lit(const GroundPoint& point, float footprint_m) const {
    const nature::LightLeft left = left_at(point, footprint_m);
    const float towards = std::max(glm::dot(point.normal, glm::vec3(daylight_.to_sun())), 0.0F);
    return own(point, footprint_m) *
           (daylight_.ambient() * left.sky + daylight_.sunlight() * (towards * left.sun));
}

std::uint32_t GroundPalette::packed(const GroundPoint& point, float footprint_m) const {
    const auto number = static_cast<std::uint32_t>(std::lround(covers(point, footprint_m)));
    return (models::packed_colour(lit(point, footprint_m)) & 0x00ffffffU) | number << 24U;
}

float GroundPalette::covers(const GroundPoint& point, float footprint_m) const {
    if (is_water(point)) {
        return 0.0F;
    }
    Site site = site_of(point, footprint_m, water_m_);
    if (climate_.dust) {
        return dusty_mixture(site);
    }
    const float white = snow_cover(site, point.normal, climate_);
    if (climate_.arid) {
        return glm::mix(arid_mixture(site), snow_number, white);
    }
    site.height_m = height_of_cover_m(site.height_m, climate_);
    site.summer = summer_of(climate_);
    return glm::mix(temperate_mixture(site), snow_number, white);
}

scene::CoverContrast GroundPalette::contrast() const {
    if (climate_.dust) {
        return scene::CoverContrast(dusty_covers(*climate_.dust));
    }
    return scene::CoverContrast(climate_.arid ? arid_covers() : temperate_covers());
}

bool GroundPalette::is_water(const GroundPoint& point) const {
    return !climate_.dust && point.height_m <= water_m_ && 1.0F - point.normal.z < 1e-4F;
}

nature::Growth GroundPalette::growth(const GroundPoint& point, float footprint_m) const {
    nature::Growth growth;
    growth.sun = left_at(point, footprint_m).sun;
    Site site = site_of(point, footprint_m, water_m_);
    const float white = snow_cover(site, point.normal, climate_);
    if (climate_.dust || is_water(point) || site.steepness > 0.16F || white > 0.5F) {
        return growth;
    }
    if (climate_.arid) {
        growth.shrubs = 0.12F + 0.35F * shrubs_of(site);
        return growth;
    }
    site.height_m = height_of_cover_m(site.height_m, climate_);
    site.summer = summer_of(climate_);
    const Cover cover = cover_of(site);
    const float trees =
        0.85F * cover.wooded + 0.02F * site.summer * cover.below_trees * (1.0F - cover.farmed);
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
