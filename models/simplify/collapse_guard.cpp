#include "models/simplify/collapse_guard.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::models::simplify {

namespace {

constexpr double least_cosine = 0.2;
/// Twice the area over the sum of the squared sides: 0.58 for equal sides.
constexpr double least_roundness = 0.02;

double roundness(const std::array<glm::dvec3, 3>& corners, double area2) {
    double sides = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 side = corners[(i + 1) % 3] - corners[i];
        sides += glm::dot(side, side);
    }
    return sides > 0.0 ? area2 / sides : 0.0;
}

} // namespace

bool may_become(
    const std::array<glm::dvec3, 3>& before,
    const std::array<glm::dvec3, 3>& after,
    Strictness strictness) {
    if (strictness == Strictness::None) {
        return true;
    }
    const glm::dvec3 old_normal = area_vector(before);
    const glm::dvec3 new_normal = area_vector(after);
    const double old2 = glm::dot(old_normal, old_normal);
    const double new2 = glm::dot(new_normal, new_normal);
    const double cosine = glm::dot(old_normal, new_normal);
    if (old2 > 0.0) {
        const bool strict = strictness == Strictness::Normal;
        const double least = strict ? least_cosine : 0.0;
        if (!(cosine > 0.0) || cosine * cosine < least * least * old2 * new2) {
            return false;
        }
    }
    if (strictness == Strictness::Loose) {
        return new2 > 0.0;
    }
    const double round = roundness(after, std::sqrt(new2));
    return round >= least_roundness || round >= roundness(before, std::sqrt(old2));
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
    Strictness strictness) {
    return std::ranges::all_of(ring, [&](const RingFace& face) {
        const glm::dvec3& old_place = surface.places[surface.mesh.origin(face.half_edge)];
        return may_become(
            moved_corners(surface, face, old_place),
            moved_corners(surface, face, place),
            strictness);
    });
}

} // namespace octant::models::simplify
