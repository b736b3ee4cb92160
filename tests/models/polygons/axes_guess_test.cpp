#include "models/polygons/axes_guess.h"
#include "models/polygons/mesh_polygons.h"
#include "models/polygons/obj_reader.h"
#include "tests/sample_meshes.h"

#include <catch2/catch.hpp>

#include <array>
#include <fmt/format.h>
#include <string>

using namespace octant::models;
using namespace octant::models::polygons;

namespace {

TriangleMesh in_file(const PolygonModel& body, const FileAxes& axes) {
    TriangleMesh mesh = mesh_from_polygons(body);
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m = axes.file_from_body(vertex_m); }
    return mesh;
}

TriangleMesh box(const glm::dvec3& half_m) {
    TriangleMesh mesh = octant::tests::cube();
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m = half_m * (2.0 * vertex_m - 1.0); }
    return mesh;
}

} // namespace

TEST_CASE("nose and top of the F-15 are found whichever way its file turns it") {
    const PolygonModel body = read_obj(std::filesystem::path(OCTANT_SOURCE_DIR) / "models" / "f15.obj");
    for (const std::string axes :
        {"right,up,back", "back,up,left", "left,up,forward", "forward,left,up", "right,forward,up", "back,right,up"}) {
        CAPTURE(axes);
        const auto guess = guess_axes(in_file(body, FileAxes::from_text(axes)));
        REQUIRE(guess.has_value());
        CHECK(guess->text() == axes);
    }
}

TEST_CASE("shapes without nose or top are not guessed at") {
    CHECK_FALSE(guess_axes(TriangleMesh()).has_value());
    CHECK_FALSE(guess_axes(box({1.0, 1.0, 1.0})).has_value());
    CHECK_FALSE(guess_axes(box({5.0, 3.0, 1.0})).has_value());
}
