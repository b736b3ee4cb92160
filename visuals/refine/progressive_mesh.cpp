// The vertex hierarchy and its fundamental cut vertices: J. Kim, S. Lee, "Truly Selective Refinement of Progressive
// Meshes", Graphics Interface 2001, section 3.
//
// The constructor orders faces and nodes for locality, finds the two fundamental cut vertices vs.l^ and vs.r^ of each
// node, and bounds each node (bound_all).
//
// Deviation: the paper searches the fundamental cut vertices along the common border of the regions S(vu) and S(vt).
// Here none is searched: every face of an active mesh is one original face with its corners replaced by their active
// ancestors, so the cut vertices are the third corners of the two original faces that the collapse removes.
#include "visuals/refine/progressive_mesh.h"

#include "models/collapse_sequence.h"
#include "sim/base/error.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numbers>
#include <numeric>
#include <utility>

namespace octant::visuals::refine {

namespace {

// From a sequence of edge collapses to the parts of a vertex hierarchy: J. Kim, S. Lee, "Truly Selective Refinement of
// Progressive Meshes", Graphics Interface 2001, section 3 (vertex hierarchy). The sequence names nodes by vertex and
// collapse numbers; here leaves are renumbered in depth-first order, so that the region S(v) of any node is a range of
// leaves.

using models::Collapse;
using models::CollapseSequence;
using models::TriangleMesh;

/// A unit normal times the area of the surface that it was averaged over (twice the area, to be exact).
using WeightedNormal = glm::dvec3;

/// Whether every coordinate of the original is a float already, so that it can be kept bit for bit.
bool all_floats(const CollapseSequence& sequence) {
    const auto is_float = [](const glm::dvec3& point_m) { return glm::dvec3(glm::vec3(point_m)) == point_m; };
    return std::ranges::all_of(sequence.original.vertices_m, is_float);
}

/// For each original vertex its leaf number, in an order in which the leaves below any node are consecutive.
std::vector<std::uint32_t> leaf_order(const CollapseSequence& sequence) {
    const std::size_t leaves = sequence.original.vertices_m.size();
    const std::size_t nodes = leaves + sequence.collapses.size();
    std::vector<std::uint32_t> sizes(nodes, 1); // the number of leaves below each node
    std::vector<bool> has_parent(nodes, false);
    for (std::size_t i = 0; i < sequence.collapses.size(); ++i) {
        const Collapse& collapse = sequence.collapses[i];
        sizes[leaves + i] = sizes[collapse.first] + sizes[collapse.second];
        has_parent[collapse.first] = true;
        has_parent[collapse.second] = true;
    }
    std::vector<std::uint32_t> begins(nodes, 0);
    std::uint32_t next = 0;
    for (std::size_t node = 0; node < nodes; ++node) {
        if (!has_parent[node]) {
            begins[node] = next;
            next += sizes[node];
        }
    }
    for (std::size_t i = sequence.collapses.size(); i-- > 0;) {
        const Collapse& collapse = sequence.collapses[i];
        begins[collapse.first] = begins[leaves + i];
        begins[collapse.second] = begins[leaves + i] + sizes[collapse.first];
    }
    begins.resize(leaves);
    return begins;
}

/// For each original vertex the sum of its given corner normals weighted by area, or of the normals of its faces where
/// it has none.
std::vector<WeightedNormal> vertex_normals(const TriangleMesh& mesh) {
    std::vector<WeightedNormal> from_faces(mesh.vertices_m.size(), WeightedNormal(0.0));
    std::vector<glm::dvec3> given(mesh.normals.empty() ? 0 : mesh.vertices_m.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& corners = mesh.triangles[t];
        const glm::dvec3& a_m = mesh.vertices_m[corners[0]];
        const glm::dvec3 area = glm::cross(mesh.vertices_m[corners[1]] - a_m, mesh.vertices_m[corners[2]] - a_m);
        for (std::size_t k = 0; k < 3; ++k) {
            from_faces[corners[k]] += area;
            if (!given.empty()) {
                const std::uint32_t normal = mesh.corner_normals[t][k];
                given[corners[k]] += glm::length(area) * glm::dvec3(mesh.normals[normal]);
            }
        }
    }
    for (std::size_t v = 0; v < given.size(); ++v) {
        from_faces[v] = glm::length(given[v]) > 0.0 ? given[v] : from_faces[v];
    }
    return from_faces;
}

PackedNormal packed_direction(const WeightedNormal& normal) {
    const double length = glm::length(normal);
    return packed(length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0F));
}

void add_leaves(const CollapseSequence& sequence, ProgressiveMeshData& parts) {
    const TriangleMesh& mesh = sequence.original;
    for (const std::uint32_t vertex : parts.original_vertices) {
        parts.positions_m.emplace_back(mesh.vertices_m[vertex] - parts.origin_m);
        if (!mesh.colours.empty()) { parts.colours.push_back(packed_rgb16(mesh.colours[vertex])); }
    }
}

void add_splits(
    const CollapseSequence& sequence, const std::vector<std::uint32_t>& places, ProgressiveMeshData& parts) {
    const std::size_t leaves = places.size();
    const auto node_of = [&](std::uint32_t vertex) { return vertex < leaves ? places[vertex] : vertex; };
    parts.splits.reserve(sequence.collapses.size());
    for (const Collapse& collapse : sequence.collapses) {
        parts.splits.push_back({node_of(collapse.first), node_of(collapse.second), collapse.left, collapse.right,
            static_cast<float>(collapse.error_m)});
        parts.positions_m.emplace_back(collapse.position_m - parts.origin_m);
        if (!sequence.original.colours.empty()) { parts.colours.push_back(packed_rgb16(collapse.colour)); }
    }
}

/// Adds the normals of leaves and of inner nodes; an inner node's is the area-weighted mean of its leaves'.
void add_normals(const TriangleMesh& mesh, ProgressiveMeshData& parts) {
    const std::vector<WeightedNormal> by_vertex = vertex_normals(mesh);
    std::vector<WeightedNormal> sums;
    sums.reserve(parts.positions_m.size());
    for (const std::uint32_t vertex : parts.original_vertices) { sums.push_back(by_vertex[vertex]); }
    for (const VertexSplit& split : parts.splits) { sums.push_back(sums[split.first] + sums[split.second]); }
    parts.normals.reserve(sums.size());
    for (const WeightedNormal& sum : sums) { parts.normals.push_back(packed_direction(sum)); }
}

void add_faces(const TriangleMesh& mesh, const std::vector<std::uint32_t>& places, ProgressiveMeshData& parts) {
    parts.faces.reserve(mesh.triangles.size());
    for (const Triangle& corners : mesh.triangles) {
        parts.faces.push_back({places[corners[0]], places[corners[1]], places[corners[2]]});
    }
    parts.materials = mesh.materials;
    parts.face_materials.assign(mesh.triangle_materials.begin(), mesh.triangle_materials.end());
}

/// The parts of a hierarchy from a simplification's sequence of collapses. The leaves are renumbered so that those
/// below any node are consecutive, and every node gets a normal.
ProgressiveMeshData mesh_data_of(const CollapseSequence& sequence) {
    const TriangleMesh& mesh = sequence.original;
    assert(mesh.materials.size() < 65536);
    const std::size_t nodes = mesh.vertices_m.size() + sequence.collapses.size();
    ProgressiveMeshData parts;
    parts.name = mesh.name;
    if (!all_floats(sequence)) {
        const models::BoundingBox bounds = models::bounds_of(mesh);
        parts.origin_m = glm::dvec3(glm::vec3(0.5 * (bounds.min_m + bounds.max_m)));
    }
    const std::vector<std::uint32_t> places = leaf_order(sequence);
    parts.original_vertices.resize(places.size());
    for (std::uint32_t vertex = 0; vertex < places.size(); ++vertex) {
        parts.original_vertices[places[vertex]] = vertex;
    }
    parts.positions_m.reserve(nodes);
    parts.colours.reserve(mesh.colours.empty() ? 0 : nodes);
    add_leaves(sequence, parts);
    add_splits(sequence, places, parts);
    add_normals(mesh, parts);
    add_faces(mesh, places, parts);
    return parts;
}

/// The corner of a face that is not one of the leaves [begin, end).
std::uint32_t third_corner(const Triangle& face, std::uint32_t begin, std::uint32_t end) {
    for (const std::uint32_t corner : face) {
        if (corner < begin || corner >= end) { return corner; }
    }
    assert(false);
    return none;
}

template <class Item>
std::size_t bytes_of(const std::vector<Item>& items) {
    return items.capacity() * sizeof(Item);
}

} // namespace

