#include "visuals/draworder/ray_targets.h"

#include "models/polygons/polygon_outlines.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace octant::visuals::draworder {

namespace {

/// By so much of it and by so many radii of the model is a ball larger than its target: a thousand times what rounding
/// makes of the distance of a ray from an eye twenty radii away.
constexpr double more_of_ball = 1e-3;
constexpr double more_of_model = 1e-5;

/// Adds what follows from the corners; false for a polygon without area.
bool complete(RayTarget& target) {
    const std::size_t count = target.corners.size();
    for (const glm::dvec3& corner : target.corners) { target.middle += corner / static_cast<double>(count); }
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 from = target.corners[i] - target.middle;
        sum += glm::cross(from, target.corners[(i + 1) % count] - target.middle);
        target.radius = std::max(target.radius, glm::length(from));
    }
    target.normal = glm::normalize(sum);
    return std::isfinite(target.normal.x);
}

/// Where a ray hits a target, given how high its eye lies above the target's plane.
std::optional<RayHit> hit_of(const RayTarget& target, const glm::dvec3& eye, double height, const glm::dvec3& ray) {
    const double slope = glm::dot(ray, target.normal);
    if (slope * height >= 0.0) { return std::nullopt; }
    const double distance = -height / slope;
    const glm::dvec3 at = eye + ray * distance;
    const glm::dvec3 aside = at - target.middle;
    if (glm::dot(aside, aside) > target.radius * target.radius ||
        !models::polygons::is_inside(target.corners, target.normal, at)) {
        return std::nullopt;
    }
    return RayHit{.distance = distance,
        .edge_distance = models::polygons::distance_to_sides(target.corners, at),
        .distance_tolerance = RayTargets::ray_tolerance / std::abs(slope)};
}

} // namespace

RayTargets::RayTargets(const models::polygons::PolygonModel& model, std::span<const std::uint32_t> two_sided)
    : model_(model), two_sided_(model.polygons.size(), false) {
    for (const std::uint32_t polygon : two_sided) { two_sided_[polygon] = true; }
    glm::dvec3 least(std::numeric_limits<double>::max());
    glm::dvec3 most(std::numeric_limits<double>::lowest());
    for (const std::uint32_t vertex : model.corner_vertices) {
        least = glm::min(least, model.vertices_m[vertex]);
        most = glm::max(most, model.vertices_m[vertex]);
    }
    middle_m_ = (least + most) / 2.0;
    radius_m_ = std::max(glm::length(most - least) / 2.0, std::numeric_limits<double>::min());
}

void RayTargets::turn(double turn_rad, bool turning_parts) {
    all_.clear();
    ball2_.clear();
    faced_.clear();
    for (std::uint32_t i = 0; i < model_.polygons.size(); ++i) {
        const auto pivot = models::polygons::pivot_of(model_, i);
        if (pivot && !turning_parts) { continue; }
        RayTarget target;
        target.polygon = i;
        target.two_sided = two_sided_[i];
        for (const std::uint32_t vertex : model_.corners(i)) {
            glm::dvec3 at_m = model_.vertices_m[vertex];
            if (pivot) { at_m = models::polygons::turned(model_.pivots[*pivot], at_m, turn_rad); }
            target.corners.push_back(in_radii(at_m));
        }
        if (complete(target)) {
            const double size = target.radius * (1.0 + more_of_ball) + more_of_model;
            ball2_.push_back(size * size);
            all_.push_back(std::move(target));
        }
    }
}

const RayTarget* RayTargets::of(std::uint32_t polygon) const {
    const auto found = std::ranges::find(all_, polygon, &RayTarget::polygon);
    return found != all_.end() ? &*found : nullptr;
}

void RayTargets::set_eye(const glm::dvec3& eye, std::span<const std::uint32_t> painted) {
    eye_ = eye;
    painted_.assign(model_.polygons.size(), 0);
    for (std::uint32_t i = 0; i < painted.size(); ++i) { painted_[painted[i]] = i + 1; }
    faced_.clear();
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const glm::dvec3 to_middle = all_[i].middle - eye;
        const double height = -glm::dot(to_middle, all_[i].normal);
        if (height > 0.0 || (height < 0.0 && all_[i].two_sided)) {
            const double min_along2 = glm::dot(to_middle, to_middle) - ball2_[i];
            faced_.push_back({i, height, to_middle, min_along2});
        }
    }
}

void RayTargets::intersect(const glm::dvec3& ray, std::vector<RayHit>& hits) const {
    hits.clear();
    for (const FacingTarget& faced : faced_) {
        const double along = glm::dot(faced.to_middle, ray);
        if (along * along < faced.min_along2) { continue; }
        if (std::optional<RayHit> hit = hit_of(all_[faced.target], eye_, faced.height, ray)) {
            hit->target = faced.target;
            hit->painted = painted_[all_[faced.target].polygon];
            hits.push_back(*hit);
        }
    }
}

} // namespace octant::visuals::draworder
