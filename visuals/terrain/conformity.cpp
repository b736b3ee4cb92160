// Tests that a mesh of the ground is conforming, by matching edges: the property that the paper's fans and the
// bisection promise, and that cracks violate.
//
// Edges are kept by their vertices' numbers in an open hash table. An edge with a single triangle is allowed at the
// field's border and where the frustum does not see it. A vertex inside an edge leaves that edge open, so that only
// open edges need to be compared with vertices, and only with those of open edges.
#include "visuals/terrain/conformity.h"

#include "sim/base/geometry2d.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace octant::visuals::terrain {

namespace {

/// Vertices are snapped to this fraction of a sample, which floats far from the eye still resolve.
constexpr double snap_steps_per_sample = 256.0;

constexpr std::uint64_t hash_factor = 0x9e3779b97f4a7c15ULL;

/// Whether any part of a line (relative to the eye) is inside the frustum by more than rounding.
bool is_seen(const glm::dvec3& a_m, const glm::dvec3& b_m, const MeshView& view) {
    const double rounding_m = 1e-2 + 1e-6 * std::max(glm::length(a_m), glm::length(b_m));
    double first = 0.0;
    double last = 1.0;
    for (const glm::dvec3& normal : view.frustum_normals) {
        if (normal == glm::dvec3(0.0)) { continue; }
        const double at_a = glm::dot(normal, a_m) - rounding_m;
        const double at_b = glm::dot(normal, b_m) - rounding_m;
        if (at_a < 0.0 && at_b < 0.0) { return false; }
        if (at_a < 0.0) {
            first = std::max(first, at_a / (at_a - at_b));
        } else if (at_b < 0.0) {
            last = std::min(last, at_a / (at_a - at_b));
        }
    }
    return first < last;
}

/// An order of positions: west before east, then south before north.
bool before(const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

} // namespace

std::string Conformity::text() const {
    return fmt::format("{} open edges, {} corners on edges, {} crowded edges, {} turned triangles, {} doubled "
                       "vertices",
        open_edges, t_junctions, overlapping_edges, inverted_triangles, duplicate_vertices);
}

ConformityCheck::ConformityCheck(const GroundSamples& ground)
    : spacing_m_(ground.spacing_m()), half_extent_m_(ground.half_extent_m()),
      last_(ground.columns() - 1, ground.rows() - 1) {}

Conformity ConformityCheck::check(const GroundMesh& mesh, const MeshView& view) {
    Conformity found;
    locate_vertices(mesh, view);
    match_edges(mesh, found);
    open_.clear();
    for (const Edge& edge : edges_) {
        if (edge.mesh != mesh_) { continue; }
        found.overlapping_edges += edge.forward > 1 || edge.back > 1 ? 1 : 0;
        if (edge.forward + edge.back != 1 || on_border(places_[edge.low], places_[edge.high])) { continue; }
        open_.push_back(edge);
        const bool seen = is_seen(
            glm::dvec3(mesh.vertices[edge.low].position_m), glm::dvec3(mesh.vertices[edge.high].position_m), view);
        found.open_edges += seen ? 1 : 0;
    }
    found.t_junctions = count_t_junctions();
    found.duplicate_vertices = duplicate_vertices();
    return found;
}

/// Snaps all vertices to the grid.
void ConformityCheck::locate_vertices(const GroundMesh& mesh, const MeshView& view) {
    places_.clear();
    for (const models::ColourVertex& vertex : mesh.vertices) {
        const glm::dvec2 world_m = glm::dvec2(vertex.position_m) + glm::dvec2(view.eye_m);
        places_.push_back(
            glm::round((world_m + half_extent_m_) * (snap_steps_per_sample / spacing_m_)) / snap_steps_per_sample);
    }
}

/// Enters all edges into the hash table and counts turned triangles.
void ConformityCheck::match_edges(const GroundMesh& mesh, Conformity& found) {
    const std::size_t wanted = std::bit_ceil(2 * mesh.indices.size() + 2);
    if (edges_.size() < wanted) {
        edges_.assign(wanted, {});
        mesh_ = 0;
    }
    ++mesh_;
    used_.assign(mesh.vertices.size(), 0);
    for (const std::uint32_t vertex : mesh.indices) { used_[vertex] = 1; }
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        const std::uint32_t a = mesh.indices[k];
        const std::uint32_t b = mesh.indices[k + 1];
        const std::uint32_t c = mesh.indices[k + 2];
        found.inverted_triangles += octant::signed_area2(places_[a], places_[b], places_[c]) > 0.0 ? 0 : 1;
        add_edge(a, b);
        add_edge(b, c);
        add_edge(c, a);
    }
}

