#pragma once

#include "models/colour_vertex.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace octant::visuals::terrain {

/// The order in which triangles are drawn.
enum class PaintOrder {
    /// No triangle is hidden by an earlier one, so that pictures need no depth buffer.
    BackToFront,
    FrontToBack ///< Exactly the reverse: with a depth buffer, what is hidden is rejected early.
};

/// The view for which a mesh is made.
struct MeshView {
    glm::dvec3 eye_m{0.0}; ///< In world axes; may lie outside the field or below the ground.
    /// The view frustum's planes through the eye, as unit normals in world axes that point inside. A zero vector leaves
    /// out its plane; if all are zero, nothing is culled.
    std::array<glm::dvec3, 4> frustum_normals{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
    /// The magnification against the reference lens: tan(reference / 2) / tan(field of view / 2), at least 1
    /// (asserted). It multiplies C.
    double magnification = 1.0;
    PaintOrder order = PaintOrder::BackToFront;
    /// The focal length in pixels: how many pixels a metre covers at a distance of one metre in the middle of the
    /// picture, picture height / (2 tan(vertical field of view / 2)). For meshes by screen-space error.
    double focal_px = 869.1;
    /// The direction of view, a unit vector in world axes. Errors are then those in the flat picture around that
    /// direction; with a zero vector, those in a picture on a sphere around the eye.
    glm::dvec3 ahead{0.0};
    /// The cosine of the angle between `ahead` and the picture's corners.
    double corner_cos = 1.0;
    /// The ground is lowered by d^2 / (2 R), where d is the horizontal distance from the eye; 0 = flat earth. For
    /// meshes by screen-space error.
    double earth_radius_m = 0.0;

    bool operator==(const MeshView&) const = default;
};

/// Counts of a mesh and of the work to make it.
struct MeshCounters {
    int triangles = 0;
    int fans = 0;          ///< Nodes that gave at least one triangle.
    int nodes_visited = 0; ///< How often nodes were tested for culling or splitting.
};

/// The counts of a mesh that was not made.
struct CountedMesh {
    MeshCounters counters;
    double resolution = 0.0; ///< C it would be made with, before magnification.
};

/// The geomorph of a vertex. 16 bytes.
struct VertexMorph {
    std::uint16_t column = 0; ///< The sample that it belongs to.
    std::uint16_t row = 0;
    /// The two vertices in the middle of which it appears, both of which come before it in the mesh; the vertex itself
    /// if it is always there.
    std::uint32_t parent_a = 0;
    std::uint32_t parent_b = 0;
    /// The progress of its motion: 0 = in the middle between its parents, 1 = at its sample.
    float weight = 1.0F;
};

/// The ground as it is drawn for one view, positions relative to the eye. The memory belongs to the mesher and stays
/// valid at least until its next mesh.
struct GroundMesh {
    std::span<const models::ColourVertex> vertices; ///< The samples in use, each once.
    /// The triangles in the view's painting order, counter-clockwise seen from above.
    std::span<const std::uint32_t> indices;
    MeshCounters counters;
    double resolution = 0.0; ///< C it was made with, before magnification.
    /// An upper bound of the distance of any sample in the picture from the triangles, in pixels; 0 for the paper's
    /// method.
    double error_px = 0.0;
    std::span<const VertexMorph> morphs; ///< One for each vertex; empty for the paper's method.
};

/// A node that is in the mesh. Its centre is a vertex unless all four quadrants are split. Sets of quadrants are bit
/// masks: 1 south-west, 2 south-east, 4 north-west, 8 north-east.
struct GroundFan {
    std::uint32_t node = 0; ///< The index in Quadtree::nodes().
    std::uint16_t column = 0;
    std::uint16_t row = 0;
    std::uint8_t level = 0;
    std::uint8_t split = 0;  ///< Quadrants that are left to a child's own fan, drawn unless hidden.
    std::uint8_t hidden = 0; ///< Quadrants outside the frustum or the field.
};

} // namespace octant::visuals::terrain
