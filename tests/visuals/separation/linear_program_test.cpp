#include "visuals/separation/linear_program.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <thread>
#include <vector>

using namespace octant::visuals::separation;

namespace {

/// The largest z in a ball, whose surface stands as many planes around it; some are nearly equal.
LinearProgram highest_point_in_ball(int planes) {
    LinearProgram program;
    program.variables.assign(3, {.least = -unbounded});
    program.variables[2].weight = 1.0;
    for (int i = 0; i < planes; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / planes;
        const double across = std::sqrt(1.0 - z * z);
        program.rows.push_back({.factors = {across * std::cos(2.4 * i), across * std::sin(2.4 * i), z}, .most = 1.0});
    }
    return program;
}

} // namespace

TEST_CASE("a linear programme is solved, or said to have no solution") {
    // x + y as large as can be with x + 2 y <= 4, x <= 3.
    LinearProgram program;
    program.variables = {{.weight = 1.0, .most = 3.0}, {.weight = 1.0}};
    program.rows = {{.factors = {1.0, 2.0}, .most = 4.0}};
    const auto values = optimum(program);
    REQUIRE(values);
    CHECK((*values)[0] == Approx(3.0));
    CHECK((*values)[1] == Approx(0.5));
    program.rows.push_back({.factors = {1.0, 1.0}, .least = 10.0});
    CHECK_FALSE(optimum(program));
    program.rows = {};
    CHECK_FALSE(optimum(program));
}

TEST_CASE("variables without bounds and rows with two are solved as well") {
    LinearProgram program;
    program.variables = {{.weight = -1.0, .least = -unbounded}, {.weight = 0.0, .least = -2.0, .most = 5.0}};
    program.rows = {{.factors = {1.0, 1.0}, .least = 1.0, .most = 1.0}};
    const auto values = optimum(program);
    REQUIRE(values);
    CHECK((*values)[0] == Approx(-4.0));
    CHECK((*values)[1] == Approx(5.0));
}

TEST_CASE("threads that solve side by side get what each would get alone") {
    const auto alone = optimum(highest_point_in_ball(300));
    REQUIRE(alone);
    CHECK((*alone)[2] > 1.0);
    CHECK((*alone)[2] < 1.1);
    std::vector<std::optional<std::vector<double>>> together(8);
    std::vector<std::thread> threads;
    for (auto& values : together) {
        threads.emplace_back([&values] {
            for (int i = 0; i < 20; ++i) { values = optimum(highest_point_in_ball(300)); }
        });
    }
    for (std::thread& thread : threads) { thread.join(); }
    for (const auto& values : together) { CHECK(values == alone); }
}
