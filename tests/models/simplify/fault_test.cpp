#include "models/simplify/fault.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>

#include <utility>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

TEST_CASE("a surface is not off itself, and a larger one by what it is larger") {
    const TriangleMesh small = ball(12);
    TriangleMesh large = small;
    for (glm::dvec3& vertex_m : large.vertices_m) {
        vertex_m *= 1.1;
    }
    CHECK(fault_of(small, measure::TargetSurface(small)).off_m == 0.0);
    const Fault fault = fault_of(large, measure::TargetSurface(small));
    CHECK(fault.off_m == Approx(0.1).epsilon(0.05));
    CHECK(fault.rms_m == Approx(0.1).epsilon(0.05));
    CHECK(fault.turned == 0.0);
}

TEST_CASE("a surface that faces inwards is turned over") {
    const TriangleMesh outwards = ball(12);
    TriangleMesh inwards = outwards;
    for (std::size_t v = 0; v < inwards.vertices_m.size(); ++v) {
        inwards.vertices_m[v] *= 1.1;
    }
    for (Triangle& triangle : inwards.triangles) {
        std::swap(triangle[0], triangle[1]);
    }
    CHECK(fault_of(inwards, measure::TargetSurface(outwards)).turned > 0.99);
}

TEST_CASE("without a yardstick the product of distance and root mean square counts") {
    const Yardstick none_known;
    CHECK(none_known.is_beaten_by({100.0, 100.0, 0.0}));
    CHECK(none_known.badness({2.0, 0.1, 0.0}) < none_known.badness({1.0, 0.3, 0.0}));
    CHECK(none_known.badness({1.0, 0.1, 0.0}) < none_known.badness({1.0, 0.1, 0.001}));
}

TEST_CASE("what plain ways beat in one value is worse than what they beat in none") {
    Yardstick yardstick;
    yardstick.add({1.0, 0.5, 0.001});
    yardstick.add({2.0, 0.1, 0.003});
    const Fault balanced{0.85, 0.079, 0.0};
    const Fault far_off{1.5, 0.03, 0.0};
    const Fault far_in_the_mean{0.4, 0.15, 0.0};
    CHECK(yardstick.is_beaten_by(balanced));
    CHECK_FALSE(yardstick.is_better_than(balanced));
    CHECK(yardstick.is_better_than(far_off));
    CHECK(yardstick.is_better_than(far_in_the_mean));
    CHECK_FALSE(yardstick.is_beaten_by(far_off));
    CHECK_FALSE(yardstick.is_beaten_by(far_in_the_mean));
    CHECK(yardstick.badness(balanced) < yardstick.badness(far_off));
    CHECK(yardstick.badness(balanced) < yardstick.badness(far_in_the_mean));
}

TEST_CASE("a start for revisions is judged by the mean distance first, and by turned area") {
    Yardstick yardstick;
    yardstick.add({1.0, 1.0, 0.001});
    const Fault near_in_the_mean{1.3, 0.9, 0.0};
    const Fault near_at_most{0.9, 1.1, 0.0};
    CHECK(yardstick.hopelessness(near_in_the_mean) < yardstick.hopelessness(near_at_most));
    CHECK(yardstick.hopelessness({1.3, 0.9, 0.003}) > yardstick.hopelessness(near_at_most));
    CHECK(yardstick.is_better_in_the_mean_than(near_in_the_mean));
    CHECK_FALSE(yardstick.is_better_in_the_mean_than({5.0, 0.7, 0.0}));
    INFO("without a yardstick nothing is better");
    CHECK_FALSE(Yardstick().is_better_in_the_mean_than(near_in_the_mean));
}

TEST_CASE("what turns more over than plain ways is no better for being nearer") {
    Yardstick yardstick;
    yardstick.add({1.0, 0.1, 0.001});
    yardstick.add({2.0, 0.2, 0.004});
    CHECK(yardstick.allowed_turned() == 0.001);
    CHECK(yardstick.is_beaten_by({0.5, 0.05, 0.0009}));
    CHECK_FALSE(yardstick.is_beaten_by({0.5, 0.05, 0.002}));
    CHECK(yardstick.badness({0.5, 0.05, 0.001}) < yardstick.badness({0.4, 0.04, 0.003}));
    Yardstick clean;
    clean.add({1.0, 0.1, 0.0});
    INFO("a share that a few samples make is allowed");
    CHECK(clean.is_beaten_by({0.5, 0.05, 0.0001}));
}
