#include "models/simplify/material_borders.h"
#include "models/simplify/simplify.h"
#include "models/simplify/working_surface.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

/// A sheet of two materials, which meet where x is `border_m`.
TriangleMesh two_grounds(TriangleMesh sheet, double border_m) {
    sheet.materials = {{"grass", glm::vec3(0.2F)}, {"sand", glm::vec3(0.8F)}};
    for (const Triangle& t : sheet.triangles) {
        const auto& at = sheet.vertices_m;
        const double x = (at[t[0]].x + at[t[1]].x + at[t[2]].x) / 3.0;
        sheet.triangle_materials.push_back(x < border_m ? 0 : 1);
    }
    return sheet;
}

} // namespace

TEST_CASE("borders of materials are as far apart as one of them was moved") {
    const TriangleMesh sheet = strip(4, 8);
    const TriangleMesh one = two_grounds(sheet, 1.0);
    const BorderDistance moved = material_border_distance(two_grounds(sheet, 1.25), one);
    CHECK(moved.most_m == Approx(0.25));
    CHECK(moved.rms_m > 0.0);
    CHECK(moved.rms_m < 0.25);
    CHECK(material_border_distance(one, one).most_m == Approx(0.0).margin(1e-12));
    CHECK(std::isinf(material_border_distance(sheet, one).most_m));
    CHECK(material_border_distance(sheet, sheet).most_m == 0.0);
}

TEST_CASE("what moves a border of materials by more than little does not keep it") {
    CHECK(BorderDistance{1.01, 1.01}.keeps({1.0, 1.0}));
    CHECK_FALSE(BorderDistance{1.1, 1.0}.keeps({1.0, 1.0}));
    CHECK_FALSE(BorderDistance{0.5, 1.1}.keeps({1.0, 1.0}));
}

TEST_CASE("vertices move along a held border and across the surface, its ends across it alone") {
    const TriangleMesh sheet = two_grounds(strip(4, 8), 1.0);
    WorkingSurface surface(sheet, WorkingUnits::of(sheet, 0.1));
    const auto moved = [&](const glm::dvec3& place_m) {
        const auto found = std::ranges::find_if(sheet.vertices_m, [&](const glm::dvec3& v) {
            return glm::distance(v, place_m) < 1e-9;
        });
        REQUIRE(found != sheet.vertices_m.end());
        const auto vertex = static_cast<std::uint32_t>(found - sheet.vertices_m.begin());
        return surface.along_borders(vertex, {1.0, 2.0, 3.0});
    };
    const glm::dvec3 whole(1.0, 2.0, 3.0);
    CHECK(moved({1.0, 0.5, 0.0}) == whole); // not held
    surface.holds_borders = true;
    CHECK(moved({0.5, 0.5, 0.0}) == whole);
    CHECK(glm::distance(moved({1.0, 0.5, 0.0}), {0.0, 2.0, 3.0}) < 1e-12);
    CHECK(glm::distance(moved({1.0, 0.0, 0.0}), {0.0, 0.0, 3.0}) < 1e-12);
}

TEST_CASE("revisions of a bumpy sheet leave its border of materials in place") {
    TriangleMesh sheet = strip(16, 24);
    for (glm::dvec3& place_m : sheet.vertices_m) {
        place_m.z = 0.1 * std::sin(5.0 * place_m.x) * std::cos(4.0 * place_m.y);
    }
    const TriangleMesh fine = two_grounds(sheet, 1.0);
    SimplifyOptions options;
    options.goal.faces = 60;
    const TriangleMesh coarse = simplified(fine, options).mesh;
    CHECK(coarse.triangles.size() == 60);
    CHECK(material_border_distance(coarse, fine).most_m < 0.03);
}
