#include "sim/base/random_generator.h"
#include "tests/order_shapes.h"
#include "visuals/draworder/ray_targets.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

using namespace octant::visuals::draworder;
using octant::RandomGenerator;

namespace {

/// How far along a ray a fan of triangles is met from the front, each by the equation eye + ray * away = a + (b - a) *
/// s + (c - a) * t.
std::optional<double> met_by_fan(const std::vector<glm::dvec3>& corners, const glm::dvec3& eye, const glm::dvec3& ray) {
    for (std::size_t k = 2; k < corners.size(); ++k) {
        const glm::dvec3 one = corners[k - 1] - corners[0];
        const glm::dvec3 other = corners[k] - corners[0];
        if (glm::dot(glm::cross(one, other), ray) >= 0.0) { continue; }
        const glm::dvec3 found = glm::inverse(glm::dmat3(one, other, -ray)) * (eye - corners[0]);
        if (found.x >= 0.0 && found.y >= 0.0 && found.x + found.y <= 1.0 && found.z > 0.0) { return found.z; }
    }
    return std::nullopt;
}

} // namespace

TEST_CASE("rays of a trial meet all that they meet one by one, from far, near and within") {
    const auto model = octant::tests::pile(11, 40);
    RayTargets targets(model);
    targets.turn(0.0, true);
    REQUIRE(targets.all().size() > 200);
    RandomGenerator dice(7);
    std::vector<RayHit> hits;
    long met = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 eye = dice.direction() * (0.05 * std::pow(400.0, dice.next()));
        const auto& aim = targets.all()[static_cast<std::size_t>(i) % targets.all().size()];
        const glm::dvec3 ray = glm::normalize(aim.middle + dice.direction() * (0.9 * aim.radius) - eye);
        targets.set_eye(eye, {});
        targets.intersect(ray, hits);
        auto hit = hits.begin();
        for (std::size_t k = 0; k < targets.all().size(); ++k) {
            const auto hit_distance = met_by_fan(targets.all()[k].corners, eye, ray);
            const bool is_hit = hit != hits.end() && hit->target == k;
            if (is_hit && hit_distance) {
                CHECK(hit->distance == Approx(*hit_distance).epsilon(1e-9));
                ++met;
            } else if (is_hit) {
                CHECK(hit->edge_distance < 1e-9);
            } else if (hit_distance) {
                FAIL_CHECK("ray " << i << " passes target " << k);
            }
            hit += is_hit ? 1 : 0;
        }
        CHECK(hit == hits.end());
    }
    CHECK(met > 2000);
}
