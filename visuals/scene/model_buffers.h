#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// A vertex of an aircraft as a renderer loads it once. Body axes x forward, y right, z down. 52 bytes. The normal
/// lights a smooth polygon at this corner; face normal and face colour belong to the flat polygon that begins at this
/// vertex.
struct ModelVertex {
    glm::vec3 position_m{0.0F};
    glm::vec3 normal{0.0F};
    glm::vec3 face_normal{0.0F};
    /// The colour where the polygon is smooth, as ColourVertex::colour.
    std::uint32_t colour = 0;
    /// The colour where the polygon is flat, as ColourVertex::colour.
    std::uint32_t face_colour = 0;
    /// 0 = body, k = pivot k - 1 of the model: turns with FramePlan::parts.
    std::uint32_t part = 0;
    /// Polygon that begins here: a bit of FramePlan::smooth, counted on from the draw's `first_smooth`.
    std::uint32_t polygon = 0;
};

/// What a renderer loads once for an aircraft: all draw lists lie in one index buffer.
struct ModelBuffers {
    std::vector<ModelVertex> vertices;
    /// Triangles. The first corner of each belongs to it, or to a polygon that it is a part of, alone.
    std::vector<std::uint32_t> indices;
    /// Whether a plan may draw it by depth though its polygons are painted in order: it has levels of detail, or is
    /// refined in each frame.
    bool has_depth_drawn_meshes = false;
};

} // namespace octant::visuals::scene
