#include "models/polygons/file_axes.h"
#include "sim/base/error.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string>

using octant::models::polygons::FileAxes;

namespace {

const std::array<std::string, 6> names{"right", "left", "up", "down", "forward", "back"};

std::string axes_fault(const std::string& text) {
    try {
        FileAxes::from_text(text);
    } catch (const octant::Error& error) { return error.what(); }
    return "accepted";
}

} // namespace

TEST_CASE("usual OBJ axes become body axes: right to y, up to -z, -z ahead to x") {
    const FileAxes axes;
    CHECK(axes.text() == "right,up,back");
    CHECK(axes.body_from_file({1, 0, 0}) == glm::dvec3(0, 1, 0));
    CHECK(axes.body_from_file({0, 1, 0}) == glm::dvec3(0, 0, -1));
    CHECK(axes.body_from_file({0, 0, -1}) == glm::dvec3(1, 0, 0));
    CHECK(axes.file_from_body({1, 2, 3}) == glm::dvec3(2, -3, -1));
}

TEST_CASE("axes written as body axes change nothing") {
    const FileAxes axes = FileAxes::from_text(" forward, right ,down");
    CHECK(axes.body_from_file({1, 2, 3}) == glm::dvec3(1, 2, 3));
    CHECK(axes.text() == "forward,right,down");
}

TEST_CASE("of all 216 triples 24 are right-handed, and each of them converts there and back") {
    int accepted = 0;
    for (const auto& x : names) {
        for (const auto& y : names) {
            for (const auto& z : names) {
                const std::string text = fmt::format("{},{},{}", x, y, z);
                if (axes_fault(text) != "accepted") { continue; }
                ++accepted;
                const FileAxes axes = FileAxes::from_text(text);
                CHECK(axes.text() == text);
                const glm::dvec3 p(0.1, -2.3, 1e9);
                CHECK(axes.file_from_body(axes.body_from_file(p)) == p);
                CHECK(axes.body_from_file(axes.file_from_body(p)) == p);
            }
        }
    }
    CHECK(accepted == 24);
}

TEST_CASE("zero stays a plain zero") {
    const glm::dvec3 zero = FileAxes().body_from_file({0, 0, 0});
    for (int i = 0; i < 3; ++i) { CHECK_FALSE(std::signbit(zero[i])); }
}

TEST_CASE("wrong axes are refused with what was expected") {
    const std::string expected =
        "axes: expected where x, y and z point, such as right,up,back (of right, left, up, down, "
        "forward, back), got ";
    CHECK(axes_fault("") == expected + "''");
    CHECK(axes_fault("right,up") == expected + "'right,up'");
    CHECK(axes_fault("right,up,aft") == expected + "'right,up,aft'");
    CHECK(axes_fault("x,y,-z") == expected + "'x,y,-z'");
    CHECK(axes_fault("right,up,left") == expected + "'right,up,left', where two axes lie on one line");
    CHECK(axes_fault("right,up,forward") == expected + "'right,up,forward', which is left-handed");
}

TEST_CASE("with the nose at the other end the top stays where it is") {
    CHECK(octant::models::polygons::nose_at_other_end(FileAxes()).text() == "left,up,forward");
    CHECK(
        octant::models::polygons::nose_at_other_end(FileAxes::from_text("forward,left,up")).text() == "back,right,up");
}