ProgressiveMesh::ProgressiveMesh(ProgressiveMeshData parts) : parts_(std::move(parts)) {
    assert(parts_.positions_m.size() == leaf_count() + parts_.splits.size());
    assert(parts_.normals.size() == parts_.positions_m.size());
    if (face_count() > max_faces || leaf_count() > max_leaves) {
        throw Error(fmt::format("{}: expected at most {} faces and {} vertices to refine, got {} and {}", parts_.name,
            max_faces, max_leaves, face_count(), leaf_count()));
    }
    order_faces();
    order_nodes();
    find_cuts();
    bound_leaves();
    bound_nodes();
    bound_all();
}

ProgressiveMesh::ProgressiveMesh(const models::CollapseSequence& sequence) : ProgressiveMesh(mesh_data_of(sequence)) {}

/// Sorts the faces by their corners' leaf numbers, so that a split finds its faces close together in memory.
void ProgressiveMesh::order_faces() {
    const auto key = [&](std::uint32_t face) {
        Triangle corners = parts_.faces[face];
        std::ranges::sort(corners);
        return corners;
    };
    std::vector<std::uint32_t> order(face_count());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, key);
    std::vector<std::uint32_t> places(face_count());
    ProgressiveMeshData ordered;
    ordered.faces.reserve(face_count());
    ordered.original_faces.reserve(face_count());
    for (const std::uint32_t face : order) {
        places[face] = static_cast<std::uint32_t>(ordered.faces.size());
        ordered.faces.push_back(parts_.faces[face]);
        ordered.original_faces.push_back(parts_.original_faces.empty() ? face : parts_.original_faces[face]);
        if (!parts_.face_materials.empty()) { ordered.face_materials.push_back(parts_.face_materials[face]); }
    }
    ordered.face_materials.shrink_to_fit();
    parts_.faces = std::move(ordered.faces);
    parts_.original_faces = std::move(ordered.original_faces);
    parts_.face_materials = std::move(ordered.face_materials);
    for (VertexSplit& split : parts_.splits) {
        for (std::uint32_t* face : {&split.left_face, &split.right_face}) {
            *face = *face == none ? none : places[*face];
        }
    }
}

