#pragma once

#include "models/colour_vertex.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace octant::visuals::terrain {

/// In which order triangles are drawn.
enum class PaintOrder {
    BackToFront, ///< none is hidden by an earlier one: pictures need no depth
    FrontToBack  ///< exactly the reverse: with depth, what is hidden is rejected early
};

/// From where the ground is seen.
struct MeshView {
    glm::dvec3 eye_m{0.0}; ///< world axes; may lie outside the field or below the ground
    /// Planes through the eye, unit normals in world axes pointing inside. A zero vector leaves
    /// out its plane; all zero: nothing is culled.
    std::array<glm::dvec3, 4> frustum_normals{
        glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
    /// How many times larger than through the reference lens things appear: tan(reference / 2) /
    /// tan(field of view / 2). Multiplies C. At least 1 (asserted).
    double magnification = 1.0;
    PaintOrder order = PaintOrder::BackToFront;
    /// Pixels that a metre covers one metre before the eye, in the middle of the picture: picture
    /// height / (2 tan(vertical field of view / 2)). For meshes by screen-space error.
    double focal_px = 869.1;
    /// The ground is lowered by d^2 / (2 R), d = level distance from the eye; 0 = flat earth. For
    /// meshes by screen-space error.
    double earth_radius_m = 0.0;

    bool operator==(const MeshView&) const = default;
};

struct MeshCounters {
    int triangles = 0;
    int fans = 0;          ///< nodes that gave at least one triangle
    int nodes_visited = 0; ///< how often nodes were tested for culling or splitting
};

/// Where the vertex of a mesh with geomorphs comes from. 16 bytes.
struct VertexOrigin {
    std::uint16_t column = 0; ///< its sample
    std::uint16_t row = 0;
    std::uint32_t end_a = 0; ///< vertices in the middle of which it appears, both before it; itself
    std::uint32_t end_b = 0; ///< for those that are always there
    float weight = 1.0F;     ///< 0 = wholly as the middle of its ends, 1 = wholly its sample
};

/// The ground for one view. The memory is the mesher's and lasts at least until its next mesh.
struct GroundMesh {
    std::span<const models::ColourVertex> vertices; ///< used samples, each once
    std::span<const std::uint32_t> indices; ///< triangles in the view's order, counter-clockwise
                                            ///< seen from above
    MeshCounters counters;
    double resolution = 0.0; ///< C it was made with, before magnification
    double error_px = 0.0;   ///< screen-space error it was made for; 0 where C decides
    std::span<const VertexOrigin> origins; ///< of the vertices; empty where C decides
};

/// A node that is in the mesh: its centre is a vertex, unless all four quadrants are split.
/// Quadrants are bits: 1 south-west, 2 south-east, 4 north-west, 8 north-east.
struct GroundFan {
    std::uint32_t node = 0; ///< index into Quadtree::nodes()
    std::uint16_t column = 0;
    std::uint16_t row = 0;
    std::uint8_t level = 0;
    std::uint8_t split = 0;  ///< quadrants left to a child's own fan, drawn unless hidden
    std::uint8_t hidden = 0; ///< quadrants outside the frustum or the field
    bool at_frustum = false; ///< not known to be wholly inside the frustum
};

} // namespace octant::visuals::terrain
