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
    /// Only for water: the share of its surroundings that is land.
    float land_share = 0.0F;
};

/// Unit vector towards the sun, world axes. Azimuth clockwise from north.
glm::vec3 direction_to_sun(const scene::AirSettings& settings);

/// Colours of sky, haze and light under the settings' sun. On Mars dust colours the sky.
nature::Daylight daylight_of(const scene::AirSettings& settings, const nature::Climate& climate = {});

/// The factor of light on the colour of a surface. `normal`: unit vector, world axes.
glm::vec3 illumination(const glm::vec3& normal, const nature::Daylight& day);

/// The shadows of the ground on itself under the settings' sun; null if the settings turn them off. `same_ground`: as
/// for nature::ReliefShadows.
std::shared_ptr<const nature::ReliefShadows> make_relief_shadows(const terrain::GroundSamples& ground,
    const scene::AirSettings& settings, const nature::ReliefShadows* same_ground = nullptr);

/// The climate at a position on the earth; without a position, that of generated ground. No vegetation on other bodies.
nature::Climate climate_at(const std::optional<GeoPosition>& place);

/// The height of the water under these settings; nothing on other bodies than the earth.
std::optional<double> water_level_of(const scene::AirSettings& settings, const nature::Climate& climate);

/// Whether ground has the same colours under both: its sun, water and palette.
bool same_colours(const scene::AirSettings& a, const scene::AirSettings& b);

/// The colour of ground by position, height and slope.
class GroundPalette {
public:
    /// `terrain_shadows`: null = no shadows.
    explicit GroundPalette(const scene::AirSettings& settings, const nature::Climate& climate = {},
        std::shared_ptr<const nature::ReliefShadows> terrain_shadows = nullptr);

    /// The colour without light, display values 0..1, as the mean over an area about `footprint_m` wide.
    glm::vec3 albedo(const TerrainPoint& point, float footprint_m) const;

    /// albedo() times the light at the point, display values.
    glm::vec3 lit_colour(const TerrainPoint& point, float footprint_m) const;

    /// lit_colour(), packed; alpha is cover_code().
    std::uint32_t packed(const TerrainPoint& point, float footprint_m) const;

    /// The code of the land covers at a point (scene::LandCoverContrast), 0..255; 0 on water and nowhere else.
    float cover_code(const TerrainPoint& point, float footprint_m) const;

    /// The contrast of each land cover in the detail texture.
    scene::LandCoverContrast contrast() const;

    /// Whether a point is under water.
    bool is_water(const TerrainPoint& point) const;

    /// The density of scenery at a point.
    nature::SceneryDensity scenery_density(const TerrainPoint& point, float footprint_m) const;

    /// The share of the light that the relief leaves at a point: red, green, blue.
    glm::vec3 light_visibility(const TerrainPoint& point, float footprint_m) const;

private:
    /// albedo() and cover_code(), which cost little more than one of them.
    struct Cover {
        glm::vec3 albedo{0.0F};
        float code = 0.0F;
    };

    /// `open_sky`: nature::LightVisibility::sky there.
    Cover cover(const TerrainPoint& point, float footprint_m, float open_sky) const;
    glm::vec3 light(const TerrainPoint& point, const nature::LightVisibility& left) const;
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

/// The sample nearest to a position (world axes) with the mean slope over about `footprint_m`.
TerrainPoint nearest_point(const terrain::GroundSamples& ground, const glm::dvec2& at_m, double footprint_m);

/// Its colour as the mean over about `footprint_m`.
glm::vec3 nearest_colour(
    const terrain::GroundSamples& ground, const GroundPalette& palette, const glm::dvec2& at_m, double footprint_m);

/// Mean of packed colours, display values 0..1.
glm::vec3 mean_colour(const std::vector<std::uint32_t>& colours);

} // namespace octant::visuals::landscape