void ConformityCheck::add_edge(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t low = std::min(from, to);
    const std::uint32_t high = std::max(from, to);
    const std::size_t mask = edges_.size() - 1;
    const std::uint64_t mixed = (std::uint64_t{low} << 32U | std::uint64_t{high}) * hash_factor;
    std::size_t slot = static_cast<std::size_t>(mixed >> 32U) & mask;
    while (edges_[slot].mesh == mesh_ && (edges_[slot].low != low || edges_[slot].high != high)) {
        slot = (slot + 1) & mask;
    }
    Edge& edge = edges_[slot];
    if (edge.mesh != mesh_) { edge = {low, high, mesh_, 0, 0}; }
    std::uint16_t& way = from == low ? edge.forward : edge.back;
    ++way;
}

bool ConformityCheck::on_border(const glm::dvec2& a, const glm::dvec2& b) const {
    return (a.x == b.x && (a.x == 0.0 || a.x == last_.x)) || (a.y == b.y && (a.y == 0.0 || a.y == last_.y));
}

/// Counts used vertices at positions that another vertex has.
int ConformityCheck::duplicate_vertices() {
    constexpr std::uint32_t free_slot = ~std::uint32_t{0};
    const std::size_t mask = std::bit_ceil(2 * places_.size() + 2) - 1;
    slots_.assign(mask + 1, free_slot);
    int doubled = 0;
    for (std::uint32_t k = 0; k < places_.size(); ++k) {
        if (used_[k] == 0) { continue; }
        const glm::dvec2 part = places_[k] * snap_steps_per_sample;
        const auto east = static_cast<std::uint64_t>(static_cast<std::int64_t>(part.x));
        const auto north = static_cast<std::uint64_t>(static_cast<std::int64_t>(part.y));
        auto slot = static_cast<std::size_t>((east << 32U ^ north) * hash_factor >> 32U) & mask;
        while (slots_[slot] != free_slot && places_[slots_[slot]] != places_[k]) { slot = (slot + 1) & mask; }
        doubled += slots_[slot] == free_slot ? 0 : 1;
        slots_[slot] = k;
    }
    return doubled;
}

/// Counts vertices strictly inside open edges.
int ConformityCheck::count_t_junctions() {
    sorted_.clear();
    for (const Edge& edge : open_) {
        sorted_.push_back(edge.low);
        sorted_.push_back(edge.high);
    }
    const auto by_place = [&](std::uint32_t a, std::uint32_t b) { return before(places_[a], places_[b]); };
    std::sort(sorted_.begin(), sorted_.end(), by_place);
    sorted_.erase(std::unique(sorted_.begin(), sorted_.end()), sorted_.end());
    int corners = 0;
    for (const Edge& edge : open_) {
        const bool turned = before(places_[edge.high], places_[edge.low]);
        const std::uint32_t first = turned ? edge.high : edge.low;
        const std::uint32_t end = turned ? edge.low : edge.high;
        auto at = std::upper_bound(sorted_.begin(), sorted_.end(), first, by_place);
        for (; at != sorted_.end() && before(places_[*at], places_[end]); ++at) {
            corners += octant::signed_area2(places_[first], places_[end], places_[*at]) == 0.0 ? 1 : 0;
        }
    }
    return corners;
}

} // namespace octant::visuals::terrain
