// Every order is tried before it is used. Rays that pass a side of a polygon within a hair are not
// counted: there rounding decides what is seen.
#include "visuals/draworder/order_trial.h"

#include "models/polygons/inside_outline.h"
#include "sim/base/dice.h"
#include "visuals/draworder/eyes_beyond.h"
#include "visuals/draworder/order_proof.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

using models::polygons::PolygonModel;

/// In radii of the model: what lies nearer to a side than this is not counted, nor differences of
/// depth below it. A little more than the inset of hiding tests (Tolerances).
constexpr double hair = 3e-9;
/// Polygons are compared with rays so often in all, some 10 ns each.
constexpr std::size_t most_comparisons = 20'000'000;
constexpr std::size_t most_eyes = 2'000;
constexpr std::size_t rays_an_eye = 10;
/// So many rays are cast at each pair for which no proof was found.
constexpr std::size_t rays_a_pair = 100;
/// Polygons whose corners are all nearer than this to one another's planes lie in one plane.
constexpr double in_plane = 1e-9;

/// A convex polygon in radii of the model about its middle.
struct Target {
    std::uint32_t polygon = 0;
    glm::dvec3 normal{0.0};
    glm::dvec3 middle{0.0};
    double radius = 0.0;
    std::vector<glm::dvec3> corners;
};

/// How a ray meets a target: where, how far inside its sides, and how far along the ray it would be
/// met if the target were moved by a hair. That is more for a ray that grazes it.
struct Hit {
    double away = 0.0;
    double inside = 0.0;
    double doubt = 0.0;
};

std::optional<Hit> meet(const Target& target, const glm::dvec3& eye, const glm::dvec3& ray) {
    const double slope = glm::dot(ray, target.normal);
    const double height = glm::dot(eye - target.middle, target.normal);
    if (height <= 0.0 || slope >= 0.0) {
        return std::nullopt;
    }
    const double away = -height / slope;
    const glm::dvec3 at = eye + ray * away;
    const glm::dvec3 aside = at - target.middle;
    if (glm::dot(aside, aside) > target.radius * target.radius) {
        return std::nullopt;
    }
    if (!models::polygons::is_inside(target.corners, target.normal, at)) {
        return std::nullopt;
    }
    return Hit{away, models::polygons::distance_to_sides(target.corners, at), hair / -slope};
}

/// One trial at one angle of the turning parts.
class Trying {
public:
    Trying(const PolygonModel& model, const DrawOrder& order, const TrialScope& scope)
        : model_(model)
        , order_(order)
        , scope_(scope) {
        glm::dvec3 least(std::numeric_limits<double>::max());
        glm::dvec3 most(std::numeric_limits<double>::lowest());
        for (const std::uint32_t vertex : model.corner_vertices) {
            least = glm::min(least, model.vertices_m[vertex]);
            most = glm::max(most, model.vertices_m[vertex]);
        }
        middle_m_ = (least + most) / 2.0;
        radius_m_ = std::max(glm::length(most - least) / 2.0, std::numeric_limits<double>::min());
    }

    void look(double turn_rad, std::size_t comparisons, Trial& trial) {
        turn(turn_rad);
        if (targets_.empty()) {
            return;
        }
        const std::size_t rays = comparisons / targets_.size();
        const std::size_t most = most_eyes * comparisons / most_comparisons;
        const std::size_t eyes = std::clamp<std::size_t>(rays / rays_an_eye, 20, most);
        for (std::size_t i = 0; i < eyes; ++i) {
            const glm::dvec3 eye = next_eye(i);
            const glm::dvec3 eye_m = middle_m_ + eye * radius_m_;
            if (is_looked_from(eye_m)) {
                look_from(eye, eye_m, trial);
            }
        }
    }

    /// Casts rays at one polygon through another that is painted earlier, from eyes beyond, as the
    /// parts were turned last.
    void look_at_pair(std::uint32_t earlier, std::uint32_t later, Trial& trial) {
        const Target* const near_one = target_of(earlier);
        const Target* const far_one = target_of(later);
        for (std::size_t i = 0; i < rays_a_pair && near_one != nullptr && far_one != nullptr; ++i) {
            const glm::dvec3 through = point_of(*near_one);
            const glm::dvec3 way = through - point_of(*far_one);
            const double length = glm::length(way);
            const glm::dvec3 eye = through + way * (30.0 * small() / std::max(length, hair));
            const glm::dvec3 eye_m = middle_m_ + eye * radius_m_;
            if (length > hair && is_looked_from(eye_m)) {
                paint_from(eye_m);
                look_along(eye, -way / length, trial);
            }
        }
    }

private:
    const Target* target_of(std::uint32_t polygon) const {
        const auto found = std::ranges::find(targets_, polygon, &Target::polygon);
        return found != targets_.end() ? &*found : nullptr;
    }

