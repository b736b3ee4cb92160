#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "visuals/scene/tower.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace octant;
using namespace octant::visuals::scene;

namespace {

constexpr double radius_m = 10.0;

const GroundHeight affine_ground = [](double, double) { return std::optional<double>(0.0); };
const GroundHeight no_ground = [](double, double) { return std::optional<double>(); };

/// Hills of 240 m over a map of 16 km.
std::optional<double> rolling_m(double x_m, double y_m) {
    if (std::max(std::abs(x_m), std::abs(y_m)) > 8000.0) { return std::nullopt; }
    return 120.0 * (1.0 + std::sin(x_m / 400.0) * std::cos(y_m / 550.0));
}

/// Straight north at 200 m/s, five states a second.
std::vector<sim::AircraftState> northward(double x_m, double z_m, double from_m, double to_m) {
    std::vector<sim::AircraftState> flight;
    for (double y_m = from_m; y_m <= to_m; y_m += 40.0) {
        sim::AircraftState& state = flight.emplace_back();
        state.time_s = (y_m - from_m) / 200.0;
        state.position_m = {x_m, y_m, z_m};
        state.velocity_mps = {0.0, 200.0, 0.0};
    }
    return flight;
}

bool in_sight(const glm::dvec3& eye_m, const glm::dvec3& target_m, const GroundHeight& ground) {
    for (int step = 1; step < 2000; ++step) {
        const glm::dvec3 at_m = glm::mix(eye_m, target_m, step / 2000.0);
        if (const auto height_m = ground(at_m.x, at_m.y); height_m && *height_m > at_m.z) { return false; }
    }
    return true;
}

double elevation_rad(const glm::dvec3& direction) { return std::asin(direction.z / glm::length(direction)); }

/// What the sphere around the aircraft fills of the picture's height.
double share_of(const Camera& camera, const glm::dvec3& aircraft_m) {
    return radius_m / glm::distance(camera.eye_m, aircraft_m) / std::tan(0.5 * camera.vertical_fov_rad);
}

} // namespace

TEST_CASE("from the tower a flight over hills is large, in sight, and before relief and sky") {
    const auto flight = northward(300.0, 420.0, -3000.0, 3000.0);
    const Tower chosen = tower_for({flight, radius_m, 20.0, {0.0, 0.0}}, rolling_m);
    int good = 0;
    for (const sim::AircraftState& state : flight) {
        const Camera camera = tower_camera(chosen, state.position_m, radius_m);
        const glm::dvec3 to_m = state.position_m - chosen.eye_m;
        const double skyline = skyline_rad(chosen, std::atan2(to_m.x, to_m.y));
        const double off_rad = std::abs(elevation_rad(view_direction(camera)) - skyline);
        const double share = share_of(camera, state.position_m);
        good += in_sight(chosen.eye_m, state.position_m, rolling_m) && share > 0.139 && share < 0.7 &&
                        off_rad < 0.5 * camera.vertical_fov_rad
                    ? 1
                    : 0;
    }
    CHECK(good > 0.8 * static_cast<double>(flight.size()));
    CHECK(chosen.eye_m.z >= *rolling_m(chosen.eye_m.x, chosen.eye_m.y) + 2.0);
}

TEST_CASE("a tower on the wrong side of a wall scores nothing, and none is put there") {
    const GroundHeight wall = [](double x_m, double) {
        return std::optional<double>(std::abs(x_m - 100.0) < 30.0 ? 900.0 : 0.0);
    };
    const auto flight = northward(1500.0, 300.0, -2000.0, 2000.0);
    const TowerRequest request{flight, radius_m, 20.0, {0.0, 0.0}};
    CHECK(tower_score({-500.0, 0.0, 25.0}, request, wall) == 0.0);
    CHECK(tower_score({700.0, 0.0, 25.0}, request, wall) > 0.2);
    CHECK(tower_for(request, wall).eye_m.x > 100.0);
}