/// Finds the roots, makes errors monotone towards them, and gives the inner nodes their final numbers.
void ProgressiveMesh::order_nodes() {
    const auto leaves = static_cast<std::uint32_t>(leaf_count());
    std::vector<std::uint32_t> first_leaves(parts_.positions_m.size());
    std::iota(first_leaves.begin(), first_leaves.end(), 0U);
    std::vector<bool> has_parent(first_leaves.size(), false);
    auto node = leaves;
    for (VertexSplit& split : parts_.splits) {
        assert(split.first < node && split.second < node && split.first != split.second);
        for (const std::uint32_t child : {split.first, split.second}) {
            assert(!has_parent[child]);
            has_parent[child] = true;
            const float error_m = child < leaves ? 0.0F : parts_.splits[child - leaves].error_m;
            split.error_m = std::max(split.error_m, error_m);
        }
        first_leaves[node] = first_leaves[split.first];
        split.first_leaf = first_leaves[node];
        split.middle = first_leaves[split.second];
        ++node;
    }
    for (node = 0; node < has_parent.size(); ++node) {
        if (!has_parent[node]) { roots_.push_back(node); }
    }
    std::ranges::sort(roots_, {}, [&](std::uint32_t root) { return first_leaves[root]; });
    const std::vector<std::uint32_t> numbers = new_numbers();
    for (std::uint32_t& root : roots_) { root = numbers[root]; }
    packed_splits_.resize(parts_.splits.size());
    sequence_numbers_.resize(packed_splits_.size());
    for (node = leaves; node < numbers.size(); ++node) {
        const VertexSplit& split = parts_.splits[node - leaves];
        sequence_numbers_[numbers[node] - leaves] = node;
        packed_splits_[numbers[node] - leaves] = {split.first_leaf, split.middle & 0x7fffffffU,
            split.second < leaves ? 1U : 0U, split.left_face, split.right_face, none, none, split.error_m};
    }
    parts_.splits = {};
    place_shapes(numbers);
}

