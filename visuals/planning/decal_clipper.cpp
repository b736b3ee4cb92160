#include "visuals/planning/decal_clipper.h"

#include "visuals/planning/ground_frame.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::planning {

namespace {

constexpr double min_area_m2 = 1e-5;
/// A little more than two of scene::screen_step_px, by which two sides may be rounded apart.
constexpr double overlap_px = 0.01;
constexpr double max_overlap = 0.05; ///< of the distance from the eye

double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// How far a corner of an edge moves across it in a plane, along a vector of length 1 on the map,
/// so that the eye sees it move by an angle. `across` is in the plane, `sideways` a unit vector
/// across the plane through the eye and the edge.
double moved_m(
    const glm::dvec3& corner_m,
    const glm::dvec3& across,
    const glm::dvec3& sideways,
    double angle_rad) {
    const double seen = std::abs(glm::dot(across, sideways));
    return glm::length(corner_m) * std::min(angle_rad / std::max(seen, 1e-9), max_overlap);
}

} // namespace

void DecalClipper::begin(const scene::TriangleDraw& triangles, const FrameView& view) {
    triangles_ = triangles;
    view_ = &view;
    overlap_rad_ = overlap_px * view.pixel_rad;
    decals_.clear();
    corners_m_.clear();
    triangle_count_ = 0;
}

void DecalClipper::set_triangle(std::uint32_t triangle) {
    number_ = triangle;
    has_sides_ = false;
    place_triangle(triangles_, triangle, triangle_);
    for (std::size_t i = 0; i < 3; ++i) {
        corners_on_plan_m_[i] = glm::dvec2(triangle_[i].at_m);
    }
}

bool DecalClipper::is_seen() const {
    const glm::dvec3& a = triangle_[0].at_m;
    const glm::dvec3 up = glm::cross(triangle_[1].at_m - a, triangle_[2].at_m - a);
    return up.z > 0.0 && glm::dot(up, a) < 0.0 && may_be_in_view();
}

/// False only for a triangle of which nothing is in view, nor of what is painted a little beyond
/// its sides.
bool DecalClipper::may_be_in_view() const {
    return std::ranges::all_of(view_->frustum, [&](const glm::dvec3& inwards) {
        return std::ranges::any_of(triangle_, [&](const ViewVertex& corner) {
            const double inside_m = glm::dot(inwards, corner.at_m);
            return inside_m >= 0.0 || inside_m >= -view_->pixel_rad * glm::length(corner.at_m);
        });
    });
}

glm::vec3 DecalClipper::colour() const {
    const std::uint32_t* const corner = &triangles_.indices[std::size_t{3} * number_];
    glm::vec3 sum(0.0F);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t packed = triangles_.vertices[corner[i]].colour;
        sum += glm::vec3(packed & 0xffU, packed >> 8U & 0xffU, packed >> 16U & 0xffU);
    }
    return sum / (3.0F * 255.0F);
}

bool DecalClipper::is_scenery() const {
    const std::uint32_t* const corner = &triangles_.indices[std::size_t{3} * number_];
    return std::all_of(corner, corner + 3, [&](std::uint32_t vertex) {
        return triangles_.vertices[vertex].colour >> 24U == 0;
    });
}

/// The plane and the sides of the triangle at hand, and how far each end moves outwards to overlap:
/// on most triangles nothing is laid.
void DecalClipper::place_sides() {
    has_sides_ = true;
    plane_ = plane_of(triangle_);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& from_m = triangle_[i].at_m;
        const glm::dvec3& to_m = triangle_[(i + 1) % 3].at_m;
        const glm::dvec2 edge = glm::normalize(glm::dvec2(to_m - from_m));
        const glm::dvec2 out(edge.y, -edge.x);
        const glm::dvec3 across(out, -glm::dot(glm::dvec2(plane_.normal), out) / plane_.normal.z);
        const glm::dvec3 upright = glm::cross(from_m, to_m);
        const glm::dvec3 sideways = upright / std::max(glm::length(upright), 1e-9);
        sides_[i] = {
            glm::dvec2(from_m),
            glm::dvec2(to_m),
            out,
            moved_m(from_m, across, sideways, overlap_rad_),
            moved_m(to_m, across, sideways, overlap_rad_)};
    }
}

/// Cuts off what lies to the right of a line.
void DecalClipper::cut(ClippedPatch& piece, const glm::dvec2& from, const glm::dvec2& to) {
    ClippedPatch kept;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const glm::dvec2& a = piece.corners[i];
        const glm::dvec2& b = piece.corners[i + 1 < piece.count ? i + 1 : 0];
        const double a_side = area2(from, to, a);
        const double b_side = area2(from, to, b);
        if (a_side >= 0.0) {
            kept.corners[kept.count++] = a;
        }
        if ((a_side > 0.0 && b_side < 0.0) || (a_side < 0.0 && b_side > 0.0)) {
            kept.corners[kept.count++] = glm::mix(a, b, a_side / (a_side - b_side));
        }
    }
    piece = kept;
}

/// Which sides of the triangle at hand cut a patch; nothing where it lies beyond one of them.
std::optional<DecalClipper::SideFlags> DecalClipper::sides_across(const ClippedPatch& patch) const {
    SideFlags across{};
    for (std::size_t side = 0; side < sides_.size(); ++side) {
        std::size_t inside = 0;
        for (std::size_t i = 0; i < patch.count; ++i) {
            const bool is_in =
                area2(sides_[side].from_m, sides_[side].to_m, patch.corners[i]) >= 0.0;
            inside += is_in ? 1U : 0U;
        }
        if (inside == 0) {
            return std::nullopt;
        }
        across[side] = inside < patch.count;
    }
    return across;
}

/// A patch cut to some sides of the triangle at hand, which move out by so many overlaps.
DecalClipper::ClippedPatch
DecalClipper::piece_of(const ClippedPatch& patch, const SideFlags& across, double overlaps) const {
    ClippedPatch piece = patch;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        if (across[i]) {
            const Side& side = sides_[i];
            cut(piece,
                side.from_m + side.out * (side.from_moved_m * overlaps),
                side.to_m + side.out * (side.to_moved_m * overlaps));
        }
    }
    return piece;
}

void DecalClipper::add_decal(
    const Patch& patch, std::uint32_t colour, GroundLayer layer, double overlaps) {
    const auto area_m2 = [](const ClippedPatch& piece) {
        double sum_m2 = 0.0;
        for (std::size_t i = 2; i < piece.count; ++i) {
            sum_m2 += 0.5 * area2(piece.corners[0], piece.corners[i - 1], piece.corners[i]);
        }
        return sum_m2;
    };
    if (!has_sides_) {
        place_sides();
    }
    ClippedPatch all{{}, patch.size()};
    std::ranges::copy(patch, all.corners.begin());
    const std::optional<SideFlags> across = sides_across(all);
    if (!across || area_m2(piece_of(all, *across, 0.0)) <= min_area_m2) {
        return;
    }
    const ClippedPatch piece = piece_of(all, *across, overlaps);
    decals_.push_back(
        {number_,
         static_cast<std::uint32_t>(corners_m_.size()),
         static_cast<std::uint32_t>(piece.count),
         colour,
         layer});
    for (std::size_t i = 0; i < piece.count; ++i) {
        const glm::dvec2& at_m = piece.corners[i];
        const double up_m =
            -(glm::dot(glm::dvec2(plane_.normal), at_m) + plane_.offset_m) / plane_.normal.z;
        corners_m_.emplace_back(at_m, up_m);
    }
    triangle_count_ += static_cast<int>(piece.count) - 2;
}

} // namespace octant::visuals::planning
