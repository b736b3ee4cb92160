#include "visuals/draworder/octant_path.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <string>

using namespace octant;
using namespace octant::visuals::draworder;

TEST_CASE("children of an octant path are the parts of its triangle") {
    const auto close = [](const OctantTriangle& a, const OctantTriangle& b) {
        return std::ranges::equal(a, b, [](const auto& p, const auto& q) { return glm::distance(p, q) < 1e-15; });
    };
    CHECK(close(octant_triangle("+-+"), {glm::dvec3(1, 0, 0), {0, -1, 0}, {0, 0, 1}}));
    CHECK(close(octant_triangle("+++/0"), {glm::dvec3(1, 0, 0), {0.5, 0.5, 0}, {0.5, 0, 0.5}}));
    CHECK(close(octant_triangle("+++/1"), {glm::dvec3(0.5, 0.5, 0), {0, 1, 0}, {0, 0.5, 0.5}}));
    CHECK(close(octant_triangle("+++/2"), {glm::dvec3(0.5, 0, 0.5), {0, 0.5, 0.5}, {0, 0, 1}}));
    CHECK(close(octant_triangle("+++/3"), {glm::dvec3(0, 0.5, 0.5), {0.5, 0, 0.5}, {0.5, 0.5, 0}}));
}

TEST_CASE("an octant path means the same eyes in the axes of any file") {
    for (const char* name : {"right,up,back", "up,right,forward", "left,back,up"}) {
        const auto axes = models::polygons::FileAxes::from_text(name);
        for (const std::string path : {"+++", "-+-/2", "+--/0/3/1", "---/1/1/0/2"}) {
            const std::string in_file = path_in_file(path, axes);
            CHECK(path_in_body(in_file, axes) == path);
            glm::dvec3 body(0.0);
            glm::dvec3 file(0.0);
            for (const glm::dvec3& corner : octant_triangle(path)) { body += corner; }
            for (const glm::dvec3& corner : octant_triangle(in_file)) { file += corner; }
            CHECK(glm::distance(axes.body_from_file(file), body) < 1e-15);
        }
    }
}
