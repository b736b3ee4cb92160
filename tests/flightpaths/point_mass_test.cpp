#include "flightpaths/manoeuvre.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace octant;
using namespace octant::flightpaths;

namespace {

PointMass mass_after(PointMass mass, const PointMassControls& controls, double seconds) {
    for (long step = 0; step < sim::step_at(seconds); ++step) { mass = stepped(mass, controls, sim::step_s); }
    return mass;
}

} // namespace

TEST_CASE("one g with level wings flies straight and level") {
    const PointMass end = mass_after(point_mass_at({0, 0, 100}, 200, 0, 0), {}, 10);
    CHECK(end.position_m.x == Approx(0).margin(1e-9));
    CHECK(end.position_m.y == Approx(2000));
    CHECK(end.position_m.z == Approx(100).margin(1e-9));
}

TEST_CASE("a level turn at bank b turns at g tan(b) / V on a circle of radius V^2 / (g tan(b))") {
    const double bank = rad_from_deg(60);
    PointMass mass = point_mass_at({0, 0, 0}, 100, 0, 0, bank);
    mass.load_factor = 2.0;
    const double rate = gravity_mps2 * std::tan(bank) / 100;
    CHECK(track_rate_radps(mass) == Approx(rate));
    const PointMass end = mass_after(mass, {}, 5);
    CHECK(euler_from_body_to_world(end.flight_to_world).heading_rad == Approx(5 * rate));
    CHECK(euler_from_body_to_world(end.flight_to_world).roll_rad == Approx(bank));
    const double radius = 100 / rate;
    CHECK(end.position_m.x == Approx(radius * (1 - std::cos(5 * rate))));
    CHECK(end.position_m.y == Approx(radius * std::sin(5 * rate)));
    CHECK(end.position_m.z == Approx(0).margin(1e-6));
}

TEST_CASE("a pull at 3.5 g from level starts to climb at 2.5 g / V") {
    PointMass mass = point_mass_at({0, 0, 0}, 250, 1.0, 0);
    mass.load_factor = 3.5;
    const PointMass end = mass_after(mass, {}, 0.1);
    CHECK(euler_from_body_to_world(end.flight_to_world).pitch_rad ==
          Approx(0.1 * 2.5 * gravity_mps2 / 250).epsilon(0.001));
}

TEST_CASE("without lift the path is a throw") {
    PointMass mass = point_mass_at({0, 0, 0}, 100, 0, 0);
    mass.load_factor = 0.0;
    // The speed of a throw grows; here it is held, so only the start is compared.
    const PointMass end = mass_after(mass, {}, 0.5);
    CHECK(end.position_m.z == Approx(-0.5 * gravity_mps2 * 0.25).epsilon(0.01));
}

TEST_CASE("a loop through the vertical comes back with no jump of attitude") {
    PointMass mass = point_mass_at({0, 0, 0}, 200, 0.3, 0);
    double highest = 0.0;
    double turned = 0.0;
    for (int step = 0; step < 120 * 60 && turned < 2 * pi; ++step) {
        mass.load_factor = 4.0 + (mass.flight_to_world * glm::dvec3(0, 0, -1)).z; // 4 g across the path
        const PointMass next = stepped(mass, {}, sim::step_s);
        const double dot = std::min(1.0, std::abs(glm::dot(mass.flight_to_world, next.flight_to_world)));
        CHECK(2 * std::acos(dot) < 1.1 * 4 * gravity_mps2 / 200 * sim::step_s);
        turned += 4 * gravity_mps2 / 200 * sim::step_s;
        mass = next;
        highest = std::max(highest, mass.position_m.z);
    }
    CHECK(highest == Approx(2 * 200 * 200 / (4 * gravity_mps2)).epsilon(0.01));
    CHECK(euler_from_body_to_world(mass.flight_to_world).heading_rad == Approx(0.3).epsilon(0.01));
}

TEST_CASE("the angle of attack raises the nose about the banked wings") {
    const PointMass level = point_mass_at({0, 0, 0}, 200, 0.0, 0.1);
    CHECK(euler_from_body_to_world(body_to_world(level, 0.05)).pitch_rad == Approx(0.15));
    const PointMass banked = point_mass_at({0, 0, 0}, 200, 0.0, 0.0, pi / 2);
    CHECK(euler_from_body_to_world(body_to_world(banked, 0.05)).heading_rad == Approx(0.05));
}
