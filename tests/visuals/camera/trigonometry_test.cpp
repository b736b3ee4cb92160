#include "sim/base/units.h"
#include "visuals/camera/trigonometry.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::camera {

TEST_CASE("angles, sines and cosines are exact to a few bits") {
    double worst_sine = 0.0;
    double worst_angle = 0.0;
    for (int i = -4000; i <= 4000; ++i) {
        const double angle_rad = i * 0.00123;
        const glm::dvec2 found = cosine_and_sine(angle_rad);
        worst_sine =
            std::max({worst_sine, std::abs(found.x - std::cos(angle_rad)), std::abs(found.y - std::sin(angle_rad))});
        const double along = std::cos(angle_rad);
        const double across = std::abs(std::sin(angle_rad));
        worst_angle = std::max(worst_angle, std::abs(angle_of(along, across) - std::atan2(across, along)));
    }
    CHECK(worst_sine < 1e-15);
    CHECK(worst_angle < 1e-15);
    CHECK(cosine_and_sine(1e-9).y == 1e-9);
    CHECK(angle_of(1.0, 1e-9) == Approx(1e-9).epsilon(1e-15));
    CHECK(angle_of(-1.0, 0.0) == pi);
    CHECK(angle_of(0.0, 2.0) == Approx(pi / 2.0).epsilon(4e-16));
}

TEST_CASE("a rotation turns about its axis to the right") {
    const glm::dvec3 turned = rotation_by({0.0, 0.0, pi / 2.0}) * glm::dvec3(1.0, 0.0, 0.0);
    CHECK(glm::distance(turned, glm::dvec3(0.0, 1.0, 0.0)) < 1e-15);
    CHECK(rotation_by(glm::dvec3(0.0)) == glm::dquat(1.0, 0.0, 0.0, 0.0));
}

} // namespace octant::visuals::camera
