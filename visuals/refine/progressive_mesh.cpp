// J. Kim, S. Lee, "Truly Selective Refinement of Progressive Meshes", Graphics Interface 2001,
// section 3: the vertex hierarchy and the fundamental cut vertices.
//
// Deviations: the fundamental cut vertices are not searched for along the border of both regions:
// they are the third corners of the two original faces that the collapse takes away.
#include "visuals/refine/progressive_mesh.h"

#include "visuals/refine/sequence_parts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

namespace octant::visuals::refine {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float rounding = 1.0F + 4e-6F; ///< of distances taken in float

float angle_rad(const glm::vec3& a, const glm::vec3& b) {
    return std::acos(glm::clamp(glm::dot(a, b), -1.0F, 1.0F));
}

std::uint16_t packed_angle(float angle_rad) {
    return static_cast<std::uint16_t>(
        std::min(65535.0F, std::ceil(angle_rad / pi * 65535.0F + 0.01F)));
}

std::uint32_t third_corner(const Triangle& face, std::uint32_t begin, std::uint32_t end) {
    for (const std::uint32_t corner : face) {
        if (corner < begin || corner >= end) {
            return corner;
        }
    }
    assert(false);
    return none;
}

template <class Item>
std::size_t bytes_of(const std::vector<Item>& items) {
    return items.capacity() * sizeof(Item);
}

} // namespace

ProgressiveMesh::ProgressiveMesh(ProgressiveParts parts)
    : parts_(std::move(parts)) {
    assert(parts_.positions_m.size() == leaf_count() + parts_.splits.size());
    assert(parts_.normals.size() == parts_.positions_m.size());
    order_faces();
    find_places();
    raise_errors();
    move_shapes();
    find_first_leaves();
    find_cuts();
    bound_leaves();
    bound_nodes();
}

ProgressiveMesh::ProgressiveMesh(const models::CollapseSequence& sequence)
    : ProgressiveMesh(parts_of(sequence)) {}

/// By their corners' places in the hierarchy: a split then finds its faces close together.
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
    ProgressiveParts ordered;
    ordered.faces.reserve(face_count());
    ordered.original_faces.reserve(face_count());
    for (const std::uint32_t face : order) {
        places[face] = static_cast<std::uint32_t>(ordered.faces.size());
        ordered.faces.push_back(parts_.faces[face]);
        ordered.original_faces.push_back(
            parts_.original_faces.empty() ? face : parts_.original_faces[face]);
        if (!parts_.face_materials.empty()) {
            ordered.face_materials.push_back(parts_.face_materials[face]);
        }
    }
    ordered.face_materials.shrink_to_fit();
    parts_.faces = std::move(ordered.faces);
    parts_.original_faces = std::move(ordered.original_faces);
    parts_.face_materials = std::move(ordered.face_materials);
    for (Split& split : parts_.splits) {
        for (std::uint32_t* face : {&split.left_face, &split.right_face}) {
            *face = *face == none ? none : places[*face];
        }
    }
}

void ProgressiveMesh::find_places() {
    places_.assign(parts_.positions_m.size(), none);
    auto node = static_cast<std::uint32_t>(leaf_count());
    for (const Split& split : parts_.splits) {
        assert(split.first < node && split.second < node && split.first != split.second);
        assert(places_[split.first] == none && places_[split.second] == none);
        places_[split.first] = 0; // no root
        places_[split.second] = 0;
        ++node;
    }
    for (node = 0; node < places_.size(); ++node) {
        if (places_[node] == none) {
            places_[node] = static_cast<std::uint32_t>(roots_.size());
            roots_.push_back(node);
        }
    }
    for (node = static_cast<std::uint32_t>(leaf_count()); node < places_.size(); ++node) {
        const std::size_t place = first_child_place(node);
        places_[split_of(node).first] = static_cast<std::uint32_t>(place);
        places_[split_of(node).second] = static_cast<std::uint32_t>(place + 1);
    }
}

void ProgressiveMesh::raise_errors() {
    for (Split& split : parts_.splits) {
        split.error_m = std::max({split.error_m, error_m(split.first), error_m(split.second)});
    }
}

void ProgressiveMesh::move_shapes() {
    has_colours_ = !parts_.colours.empty();
    shapes_.resize(node_count());
    for (std::uint32_t node = 0; node < node_count(); ++node) {
        shape(node).position_m = parts_.positions_m[node];
        shape(node).normal = parts_.normals[node];
        if (has_colours_) {
            shape(node).colour = parts_.colours[node];
        }
    }
    parts_.positions_m = {};
    parts_.normals = {};
    parts_.colours = {};
}

ProgressiveParts ProgressiveMesh::whole_parts() const {
    ProgressiveParts parts = parts_;
    for (std::uint32_t node = 0; node < node_count(); ++node) {
        parts.positions_m.push_back(shape(node).position_m);
        parts.normals.push_back(shape(node).normal);
        if (has_colours_) {
            parts.colours.push_back(shape(node).colour);
        }
    }
    return parts;
}

void ProgressiveMesh::find_first_leaves() {
    for (Split& split : parts_.splits) {
        split.first_leaf = first_leaf(split.first);
        split.middle = first_leaf(split.second);
    }
}

void ProgressiveMesh::find_cuts() {
    std::vector<std::uint32_t> ends(parts_.splits.size()); // of the leaves below each inner node
    const auto leaves = static_cast<std::uint32_t>(leaf_count());
    for (std::size_t i = 0; i < ends.size(); ++i) {
        Split& split = parts_.splits[i];
        ends[i] = is_leaf(split.second) ? split.second + 1 : ends[split.second - leaves];
        const auto cut = [&](std::uint32_t face) {
            return face == none ? none
                                : third_corner(parts_.faces[face], split.first_leaf, ends[i]);
        };
        split.left_cut = cut(split.left_face);
        split.right_cut = cut(split.right_face);
    }
}

void ProgressiveMesh::bound_leaves() {
    for (std::uint32_t face = 0; face < face_count(); ++face) {
        const glm::vec3 normal_of_face = face_normal(face);
        const bool flat = normal_of_face == glm::vec3(0.0F);
        const Triangle& corners = parts_.faces[face];
        for (const std::uint32_t leaf : corners) {
            NodeShape& here = shape(leaf);
            for (const std::uint32_t other : corners) {
                here.radius_m = std::max(
                    here.radius_m, rounding * glm::distance(here.position_m, position_m(other)));
            }
            const float angle = flat ? 0.0F : angle_rad(normal(leaf), normal_of_face);
            here.cone = std::max(here.cone, packed_angle(angle));
        }
    }
}

void ProgressiveMesh::bound_nodes() {
    for (auto node = static_cast<std::uint32_t>(leaf_count()); node < node_count(); ++node) {
        const Split& split = split_of(node);
        NodeShape& here = shape(node);
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

std::size_t ProgressiveMesh::bytes() const {
    return sizeof(*this) + bytes_of(parts_.splits) + bytes_of(parts_.faces) +
           bytes_of(parts_.face_materials) + bytes_of(parts_.original_faces) +
           bytes_of(parts_.original_vertices) + bytes_of(roots_) + bytes_of(places_) +
           bytes_of(shapes_);
}

} // namespace octant::visuals::refine
