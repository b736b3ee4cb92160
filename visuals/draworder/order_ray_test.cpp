// Every order is tested before it is used. Rays within ray_tolerance of a side of a polygon are not counted: there
// rounding decides what is seen.
#include "visuals/draworder/order_ray_test.h"

#include "sim/base/random_generator.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/proof_walk.h"
#include "visuals/draworder/ray_targets.h"
#include "visuals/draworder/search_budget.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

using models::polygons::PolygonModel;

/// About the work of a pair that a polygon's plane decides, of one with a proof, of one without, and of a polygon of a
/// part (SearchBudget).
constexpr std::uint64_t units_of_pair = 20;
constexpr std::uint64_t units_of_proof = 2'000;
constexpr std::uint64_t units_without_proof = 1'000'000;
constexpr std::uint64_t units_of_polygon_in_part = 60;

/// How far an order is proved.
struct OrderProof {
    /// Pairs and polygons for which no proof was found.
    std::uint64_t unproved = 0;
    /// The first of these pairs: which is painted earlier, which later.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> unproved_pairs;
    static constexpr std::size_t max_unproved_pairs = 100;
    /// Whether the proof came to the end of the order before its budget was spent.
    bool is_complete = false;
};

/// Counts what the walk does not prove, and spends its budget.
class ProofCounter : public ProofVisitor {
public:
    explicit ProofCounter(SearchBudget& budget) : budget_(budget) {}

    OrderProof& proof() { return proof_; }

    void begin_pairs(int /*part*/, std::uint32_t /*later*/, std::size_t count) override {
        budget_.spend(units_of_pair * count);
    }

    void add_pair(separation::DecidingPolygon /*by*/) override {}

    void end_pairs() override {}

    void add_plane_proof(int /*part*/, const separation::SeparatingPlaneProof& plane_proof, std::uint32_t earlier,
        std::uint32_t later) override {
        if (plane_proof.kind != separation::SeparatingPlaneProof::Kind::None) {
            budget_.spend(units_of_proof);
            return;
        }
        ++proof_.unproved;
        if (proof_.unproved_pairs.size() < OrderProof::max_unproved_pairs) {
            proof_.unproved_pairs.emplace_back(earlier, later);
        }
        budget_.spend(units_without_proof);
    }

    void add_back_facing(
        int /*part*/, std::uint32_t /*polygon*/, const separation::PlaneFactors& /*factors*/) override {
        budget_.spend(units_of_proof);
    }

    void add_unproved(int /*part*/, std::uint32_t /*polygon*/) override {
        ++proof_.unproved;
        budget_.spend(units_without_proof);
    }

    void end_part(std::size_t polygons) override { budget_.spend(units_of_polygon_in_part * polygons); }

private:
    SearchBudget& budget_;
    OrderProof proof_;
};

/// Proves an order pair by pair (proof_walk.h), for about so many seconds of work on one core. Work is counted, not
/// timed: the same model and order give the same proof.
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
        ProofCounter counter(budget);
        try {
            visit_proof({model, order, axes, local}, counter);
            counter.proof().is_complete = true;
        } catch (const SearchGivenUp&) { return best.is_complete ? best : counter.proof(); }
        if (!best.is_complete || counter.proof().unproved < best.unproved) { best = counter.proof(); }
        if (best.unproved == 0) { break; }
    }
    return best;
}

constexpr double ray_tolerance = RayTargets::ray_tolerance;
/// About how often a ray is tested against a polygon in all, some 10 ns each.
constexpr std::size_t max_comparisons = 20'000'000;
constexpr std::size_t max_eyes = 2'000;
constexpr std::size_t rays_an_eye = 10;
/// The rays at each pair without a proof; fewer where they would cost more comparisons than all other rays.
constexpr std::size_t rays_a_pair = 100;
constexpr std::size_t min_rays_a_pair = 4;
/// Polygons whose corners are all nearer than this to one another's planes lie in one plane.
constexpr double in_plane = 1e-9;

/// Casts rays and counts them in a result.
class RayTester {
public:
    RayTester(const PolygonModel& model, const DrawOrder& order, const RayTestOptions& scope, RayTestResult& result)
        : model_(model), order_(order), scope_(scope), result_(result), targets_(model) {}

    /// Turns the parts, and casts rays from eyes everywhere.
    void test_angle(double turn_rad, std::size_t comparisons) {
        targets_.turn(turn_rad, scope_.turning_parts);
        if (targets_.all().empty()) { return; }
        const std::size_t rays = comparisons / targets_.all().size();
        const std::size_t most = max_eyes * comparisons / max_comparisons;
        const std::size_t eyes = std::clamp<std::size_t>(rays / rays_an_eye, 20, most);
        for (std::size_t i = 0; i < eyes; ++i) {
            const glm::dvec3 eye = next_eye(i);
            const glm::dvec3 eye_m = targets_.in_model_m(eye);
            if (is_in_scope(eye_m)) { cast_rays_from(eye, eye_m); }
        }
    }

