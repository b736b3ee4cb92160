// Every order is tried before it is used. Rays that pass a side of a polygon within a hair are not
// counted: there rounding decides what is seen.
#include "visuals/draworder/order_trial.h"

#include "sim/base/dice.h"
#include "visuals/draworder/eyes_beyond.h"
#include "visuals/draworder/order_proof.h"
#include "visuals/draworder/trial_targets.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

using models::polygons::PolygonModel;

constexpr double hair = TrialTargets::hair;
/// Polygons are compared with rays so often in all, some 10 ns each.
constexpr std::size_t max_comparisons = 20'000'000;
constexpr std::size_t max_eyes = 2'000;
constexpr std::size_t rays_an_eye = 10;
/// So many rays are cast at each pair for which no proof was found; fewer where that would be more
/// comparisons than all others.
constexpr std::size_t rays_a_pair = 100;
constexpr std::size_t min_rays_a_pair = 4;
/// Polygons whose corners are all nearer than this to one another's planes lie in one plane.
constexpr double in_plane = 1e-9;

/// One trial at one angle of the turning parts.
class Trying {
public:
    Trying(const PolygonModel& model, const DrawOrder& order, const TrialScope& scope)
        : model_(model)
        , order_(order)
        , scope_(scope)
        , targets_(model) {}

    void look(double turn_rad, std::size_t comparisons, Trial& trial) {
        targets_.turn(turn_rad, scope_.turning_parts);
        if (targets_.all().empty()) {
            return;
        }
        const std::size_t rays = comparisons / targets_.all().size();
        const std::size_t most = max_eyes * comparisons / max_comparisons;
        const std::size_t eyes = std::clamp<std::size_t>(rays / rays_an_eye, 20, most);
        for (std::size_t i = 0; i < eyes; ++i) {
            const glm::dvec3 eye = next_eye(i);
            const glm::dvec3 eye_m = targets_.in_model_m(eye);
            if (is_looked_from(eye_m)) {
                look_from(eye, eye_m, trial);
            }
        }
    }

    /// Casts rays at polygons through others that are painted earlier, from eyes beyond, as the
    /// parts were turned last.
    void look_at_pairs(
        std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs,
        std::size_t comparisons,
        Trial& trial) {
        const std::size_t once = std::max<std::size_t>(pairs.size() * targets_.all().size(), 1);
        const std::size_t rays = std::clamp(comparisons / once, min_rays_a_pair, rays_a_pair);
        for (const auto& [earlier, later] : pairs) {
            const TrialTarget* const near_one = targets_.of(earlier);
            const TrialTarget* const far_one = targets_.of(later);
            for (std::size_t i = 0; i < rays && near_one != nullptr && far_one != nullptr; ++i) {
                look_through(*near_one, *far_one, trial);
            }
        }
    }

private:
    void look_through(const TrialTarget& near_one, const TrialTarget& far_one, Trial& trial) {
        const glm::dvec3 through = point_of(near_one);
        const glm::dvec3 way = through - point_of(far_one);
        const double length = glm::length(way);
        const glm::dvec3 eye = through + way * (30.0 * small() / std::max(length, hair));
        const glm::dvec3 eye_m = targets_.in_model_m(eye);
        if (length > hair && is_looked_from(eye_m)) {
            paint_from(eye_m);
            targets_.look_from(eye);
            look_along(-way / length, trial);
        }
    }

    bool is_looked_from(const glm::dvec3& eye_m) const {
        const glm::dvec3 size_m = glm::abs(eye_m - scope_.centre_m);
        return size_m.x + size_m.y + size_m.z >= scope_.min_distance_m;
    }

    const TrialTarget& any_target() {
        const auto& all = targets_.all();
        const auto place = dice_.next() * static_cast<double>(all.size());
        return all[std::min(static_cast<std::size_t>(place), all.size() - 1)];
    }

