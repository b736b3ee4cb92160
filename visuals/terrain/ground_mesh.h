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
};

struct MeshCounters {
    int triangles = 0;
    int fans = 0;          ///< nodes that gave at least one triangle
    int nodes_visited = 0; ///< how often nodes were tested for culling or splitting
};

/// The ground for one view. The memory is the mesher's and lasts until its next mesh.
struct GroundMesh {
    std::span<const models::ColourVertex> vertices; ///< used samples, each once
    std::span<const std::uint32_t> indices; ///< triangles in the view's order, counter-clockwise
                                            ///< seen from above
    MeshCounters counters;
    double resolution = 0.0; ///< C it was made with, before magnification
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
