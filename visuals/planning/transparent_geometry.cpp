#include "visuals/planning/transparent_geometry.h"

#include "visuals/planning/sky.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace octant::visuals::planning {

namespace {

constexpr float nearest_m = 0.3F;
/// How far beyond the view's sides triangles are cut.
constexpr float margin = 1.05F;

/// Distances to the planes in clip space, below zero outside.
constexpr int planes = 5;

float before_plane(const glm::vec4& clip, int plane) {
    switch (plane) {
    case 0:
        return clip.w - nearest_m;
    case 1:
        return margin * clip.w - clip.x;
    case 2:
        return margin * clip.w + clip.x;
    case 3:
        return margin * clip.w - clip.y;
    default:
        return margin * clip.w + clip.y;
    }
}

glm::vec3 rgb_of(std::uint32_t colour) {
    return glm::vec3(static_cast<float>(colour & 0xffU), static_cast<float>(colour >> 8U & 0xffU),
               static_cast<float>(colour >> 16U & 0xffU)) /
           255.0F;
}

std::uint32_t packed(const glm::vec4& colour) {
    const auto alpha = static_cast<std::uint32_t>(std::lround(255.0F * std::clamp(colour.w, 0.0F, 1.0F)));
    return (models::packed_colour(glm::vec3(colour)) & 0x00ffffffU) | (alpha << 24U);
}

} // namespace

void TransparentGeometry::begin(const glm::mat4& world_to_clip, const glm::ivec2& size_px, const scene::Haze& haze) {
    world_to_clip_ = world_to_clip;
    size_px_ = glm::vec2(size_px);
    haze_ = &haze;
    vertices_.clear();
    indices_.clear();
}

TransparentGeometry::TransparentVertex TransparentGeometry::placed(const models::ColourVertex& vertex) const {
    TransparentVertex vertex_out;
    vertex_out.clip = world_to_clip_ * glm::vec4(vertex.position_m, 1.0F);
    for (int plane = 0; plane < planes; ++plane) {
        vertex_out.outside |= before_plane(vertex_out.clip, plane) < 0.0F ? 1U << plane : 0U;
    }
    return vertex_out;
}

/// Through the haze, unless it has been asked for before.
void TransparentGeometry::colour(const models::ColourVertex& vertex, TransparentVertex& vertex_out) const {
    if (vertex_out.colour.x < 0.0F) {
        vertex_out.colour = glm::vec4(through_haze(*haze_, glm::dvec3(vertex.position_m), rgb_of(vertex.colour)),
            static_cast<float>(vertex.colour >> 24U) / 255.0F);
    }
}

TransparentRange TransparentGeometry::add(
    std::span<const models::ColourVertex> vertices, std::span<const std::uint32_t> indices) {
    TransparentRange range{indices_.size(), 0};
    vertex_cache_.clear();
    for (const models::ColourVertex& vertex : vertices) { vertex_cache_.push_back(placed(vertex)); }
    std::array<TransparentVertex, 3> three;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        std::uint32_t all = ~0U;
        std::uint32_t any = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const TransparentVertex& vertex_out = vertex_cache_[indices[i + k]];
            all &= vertex_out.outside;
            any |= vertex_out.outside;
        }
        if (all != 0) { continue; }
        for (std::size_t k = 0; k < 3; ++k) {
            TransparentVertex& vertex_out = vertex_cache_[indices[i + k]];
            colour(vertices[indices[i + k]], vertex_out);
            three[k] = vertex_out;
        }
        if (any == 0) {
            add_polygon(three);
        } else {
            polygon_.assign(three.begin(), three.end());
            cut();
            add_polygon(polygon_);
        }
    }
    range.count = indices_.size() - range.first;
    return range;
}

/// Cuts the polygon down to the view (Sutherland and Hodgman 1974).
void TransparentGeometry::cut() {
    for (int plane = 0; plane < planes; ++plane) {
        scratch_.clear();
        for (std::size_t i = 0; i < polygon_.size(); ++i) {
            const TransparentVertex& from = polygon_[i];
            const TransparentVertex& to = polygon_[(i + 1) % polygon_.size()];
            const float from_m = before_plane(from.clip, plane);
            const float to_m = before_plane(to.clip, plane);
            if (from_m >= 0.0F) { scratch_.push_back(from); }
            if ((from_m < 0.0F) != (to_m < 0.0F)) {
                const float share = from_m / (from_m - to_m);
                scratch_.push_back({glm::mix(from.clip, to.clip, share), glm::mix(from.colour, to.colour, share), 0});
            }
        }
        std::swap(polygon_, scratch_);
    }
}

void TransparentGeometry::add_polygon(std::span<const TransparentVertex> corners) {
    if (corners.size() < 3) { return; }
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    for (const TransparentVertex& vertex_out : corners) {
        const glm::vec2 at = glm::vec2(vertex_out.clip) / vertex_out.clip.w;
        vertices_.push_back({glm::vec2(0.5F + 0.5F * at.x, 0.5F - 0.5F * at.y) * size_px_, packed(vertex_out.colour)});
    }
    for (std::uint32_t i = 2; i < corners.size(); ++i) {
        indices_.insert(indices_.end(), {first, first + i - 1, first + i});
    }
}

} // namespace octant::visuals::planning
