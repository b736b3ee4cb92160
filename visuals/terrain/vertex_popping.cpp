// The measure of popping: what the quadtree paper does not look at (it counts triangles) and geomorphs remove. `octant
// study popping` plots it along flights.
//
// Most vertices of a mesh are in the next one, too, and tell its height there. A vertex that only one of two meshes has
// lies in the middle of an edge that is within one triangle of the other mesh (error_mesher.cpp), so that the other
// surface's height is the mean of that at the edge's ends. Only where a mesh does not tell the ends of its vertices is
// its surface searched.
#include "visuals/terrain/vertex_popping.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_precision.hpp>

#include <bit>
#include <cmath>

namespace octant::visuals::terrain {

namespace {

/// The cell of a grid that is finer than samples lie apart.
glm::i64vec2 cell_of(const glm::dvec2& place_m) {
    constexpr double cell_m = 0.25;
    return glm::i64vec2(glm::floor(place_m / cell_m));
}

} // namespace

void PoppingMeter::Frame::set_mesh(const GroundMesh& mesh, const PerspectiveView& view) {
    view_ = view;
    vertices_.assign(mesh.vertices.begin(), mesh.vertices.end());
    indices_.assign(mesh.indices.begin(), mesh.indices.end());
    morphs_.assign(mesh.morphs.begin(), mesh.morphs.end());
    has_surface_ = false;
    used_.assign(vertices_.size(), 0);
    for (const std::uint32_t vertex : indices_) { used_[vertex] = 1; }
    vertices_m_.clear();
    slots_.assign(std::bit_ceil(4 * vertices_.size() + 1), 0);
    for (std::uint32_t vertex = 0; vertex < vertices_.size(); ++vertex) {
        vertices_m_.push_back(view.eye_m + glm::dvec3(vertices_[vertex].position_m));
        // Vertices that are only ends of others are on the surface; what else is unused may not be.
        if (used_[vertex] == 0 && morphs_.empty()) { continue; }
        std::size_t slot = slot_of(cell_of(glm::dvec2(vertices_m_.back())));
        while (slots_[slot] != 0) { slot = (slot + 1) & (slots_.size() - 1); }
        slots_[slot] = vertex + 1;
    }
}

template <typename Take>
void PoppingMeter::Frame::for_each_used(const Take& set_mesh) const {
    for (std::uint32_t vertex = 0; vertex < used_.size(); ++vertex) {
        if (used_[vertex] != 0) { set_mesh(vertex, vertices_m_[vertex]); }
    }
}

std::size_t PoppingMeter::Frame::slot_of(const glm::i64vec2& cell) const {
    const auto column = static_cast<std::uint64_t>(cell.x);
    const auto row = static_cast<std::uint64_t>(cell.y);
    const std::uint64_t mixed = (column << 32U ^ (row & 0xffffffffU)) * 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(mixed >> 32U) & (slots_.size() - 1);
}

/// The height of this mesh's own vertex at a place; nothing where it has none.
std::optional<double> PoppingMeter::Frame::own_height_at(const glm::dvec3& place_m) const {
    constexpr double rounding = 1e-6; // Positions are floats from the eye.
    const glm::dvec2 place(place_m);
    const glm::dvec2 away_m = glm::abs(place - glm::dvec2(view_.eye_m));
    const double near_m = rounding * (away_m.x + away_m.y);
    const glm::i64vec2 first = cell_of(place - near_m);
    const glm::i64vec2 last = cell_of(place + near_m);
    glm::i64vec2 cell = first;
    for (cell.y = first.y; cell.y <= last.y; ++cell.y) {
        for (cell.x = first.x; cell.x <= last.x; ++cell.x) {
            for (std::size_t slot = slot_of(cell); slots_[slot] != 0; slot = (slot + 1) & (slots_.size() - 1)) {
                const glm::dvec3& own_m = vertices_m_[slots_[slot] - 1];
                const glm::dvec2 off_m = glm::abs(glm::dvec2(own_m) - place);
                if (off_m.x + off_m.y <= near_m) { return own_m.z; }
            }
        }
    }
    return std::nullopt;
}

std::optional<double> PoppingMeter::Frame::height_at(const Frame& other, std::uint32_t vertex) {
    const glm::dvec3& place_m = other.vertices_m_[vertex];
    if (const auto own_m = own_height_at(place_m)) { return own_m; }
    if (!morphs_.empty() && !other.morphs_.empty()) {
        const VertexMorph& origin = other.morphs_[vertex];
        if (origin.parent_a != vertex) {
            const auto from_a = height_at(other, origin.parent_a);
            const auto from_b = height_at(other, origin.parent_b);
            return from_a && from_b ? std::optional(0.5 * (*from_a + *from_b)) : std::nullopt;
        }
    }
    if (!has_surface_) {
        GroundMesh mesh;
        mesh.vertices = vertices_;
        mesh.indices = indices_;
        surface_.set_mesh(mesh, view_.eye_m);
        has_surface_ = true;
    }
    return surface_.height_at(place_m.x, place_m.y);
}

std::optional<VertexPopping> PoppingMeter::next(const GroundMesh& mesh, const PerspectiveView& view) {
    Frame& later = frames_[taken_ % 2];
    Frame& earlier = frames_[(taken_ + 1) % 2];
    later.set_mesh(mesh, view);
    if (++taken_ == 1) { return std::nullopt; }
    VertexPopping most;
    compare_at(later, earlier, later, most);
    compare_at(earlier, later, later, most);
    return most;
}

/// Compares the vertices of `own` with the surface of `other`, as seen from `later`.
void PoppingMeter::compare_at(const Frame& own, Frame& other, const Frame& later, VertexPopping& most) {
    const PerspectiveView& view = later.view();
    own.for_each_used([&](std::uint32_t vertex, const glm::dvec3& vertex_m) {
        const auto shows = [&vertex_m](const PerspectiveView& picture) {
            return picture.shows(picture.seen_m(vertex_m - picture.eye_m));
        };
        if (!shows(own.view()) || !shows(other.view())) { return; }
        const auto height_m = other.height_at(own, vertex);
        if (!height_m) { return; }
        const glm::dvec3 there = view.seen_m(glm::dvec3(vertex_m.x, vertex_m.y, *height_m) - view.eye_m);
        if (there.z < view.near_m) { return; }
        const glm::dvec3 seen = view.seen_m(vertex_m - view.eye_m);
        const double popping_px = glm::distance(view.pixel(seen), view.pixel(there));
        if (popping_px > most.popping_px) { most = {popping_px, vertex_m}; }
    });
}

} // namespace octant::visuals::terrain
