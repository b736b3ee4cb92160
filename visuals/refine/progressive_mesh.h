#pragma once

#include "models/collapse_sequence.h"
#include "models/triangle_mesh.h"
#include "visuals/refine/packed_attributes.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::refine {

using models::none;
using models::Triangle;

/// What a collapse merged. `first` and `second` are its children, vu and vt.
struct Split {
    std::uint32_t first = none;
    std::uint32_t second = none;
    std::uint32_t left_face = none;  ///< that the collapse took away; none on a boundary
    std::uint32_t right_face = none; ///< the same
    float error_m = 0.0F;            ///< of the made node, never less than its children's

    // Found by ProgressiveMesh; nothing in ProgressiveParts.
    std::uint32_t left_cut = none;  ///< l^: third corner (a leaf) of left_face
    std::uint32_t right_cut = none; ///< r^: the same of right_face
    std::uint32_t first_leaf = 0;   ///< leaves below the made node are numbered from this one on,
    std::uint32_t middle = 0;       ///< those below its second child from this one on
};

/// What a vertex hierarchy is made from. Nodes: first the leaves, then one a split, children before
/// parents and the finest split first (ProgressiveMesh gives inner nodes other numbers). Leaves are
/// numbered so that those below any node follow one another, those of its first child first.
struct ProgressiveParts {
    std::string name;
    glm::dvec3 origin_m{0.0};                  ///< positions are relative to it
    std::vector<glm::vec3> positions_m;        ///< one a node
    std::vector<PackedNormal> normals;         ///< one a node
    std::vector<PackedColour> colours;         ///< one a node, or empty
    std::vector<Split> splits;                 ///< one an inner node
    std::vector<Triangle> faces;               ///< of the original mesh, corners are leaves
    std::vector<std::uint32_t> original_faces; ///< their numbers there; empty = as they come
    std::vector<std::uint16_t> face_materials; ///< one a face, or empty
    std::vector<models::Material> materials;
    std::vector<std::uint32_t> original_vertices; ///< number of each leaf in the original mesh
    std::vector<std::string> notes;               ///< what reading found; often none
};

/// A node where it is drawn. 28 bytes: siblings lie side by side.
struct NodeShape {
    glm::vec3 position_m{0.0F};
    PackedNormal normal;
    float radius_m = 0.0F;
    PackedColour colour;    ///< white where the mesh has none
    std::uint16_t cone = 0; ///< half-angle in steps of pi / 65535, rounded up
};

/// A mesh with the vertex hierarchy that simplified it: a forest whose leaves are the original
/// vertices. Shared by any number of fronts (SelectiveRefiner), never changed. About 130 bytes an
/// original vertex, see bytes().
///
/// Nodes: first the leaves, then the inner ones. From the last number down to the first inner one a
/// node is followed by all below its first child, then by all below its second: what lies close
/// together on the surface does so in memory, and parents are met before their children.
class ProgressiveMesh {
public:
    /// The parts must keep their promises (asserted where cheap). Throws Error for more faces than
    /// `most_faces` or more leaves than `most_leaves`.
    explicit ProgressiveMesh(ProgressiveParts parts);

    /// Positions that are floats already are kept bit for bit, others rounded to float relative to
    /// the middle of the mesh; colours have 16 bits a part. Corner normals of the original are
    /// averaged into one a vertex; without them faces give the normals, weighted by area.
    explicit ProgressiveMesh(const models::CollapseSequence& sequence);

    static constexpr std::size_t most_faces = 5'592'400; ///< fronts number corners in 24 bits
    static constexpr std::size_t most_leaves = 16'777'000;

    std::size_t leaf_count() const { return parts_.original_vertices.size(); }

    std::size_t node_count() const { return places_.size(); }

    std::size_t face_count() const { return parts_.faces.size(); }

    bool is_leaf(std::uint32_t node) const { return node < leaf_count(); }

    /// none of a root.
    std::uint32_t parent(std::uint32_t node) const {
        const std::size_t place = places_[node];
        return place < roots_.size()
                   ? none
                   : static_cast<std::uint32_t>(node_count() - 1 - (place - roots_.size()) / 2);
    }