    /// Casts rays through polygons that are painted earlier at others painted later, at the angle tested last.
    void test_pairs(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs, std::size_t comparisons) {
        const std::size_t once = std::max<std::size_t>(pairs.size() * targets_.all().size(), 1);
        const std::size_t rays = std::clamp(comparisons / once, min_rays_a_pair, rays_a_pair);
        for (const auto& [earlier, later] : pairs) {
            const RayTarget* const occluder = targets_.of(earlier);
            const RayTarget* const occluded = targets_.of(later);
            for (std::size_t i = 0; i < rays && occluder != nullptr && occluded != nullptr; ++i) {
                cast_ray_through(*occluder, *occluded);
            }
        }
    }

private:
    void cast_ray_through(const RayTarget& occluder, const RayTarget& occluded) {
        const glm::dvec3 through = point_of(occluder);
        const glm::dvec3 way = through - point_of(occluded);
        const double length = glm::length(way);
        const glm::dvec3 eye = through + way * (30.0 * small() / std::max(length, ray_tolerance));
        const glm::dvec3 eye_m = targets_.in_model_m(eye);
        if (length > ray_tolerance && is_in_scope(eye_m)) {
            set_eye(eye, eye_m);
            cast_ray(-way / length);
        }
    }

    bool is_in_scope(const glm::dvec3& eye_m) const {
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
        const glm::dvec3 eye = dice_.direction() * (0.05 * std::pow(400.0, dice_.next()));
        if (number % 4 == 1) {
            const RayTarget& target = any_target();
            return point_of(target) + target.normal * small();
        }
        const auto nodes = order_.nodes();
        if (number % 4 == 3 && !nodes.empty()) {
            const double place = dice_.next() * static_cast<double>(nodes.size());
            const auto& node = nodes[std::min(static_cast<std::size_t>(place), nodes.size() - 1)];
            const double side = dice_.next() < 0.5 ? -small() : small();
            const double height = distance_m(node.plane, targets_.in_model_m(eye)) / targets_.radius_m();
            return eye + node.plane.normal * (side - height);
        }
        return eye;
    }

    void set_eye(const glm::dvec3& eye, const glm::dvec3& eye_m) {
        painted_.clear();
        order_.append_painted(eye_m, walk_, painted_);
        targets_.set_eye(eye, painted_);
    }

    void cast_rays_from(const glm::dvec3& eye, const glm::dvec3& eye_m) {
        set_eye(eye, eye_m);
        for (std::size_t i = 0; i < rays_an_eye; ++i) {
            const glm::dvec3 towards = point_of(any_target()) - eye;
            const double length = glm::length(towards);
            if (length > 0.0) { cast_ray(towards / length); }
        }
    }

    void cast_ray(const glm::dvec3& ray) {
        targets_.intersect(ray, hits_);
        if (hits_.empty()) { return; }
        const RayHit& nearest = *std::ranges::min_element(hits_, {}, &RayHit::distance);
        const RayHit& seen = *std::ranges::max_element(hits_, {}, &RayHit::painted);
        if (nearest.edge_distance < ray_tolerance) { return; }
        ++result_.rays;
        if (seen.painted == 0) {
            ++result_.wrong;
            return;
        }
        const double tolerance =
            seen.distance_tolerance + nearest.distance_tolerance + ray_tolerance * nearest.distance;
        const bool is_behind = seen.distance - nearest.distance > tolerance;
        result_.wrong += seen.edge_distance >= ray_tolerance && (is_behind || lies_under(seen)) ? 1 : 0;
    }

    /// Whether a later polygon of the file lies on what is seen, in one plane and facing alike, where the ray meets it.
    bool lies_under(const RayHit& seen) const {
        const RayTarget& target = targets_.all()[seen.target];
        return std::ranges::any_of(hits_, [&](const RayHit& hit) {
            const RayTarget& other = targets_.all()[hit.target];
            return hit.edge_distance >= ray_tolerance &&
                   std::abs(hit.distance - seen.distance) < hit.distance_tolerance &&
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
    const RayTestOptions& scope_;
    RayTestResult& result_;
    RandomGenerator dice_{1989};
    RayTargets targets_;
    DrawOrder::Walk walk_;
    std::vector<std::uint32_t> painted_;
    std::vector<RayHit> hits_; ///< Of the ray cast last.
};

} // namespace

RayTestResult ray_test_order(const PolygonModel& model, const DrawOrder& order, const RayTestOptions& scope) {
    constexpr std::array angles_rad{0.0, 0.7, 2.1, 4.4};
    const bool turns = !model.pivots.empty();
    OrderProof proof;
    if (!turns || scope.turning_parts) { // else no order is right, and none can be proved
        proof = prove_order(model, scope.proved_order != nullptr ? *scope.proved_order : order, scope.proof_s);
    }
    RayTestResult result{.unproved = proof.unproved, .is_proof_complete = proof.is_complete};
    RayTester tester(model, order, scope, result);
    const std::size_t angles = turns && scope.turning_parts ? angles_rad.size() : 1;
    for (const double angle_rad : std::span(angles_rad).first(angles)) {
        tester.test_angle(angle_rad, max_comparisons / angles);
        tester.test_pairs(proof.unproved_pairs, max_comparisons / angles);
    }
    return result;
}

} // namespace octant::visuals::draworder
