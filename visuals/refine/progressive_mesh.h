#pragma once

#include "models/collapse_sequence.h"
#include "models/material.h"
#include "models/triangle_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::refine {

/// A unit vector in 32 bits by octahedral coding: it is projected onto an octahedron, which is unfolded into a square
/// with 16 bits an axis. The error is below 1e-4 rad.
struct PackedNormal {
    std::int16_t x = 0;
    std::int16_t y = 0;

    bool operator==(const PackedNormal&) const = default;
};

/// Packs a vector of any length. A zero vector becomes +z.
inline PackedNormal packed(const glm::vec3& normal) {
    const float sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    if (!(sum > 0.0F)) { return {}; }
    float x = normal.x / sum;
    float y = normal.y / sum;
    if (normal.z < 0.0F) {
        const float folded_x = (1.0F - std::abs(y)) * (x < 0.0F ? -1.0F : 1.0F);
        y = (1.0F - std::abs(x)) * (y < 0.0F ? -1.0F : 1.0F);
        x = folded_x;
    }
    return {static_cast<std::int16_t>(std::lround(x * 32767.0F)), static_cast<std::int16_t>(std::lround(y * 32767.0F))};
}

/// The unit vector that was packed.
inline glm::vec3 unpacked(const PackedNormal& normal) {
    float x = static_cast<float>(normal.x) / 32767.0F;
    float y = static_cast<float>(normal.y) / 32767.0F;
    const float z = 1.0F - std::abs(x) - std::abs(y);
    const float fold = z < 0.0F ? -z : 0.0F;
    x += x < 0.0F ? fold : -fold;
    y += y < 0.0F ? fold : -fold;
    return glm::normalize(glm::vec3(x, y, z));
}

/// A colour as three display values, 0 to 1 each, in 16 bits.
struct PackedColour {
    std::uint16_t red = 65535;
    std::uint16_t green = 65535;
    std::uint16_t blue = 65535;

    bool operator==(const PackedColour&) const = default;
};

/// Packs a colour; parts outside 0 to 1 are clamped.
inline PackedColour packed_rgb16(const glm::vec3& colour) {
    const auto part = [](float value) {
        return static_cast<std::uint16_t>(std::lround(glm::clamp(value, 0.0F, 1.0F) * 65535.0F));
    };
    return {part(colour.x), part(colour.y), part(colour.z)};
}

inline glm::vec3 unpacked(const PackedColour& colour) {
    return glm::vec3(colour.red, colour.green, colour.blue) / 65535.0F;
}

/// The colour as the renderer takes it, 8 bits a part: the same rounding as models::packed_colour.
inline std::uint32_t packed_rgba8(const PackedColour& colour) {
    const auto byte = [](std::uint32_t part) { return (part * 255U + 32767U) / 65535U; };
    return byte(colour.red) | byte(colour.green) << 8U | byte(colour.blue) << 16U | 0xff000000U;
}

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

/// The data to draw a node and to evaluate its error. 28 bytes; siblings are adjacent in memory, because a split reads
/// both.
struct NodeGeometry {
    glm::vec3 position_m{0.0F};
    PackedNormal normal;
    float radius_m = 0.0F; ///< The radius of its bounding sphere, see ProgressiveMesh::radius_m.
    PackedColour colour;   ///< White where the mesh has no colours.
    /// The half-angle of the normal cone, in steps of pi / 65535, rounded up.
    std::uint16_t cone = 0;
};

/// A mesh with the vertex hierarchy that simplifying it made: a forest whose leaves are the original vertices and whose
/// roots are the vertices of the base mesh. It never changes and may be shared by any number of fronts
/// (SelectiveRefiner). About 130 bytes an original vertex, see bytes().
///
/// Numbers: first the leaves, then the inner nodes. Walking from the highest number down, a node is followed by the
/// whole subtree of its first child and then by that of its second (a preorder). So what is close on the surface is
/// close in memory, and parents come before their children.
class ProgressiveMesh {
public:
    /// The parts must keep the promises stated at ProgressiveMeshData (asserted where that is cheap). Throws Error for
    /// more faces than `max_faces` or more leaves than `max_leaves`.
    explicit ProgressiveMesh(ProgressiveMeshData parts);

    /// Makes a hierarchy from a simplification. Positions that are floats already are kept bit for bit; others are
    /// rounded to float relative to the middle of the mesh. Colours keep 16 bits a part. Corner normals of the original
    /// are averaged into one a vertex; where there are none, face normals weighted by area are used.
    explicit ProgressiveMesh(const models::CollapseSequence& sequence);

    /// A front numbers its corners in 24 bits.
    static constexpr std::size_t max_faces = 5'592'400;
    static constexpr std::size_t max_leaves = 16'777'000;

    std::size_t leaf_count() const { return parts_.original_vertices.size(); }

    std::size_t node_count() const { return places_.size(); }

    std::size_t face_count() const { return parts_.faces.size(); }

    bool is_leaf(std::uint32_t node) const { return node < leaf_count(); }

    /// The parent of a node; `none` for a root.
    std::uint32_t parent(std::uint32_t node) const {
        const std::size_t place = places_[node];
        return place < roots_.size() ? none
                                     : static_cast<std::uint32_t>(node_count() - 1 - (place - roots_.size()) / 2);
    }