    /// Of an inner node.
    Split split_of(std::uint32_t node) const {
        const Fork& fork = forks_[node - leaf_count()];
        const std::uint32_t below_first = fork.middle - fork.first_leaf; // leaves
        Split split;
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

    /// Inner nodes, the last collapse's first.
    std::vector<std::uint32_t> coarsest_first() const;

    /// Whether a face belongs to the base mesh already; one a face.
    std::vector<bool> base_faces() const;

    /// Leaves below a node are numbered from this one on; a leaf is its own.
    std::uint32_t first_leaf(std::uint32_t node) const {
        return is_leaf(node) ? node : forks_[node - leaf_count()].first_leaf;
    }

    /// The last one of them.
    std::uint32_t last_leaf(std::uint32_t node) const {
        while (!is_leaf(node)) {
            node = split_of(node).second;
        }
        return node;
    }

    const NodeShape& shape(std::uint32_t node) const { return shapes_[places_[node]]; }

    /// Of both children of an inner node, the first one's first.
    std::span<const NodeShape, 2> child_shapes(std::uint32_t node) const {
        return std::span<const NodeShape, 2>(&shapes_[first_child_place(node)], 2);
    }

    const glm::vec3& position_m(std::uint32_t node) const { return shape(node).position_m; }

    glm::vec3 normal(std::uint32_t node) const { return unpacked(shape(node).normal); }

    PackedNormal packed_normal(std::uint32_t node) const { return shape(node).normal; }

    PackedColour packed_colour(std::uint32_t node) const { return shape(node).colour; }

    bool has_colours() const { return has_colours_; }

    /// As RefinedVertex::colour; white where the mesh has no colours.
    std::uint32_t colour(std::uint32_t node) const { return drawn_colour(shape(node).colour); }

    /// Of the surface where this node is active; 0 for leaves, never falling towards the root.
    float error_m(std::uint32_t node) const {
        return is_leaf(node) ? 0.0F : forks_[node - leaf_count()].error_m;
    }

    /// About the node's position, holds the positions of all nodes below it, the original faces
    /// at the leaves, and the spheres of its children.
    float radius_m(std::uint32_t node) const { return shape(node).radius_m; }

    /// Half-angle of the cone about normal(node) that holds the normals of all original faces at
    /// the leaves below; pi for all directions.
    float cone_rad(std::uint32_t node) const;

    /// Faces are numbered so that neighbours in memory are neighbours on the surface, see
    /// original_face.
    std::span<const Triangle> faces() const { return parts_.faces; }

    std::uint32_t original_face(std::uint32_t face) const { return parts_.original_faces[face]; }

    std::span<const std::uint32_t> roots() const { return roots_; }

    /// Middle of the box around the original vertices, in file axes.
    const glm::dvec3& middle_m() const { return middle_m_; }

    /// Half the box's diagonal.
    double half_diagonal_m() const { return half_diagonal_m_; }

    /// What it is made from, but for splits, positions, normals and colours: these are in
    /// split_of() and shape().
    const ProgressiveParts& parts() const { return parts_; }

    /// All that it can be made from again.
    ProgressiveParts whole_parts() const;

    /// The number that a CollapseSequence gives a node: that of the vertex in the original mesh,
    /// or the vertex count plus the collapse's place.
    std::uint32_t sequence_number(std::uint32_t node) const {
        return is_leaf(node) ? parts_.original_vertices[node]
                             : sequence_numbers_[node - leaf_count()];
    }

    /// Unit normal of an original face; 0 for one without area.
    glm::vec3 face_normal(std::uint32_t face) const;

    /// Memory of hierarchy and faces.
    std::size_t bytes() const;

private:
    /// What split_of() tells, packed. 28 bytes.
    struct Fork {
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

    ProgressiveParts parts_;
    std::vector<Fork> forks_;                     ///< one an inner node
    std::vector<std::uint32_t> sequence_numbers_; ///< one an inner node

    /// Place of an inner node's children in shapes_: behind the roots, the coarsest split's first.
    std::size_t first_child_place(std::uint32_t node) const {
        return roots_.size() + 2 * (node_count() - 1 - node);
    }

    NodeShape& shape(std::uint32_t node) { return shapes_[places_[node]]; }

    std::vector<std::uint32_t> roots_;  ///< by their first leaves
    std::vector<std::uint32_t> places_; ///< in shapes_, one a node; says its parent too
    std::vector<NodeShape> shapes_;
    bool has_colours_ = false;
    glm::dvec3 middle_m_{0.0};
    double half_diagonal_m_ = 0.0;
};

} // namespace octant::visuals::refine
