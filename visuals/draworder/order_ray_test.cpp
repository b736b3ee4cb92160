// Every order is tested before it is used. Rays that pass a side of a polygon within a hair are not counted: there
// rounding decides what is seen.
#include "visuals/draworder/order_ray_test.h"

#include "models/polygons/polygon_outlines.h"
#include "sim/base/random_generator.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/proof_walk.h"
#include "visuals/draworder/search_budget.h"

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

/// Where a ray meets a target above which its eye lies.
std::optional<RayHit> meet_one(const RayTarget& target, const glm::dvec3& eye, double height, const glm::dvec3& ray) {
    const double slope = glm::dot(ray, target.normal);
    if (slope >= 0.0) { return std::nullopt; }
    const double hit_distance = -height / slope;
    const glm::dvec3 at = eye + ray * hit_distance;
    const glm::dvec3 aside = at - target.middle;
    if (glm::dot(aside, aside) > target.radius * target.radius ||
        !models::polygons::is_inside(target.corners, target.normal, at)) {
        return std::nullopt;
    }
    return RayHit{
        0, hit_distance, models::polygons::distance_to_sides(target.corners, at), RayTargets::ray_tolerance / -slope};
}

} // namespace

RayTargets::RayTargets(const models::polygons::PolygonModel& model) : model_(model) {
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
        for (const std::uint32_t vertex : model_.corners(i)) {
            glm::dvec3 at_m = model_.vertices_m[vertex];
            if (pivot) { at_m = models::polygons::turned(model_.pivots[*pivot], at_m, turn_rad); }
            target.corners.push_back((at_m - middle_m_) / radius_m_);
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

void RayTargets::set_eye(const glm::dvec3& eye) {
    eye_ = eye;
    faced_.clear();
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const glm::dvec3 to_middle = all_[i].middle - eye;
        const double height = -glm::dot(to_middle, all_[i].normal);
        if (height > 0.0) {
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
        if (std::optional<RayHit> hit = meet_one(all_[faced.target], eye_, faced.height, ray)) {
            hit->target = faced.target;
            hits.push_back(*hit);
        }
    }
}

namespace {

/// About the work of one of each (SearchBudget).
constexpr std::uint64_t units_of_pair = 20;
constexpr std::uint64_t units_of_witness = 2'000;
constexpr std::uint64_t units_of_none = 1'000'000;
constexpr std::uint64_t units_of_polygon_in_part = 60;

/// How far an order is proved.
struct OrderProof {
    /// Pairs and polygons for which no proof was found.
    std::uint64_t unproved = 0;
    /// The first of these pairs: which is painted earlier, which later.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> unproved_pairs;
    static constexpr std::size_t max_open = 100;
    /// Whether the whole order was looked at; else the work was spent before.
    bool is_complete = false;
};

/// Counts what is found, and what that costs.
class Counting : public ProofVisitor {
public:
    explicit Counting(SearchBudget& budget) : budget_(budget) {}

    OrderProof& proof() { return proof_; }

    void begin_pairs(int /*part*/, std::uint32_t /*later*/, std::size_t count) override {
        budget_.spend(units_of_pair * count);
    }

    void add_pair(separation::DecidingPolygon /*by*/) override {}

    void end_pairs() override {}

    void add_plane_proof(int /*part*/, const separation::SeparatingPlaneProof& plane_proof, std::uint32_t earlier,
        std::uint32_t later) override {
        if (plane_proof.kind != separation::SeparatingPlaneProof::Kind::None) {
            budget_.spend(units_of_witness);
            return;
        }
        ++proof_.unproved;
        if (proof_.unproved_pairs.size() < OrderProof::max_open) { proof_.unproved_pairs.emplace_back(earlier, later); }
        budget_.spend(units_of_none);
    }

    void add_back_facing(
        int /*part*/, std::uint32_t /*polygon*/, const separation::PlaneFactors& /*factors*/) override {
        budget_.spend(units_of_witness);
    }

    void add_unproved(int /*part*/, std::uint32_t /*polygon*/) override {
        ++proof_.unproved;
        budget_.spend(units_of_none);
    }

    void end_part(std::size_t polygons) override { budget_.spend(units_of_polygon_in_part * polygons); }

private:
    SearchBudget& budget_;
    OrderProof proof_;
};

/// Proves an order pair by pair (proof_walk.h), as far as about so many seconds of work on one core go. They are
/// counted, not timed: the same model and order give the same proof.
OrderProof prove_order(const models::polygons::PolygonModel& model, const DrawOrder& order, double seconds) {
    SearchBudget budget(seconds);
    OrderProof best;
    if (model.corner_vertices.empty()) {
        best.is_complete = true;
        return best;
    }
    const models::polygons::FileAxes axes;
    for (const double tolerance : separation::proof_tolerances_sizes) {
        const separation::LocalModel local = separation::local_model(model, axes, tolerance);
        Counting counting(budget);
        try {
            visit_proof({model, order, axes, local}, counting);
            counting.proof().is_complete = true;
        } catch (const SearchGivenUp&) { return best.is_complete ? best : counting.proof(); }
        if (!best.is_complete || counting.proof().unproved < best.unproved) { best = counting.proof(); }
        if (best.unproved == 0) { break; }
    }
    return best;
}

using models::polygons::PolygonModel;

constexpr double ray_tolerance = RayTargets::ray_tolerance;
/// Polygons are compared with rays so often in all, some 10 ns each.
constexpr std::size_t max_comparisons = 20'000'000;
constexpr std::size_t max_eyes = 2'000;
constexpr std::size_t rays_an_eye = 10;
/// So many rays are cast at each pair for which no proof was found; fewer where that would be more comparisons than all
/// others.
constexpr std::size_t rays_a_pair = 100;
constexpr std::size_t min_rays_a_pair = 4;
/// Polygons whose corners are all nearer than this to one another's planes lie in one plane.
constexpr double in_plane = 1e-9;

/// One ray test at one angle of the turning parts.
class RayTester {
public:
    RayTester(const PolygonModel& model, const DrawOrder& order, const RayTestOptions& scope)
        : model_(model), order_(order), scope_(scope), targets_(model) {}

    void look(double turn_rad, std::size_t comparisons, RayTestResult& ray_test) {
        targets_.turn(turn_rad, scope_.turning_parts);
        if (targets_.all().empty()) { return; }
        const std::size_t rays = comparisons / targets_.all().size();
        const std::size_t most = max_eyes * comparisons / max_comparisons;
        const std::size_t eyes = std::clamp<std::size_t>(rays / rays_an_eye, 20, most);
        for (std::size_t i = 0; i < eyes; ++i) {
            const glm::dvec3 eye = next_eye(i);
            const glm::dvec3 eye_m = targets_.in_model_m(eye);
            if (is_looked_from(eye_m)) { set_eye(eye, eye_m, ray_test); }
        }
    }

    /// Casts rays at polygons through others that are painted earlier, from eyes beyond, as the parts were turned last.
    void check_pairs(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs, std::size_t comparisons,
        RayTestResult& ray_test) {
        const std::size_t once = std::max<std::size_t>(pairs.size() * targets_.all().size(), 1);
        const std::size_t rays = std::clamp(comparisons / once, min_rays_a_pair, rays_a_pair);
        for (const auto& [earlier, later] : pairs) {
            const RayTarget* const occluder = targets_.of(earlier);
            const RayTarget* const occluded = targets_.of(later);
            for (std::size_t i = 0; i < rays && occluder != nullptr && occluded != nullptr; ++i) {
                look_through(*occluder, *occluded, ray_test);
            }
        }
    }

private:
    void look_through(const RayTarget& occluder, const RayTarget& occluded, RayTestResult& ray_test) {
        const glm::dvec3 through = point_of(occluder);
        const glm::dvec3 way = through - point_of(occluded);
        const double length = glm::length(way);
        const glm::dvec3 eye = through + way * (30.0 * small() / std::max(length, ray_tolerance));
        const glm::dvec3 eye_m = targets_.in_model_m(eye);
        if (length > ray_tolerance && is_looked_from(eye_m)) {
            paint_from(eye_m);
            targets_.set_eye(eye);
            cast_ray(-way / length, ray_test);
        }
    }

    bool is_looked_from(const glm::dvec3& eye_m) const {
        const glm::dvec3 size_m = glm::abs(eye_m - scope_.centre_m);
        return size_m.x + size_m.y + size_m.z >= scope_.min_distance_m;
    }

    const RayTarget& any_target() {
        const auto& all = targets_.all();
        const auto place = dice_.next() * static_cast<double>(all.size());
        return all[std::min(static_cast<std::size_t>(place), all.size() - 1)];
    }

    /// A point of a polygon, likelier near its middle.
    glm::dvec3 point_of(const RayTarget& target) {
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
        const glm::dvec3 hit_distance = dice_.direction() * (0.05 * std::pow(400.0, dice_.next()));
        if (number % 4 == 1) {
            const RayTarget& target = any_target();
            return point_of(target) + target.normal * small();
        }
        const auto nodes = order_.nodes();
        if (number % 4 == 3 && !nodes.empty()) {
            const double place = dice_.next() * static_cast<double>(nodes.size());
            const auto& node = nodes[std::min(static_cast<std::size_t>(place), nodes.size() - 1)];
            const double side = dice_.next() < 0.5 ? -small() : small();
            const double height = distance_m(node.plane, targets_.in_model_m(hit_distance)) / targets_.radius_m();
            return hit_distance + node.plane.normal * (side - height);
        }
        return hit_distance;
    }

    /// Finds out which polygons an eye is painted, and when.
    void paint_from(const glm::dvec3& eye_m) {
        painted_.clear();
        order_.append_painted(eye_m, walk_, painted_);
        place_.assign(model_.polygons.size(), 0);
        for (std::uint32_t i = 0; i < painted_.size(); ++i) { place_[painted_[i]] = i + 1; }
    }

    void set_eye(const glm::dvec3& eye, const glm::dvec3& eye_m, RayTestResult& ray_test) {
        paint_from(eye_m);
        targets_.set_eye(eye);
        for (std::size_t i = 0; i < rays_an_eye; ++i) {
            const glm::dvec3 towards = point_of(any_target()) - eye;
            const double length = glm::length(towards);
            if (length > 0.0) { cast_ray(towards / length, ray_test); }
        }
    }

    void cast_ray(const glm::dvec3& ray, RayTestResult& ray_test) {
        targets_.intersect(ray, met_);
        RayHit nearest{.hit_distance = std::numeric_limits<double>::infinity()};
        RayHit seen = nearest;
        std::uint32_t last = 0;
        for (const RayHit& hit : met_) {
            if (hit.hit_distance < nearest.hit_distance) { nearest = hit; }
            if (const std::uint32_t place = place_[targets_.all()[hit.target].polygon]; place > last) {
                last = place;
                seen = hit;
            }
        }
        if (std::isinf(nearest.hit_distance) || nearest.edge_distance < ray_tolerance) { return; }
        ++ray_test.rays;
        const double perturbed_distance =
            seen.perturbed_distance + nearest.perturbed_distance + ray_tolerance * nearest.hit_distance;
        const bool clear = last == 0 || seen.edge_distance >= ray_tolerance;
        const bool behind = seen.hit_distance - nearest.hit_distance > perturbed_distance;
        ray_test.wrong += clear && (behind || (last != 0 && lies_under(seen))) ? 1 : 0;
    }

    /// Whether a later polygon of the file lies on what is seen, in one plane and facing alike, where the ray meets it.
    bool lies_under(const RayHit& seen) const {
        const RayTarget& target = targets_.all()[seen.target];
        return std::ranges::any_of(met_, [&](const RayHit& hit) {
            const RayTarget& other = targets_.all()[hit.target];
            return hit.edge_distance >= ray_tolerance &&
                   std::abs(hit.hit_distance - seen.hit_distance) < hit.perturbed_distance &&
                   model_.parent_of(other.polygon) > model_.parent_of(target.polygon) &&
                   glm::dot(other.normal, target.normal) > 0.0 && lies_in(other, target) && lies_in(target, other);
        });
    }

    /// Whether a polygon of the file lies in the plane of a piece of another one, given any of its pieces: planes that
    /// cross at a small angle are near one another along a line, too.
    bool lies_in(const RayTarget& piece, const RayTarget& other) const {
        const std::uint32_t parent = model_.parent_of(piece.polygon);
        return std::ranges::all_of(targets_.all(), [&](const RayTarget& target) {
            return model_.parent_of(target.polygon) != parent ||
                   std::ranges::all_of(target.corners, [&](const glm::dvec3& corner) {
                       return std::abs(glm::dot(corner - other.middle, other.normal)) < in_plane;
                   });
        });
    }

    const PolygonModel& model_;
    const DrawOrder& order_;
    RayTestOptions scope_;
    RandomGenerator dice_{1989};
    RayTargets targets_;
    DrawOrder::Walk walk_;
    std::vector<std::uint32_t> painted_;
    std::vector<RayHit> met_; ///< By the ray at hand.
    /// For each polygon when it is painted, from 1; 0 for one that is not.
    std::vector<std::uint32_t> place_;
};

/// Casts the rays of a test, those at unproved pairs too; the results of the proof stay as they are.
void cast_rays(
    RayTester& trying, std::span<const double> angles_rad, const OrderProof& proof, RayTestResult& ray_test) {
    const std::size_t comparisons = max_comparisons / angles_rad.size();
    for (const double angle_rad : angles_rad) {
        trying.look(angle_rad, comparisons, ray_test);
        trying.check_pairs(proof.unproved_pairs, comparisons, ray_test);
    }
}

} // namespace

RayTestResult ray_test_order(const PolygonModel& model, const DrawOrder& order, const RayTestOptions& scope) {
    constexpr std::array angles_rad{0.0, 0.7, 2.1, 4.4};
    const bool turns = !model.pivots.empty();
    const std::size_t angles = turns && scope.turning_parts ? angles_rad.size() : 1;
    OrderProof proof;
    if (!turns || scope.turning_parts) { // else no order is right, and none can be proved
        proof = prove_order(model, scope.proved_order != nullptr ? *scope.proved_order : order, scope.proof_s);
    }
    RayTestResult ray_test{.unproved = proof.unproved, .is_proof_complete = proof.is_complete};
    RayTester trying(model, order, scope);
    cast_rays(trying, std::span(angles_rad).first(angles), proof, ray_test);
    return ray_test;
}

} // namespace octant::visuals::draworder