TEST_CASE("ground behind the aircraft that shows single samples scores less") {
    const GroundHeight slope = [](double x_m, double) {
        return std::optional<double>(std::clamp(0.5 * (x_m - 600.0), 0.0, 70.0));
    };
    const auto flight = northward(300.0, 60.0, -800.0, 800.0);
    const auto score_of = [&](double spacing_m) {
        return tower_score({0.0, 0.0, 25.0}, {flight, radius_m, spacing_m, {0.0, 0.0}}, slope);
    };
    CHECK(score_of(90.0) < score_of(1.0) - 0.1);
    const Tower coarse = tower_at({0.0, 0.0, 25.0}, {flight, radius_m, 90.0, {0.0, 0.0}}, slope);
    const Tower fine = tower_at({0.0, 0.0, 25.0}, {flight, radius_m, 1.0, {0.0, 0.0}}, slope);
    CHECK(coarse.min_fov_rad > 2.0 * fine.min_fov_rad);
}

TEST_CASE("the tower widens no further than the aircraft can still be known") {
    Tower chosen{{0.0, 0.0, 20.0}, {}, 1.0};
    const glm::dvec3 far_m(0.0, 4000.0, 60.0);
    CHECK(share_of(tower_camera(chosen, far_m, radius_m), far_m) == Approx(0.18).epsilon(1e-3));
    chosen.min_fov_rad = 0.01;
    CHECK(share_of(tower_camera(chosen, far_m, radius_m), far_m) > 0.2);
}

TEST_CASE("an aircraft that crosses high before nothing but sky is held in the middle") {
    const Tower chosen{{0.0, 0.0, 20.0}, {}, 0.01};
    const glm::dvec3 high_m(0.0, 300.0, 900.0);
    const Camera camera = tower_camera(chosen, high_m, radius_m);
    CHECK(glm::dot(view_direction(camera), glm::normalize(high_m - camera.eye_m)) == Approx(1.0));
    CHECK(share_of(camera, high_m) == Approx(0.5).epsilon(1e-3));
}

TEST_CASE("the tower's look and zoom move without jumps from picture to picture") {
    const auto flight = northward(300.0, 420.0, -3000.0, 3000.0);
    const Tower chosen = tower_for({flight, radius_m, 20.0, {0.0, 0.0}}, rolling_m);
    Camera before = tower_camera(chosen, flight.front().position_m, radius_m);
    for (double y_m = -3000.0; y_m < 3000.0; y_m += 200.0 / 60.0) {
        const Camera now = tower_camera(chosen, {300.0, y_m, 420.0}, radius_m);
        const double zoom = now.vertical_fov_rad / before.vertical_fov_rad;
        REQUIRE(std::abs(std::log(zoom)) < 0.06);
        REQUIRE(glm::dot(view_direction(now), view_direction(before)) > std::cos(0.05));
        before = now;
    }
}

TEST_CASE("where there is no ground beside the flight the tower stands where it is told") {
    CHECK(tower_score({0.0, 0.0, 20.0}, TowerRequest(), affine_ground) == 0.0);
    const auto flight = northward(0.0, 300.0, -1000.0, 1000.0);
    const Tower chosen = tower_for({flight, radius_m, 0.0, {70.0, 90.0}}, no_ground);
    CHECK(chosen.eye_m == glm::dvec3(70.0, 90.0, 25.0));
    sim::AircraftState still;
    still.position_m = {0.0, 0.0, 300.0};
    const Tower waiting = tower_for({{&still, 1}, radius_m, 0.0, {0.0, 0.0}}, affine_ground);
    const double off_m = glm::distance(waiting.eye_m, still.position_m);
    CHECK(off_m > 100.0);
    CHECK(off_m < 3000.0);
}

TEST_CASE("the same flight has the same tower") {
    const auto flight = northward(300.0, 420.0, -3000.0, 3000.0);
    const TowerRequest request{flight, radius_m, 20.0, {0.0, 0.0}};
    const Tower one = tower_for(request, rolling_m);
    const Tower other = tower_for(request, rolling_m);
    CHECK(one.eye_m == other.eye_m);
    CHECK(one.skyline_rad == other.skyline_rad);
    CHECK(one.min_fov_rad == other.min_fov_rad);
}

TEST_CASE("coarse ground does not hold the lens wide where the picture shows sky alone") {
    const Tower coarse{{0.0, 0.0, 20.0}, {}, 0.05};
    const glm::dvec3 high_m(0.0, 1500.0, 900.0);
    CHECK(share_of(tower_camera(coarse, high_m, radius_m), high_m) == Approx(0.5).epsilon(1e-3));
    const glm::dvec3 low_m(0.0, 1500.0, 25.0);
    CHECK(share_of(tower_camera(coarse, low_m, radius_m), low_m) < 0.4);
}