    bool is_looked_from(const glm::dvec3& eye_m) const {
        const glm::dvec3 size_m = glm::abs(eye_m - scope_.centre_m);
        return size_m.x + size_m.y + size_m.z >= scope_.min_distance_m;
    }

    void turn(double turn_rad) {
        targets_.clear();
        for (std::uint32_t i = 0; i < model_.polygons.size(); ++i) {
            const auto pivot = models::polygons::pivot_of(model_, i);
            if (pivot && !scope_.turning_parts) {
                continue;
            }
            Target target;
            target.polygon = i;
            for (const std::uint32_t vertex : model_.corners(i)) {
                glm::dvec3 at_m = model_.vertices_m[vertex];
                if (pivot) {
                    at_m = models::polygons::turned(model_.pivots[*pivot], at_m, turn_rad);
                }
                target.corners.push_back((at_m - middle_m_) / radius_m_);
            }
            if (complete(target)) {
                targets_.push_back(std::move(target));
            }
        }
    }

    /// Adds what follows from the corners; false for a polygon without area.
    static bool complete(Target& target) {
        const std::size_t count = target.corners.size();
        for (const glm::dvec3& corner : target.corners) {
            target.middle += corner / static_cast<double>(count);
        }
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 from = target.corners[i] - target.middle;
            sum += glm::cross(from, target.corners[(i + 1) % count] - target.middle);
            target.radius = std::max(target.radius, glm::length(from));
        }
        target.normal = glm::normalize(sum);
        return std::isfinite(target.normal.x);
    }

    const Target& any_target() {
        const auto place = dice_.next() * static_cast<double>(targets_.size());
        return targets_[std::min(static_cast<std::size_t>(place), targets_.size() - 1)];
    }

    /// A point of a polygon, likelier near its middle.
    glm::dvec3 point_of(const Target& target) {
        glm::dvec3 point(0.0);
        double sum = 0.0;
        for (const glm::dvec3& corner : target.corners) {
            const double weight = dice_.next();
            point += corner * weight;
            sum += weight;
        }
        return sum > 0.0 ? point / sum : target.middle;
    }

    double small() { return std::pow(10.0, dice_.between(-5.0, -0.5)); }

    /// By turns an eye far or near, one close to a polygon, and one close to a plane of the order.
    glm::dvec3 next_eye(std::size_t number) {
        const glm::dvec3 away = dice_.direction() * (0.05 * std::pow(400.0, dice_.next()));
        if (number % 4 == 1) {
            const Target& target = any_target();
            return point_of(target) + target.normal * small();
        }
        const auto nodes = order_.nodes();
        if (number % 4 == 3 && !nodes.empty()) {
            const double place = dice_.next() * static_cast<double>(nodes.size());
            const auto& node = nodes[std::min(static_cast<std::size_t>(place), nodes.size() - 1)];
            const double side = dice_.next() < 0.5 ? -small() : small();
            const double height = distance_m(node.plane, middle_m_ + away * radius_m_) / radius_m_;
            return away + node.plane.normal * (side - height);
        }
        return away;
    }

    /// Finds out which polygons an eye is painted, and when.
    void paint_from(const glm::dvec3& eye_m) {
        painted_.clear();
        order_.append_painted(eye_m, walk_, painted_);
        place_.assign(model_.polygons.size(), 0);
        for (std::uint32_t i = 0; i < painted_.size(); ++i) {
            place_[painted_[i]] = i + 1;
        }
    }

    void look_from(const glm::dvec3& eye, const glm::dvec3& eye_m, Trial& trial) {
        paint_from(eye_m);
        for (std::size_t i = 0; i < rays_an_eye; ++i) {
            const glm::dvec3 towards = point_of(any_target()) - eye;
            const double length = glm::length(towards);
            if (length > 0.0) {
                look_along(eye, towards / length, trial);
            }
        }
    }

    void look_along(const glm::dvec3& eye, const glm::dvec3& ray, Trial& trial) {
        Hit nearest{.away = std::numeric_limits<double>::infinity()};
        Hit seen = nearest;
        const Target* on_top = nullptr;
        std::uint32_t last = 0;
        met_.clear();
        for (const Target& target : targets_) {
            const auto hit = meet(target, eye, ray);
            if (!hit) {
                continue;
            }
            met_.emplace_back(&target, *hit);
            if (hit->away < nearest.away) {
                nearest = *hit;
            }
            if (place_[target.polygon] > last) {
                last = place_[target.polygon];
                seen = *hit;
                on_top = &target;
            }
        }
        if (std::isinf(nearest.away) || nearest.inside < hair) {
            return;
        }
        ++trial.rays;
        const double doubt = seen.doubt + nearest.doubt + hair * nearest.away;
        const bool clear = last == 0 || seen.inside >= hair;
        const bool behind = seen.away - nearest.away > doubt;
        trial.wrong += clear && (behind || lies_under(on_top, seen.away)) ? 1 : 0;
    }

    /// Whether a later polygon of the file lies on a target, in one plane and facing alike, where
    /// the ray meets it.
    bool lies_under(const Target* target, double away) const {
        return std::ranges::any_of(met_, [&](const auto& met) {
            const auto& [other, hit] = met;
            return target != nullptr && hit.inside >= hair &&
                   std::abs(hit.away - away) < hit.doubt &&
                   model_.parent_of(other->polygon) > model_.parent_of(target->polygon) &&
                   glm::dot(other->normal, target->normal) > 0.0 && lies_in(*other, *target) &&
                   lies_in(*target, *other);
        });
    }

    /// Whether a polygon of the file lies in the plane of a piece of another one, given any of its
    /// pieces: planes that cross at a small angle are near one another along a line, too.
    bool lies_in(const Target& piece, const Target& other) const {
        const std::uint32_t parent = model_.parent_of(piece.polygon);
        return std::ranges::all_of(targets_, [&](const Target& target) {
            return model_.parent_of(target.polygon) != parent ||
                   std::ranges::all_of(target.corners, [&](const glm::dvec3& corner) {
                       return std::abs(glm::dot(corner - other.middle, other.normal)) < in_plane;
                   });
        });
    }

    const PolygonModel& model_;
    const DrawOrder& order_;
    TrialScope scope_;
    glm::dvec3 middle_m_{0.0};
    double radius_m_ = 1.0;
    Dice dice_{1989};
    std::vector<Target> targets_;
    DrawOrder::Walk walk_;
    std::vector<std::uint32_t> painted_;
    std::vector<std::pair<const Target*, Hit>> met_; ///< By the ray at hand.
    /// For each polygon when it is painted, from 1; 0 for one that is not.
    std::vector<std::uint32_t> place_;
};

