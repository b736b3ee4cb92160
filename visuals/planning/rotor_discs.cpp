#include "visuals/planning/rotor_discs.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <glm/common.hpp>

#include <algorithm>
#include <functional>
#include <utility>

namespace octant::visuals::planning {

namespace {

/// What covers a larger share of a circle about its axis is no blade there: a spinner inside, a fan of a jet further
/// out.
constexpr double max_solidity = 0.5;

} // namespace

DiscCoverage::DiscCoverage(const models::polygons::Pivot& axis, double radius_m) : axis_(axis), radius_m_(radius_m) {
    for (std::size_t i = 0; i < directions; ++i) {
        const double turn = 2.0 * pi * (static_cast<double>(i) + 0.5) / directions;
        ways_[i] = {std::cos(turn), std::sin(turn)};
    }
}

void DiscCoverage::add(std::span<const glm::dvec3> corners_m) {
    flat_.clear();
    for (const glm::dvec3& corner_m : corners_m) {
        const glm::dvec3 off_m = corner_m - axis_.point_m;
        flat_.emplace_back(glm::dot(off_m, right_), glm::dot(off_m, up_));
    }
    glm::dvec2 min_m = flat_[0];
    glm::dvec2 max_m = flat_[0];
    double twice_area_m2 = 0.0;
    for (std::size_t i = 1; i < flat_.size(); ++i) {
        min_m = glm::min(min_m, flat_[i]);
        max_m = glm::max(max_m, flat_[i]);
        twice_area_m2 += cross(flat_[i - 1] - flat_[0], flat_[i] - flat_[0]);
    }
    if (twice_area_m2 == 0.0) { return; }
    const double nearest_m = glm::length(glm::max(glm::max(min_m, -max_m), 0.0));
    const double farthest_m = glm::length(glm::max(max_m, -min_m));
    for (std::size_t circle = 0; circle < circles; ++circle) {
        const double at_m = radius_m_ * (static_cast<double>(circle) + 0.5) / circles;
        if (at_m < nearest_m || at_m > farthest_m) { continue; }
        for (std::size_t direction = 0; direction < directions; ++direction) {
            bool& covered = covered_[circle][direction];
            covered = covered || holds(at_m * ways_[direction], twice_area_m2);
        }
    }
}

std::optional<double> DiscCoverage::hub_radius_m() const {
    std::size_t hub = 0; // circles
    std::size_t all = 0; // places that are covered
    for (std::size_t circle = 0; circle < circles; ++circle) {
        const auto count = static_cast<std::size_t>(std::ranges::count(covered_[circle], true));
        if (static_cast<double>(count) > max_solidity * directions) { hub = circle + 1; }
        all += count;
    }
    if (static_cast<double>(all) > max_solidity * circles * directions) { return std::nullopt; }
    constexpr double corners = 1.25; // of a hub of few sides, over the radius of its sides
    const double share = hub == 0 ? 0.0 : (corners * static_cast<double>(hub) + 1.0) / circles;
    return share < 1.0 ? std::optional(radius_m_ * share) : std::nullopt;
}

bool DiscCoverage::holds(const glm::dvec2& place_m, double twice_area_m2) const {
    for (std::size_t i = 0; i < flat_.size(); ++i) {
        const glm::dvec2& from = flat_[i];
        if (twice_area_m2 * cross(flat_[(i + 1) % flat_.size()] - from, place_m - from) < 0.0) { return false; }
    }
    return true;
}

namespace {

/// Slower rotors are seen as they stand.
constexpr double disc_turns_per_s = 3.0;

/// Finds the discs of a model.
class DiscFinder {
public:
    explicit DiscFinder(const models::polygons::PolygonModel& model)
        : model_(model), disc_of_polygon_(model.polygons.size(), models::none) {}

    /// Once only.
    RotorDiscs find() {
        find_places();
        RotorDiscs found;
        for (const Place& place : places_) { add(place, found.discs); }
        if (!found.discs.empty()) { found.disc_of_polygon = std::move(disc_of_polygon_); }
        return found;
    }

private:
    /// What turns fast in one place, the largest part first.
    struct Place {
        std::vector<std::uint32_t> pivots;
        glm::dvec3 centre_m{0.0};
        double radius_m = 0.0;
    };

    struct Corner {
        double radius_m = 0.0; ///< from the axis
        double along_m = 0.0;  ///< along it
    };

    Corner corner_at(const models::polygons::Pivot& pivot, std::uint32_t vertex) const {
        const glm::dvec3 off_m = model_.vertices_m[vertex] - pivot.point_m;
        const double along_m = glm::dot(off_m, pivot.axis);
        return {glm::length(off_m - along_m * pivot.axis), along_m};
    }

