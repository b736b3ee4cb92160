#pragma once

#include "models/colour_vertex.h"
#include "visuals/scene/frame_plan.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// What the sky shows below the horizon, where the map has ended: an endless plain.
struct Plain {
    double height_below_eye_m = 0.0; ///< zero, less or not finite = no plain, only haze
    double map_edge_m = 0.0;         ///< level distance from the eye to the nearest edge of the map
    glm::vec3 colour{0.4F};          ///< mean colour of the ground, display values 0..1
    double earth_radius_m = 0.0;     ///< the plain sinks with the square of the distance; 0 = flat
};

/// A dome of triangles around the eye: blue overhead, pale at the horizon, the plain below it as
/// far down as the map does not cover it. Rebuilt each frame into the same memory.
class Sky {
public:
    Sky();

    /// The triangles stay valid until the next call.
    TriangleDraw around(const Plain& plain, const Haze& haze);

private:
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

} // namespace octant::visuals::scene