/// For each node of the parts its final number: a preorder walk that hands out numbers from the highest down. roots_
/// and splits still have the old numbers.
std::vector<std::uint32_t> ProgressiveMesh::new_numbers() const {
    const std::size_t leaves = leaf_count();
    std::vector<std::uint32_t> numbers(parts_.positions_m.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    auto next = static_cast<std::uint32_t>(numbers.size());
    std::vector<std::uint32_t> open(roots_.rbegin(), roots_.rend());
    while (!open.empty()) {
        const std::uint32_t node = open.back();
        open.pop_back();
        if (node >= leaves) {
            numbers[node] = --next;
            open.push_back(parts_.splits[node - leaves].second);
            open.push_back(parts_.splits[node - leaves].first);
        }
    }
    return numbers;
}

std::vector<std::uint32_t> ProgressiveMesh::coarsest_first() const {
    std::vector<std::uint32_t> nodes(packed_splits_.size());
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        nodes[node_count() - 1 - sequence_numbers_[i]] = static_cast<std::uint32_t>(leaf_count()) + i;
    }
    return nodes;
}

std::vector<bool> ProgressiveMesh::base_faces() const {
    std::vector<bool> base(face_count(), true);
    for (const PackedSplit& fork : packed_splits_) {
        for (const std::uint32_t face : {fork.left_face, fork.right_face}) {
            if (face != none) { base[face] = false; }
        }
    }
    return base;
}

/// Lays the shapes out with siblings side by side. `numbers` maps the numbers of the parts to the final ones.
void ProgressiveMesh::place_shapes(const std::vector<std::uint32_t>& numbers) {
    places_.resize(numbers.size());
    shapes_.resize(numbers.size());
    for (std::uint32_t i = 0; i < roots_.size(); ++i) { places_[roots_[i]] = i; }
    for (auto node = static_cast<std::uint32_t>(leaf_count()); node < places_.size(); ++node) {
        const std::size_t place = first_child_place(node);
        places_[split_of(node).first] = static_cast<std::uint32_t>(place);
        places_[split_of(node).second] = static_cast<std::uint32_t>(place + 1);
    }
    has_colours_ = !parts_.colours.empty();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        NodeGeometry& here = shape(numbers[i]);
        here.position_m = parts_.positions_m[i];
        here.normal = parts_.normals[i];
        if (has_colours_) { here.colour = parts_.colours[i]; }
    }
    parts_.positions_m = {};
    parts_.normals = {};
    parts_.colours = {};
}

ProgressiveMeshData ProgressiveMesh::full_data() const {
    ProgressiveMeshData parts = parts_;
    std::vector<std::uint32_t> nodes(leaf_count());
    std::iota(nodes.begin(), nodes.end(), 0U);
    const std::vector<std::uint32_t> inner = coarsest_first();
    nodes.insert(nodes.end(), inner.rbegin(), inner.rend());
    const auto old_number = [&](std::uint32_t node) { return is_leaf(node) ? node : sequence_number(node); };
    for (const std::uint32_t node : nodes) {
        parts.positions_m.push_back(shape(node).position_m);
        parts.normals.push_back(shape(node).normal);
        if (has_colours_) { parts.colours.push_back(shape(node).colour); }
        if (!is_leaf(node)) {
            const VertexSplit split = split_of(node);
            parts.splits.push_back(
                {old_number(split.first), old_number(split.second), split.left_face, split.right_face, split.error_m});
        }
    }
    return parts;
}

/// Finds the fundamental cut vertices of every inner node.
void ProgressiveMesh::find_cuts() {
    // For each inner node the end of the leaves below it.
    std::vector<std::uint32_t> ends(packed_splits_.size());
    for (auto node = static_cast<std::uint32_t>(leaf_count()); node < node_count(); ++node) {
        const std::size_t i = node - leaf_count();
        const std::uint32_t second = split_of(node).second;
        ends[i] = is_leaf(second) ? second + 1 : ends[second - leaf_count()];
        const auto cut = [&](std::uint32_t face) {
            return face == none ? none : third_corner(parts_.faces[face], packed_splits_[i].first_leaf, ends[i]);
        };
        packed_splits_[i].left_cut = cut(packed_splits_[i].left_face);
        packed_splits_[i].right_cut = cut(packed_splits_[i].right_face);
    }
}

