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

    // Found by ProgressiveMesh, kept here because a split needs all of this at once.
    std::uint32_t left_cut = none;  ///< l^: third corner (a leaf) of left_face
    std::uint32_t right_cut = none; ///< r^: the same of right_face
    std::uint32_t first_leaf = 0;   ///< leaves below the made node are numbered from this one on,
    std::uint32_t middle = 0;       ///< those below its second child from this one on
};

/// What a vertex hierarchy is made from. Nodes: first the leaves, then one a split, children before
/// parents and the finest split first. Leaves are numbered so that those below any node follow one
/// another, those of its first child first.
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
class ProgressiveMesh {
public:
    /// The parts must keep their promises (asserted where cheap).
    explicit ProgressiveMesh(ProgressiveParts parts);

    /// Positions that are floats already are kept bit for bit, others rounded to float relative to
    /// the middle of the mesh; colours have 16 bits a part. Corner normals of the original are
    /// averaged into one a vertex; without them faces give the normals, weighted by area.
    explicit ProgressiveMesh(const models::CollapseSequence& sequence);

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
    const Split& split_of(std::uint32_t node) const { return parts_.splits[node - leaf_count()]; }

    /// Leaves below a node are numbered from this one on; a leaf is its own.
    std::uint32_t first_leaf(std::uint32_t node) const {
        return is_leaf(node) ? node : split_of(node).first_leaf;
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
        return is_leaf(node) ? 0.0F : split_of(node).error_m;
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

    /// What it is made from, but for positions, normals and colours: these are in shape().
    const ProgressiveParts& parts() const { return parts_; }

    /// All that it can be made from again.
    ProgressiveParts whole_parts() const;

    /// The number that a CollapseSequence gives a node: that of the vertex in the original mesh,
    /// or the vertex count plus the collapse's place.
    std::uint32_t sequence_number(std::uint32_t node) const {
        return is_leaf(node) ? parts_.original_vertices[node] : node;
    }

    /// Unit normal of an original face; 0 for one without area.
    glm::vec3 face_normal(std::uint32_t face) const;

    /// Memory of hierarchy and faces.
    std::size_t bytes() const;

private:
    void order_faces();
    void find_places();
    void raise_errors();
    void move_shapes();
    void find_first_leaves();
    void find_cuts();
    void bound_leaves();
    void bound_nodes();

    ProgressiveParts parts_;

    /// Place of an inner node's children in shapes_: behind the roots, the coarsest split's first.
    std::size_t first_child_place(std::uint32_t node) const {
        return roots_.size() + 2 * (node_count() - 1 - node);
    }

    NodeShape& shape(std::uint32_t node) { return shapes_[places_[node]]; }

    std::vector<std::uint32_t> roots_;
    std::vector<std::uint32_t> places_; ///< in shapes_, one a node; says its parent too
    std::vector<NodeShape> shapes_;
    bool has_colours_ = false;
};

} // namespace octant::visuals::refine