/// Casts the rays of a trial, those at pairs too; what it saw of the proof stays as it is.
void cast_rays(
    Trying& trying, std::span<const double> angles_rad, const OrderProof& proof, Trial& trial) {
    for (const double angle_rad : angles_rad) {
        trying.look(angle_rad, most_comparisons / angles_rad.size(), trial);
        for (const auto& [earlier, later] : proof.open) {
            trying.look_at_pair(earlier, later, trial);
        }
    }
}

} // namespace

Trial try_order(const PolygonModel& model, const DrawOrder& order, const TrialScope& scope) {
    constexpr std::array angles_rad{0.0, 0.7, 2.1, 4.4};
    const bool turns = !model.pivots.empty();
    const std::size_t angles = turns && scope.turning_parts ? angles_rad.size() : 1;
    OrderProof proof;
    if (!turns || scope.turning_parts) { // else no order is right, and none can be proved
        proof = order_proof(
            model,
            scope.min_distance_m > 0.0 ? eyes_beyond(order, scope.centre_m, scope.min_distance_m)
                                       : order,
            scope.proof_s);
    }
    Trial trial{.unproved = proof.unproved, .is_proof_whole = proof.is_whole};
    Trying trying(model, order, scope);
    cast_rays(trying, std::span(angles_rad).first(angles), proof, trial);
    return trial;
}

} // namespace octant::visuals::draworder
