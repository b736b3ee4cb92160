#pragma once

#include "models/heights/height_field.h"
#include "sim/base/earth_frame.h"
#include "visuals/nature/climate.h"
#include "visuals/nature/daylight.h"
#include "visuals/nature/relief_shadows.h"
#include "visuals/nature/scenery.h"
#include "visuals/scene/land_cover_contrast.h"
#include "visuals/scene/settings.h"
#include "visuals/terrain/ground_query.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace octant::visuals::landscape {

/// A place on the ground.
struct TerrainPoint {
    /// East and north of the field's south-west corner.
    float east_m = 0.0F;
    float north_m = 0.0F;
    /// Above datum.
    float height_m = 0.0F;
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    /// Of water: the share of its surroundings that is land.
    float land_share = 0.0F;
};

/// Unit vector towards the sun, world axes. Azimuth clockwise from north.
glm::vec3 direction_to_sun(const scene::AirSettings& settings);

/// Colours of sky, haze and light under the settings' sun.
nature::Daylight daylight_of(const scene::AirSettings& settings);

/// Light on a surface: 1 would leave its colour as it is. Unit vector, world axes.
glm::vec3 illumination(const glm::vec3& normal, const nature::Daylight& day);

/// The shadows of the ground on itself under the settings' sun; null where they want none.
std::shared_ptr<const nature::ReliefShadows> make_relief_shadows(
    const terrain::GroundSamples& ground, const scene::AirSettings& settings);

/// What grows at a place; of made ground where there is none. Nothing grows off the earth.
nature::Climate climate_at(const std::optional<GeoPosition>& place);

/// Whether ground has the same colours under both: its sun, water and palette.
bool same_colours(const scene::AirSettings& a, const scene::AirSettings& b);

/// Which colour ground has by place, height and slope: the same everywhere and for every field.
class GroundPalette {
public:
    /// Without `terrain_shadows`, all light reaches every place.
    explicit GroundPalette(const scene::AirSettings& settings, const nature::Climate& climate = {},
        std::shared_ptr<const nature::ReliefShadows> terrain_shadows = nullptr);

    /// Own colour, display values 0..1. Features smaller than `footprint_m` are seen as their mean: the size of what
    /// one colour stands for, metres.
    glm::vec3 albedo(const TerrainPoint& point, float footprint_m) const;

    /// The colour as albedo() gives it under the light that reaches the place, display values.
    glm::vec3 lit_colour(const TerrainPoint& point, float footprint_m) const;

    /// The colour as lit_colour() gives it, packed; alpha is the number of the covers that it is mixed of
    /// (scene::LandCoverContrast): 0 on water and nowhere else.
    std::uint32_t packed(const TerrainPoint& point, float footprint_m) const;

    /// The number of the covers at a place (scene::LandCoverContrast), 0..255; 0 on water.
    float cover_code(const TerrainPoint& point, float footprint_m) const;

    /// How pixels differ from the mean of the covers around them.
    scene::LandCoverContrast contrast() const;

    /// Whether a place lies under water.
    bool is_water(const TerrainPoint& point) const;

    /// What stands at a place.
    nature::SceneryDensity scenery_density(const TerrainPoint& point, float footprint_m) const;

    /// Share of the whole light on a place that the relief leaves, for each part of the colour.
    glm::vec3 light_visibility(const TerrainPoint& point, float footprint_m) const;

private:
    nature::LightVisibility visibility_at(const TerrainPoint& point, float footprint_m) const;

    nature::Daylight daylight_;
    nature::Climate climate_;
    std::shared_ptr<const nature::ReliefShadows> terrain_shadows_;
    float water_m_;
};

/// A sample of the ground; its normal is from the heights `step` samples away on each side, fewer at the border: 1 for
/// the full-resolution ground, else the mean slope of so wide a surrounding.
TerrainPoint ground_point(const terrain::GroundSamples& ground, int column, int row, int step);

/// The ground as seen: one packed colour a sample (layout of the field: row 0 south, column 0 west), coloured by
/// height, slope and water level and lit by the sun with the full-resolution normals, so that the level of detail never
/// changes the light.
std::vector<std::uint32_t> ground_colours(
    const models::heights::HeightField& field, const scene::AirSettings& settings);

/// The sample nearest to a place, world axes, with the mean slope over about `footprint_m`.
TerrainPoint nearest_point(const terrain::GroundSamples& ground, const glm::dvec2& at_m, double footprint_m);

/// Its colour as the mean over about `footprint_m`.
glm::vec3 nearest_colour(
    const terrain::GroundSamples& ground, const GroundPalette& palette, const glm::dvec2& at_m, double footprint_m);

/// Mean of packed colours, display values 0..1.
glm::vec3 mean_colour(const std::vector<std::uint32_t>& colours);

} // namespace octant::visuals::landscape
