#pragma once

#include "models/collapse_sequence.h"
#include "models/material.h"
#include "models/triangle_mesh.h"
#include "visuals/refine/packed_attributes.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::refine {

using models::none;
using models::Triangle;

/// A node of the vertex hierarchy with its two children: the vertex split that replaces it by them, and the edge
/// collapse that undoes the split. In the paper's words the node is vs, `first` is vu and `second` is vt.
struct VertexSplit {
    std::uint32_t first = none;
    std::uint32_t second = none;
    /// The original face that the collapse removes on the left; none on a boundary.
    std::uint32_t left_face = none;
    std::uint32_t right_face = none; ///< The same on the right.
    /// The error of the surface where this node is active, never less than its children's.
    float error_m = 0.0F;

    // The rest is filled in by ProgressiveMesh and is not part of ProgressiveMeshData.

    /// The fundamental cut vertex vs.l^: the third corner (a leaf) of left_face.
    std::uint32_t left_cut = none;
    /// The fundamental cut vertex vs.r^: the third corner (a leaf) of right_face.
    std::uint32_t right_cut = none;
    /// The leaves below this node are numbered consecutively, starting here.
    std::uint32_t first_leaf = 0;
    /// Of these, the leaves below the second child start here.
    std::uint32_t middle = 0;
};

/// The data that a vertex hierarchy is made from. Nodes are numbered with the leaves first and then one inner node for
/// each split, children before parents, so the finest split comes first (ProgressiveMesh renumbers the inner nodes).
/// Leaves are numbered so that those below any node are consecutive, those of its first child first.
struct ProgressiveMeshData {
    std::string name;
    glm::dvec3 origin_m{0.0};           ///< Positions are relative to this point of the file's axes.
    std::vector<glm::vec3> positions_m; ///< One for each node.
    std::vector<PackedNormal> normals;  ///< One for each node.
    std::vector<PackedColour> colours;  ///< One for each node, or empty.
    std::vector<VertexSplit> splits;    ///< One for each inner node.
    std::vector<Triangle> faces;        ///< The faces of the original mesh; their corners are leaves.
    /// For each face its number in the original mesh; empty = in order.
    std::vector<std::uint32_t> original_faces;
    std::vector<std::uint16_t> face_materials; ///< One for each face, or empty.
    std::vector<models::Material> materials;
    /// For each leaf its number in the original mesh.
    std::vector<std::uint32_t> original_vertices;
    std::vector<std::string> notes; ///< Messages to the user about reading; often none.
};

} // namespace octant::visuals::refine