    /// A point of a polygon, likelier near its middle.
    glm::dvec3 point_of(const TrialTarget& target) {
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
            const TrialTarget& target = any_target();
            return point_of(target) + target.normal * small();
        }
        const auto nodes = order_.nodes();
        if (number % 4 == 3 && !nodes.empty()) {
            const double place = dice_.next() * static_cast<double>(nodes.size());
            const auto& node = nodes[std::min(static_cast<std::size_t>(place), nodes.size() - 1)];
            const double side = dice_.next() < 0.5 ? -small() : small();
            const double height =
                distance_m(node.plane, targets_.in_model_m(away)) / targets_.radius_m();
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
        targets_.look_from(eye);
        for (std::size_t i = 0; i < rays_an_eye; ++i) {
            const glm::dvec3 towards = point_of(any_target()) - eye;
            const double length = glm::length(towards);
            if (length > 0.0) {
                look_along(towards / length, trial);
            }
        }
    }

    void look_along(const glm::dvec3& ray, Trial& trial) {
        targets_.meet(ray, met_);
        TrialHit nearest{.away = std::numeric_limits<double>::infinity()};
        TrialHit seen = nearest;
        std::uint32_t last = 0;
        for (const TrialHit& hit : met_) {
            if (hit.away < nearest.away) {
                nearest = hit;
            }
            if (const std::uint32_t place = place_[targets_.all()[hit.target].polygon];
                place > last) {
                last = place;
                seen = hit;
            }
        }
        if (std::isinf(nearest.away) || nearest.inside < hair) {
            return;
        }
        ++trial.rays;
        const double doubt = seen.doubt + nearest.doubt + hair * nearest.away;
        const bool clear = last == 0 || seen.inside >= hair;
        const bool behind = seen.away - nearest.away > doubt;
        trial.wrong += clear && (behind || (last != 0 && lies_under(seen))) ? 1 : 0;
    }

    /// Whether a later polygon of the file lies on what is seen, in one plane and facing alike,
    /// where the ray meets it.
    bool lies_under(const TrialHit& seen) const {
        const TrialTarget& target = targets_.all()[seen.target];
        return std::ranges::any_of(met_, [&](const TrialHit& hit) {
            const TrialTarget& other = targets_.all()[hit.target];
            return hit.inside >= hair && std::abs(hit.away - seen.away) < hit.doubt &&
                   model_.parent_of(other.polygon) > model_.parent_of(target.polygon) &&
                   glm::dot(other.normal, target.normal) > 0.0 && lies_in(other, target) &&
                   lies_in(target, other);
        });
    }

    /// Whether a polygon of the file lies in the plane of a piece of another one, given any of its
    /// pieces: planes that cross at a small angle are near one another along a line, too.
    bool lies_in(const TrialTarget& piece, const TrialTarget& other) const {
        const std::uint32_t parent = model_.parent_of(piece.polygon);
        return std::ranges::all_of(targets_.all(), [&](const TrialTarget& target) {
            return model_.parent_of(target.polygon) != parent ||
                   std::ranges::all_of(target.corners, [&](const glm::dvec3& corner) {
                       return std::abs(glm::dot(corner - other.middle, other.normal)) < in_plane;
                   });
        });
    }

    const PolygonModel& model_;
    const DrawOrder& order_;
    TrialScope scope_;
    Dice dice_{1989};
    TrialTargets targets_;
    DrawOrder::Walk walk_;
    std::vector<std::uint32_t> painted_;
    std::vector<TrialHit> met_; ///< By the ray at hand.
    /// For each polygon when it is painted, from 1; 0 for one that is not.
    std::vector<std::uint32_t> place_;
};

/// Casts the rays of a trial, those at pairs too; what it saw of the proof stays as it is.
void cast_rays(
    Trying& trying, std::span<const double> angles_rad, const OrderProof& proof, Trial& trial) {
    const std::size_t comparisons = max_comparisons / angles_rad.size();
    for (const double angle_rad : angles_rad) {
        trying.look(angle_rad, comparisons, trial);
        trying.look_at_pairs(proof.open, comparisons, trial);
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
