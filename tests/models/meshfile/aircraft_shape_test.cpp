#include "models/meshfile/mesh_file.h"
#include "models/polygons/aircraft_shape.h"
#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "tests/sample_meshes.h"

#include <catch2/catch.hpp>

#include <array>
#include <filesystem>
#include <string>

using namespace octant::models;
using namespace octant::models::polygons;

namespace {

const std::filesystem::path shipped_models = std::filesystem::path(OCTANT_SOURCE_DIR) / "models";
const std::filesystem::path found_aircraft = std::filesystem::path(OCTANT_SOURCE_DIR) / "tests" / "data" / "aircraft";

TriangleMesh in_file(TriangleMesh body, const FileAxes& axes) {
    for (glm::dvec3& vertex_m : body.vertices_m) { vertex_m = axes.file_from_body(vertex_m); }
    return body;
}

TriangleMesh box(const glm::dvec3& half_m) {
    TriangleMesh mesh = octant::tests::cube();
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m = half_m * (2.0 * vertex_m - 1.0); }
    return mesh;
}

std::string found_axes(const TriangleMesh& mesh) {
    const auto guess = guess_axes(mesh);
    return guess && guess->is_clear() ? guess->axes.text() : "unclear";
}

const std::array<std::string, 8> many_axes{"right,up,back", "back,up,left", "left,up,forward", "forward,left,up",
    "right,forward,up", "back,right,up", "down,left,forward", "forward,down,left"};

} // namespace

TEST_CASE("nose and top of both aircraft are found whichever way the file turns them") {
    for (const std::string name : {"f15.obj", "500md.obj", "500md-detailed.obj"}) {
        const TriangleMesh body = mesh_from_polygons(read_obj(shipped_models / name));
        for (const std::string& axes : many_axes) {
            CAPTURE(name, axes);
            CHECK(found_axes(in_file(body, FileAxes::from_text(axes))) == axes);
        }
    }
}

TEST_CASE("one shape has one nose and top, in whichever format and unit it is") {
    CHECK(found_axes(meshfile::read_mesh(found_aircraft / "nose-x.obj")) == "back,up,left");
    CHECK(found_axes(meshfile::read_mesh(found_aircraft / "nose-x.glb")) == "back,up,left");
    CHECK(found_axes(meshfile::read_mesh(found_aircraft / "nose+y.glb")) == "right,forward,up");
    TriangleMesh small = meshfile::read_mesh(found_aircraft / "nose-x.obj");
    for (glm::dvec3& vertex_m : small.vertices_m) { vertex_m = 1e-4 * vertex_m + glm::dvec3(5.0, -3.0, 2.0); }
    CHECK(found_axes(small) == "back,up,left");
}

TEST_CASE("a flying wing stands level, its nose where its wings are swept from") {
    const std::array hints{
        AxesHint{AxesHint::Subject::Top, {0.0, 1.0, 0.0}, 2.2}, AxesHint{AxesHint::Subject::Top, {0.0, 0.0, 1.0}, 2.0}};
    const auto guess = guess_axes(meshfile::read_mesh(found_aircraft / "wing.obj"), hints);
    REQUIRE(guess.has_value());
    CHECK(guess->axes.text() == "forward,left,up");
}

TEST_CASE("a small part far away does not move nose and top") {
    TriangleMesh mesh = meshfile::read_mesh(found_aircraft / "nose-x.obj");
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const glm::dvec3& corner : {glm::dvec3(0, 40, 30), glm::dvec3(0.1, 40, 30), glm::dvec3(0, 40.1, 30)}) {
        mesh.vertices_m.push_back(corner);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    CHECK(found_axes(mesh) == "back,up,left");
}

TEST_CASE("hints decide where the shape does not, and names of materials tell nose from tail") {
    TriangleMesh body = box({5.0, 1.0, 1.0});
    const std::array hints{AxesHint{AxesHint::Subject::Top, {0.0, 1.0, 0.0}, 3.0},
        AxesHint{AxesHint::Subject::Nose, {1.0, 0.0, 0.0}, 2.0}};
    CHECK(guess_axes(body, hints)->axes.text() == "forward,up,right");
    body.materials = {{.name = "skin"}, {.name = "Exhaust_01"}};
    for (const Triangle& triangle : body.triangles) {
        const double x =
            body.vertices_m[triangle[0]].x + body.vertices_m[triangle[1]].x + body.vertices_m[triangle[2]].x;
        body.triangle_materials.push_back(x > 14.0 ? 1 : 0);
    }
    CHECK(guess_axes(body, hints)->axes.text() == "back,up,left");
}

TEST_CASE("shapes without nose or top are not taken for clear") {
    CHECK_FALSE(guess_axes(TriangleMesh()).has_value());
    for (const glm::dvec3& half_m : {glm::dvec3(1.0, 1.0, 1.0), glm::dvec3(5.0, 3.0, 1.0)}) {
        const auto guess = guess_axes(box(half_m));
        REQUIRE(guess.has_value());
        CHECK_FALSE(guess->is_clear());
    }
    TriangleMesh point = box({0.0, 0.0, 0.0});
    CHECK_FALSE(guess_axes(point).has_value());
    TriangleMesh sheet = box({3.0, 1.0, 0.0});
    CHECK(guess_axes(sheet).has_value());
    TriangleMesh line = box({3.0, 0.0, 0.0});
    CHECK(guess_axes(line).has_value());
}
