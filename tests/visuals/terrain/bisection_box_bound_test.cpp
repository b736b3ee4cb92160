#include "visuals/terrain/bisection_criterion.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace octant::visuals::terrain {

namespace {

constexpr double reach_spacing_m = 10.0;
constexpr double picture_corner_cos = 0.764;

/// A box in metres from the eye.
struct ReachBox {
    glm::dvec3 least;
    glm::dvec3 most;
};

glm::dvec3 looking(double heading, double down) {
    const double level = std::sqrt(1.0 - down * down);
    return {level * std::sin(heading), level * std::cos(heading), -down};
}

double reach_m2(const ReachBox& box, const glm::dvec3& ahead) {
    const auto samples = [](double m) { return splat4(static_cast<float>(m / reach_spacing_m)); };
    const double gap_m = std::max({box.least.z, -box.most.z, 0.0});
    BoxErrorBound reach(reach_spacing_m);
    reach.set_direction(ahead, picture_corner_cos);
    return static_cast<double>(reach.squared_m2({samples(box.least.x), samples(box.most.x), samples(box.least.y),
        samples(box.most.y), splat4(static_cast<float>(gap_m * gap_m)),
        splat4(static_cast<float>(std::min(box.least.z * ahead.z, box.most.z * ahead.z)))})[0]);
}

/// The least value at places of a lattice in the box that the picture may show.
double min_shown_m2(const ReachBox& box, const glm::dvec3& ahead) {
    constexpr int steps = 24;
    const glm::dvec2 level = glm::normalize(glm::dvec2(ahead));
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= steps; ++j) {
            for (int k = 0; k <= 4; ++k) {
                const glm::dvec3 share(i / double{steps}, j / double{steps}, k / 4.0);
                const glm::dvec3 at = box.least + share * (box.most - box.least);
                const double depth = glm::dot(at, ahead);
                if (depth < 1.0 || depth < picture_corner_cos * glm::length(at)) { continue; }
                const double along = glm::dot(glm::dvec2(at), level);
                const double aside = level.x * at.y - level.y * at.x;
                const double n = std::hypot(along, ahead.z * aside);
                least = std::min(least, std::pow(depth * depth / n, 2.0));
            }
        }
    }
    return least;
}

} // namespace

TEST_CASE("no place of a box that a picture shows lies nearer than the bound says") {
    constexpr std::array<double, 7> places = {-400.0, -130.0, -60.0, -20.0, 0.0, 45.0, 300.0};
    int shown = 0;
    for (const double down : {-0.5, -0.1, 0.0, 0.02, 0.2, 0.5, 0.75, 0.8, 0.95}) {
        for (const double heading : {0.0, 0.6, 2.1, 4.0}) {
            const glm::dvec3 ahead = looking(heading, down);
            for (const double x : places) {
                for (const double y : places) {
                    for (const double top : {-150.0, -20.0, 15.0}) {
                        const ReachBox box{{x, y, top - 30.0}, {x + 100.0, y + 80.0, top}};
                        const double min_m2 = min_shown_m2(box, ahead);
                        INFO(down << ' ' << heading << ' ' << x << ' ' << y << ' ' << top);
                        CHECK(reach_m2(box, ahead) <= 1.00001 * min_m2);
                        shown += std::isfinite(min_m2) ? 1 : 0;
                    }
                }
            }
        }
    }
    CHECK(shown > 1000);
}

TEST_CASE("what lies behind the eye does not count in a picture that cannot show it") {
    for (const double down : {0.05, 0.2, 0.4}) {
        const glm::dvec3 ahead = looking(0.0, down);
        const ReachBox in_front{{-50.0, 0.0, -100.0}, {50.0, 60.0, -80.0}};
        ReachBox around = in_front;
        around.least.y = -60.0;
        INFO(down);
        CHECK(reach_m2(around, ahead) > 0.95 * reach_m2(in_front, ahead));
    }
}

} // namespace octant::visuals::terrain
