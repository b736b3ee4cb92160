#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/backdrop.h"
#include "visuals/nature/daylight.h"
#include "visuals/scene/frame_plan.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::planning {

/// A colour at a place (world axes with the eye subtracted) as it is seen through the haze.
glm::vec3 through_haze(const scene::Haze& haze, const glm::dvec3& position_m, const glm::vec3& own);

/// What the sky shows below the horizon, where the map has ended: an endless plain.
struct SurroundingPlain {
    /// Zero, less or not finite: there is no plain, only haze.
    double height_below_eye_m = 0.0;
    /// The level distance from the eye to the nearest edge of the map.
    double map_edge_m = 0.0;
    /// The mean colour of the ground, display values 0..1.
    glm::vec3 colour{0.4F};
    /// The plain sinks with the square of the distance by this radius; 0 = it is flat.
    double earth_radius_m = 0.0;
};

/// A dome of triangles around the eye in the colours of a daylight, with the sun and its glare; the plain below it as
/// far down as the map does not cover it. What is below the horizon is made anew each frame in the same memory.
class Sky {
public:
    /// `land`: what lies around the map; may be empty.
    explicit Sky(const nature::Daylight& day, nature::Backdrop land = {});

    /// The triangles, in painting order, stay valid until the next call. The land around the map is left out from below
    /// its mean height.
    scene::TriangleDraw around(const SurroundingPlain& plain, const scene::Haze& haze, const glm::dvec3& eye_m = {});

private:
    void add_ring_triangles(std::uint32_t upper, std::uint32_t lower, int corners);
    void add_dome(const nature::Daylight& day);
    void add_sun(const nature::Daylight& day);
    void place_backdrop(const SurroundingPlain& plain, const scene::Haze& haze, const glm::dvec3& eye_m);

    /// The azimuth at which each ring of the dome begins: the sun's.
    double first_azimuth_rad_;
    nature::Backdrop land_;
    /// The land reaches so far from the world's origin along both axes.
    glm::dvec2 land_half_m_{0.0};
    /// The vertices of dome and sun, then those of the land.
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
    /// How many vertices and indices dome and sun have.
    std::size_t sky_vertices_ = 0;
    std::size_t sky_indices_ = 0;
};

} // namespace octant::visuals::planning
