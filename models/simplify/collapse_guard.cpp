// Keeps edge collapses and vertex moves from folding the surface over or making slivers: the test
// of the angle between old and new normal of M. Garland and P. Heckbert (1997), and a lower bound
// of each triangle's compactness. The topology has a test of its own,
// CollapsibleMesh::may_collapse.
#include "models/simplify/collapse_guard.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::models::simplify {

namespace {

/// Between a triangle's normal before and after; 0.2 is 78 degrees.
constexpr double least_cosine = 0.2;
/// The least roundness: twice the area over the sum of the squared sides, which is 0.58 for an
/// equilateral triangle.
constexpr double least_roundness = 0.02;
/// With Strips, the least roundness of a triangle that keeps its normal.
constexpr double least_strip_roundness = 0.002;
constexpr double kept_cosine = 0.9999; ///< A normal counts as kept from this cosine on.

double roundness(const std::array<glm::dvec3, 3>& corners, double area2) {
    double sides = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 side = corners[(i + 1) % 3] - corners[i];
        sides += glm::dot(side, side);
    }
    return sides > 0.0 ? area2 / sides : 0.0;
}

/// Whether a triangle of twice the area `area2` is no higher than `height` over its longest side.
bool is_lower(const std::array<glm::dvec3, 3>& corners, double area2, double height) {
    double longest2 = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 side = corners[(i + 1) % 3] - corners[i];
        longest2 = std::max(longest2, glm::dot(side, side));
    }
    return area2 * area2 <= height * height * longest2;
}

} // namespace

bool may_become(
    const std::array<glm::dvec3, 3>& before,
    const std::array<glm::dvec3, 3>& after,
    Strictness strictness,
    double negligible) {
    if (strictness == Strictness::None) {
        return true;
    }
    const glm::dvec3 old_normal = area_vector(before);
    const glm::dvec3 new_normal = area_vector(after);
    const double old2 = glm::dot(old_normal, old_normal);
    const double new2 = glm::dot(new_normal, new_normal);
    const double cosine = glm::dot(old_normal, new_normal);
    if (negligible > 0.0 && is_lower(before, std::sqrt(old2), negligible) &&
        is_lower(after, std::sqrt(new2), negligible)) {
        return true;
    }
    if (old2 > 0.0) {
        const double least = strictness == Strictness::Loose ? 0.0 : least_cosine;
        if (!(cosine > 0.0) || cosine * cosine < least * least * old2 * new2) {
            return false;
        }
    }
    if (strictness == Strictness::Loose) {
        return new2 > 0.0;
    }
    const double round = roundness(after, std::sqrt(new2));
    const bool is_strip = strictness == Strictness::Strips && cosine > 0.0 &&
                          cosine * cosine >= kept_cosine * kept_cosine * old2 * new2;
    const double least = is_strip ? least_strip_roundness : least_roundness;
    return round >= least || round >= roundness(before, std::sqrt(old2));
}

bool may_flip_to(
    const std::array<std::array<glm::dvec3, 3>, 2>& before,
    const std::array<std::array<glm::dvec3, 3>, 2>& after) {
    return std::ranges::all_of(before, [&](const auto& from) {
        return std::ranges::all_of(
            after, [&](const auto& to) { return may_become(from, to, Strictness::Normal); });
    });
}

std::array<glm::dvec3, 3>
moved_corners(const WorkingSurface& surface, const RingFace& face, const glm::dvec3& place) {
    return {
        place,
        surface.places[surface.mesh.target(face.half_edge)],
        surface.places[surface.mesh.origin(previous_of(face.half_edge))]};
}

bool may_move(
    const WorkingSurface& surface,
    std::span<const RingFace> ring,
    const glm::dvec3& place,
    Strictness strictness,
    double negligible) {
    return std::ranges::all_of(ring, [&](const RingFace& face) {
        const glm::dvec3& old_place = surface.places[surface.mesh.origin(face.half_edge)];
        return may_become(
            moved_corners(surface, face, old_place),
            moved_corners(surface, face, place),
            strictness,
            negligible);
    });
}

Strictness strictness_for(const WorkingSurface& surface) {
    constexpr double flat_cosine = 1.0 - 1e-9;
    if (surface.coloured()) { // A strip may be flat in space and yet not in colour.
        return Strictness::Normal;
    }
    const CollapsibleMesh& mesh = surface.mesh;
    std::size_t edges = 0;
    std::size_t flat = 0;
    for (HalfEdge h = 0; h < mesh.face_slots() * 3; ++h) {
        if (!mesh.face_is_there(face_of(h)) || mesh.edge_of(h) != h || mesh.twin(h) == none) {
            continue;
        }
        const glm::dvec3 one = area_vector(surface.corner_places(face_of(h)));
        const glm::dvec3 other = area_vector(surface.corner_places(face_of(mesh.twin(h))));
        ++edges;
        flat +=
            glm::dot(one, other) >= flat_cosine * glm::length(one) * glm::length(other) ? 1U : 0U;
    }
    return 4 * flat > edges ? Strictness::Strips : Strictness::Normal;
}

} // namespace octant::models::simplify