    /// The corner of a polygon that is farthest from the axis.
    Corner outermost(const models::polygons::Pivot& pivot, std::size_t polygon) const {
        Corner outermost;
        for (const std::uint32_t vertex : model_.corners(polygon)) {
            const Corner corner = corner_at(pivot, vertex);
            if (corner.radius_m > outermost.radius_m) { outermost = corner; }
        }
        return outermost;
    }

    /// Blades and spinner may be parts of their own: what turns about one axis in one place has one disc.
    void find_places() {
        std::vector<Place> all;
        for (std::uint32_t number = 0; number < model_.pivots.size(); ++number) {
            const models::polygons::Pivot& pivot = model_.pivots[number];
            if (std::abs(pivot.turns_per_s) < disc_turns_per_s) { continue; }
            Corner farthest;
            for (std::size_t polygon = 0; polygon < model_.polygons.size(); ++polygon) {
                if (model_.polygons[polygon].part != pivot.part) { continue; }
                const Corner corner = outermost(pivot, polygon);
                if (corner.radius_m > farthest.radius_m) { farthest = corner; }
            }
            if (farthest.radius_m > 0.0) {
                all.push_back({{number}, pivot.point_m + farthest.along_m * pivot.axis, farthest.radius_m});
            }
        }
        std::ranges::stable_sort(all, std::ranges::greater(), &Place::radius_m);
        for (const Place& place : all) {
            constexpr double one_place = 0.15; // of the larger radius
            const auto larger = std::ranges::find_if(places_, [&](const Place& other) {
                return glm::distance(other.centre_m, place.centre_m) < one_place * other.radius_m &&
                       std::abs(glm::dot(axis_of(other), axis_of(place))) > 0.99;
            });
            if (larger == places_.end()) {
                places_.push_back(place);
            } else {
                larger->pivots.push_back(place.pivots.front());
            }
        }
    }

    const glm::dvec3& axis_of(const Place& place) const { return model_.pivots[place.pivots.front()].axis; }

    void add(const Place& place, std::vector<RotorDisc>& discs) {
        const models::polygons::Pivot& axis = model_.pivots[place.pivots.front()];
        std::vector<std::uint32_t> polygons;
        for (std::uint32_t polygon = 0; polygon < model_.polygons.size(); ++polygon) {
            const auto pivot = models::polygons::pivot_of(model_, polygon);
            if (pivot && std::ranges::find(place.pivots, *pivot) != place.pivots.end()) { polygons.push_back(polygon); }
        }
        DiscCoverage coverage(axis, place.radius_m);
        std::vector<glm::dvec3> corners_m;
        for (const std::uint32_t polygon : polygons) {
            corners_m.clear();
            for (const std::uint32_t vertex : model_.corners(polygon)) {
                corners_m.push_back(model_.vertices_m[vertex]);
            }
            coverage.add(corners_m);
        }
        const std::optional<double> hub_m = coverage.hub_radius_m();
        if (!hub_m) { return; }
        const auto is_blade = [&](std::uint32_t polygon) { return outermost(axis, polygon).radius_m > *hub_m; };
        const bool has_hub = !std::ranges::all_of(polygons, is_blade);
        RotorDisc disc{.pivots = place.pivots, .root_m = has_hub ? *hub_m : 0.0, .sides = {}};
        for (const std::uint32_t polygon : polygons) {
            if (!is_blade(polygon)) { continue; }
            disc_of_polygon_[polygon] = static_cast<std::uint32_t>(discs.size());
            const Corner tip = outermost(axis, polygon);
            const double facing = glm::dot(models::polygons::normal_of(model_, polygon), axis.axis);
            for (std::size_t side = 0; side < 2; ++side) {
                constexpr double perpendicular = 1.0 - 1e-9; // Others are seen from both sides as they turn.
                RotorDisc::Side& seen = disc.sides[side];
                if ((side == 0 ? facing : -facing) <= -perpendicular || tip.radius_m <= seen.radius_m) { continue; }
                seen = {polygon, axis.point_m + tip.along_m * axis.axis, tip.radius_m};
            }
        }
        for (std::size_t side = 0; side < 2; ++side) {
            if (disc.sides[side].polygon != models::none) { continue; }
            disc.sides[side] = disc.sides[1 - side];
            disc.sides[side].polygon = models::none;
        }
        discs.push_back(std::move(disc));
    }

    const models::polygons::PolygonModel& model_;
    std::vector<std::uint32_t> disc_of_polygon_;
    std::vector<Place> places_;
};

} // namespace

RotorDiscs find_discs(const models::polygons::PolygonModel& model) { return DiscFinder(model).find(); }

} // namespace octant::visuals::planning