std::size_t ProgressiveMesh::bytes() const {
    return sizeof(*this) + bytes_of(packed_splits_) + bytes_of(sequence_numbers_) + bytes_of(parts_.faces) +
           bytes_of(parts_.face_materials) + bytes_of(parts_.original_faces) + bytes_of(parts_.original_vertices) +
           bytes_of(roots_) + bytes_of(places_) + bytes_of(shapes_);
}

// Bounds the nodes of a vertex hierarchy by spheres and normal cones, for the view criterion.

namespace {

constexpr float pi = std::numbers::pi_v<float>;
/// A factor that makes up for the rounding of distances taken in float.
constexpr float rounding = 1.0F + 4e-6F;

float angle_rad(const glm::vec3& a, const glm::vec3& b) { return std::acos(glm::clamp(glm::dot(a, b), -1.0F, 1.0F)); }

/// An angle in steps of pi / 65535, rounded up so that a cone never gets too narrow.
std::uint16_t packed_angle(float angle_rad) {
    return static_cast<std::uint16_t>(std::min(65535.0F, std::ceil(angle_rad / pi * 65535.0F + 0.01F)));
}

} // namespace

/// Finds centre and diagonal of the bounding box.
void ProgressiveMesh::bound_all() {
    if (leaf_count() == 0) { return; }
    glm::vec3 min_m = position_m(0);
    glm::vec3 max_m = min_m;
    for (std::uint32_t leaf = 0; leaf < leaf_count(); ++leaf) {
        min_m = glm::min(min_m, position_m(leaf));
        max_m = glm::max(max_m, position_m(leaf));
    }
    middle_m_ = parts_.origin_m + 0.5 * (glm::dvec3(min_m) + glm::dvec3(max_m));
    half_diagonal_m_ = 0.5 * glm::distance(glm::dvec3(min_m), glm::dvec3(max_m));
}

/// Bounds each leaf by its adjacent original faces: their corners by a sphere, their normals by a cone.
void ProgressiveMesh::bound_leaves() {
    for (std::uint32_t face = 0; face < face_count(); ++face) {
        const glm::vec3 normal_of_face = face_normal(face);
        const bool flat = normal_of_face == glm::vec3(0.0F);
        const Triangle& corners = parts_.faces[face];
        for (const std::uint32_t leaf : corners) {
            NodeGeometry& here = shape(leaf);
            for (const std::uint32_t other : corners) {
                here.radius_m = std::max(here.radius_m, rounding * glm::distance(here.position_m, position_m(other)));
            }
            const float angle = flat ? 0.0F : angle_rad(normal(leaf), normal_of_face);
            here.cone = std::max(here.cone, packed_angle(angle));
        }
    }
}

/// Bounds each inner node by the spheres and cones of its children, from the finest nodes up.
void ProgressiveMesh::bound_nodes() {
    for (auto node = static_cast<std::uint32_t>(leaf_count()); node < node_count(); ++node) {
        const VertexSplit split = split_of(node);
        NodeGeometry& here = shape(node);
        float cone = 0.0F;
        for (const std::uint32_t child : {split.first, split.second}) {
            const float away_m = glm::distance(here.position_m, position_m(child));
            here.radius_m = std::max(here.radius_m, rounding * (away_m + radius_m(child)));
            cone = std::max(cone, angle_rad(normal(node), normal(child)) + cone_rad(child));
        }
        here.cone = packed_angle(cone);
    }
}

float ProgressiveMesh::cone_rad(std::uint32_t node) const {
    return static_cast<float>(shape(node).cone) / 65535.0F * pi;
}

glm::vec3 ProgressiveMesh::face_normal(std::uint32_t face) const {
    const Triangle& corners = parts_.faces[face];
    const glm::dvec3 a(position_m(corners[0]));
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(position_m(corners[1])) - a, glm::dvec3(position_m(corners[2])) - a);
    const double length = glm::length(normal);
    return length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0F);
}

} // namespace octant::visuals::refine
