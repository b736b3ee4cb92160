#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace octant::visuals::planning {

/// What lies on a triangle of the ground, in the order in which it is painted after it.
enum class GroundLayer : std::uint32_t { Shadow, Surface, Marking, ShadowOnDecal };

/// A convex polygon in the plane of a triangle of the ground and inside it, opaque and of one colour: that of a vertex
/// without the ground's fine pattern or texture.
struct GroundDecal {
    std::uint32_t triangle = 0; ///< its number in GroundMesher::triangles()
    std::uint32_t first = 0;    ///< of its corners
    std::uint32_t count = 0;
    std::uint32_t colour = 0;
    GroundLayer layer = GroundLayer::Surface;
};

/// Corners lie in world axes with the eye subtracted, counter-clockwise seen from above.
struct GroundDecals {
    std::span<const GroundDecal> decals;
    std::span<const glm::dvec3> corners;
};

/// What corners of a layer are multiplied by: each layer lies before the one below it for a depth buffer, by 256 steps
/// of a float, and in the same place of the picture.
inline float depth_offset_factor(GroundLayer layer) { return 1.0F - static_cast<float>(layer) * 0x1p-15F; }

} // namespace octant::visuals::planning
