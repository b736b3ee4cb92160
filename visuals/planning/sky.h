#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/backdrop.h"
#include "visuals/nature/daylight.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::planning {

/// `own` mixed with the haze between the eye and a place (world axes with the eye subtracted).
glm::vec3 through_haze(const scene::Haze& haze, const glm::dvec3& position_m, const glm::vec3& own);

/// The endless plain that surrounds the map. The sky shows it below the horizon.
struct SurroundingPlain {
    /// The depth of the plain below the eye. Not finite: there is only haze.
    double height_below_eye_m = 0.0;
    /// The horizontal distance from the eye to the nearest edge of the map.
    double map_edge_m = 0.0;
    /// The mean colour of the ground, display values 0..1.
    glm::vec3 colour{0.4F};
    /// The plain sinks with the square of the distance by this radius; 0 = it is flat.
    double earth_radius_m = 0.0;
};

/// A dome of triangles around the eye in the colours of a daylight, with the sun and its glare, and below the horizon
/// the surrounding plain where the map does not cover it. The dome is made once, the rest in each frame.
class Sky {
public:
    /// `land`: the relief around the map; may be empty.
    explicit Sky(const nature::Daylight& day, nature::Backdrop land = {});

    /// Planes through the eye, normals pointing inside; a zero normal has everything inside.
    using Frustum = std::array<glm::dvec3, 4>;
    static constexpr Frustum all_around{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};

    /// The triangles, in painting order, and their vertices stay valid until the next call; those outside a plane are
    /// left out. From outside the map the land around it is left out below its mean height.
    scene::TriangleDraw around(const SurroundingPlain& plain, const scene::Haze& haze, const glm::dvec3& eye_m = {},
        const Frustum& frustum = all_around);

    /// The first of the vertices of the last around() that belongs to the land around the map.
    std::size_t first_land_vertex() const { return first_land_vertex_; }

private:
    void find_sea();
    void add_ring_triangles(std::uint32_t upper, std::uint32_t lower, int corners);
    void add_dome(const nature::Daylight& day);
    void add_sun(const nature::Daylight& day);
    void place_plain(const SurroundingPlain& plain);
    void place_land(const SurroundingPlain& plain, const glm::dvec3& eye_m);
    void find_outside(const Frustum& frustum, std::size_t vertices);
    void show_triangle(const std::uint32_t* corners, std::uint32_t first_vertex);
    void show_land(const glm::dvec2& eye_m);
    void number_shown_vertices();

    /// The azimuth at which each ring of the dome begins: the sun's.
    double first_azimuth_rad_;
    nature::Backdrop land_;
    nature::WaterReflection water_;
    /// Half the extent of the land around the world's origin along both axes.
    glm::dvec2 land_half_m_{0.0};
    glm::dvec2 map_half_m_{0.0}; ///< of the land's innermost ring
    /// The vertices of dome and sun, then those of the land.
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_; ///< of dome and sun
    /// The directions in which the corners of each ring of the dome lie, level.
    std::vector<glm::dvec3> levels_;
    /// For each of them the colour of the water beyond the land, without what it mirrors; nothing: a plain lies there.
    std::vector<std::optional<glm::vec3>> sea_;
    // Of the last frame.
    std::vector<glm::dvec3> plain_rays_; ///< of the rings below the horizon
    std::vector<glm::dvec3> land_m_;     ///< the land's vertices
    std::vector<std::int32_t> outside_;  ///< for each vertex a bit for each plane
    std::vector<std::uint8_t> is_shown_; ///< for each vertex
    std::vector<std::uint32_t> number_;  ///< for each vertex that is shown its place in shown_vertices_
    std::vector<models::ColourVertex> shown_vertices_;
    std::vector<std::uint32_t> shown_indices_;
    std::size_t first_land_vertex_ = 0; ///< in shown_vertices_
    std::size_t sky_vertices_ = 0;      ///< how many of them dome and sun have
};

/// The light, the haze and the sky of one view.
class Atmosphere {
public:
    /// Under the sun of the settings. The scene and the settings must outlive it.
    Atmosphere(const Scene& scene, const scene::AirSettings& settings);

    const nature::Daylight& daylight() const { return daylight_; }

    /// The direction to the sun: a unit vector, world axes.
    const glm::dvec3& to_sun() const { return to_sun_; }

    /// Writes light, haze and sky of a frame into its plan; valid until the next frame.
    void write(const FrameView& view, scene::FramePlan& plan);

private:
    float visibility_m(double eye_height_m) const;

    const Scene& scene_;
    const scene::AirSettings& settings_;
    nature::Daylight daylight_;
    glm::dvec3 to_sun_;
    scene::Haze haze_; ///< At the ground's mean height.
    Sky sky_;
};

} // namespace octant::visuals::planning
