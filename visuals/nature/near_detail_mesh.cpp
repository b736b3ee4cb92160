#include "visuals/nature/near_detail_mesh.h"

#include "sim/base/geometry2d.h"
#include "sim/base/hash.h"
#include "visuals/nature/near_detail_edges.h"
#include "visuals/nature/scenery.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace octant::visuals::nature {

namespace {

constexpr std::size_t min_places = std::size_t{1} << 15U;
constexpr float full_offset_ratio = 1.8F; ///< times as long: the middle is where it belongs
constexpr float offset_per_slope = 0.3F;
constexpr float shade = 0.16F;
constexpr float level_slope = 0.1F;  ///< edges more level than this have fewer shades
constexpr float quarter_edge = 1.2F; ///< over the sample distance: quarters of cells are shorter

/// In [-1, 1) by a place in the world.
float noise_at(std::int64_t column, std::int64_t row, std::uint32_t salt) {
    const auto x = static_cast<std::uint32_t>(column);
    const auto y = static_cast<std::uint32_t>(row);
    const std::uint32_t h = scrambled(x * 0x9e3779b1U ^ scrambled(y + salt * 0x85ebca77U));
    return static_cast<float>(h >> 8U) * (2.0F / 16777216.0F) - 1.0F;
}

/// Each part of two colours mixed, red, green and blue times a factor.
std::uint32_t blended(std::uint32_t a, std::uint32_t b, float share_of_b, float factor) {
    std::uint32_t blend = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) {
        const auto own = static_cast<float>(a >> shift & 0xffU);
        const auto other = static_cast<float>(b >> shift & 0xffU);
        const float mean = own + share_of_b * (other - own);
        const float part = std::clamp(mean * (shift < 24 ? factor : 1.0F) + 0.5F, 0.0F, 255.0F);
        blend |= static_cast<std::uint32_t>(part) << shift;
    }
    return blend;
}

} // namespace

void NearDetailMesh::begin(
    const NearDetailView& view,
    std::span<const models::ColourVertex> vertices,
    Scenery* scenery,
    const ColourAtPoint* colour) {
    view_ = view;
    scenery_ = scenery;
    colour_ = colour;
    vertices_.assign(vertices.begin(), vertices.end());
    midpoints_.resize(std::max({min_places, std::bit_ceil(2 * view.max_splits), midpoints_.size()}));
    ++frame_;
    added_ = 0;
}

bool NearDetailMesh::exceeds_min_edge(std::uint32_t a, std::uint32_t b) const {
    const glm::vec3& from = vertices_[a].position_m;
    const glm::vec3& to = vertices_[b].position_m;
    return squared_angular_size(from, to) > view_.min_edge_rad * view_.min_edge_rad && is_splittable(view_, from, to);
}

/// The vertex in the middle of an edge that is halved; the edge's first end where it stays whole.
std::uint32_t NearDetailMesh::midpoint_of(std::uint32_t a, std::uint32_t b) {
    if (a > b) {
        std::swap(a, b);
    }
    if (!exceeds_min_edge(a, b)) {
        return a;
    }
    const std::uint64_t edge = (std::uint64_t{a} << 32U | b) + 1;
    const std::size_t mask = midpoints_.size() - 1;
    std::size_t at = scrambled(a * 0x9e3779b1U ^ b) & mask;
    while (midpoints_[at].frame == frame_ && midpoints_[at].edge != edge) {
        at = (at + 1) & mask;
    }
    EdgeMidpoint& middle = midpoints_[at];
    if (middle.frame != frame_) {
        if (added_ >= view_.max_splits) {
            return a;
        }
        middle = {edge, add_midpoint(a, b), frame_};
    }
    return middle.vertex;
}

/// How far the middle of an edge between neighbouring samples, or shorter, lies above it when it
/// has wholly come; nothing under what stands on the ground, which stays even.
float NearDetailMesh::vertical_offset_m(
    const glm::vec3& from_m, const glm::vec3& to_m, const glm::dvec2& place_m) const {
    if (scenery_ != nullptr && scenery_->has_scenery_at(place_m)) {
        return 0.0F;
    }
    const auto spacing_m = static_cast<float>(view_.spacing_m);
    const float max_m = std::min(
        offset_per_slope * std::abs(to_m.z - from_m.z),
        static_cast<float>(max_offset_ratio) * spacing_m);
    const double cell_m = view_.spacing_m / 64.0;
    return 0.5F * max_m *
           noise_at(std::llround(place_m.x / cell_m), std::llround(place_m.y / cell_m), 1);
}