    /// The vertex split of an inner node.
    VertexSplit split_of(std::uint32_t node) const {
        const PackedSplit& fork = packed_splits_[node - leaf_count()];
        const std::uint32_t below_first = fork.middle - fork.first_leaf; // leaves
        VertexSplit split;
        split.first = below_first == 1 ? fork.first_leaf : node - 1;
        split.second = fork.second_is_leaf != 0 ? std::uint32_t{fork.middle} : node - below_first;
        split.left_face = fork.left_face;
        split.right_face = fork.right_face;
        split.error_m = fork.error_m;
        split.left_cut = fork.left_cut;
        split.right_cut = fork.right_cut;
        split.first_leaf = fork.first_leaf;
        split.middle = fork.middle;
        return split;
    }

    /// All inner nodes in the order in which a progressive mesh splits them: the last collapse first.
    std::vector<std::uint32_t> coarsest_first() const;

    /// One flag for each face: whether it belongs to the base mesh.
    std::vector<bool> base_faces() const;

    /// The first of the consecutive leaves below a node; a leaf is below itself.
    std::uint32_t first_leaf(std::uint32_t node) const {
        return is_leaf(node) ? node : packed_splits_[node - leaf_count()].first_leaf;
    }

    /// The last of the leaves below a node.
    std::uint32_t last_leaf(std::uint32_t node) const {
        while (!is_leaf(node)) { node = split_of(node).second; }
        return node;
    }

    const NodeGeometry& shape(std::uint32_t node) const { return shapes_[places_[node]]; }

    /// The shapes of both children of an inner node, the first child's first.
    std::span<const NodeGeometry, 2> child_shapes(std::uint32_t node) const {
        return std::span<const NodeGeometry, 2>(&shapes_[first_child_place(node)], 2);
    }

    const glm::vec3& position_m(std::uint32_t node) const { return shape(node).position_m; }

    glm::vec3 normal(std::uint32_t node) const { return unpacked(shape(node).normal); }

    PackedNormal packed_normal(std::uint32_t node) const { return shape(node).normal; }

    PackedColour packed_colour(std::uint32_t node) const { return shape(node).colour; }

    bool has_colours() const { return has_colours_; }

    /// How far the surface is from the original where this node is active, metres. It is 0 for leaves and never
    /// decreases towards the root.
    float error_m(std::uint32_t node) const {
        return is_leaf(node) ? 0.0F : packed_splits_[node - leaf_count()].error_m;
    }

    /// The radius of a sphere about the node's position that holds the positions of all nodes below it, the original
    /// faces at the leaves, and the spheres of its children.
    float radius_m(std::uint32_t node) const { return shape(node).radius_m; }

    /// The half-angle of the cone about normal(node) that holds the normals of all original faces at the leaves below;
    /// pi means all directions.
    float cone_rad(std::uint32_t node) const;

    /// The original faces with leaves as corners, ordered so that neighbours in memory are neighbours on the surface.
    /// original_face returns their numbers in the file.
    std::span<const Triangle> faces() const { return parts_.faces; }

    std::uint32_t original_face(std::uint32_t face) const { return parts_.original_faces[face]; }

    /// The vertices of the base mesh, ordered by their first leaves.
    std::span<const std::uint32_t> roots() const { return roots_; }

    /// The centre of the bounding box of the original vertices, in file axes.
    const glm::dvec3& middle_m() const { return middle_m_; }

    /// Half the diagonal of that bounding box.
    double half_diagonal_m() const { return half_diagonal_m_; }

    /// The data it was made from, without splits, positions, normals and colours: these have moved into split_of() and
    /// shape().
    const ProgressiveMeshData& parts() const { return parts_; }

    /// Complete parts, from which an equal hierarchy can be made.
    ProgressiveMeshData full_data() const;

    /// The number of a node in the CollapseSequence: for a leaf that of its vertex in the original mesh, for an inner
    /// node the vertex count plus the index of its collapse.
    std::uint32_t sequence_number(std::uint32_t node) const {
        return is_leaf(node) ? parts_.original_vertices[node] : sequence_numbers_[node - leaf_count()];
    }

    /// The unit normal of an original face; zero for one without area.
    glm::vec3 face_normal(std::uint32_t face) const;

    /// The memory of hierarchy and faces.
    std::size_t bytes() const;

private:
    /// The contents of split_of() in 28 bytes; children follow from the numbering of the nodes.
    struct PackedSplit {
        std::uint32_t first_leaf;
        std::uint32_t middle : 31;
        std::uint32_t second_is_leaf : 1;
        std::uint32_t left_face;
        std::uint32_t right_face;
        std::uint32_t left_cut;
        std::uint32_t right_cut;
        float error_m;
    };

    void order_faces();
    std::vector<std::uint32_t> new_numbers() const;
    void order_nodes();
    void place_shapes(const std::vector<std::uint32_t>& numbers);
    void find_cuts();
    void bound_leaves();
    void bound_nodes();
    void bound_all();

    ProgressiveMeshData parts_;
    std::vector<PackedSplit> packed_splits_;      ///< One for each inner node.
    std::vector<std::uint32_t> sequence_numbers_; ///< One for each inner node.

    /// The index in shapes_ of an inner node's first child. The roots come first, then the pairs of children, those of
    /// the highest node first.
    std::size_t first_child_place(std::uint32_t node) const { return roots_.size() + 2 * (node_count() - 1 - node); }

    NodeGeometry& shape(std::uint32_t node) { return shapes_[places_[node]]; }

    std::vector<std::uint32_t> roots_; ///< Ordered by their first leaves.
    /// For each node its index in shapes_, which also identifies its parent.
    std::vector<std::uint32_t> places_;
    std::vector<NodeGeometry> shapes_;
    bool has_colours_ = false;
    glm::dvec3 middle_m_{0.0};
    double half_diagonal_m_ = 0.0;
};

} // namespace octant::visuals::refine