std::uint32_t NearDetailMesh::add_midpoint(std::uint32_t a, std::uint32_t b) {
    const models::ColourVertex from = vertices_[a];
    const models::ColourVertex to = vertices_[b];
    glm::vec3 at_m = 0.5F * (from.position_m + to.position_m);
    const glm::dvec2 place_m = glm::dvec2(at_m) + glm::dvec2(view_.eye_m);
    const float length_m = std::sqrt(squared_plan_length_m2(from.position_m, to.position_m));
    const float distance_m = std::max(std::sqrt(squared_length(at_m)), min_detail_distance_m);
    const float grown = std::clamp(
        (length_m / (view_.min_edge_rad * distance_m) - 1.0F) / (full_offset_ratio - 1.0F), 0.0F, 1.0F);
    std::uint32_t colour = blended(from.colour, to.colour, 0.5F, 1.0F);
    if (colour_ != nullptr) {
        colour = blended(colour, (*colour_)(place_m, at_m), grown, 1.0F);
    }
    if (length_m < 1.45F * static_cast<float>(view_.spacing_m) && colour >> 24U != 0) {
        const float slope = std::abs(to.position_m.z - from.position_m.z) / length_m;
        const float rough = std::min(slope / level_slope, 1.0F);
        const double cell_m = view_.spacing_m / 64.0;
        const float shades =
            noise_at(std::llround(place_m.x / cell_m), std::llround(place_m.y / cell_m), 2);
        at_m.z += grown * vertical_offset_m(from.position_m, to.position_m, place_m);
        colour = blended(colour, colour, 0.0F, 1.0F + shade * grown * rough * shades);
    }
    vertices_.push_back({at_m, colour});
    return static_cast<std::uint32_t>(vertices_.size() - 1);
}

void NearDetailMesh::add(
    const std::uint32_t* corners, bool has_scenery, std::vector<std::uint32_t>& indices) {
    add_subdivided({corners[0], corners[1], corners[2]}, 0, has_scenery, indices);
}

bool NearDetailMesh::is_outside(const TriangleIndices& triangle) const {
    return octant::visuals::nature::is_outside(
        view_,
        {vertices_[triangle.a].position_m,
         vertices_[triangle.b].position_m,
         vertices_[triangle.c].position_m});
}

/// Things stand within quarters of cells, which are even where anything stands.
bool NearDetailMesh::is_quarter_cell(const TriangleIndices& triangle) const {
    const glm::vec3& a = vertices_[triangle.a].position_m;
    const glm::vec3& b = vertices_[triangle.b].position_m;
    const glm::vec3& c = vertices_[triangle.c].position_m;
    const float max_m = quarter_edge * static_cast<float>(view_.spacing_m);
    return std::max({squared_plan_length_m2(a, b), squared_plan_length_m2(b, c), squared_plan_length_m2(c, a)}) <
           max_m * max_m;
}

void NearDetailMesh::add_scenery(const TriangleIndices& triangle, std::vector<std::uint32_t>& indices) {
    scenery_->add(
        {vertices_[triangle.a].position_m,
         vertices_[triangle.b].position_m,
         vertices_[triangle.c].position_m},
        vertices_,
        indices);
}

/// Halves a triangle by its longest edge that looks long, and its parts likewise. The plane through
/// the cut stands upright, so that the part on the eye's side hides nothing of the other. What
/// stands on the triangle goes with its parts down to quarters of cells, unless a cut goes through
/// quarters, as it does where a longer edge stays whole.
void NearDetailMesh::add_subdivided(
    const TriangleIndices& triangle, int depth, bool has_scenery, std::vector<std::uint32_t>& indices) {
    const TriangleIndices turns[3] = {
        triangle, {triangle.b, triangle.c, triangle.a}, {triangle.c, triangle.a, triangle.b}};
    const TriangleIndices* longest = nullptr;
    std::uint32_t middle = 0;
    float length2 = 0.0F;
    float most2 = 0.0F;
    const bool whole = depth >= max_split_depth || (depth > 0 && is_outside(triangle));
    for (const TriangleIndices& turn : turns) {
        const float own2 =
            squared_plan_length_m2(vertices_[turn.a].position_m, vertices_[turn.b].position_m);
        most2 = std::max(most2, own2);
        if (own2 <= length2 || whole) {
            continue;
        }
        const std::uint32_t own = midpoint_of(turn.a, turn.b);
        if (own != std::min(turn.a, turn.b)) {
            longest = &turn;
            middle = own;
            length2 = own2;
        }
    }
    const bool cuts_quarters = length2 < most2;
    if (has_scenery && (longest == nullptr || cuts_quarters || is_quarter_cell(triangle))) {
        add_scenery(triangle, indices);
        has_scenery = false;
    }
    if (longest == nullptr) {
        for (const std::uint32_t corner : {triangle.a, triangle.b, triangle.c}) {
            indices.push_back(corner);
        }
        return;
    }
    ++added_;
    const TriangleIndices first{longest->a, middle, longest->c};
    const TriangleIndices second{middle, longest->b, longest->c};
    const glm::vec3& cut_from = vertices_[longest->c].position_m;
    const glm::vec3& cut_to = vertices_[middle].position_m;
    const bool eye_by_first =
        (signed_area2(cut_from, cut_to, glm::vec3(0.0F)) > 0.0F) ==
        (signed_area2(cut_from, cut_to, vertices_[longest->a].position_m) > 0.0F);
    add_subdivided(eye_by_first ? first : second, depth + 1, has_scenery, indices);
    add_subdivided(eye_by_first ? second : first, depth + 1, has_scenery, indices);
}

} // namespace octant::visuals::nature
