#include "models/repair/repair.h"
#include "tests/sample_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

using namespace octant::models;
using namespace octant::models::repair;
using namespace octant::tests;

namespace {

double volume_m3(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        sum += glm::dot(mesh.vertices_m[a], glm::cross(mesh.vertices_m[b], mesh.vertices_m[c]));
    }
    return sum / 6.0;
}

/// Vertices at one place made one.
TriangleMesh named_by_place(TriangleMesh mesh) {
    std::map<std::array<double, 3>, std::uint32_t> places;
    std::vector<glm::dvec3> vertices_m;
    for (Triangle& triangle : mesh.triangles) {
        for (std::uint32_t& vertex : triangle) {
            const glm::dvec3 at_m = mesh.vertices_m[vertex];
            const auto next = static_cast<std::uint32_t>(places.size());
            const auto [place, is_new] = places.try_emplace({at_m.x, at_m.y, at_m.z}, next);
            if (is_new) { vertices_m.push_back(at_m); }
            vertex = place->second;
        }
    }
    mesh.vertices_m = std::move(vertices_m);
    return mesh;
}

/// Takes out triangles that come twice: those between boxes.
void take_out_walls(TriangleMesh& mesh) {
    std::map<Triangle, int> times;
    const auto sorted = [](Triangle triangle) {
        std::ranges::sort(triangle);
        return triangle;
    };
    for (const Triangle& triangle : mesh.triangles) { ++times[sorted(triangle)]; }
    std::erase_if(mesh.triangles, [&](const Triangle& one) { return times[sorted(one)] > 1; });
}

/// Boxes of one metre with these lowest corners; they share vertices.
TriangleMesh boxes(const std::vector<glm::dvec3>& corners_m) {
    TriangleMesh mesh;
    for (const glm::dvec3& corner_m : corners_m) {
        const TriangleMesh one = cube();
        const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
        for (const glm::dvec3& vertex_m : one.vertices_m) { mesh.vertices_m.push_back(vertex_m + corner_m); }
        for (const auto& [a, b, c] : one.triangles) { mesh.triangles.push_back({a + first, b + first, c + first}); }
    }
    return named_by_place(mesh);
}

RepairedMesh checked(TriangleMesh mesh, Seams seams = Seams::Welded) {
    RepairedMesh result = repaired(std::move(mesh), seams);
    CHECK(manifold_fault(result.mesh).empty());
    CHECK(index_fault(result.mesh).empty());
    return result;
}

} // namespace

TEST_CASE("a closed mesh without faults stays as it is, bit for bit") {
    const TriangleMesh before = coloured_cube();
    const RepairedMesh after = checked(before);
    CHECK(after.mesh.vertices_m == before.vertices_m);
    CHECK(after.mesh.colours == before.colours);
    CHECK(after.mesh.triangles == before.triangles);
    CHECK(after.mesh.corner_normals == before.corner_normals);
    CHECK(after.mesh.triangle_materials == before.triangle_materials);
    CHECK(after.counts == RepairCounts{.shells = 1});
    CHECK(describe_counts(after.counts).empty());
}

TEST_CASE("an open mesh keeps its hole, which is counted") {
    TriangleMesh mesh = cube();
    mesh.triangles.resize(10);
    const RepairedMesh after = checked(mesh);
    CHECK(after.counts == RepairCounts{.boundary_loops = 1, .shells = 1});
    CHECK(after.mesh.triangles == mesh.triangles);
    CHECK(describe_counts(after.counts) == std::vector<std::string>{"1 hole or open rim left as it is"});
}

TEST_CASE("vertices of no triangle are taken out and the others keep their order") {
    TriangleMesh mesh = tetrahedron();
    mesh.vertices_m.insert(mesh.vertices_m.begin() + 1, glm::dvec3(7.0));
    mesh.triangles = {{0, 3, 2}, {0, 2, 4}, {2, 3, 4}, {0, 4, 3}};
    const RepairedMesh after = checked(mesh);
    CHECK(after.mesh.vertices_m == tetrahedron().vertices_m);
    CHECK(after.mesh.triangles == tetrahedron().triangles);
    CHECK(after.counts == RepairCounts{.unreferenced_vertices = 1, .shells = 1});
    CHECK(describe_counts(after.counts) == std::vector<std::string>{"1 vertex of no triangle taken out"});
}

TEST_CASE("triangles that share no vertices are welded where places agree") {
    TriangleMesh soup;
    for (const Triangle& triangle : tetrahedron().triangles) {
        for (const std::uint32_t vertex : triangle) { soup.vertices_m.push_back(tetrahedron().vertices_m[vertex]); }
        const auto last = static_cast<std::uint32_t>(soup.vertices_m.size());
        soup.triangles.push_back({last - 3, last - 2, last - 1});
    }
    soup.vertices_m[0].x = -0.0; // is the place of 0
    const RepairedMesh after = checked(soup);
    CHECK(after.counts == RepairCounts{.duplicate_vertices = 8, .shells = 1});
    CHECK(after.mesh.vertices_m.size() == 4);

    soup.colours.assign(12, glm::vec3(1.0F));
    for (std::size_t v = 0; v < 3; ++v) {
        soup.colours[v] = glm::vec3(0.5F); // the first triangle stays apart
    }
    const RepairedMesh coloured = checked(soup, Seams::Apart);
    CHECK(coloured.counts == RepairCounts{.duplicate_vertices = 5, .boundary_loops = 2, .shells = 2});
    const RepairedMesh mixed = checked(soup);
    CHECK(mixed.counts == RepairCounts{.duplicate_vertices = 8, .shells = 1});
    CHECK(mixed.mesh.colours[0].x == Approx(2.5 / 3.0)); // one of the three corners there is grey
}

TEST_CASE("colours that break along a welded seam stay with their corners") {
    TriangleMesh mesh = cube();
    TriangleMesh apart;
    for (const Triangle& triangle : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(apart.vertices_m.size());
        for (const std::uint32_t vertex : triangle) {
            apart.vertices_m.push_back(mesh.vertices_m[vertex]);
            apart.colours.emplace_back(apart.triangles.size() < 6 ? 0.2F : 0.8F);
        }
        apart.triangles.push_back({first, first + 1, first + 2});
    }
    std::swap(apart.triangles[2][1], apart.triangles[2][2]); // turned back by the repair
    const RepairedMesh after = checked(apart);
    CHECK(after.mesh.vertices_m.size() == 8);
    REQUIRE(after.corner_colours.size() == 12);
    for (std::size_t t = 0; t < 12; ++t) { CHECK(after.corner_colours[t][1] == glm::vec3(t < 6 ? 0.2F : 0.8F)); }
    CHECK(repaired(apart, Seams::Apart).corner_colours.empty());
    apart.colours.assign(apart.colours.size(), glm::vec3(0.5F));
    CHECK(repaired(apart).corner_colours.empty());
}

TEST_CASE("rims a rounding apart are welded, rims farther apart are not") {
    const auto quads = [](double gap) {
        TriangleMesh mesh;
        mesh.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, {1.0 + gap, 0.0, 0.0},
            {2.0, 0.0, 0.0}, {2.0, 1.0, 0.0}, {1.0 + gap, 1.0, 0.0}};
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
        return mesh;
    };
    const RepairCounts welded = checked(quads(1e-7)).counts;
    CHECK(welded == RepairCounts{.duplicate_vertices = 2, .boundary_loops = 1, .shells = 1});
    CHECK(checked(quads(1e-7), Seams::Apart).counts.shells == 2);
    CHECK(checked(quads(1e-4)).counts.shells == 2);
}

TEST_CASE("closed shells that touch along an edge stay closed") {
    TriangleMesh mesh = tetrahedron();
    const TriangleMesh one = tetrahedron();
    for (const glm::dvec3& vertex_m : one.vertices_m) { // the same one mirrored: it shares an edge
        mesh.vertices_m.push_back(glm::dvec3(vertex_m.x, -vertex_m.y, -vertex_m.z));
    }
    for (const auto& [a, b, c] : one.triangles) { mesh.triangles.push_back({a + 4, b + 4, c + 4}); }
    const RepairedMesh after = checked(mesh);
    CHECK(after.counts.boundary_loops == 0);
    CHECK(after.counts.shells == 2);
}

TEST_CASE("triangles without an area go, and what only they had goes with them") {
    TriangleMesh mesh = tetrahedron();
    mesh.vertices_m.emplace_back(0.5, 0.0, 0.0);
    mesh.vertices_m.emplace_back(0.1 + 0.2, 0.0, 0.0);
    mesh.triangles.push_back({0, 1, 1});
    mesh.triangles.push_back({0, 1, 4});
    mesh.triangles.push_back({0, 5, 1});
    const RepairedMesh after = checked(mesh);
    CHECK(after.counts == RepairCounts{.unreferenced_vertices = 2, .degenerate_triangles = 3, .shells = 1});
    CHECK(after.mesh.triangles == tetrahedron().triangles);
}

TEST_CASE("a triangle without an area that closes a T-junction opens nothing when it goes") {
    TriangleMesh box; // its edge from corner 0 to 1 has a vertex in the middle, on one side
    box.vertices_m = {
        {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 0, 0}};
    box.triangles = {{0, 3, 2}, {0, 2, 1}, {0, 8, 4}, {8, 1, 5}, {8, 5, 4}, {0, 1, 8}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7},
        {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {4, 5, 6}, {4, 6, 7}};
    const RepairedMesh closed = checked(box);
    CHECK(closed.mesh.triangles.size() == 14);
    CHECK(closed.counts.degenerate_triangles == 1);
    CHECK(closed.counts.boundary_loops == 0);
}

TEST_CASE("a long thin triangle is no degenerate one") {
    TriangleMesh mesh;
    mesh.vertices_m = {{0.0, 0.0, 0.0}, {1e6, 0.0, 0.0}, {5e5, 1e-3, 0.0}};
    mesh.triangles = {{0, 1, 2}};
    CHECK(checked(mesh).counts == RepairCounts{.boundary_loops = 1, .shells = 1});
}

TEST_CASE("a triangle that comes again, either way round, is taken out; materials follow") {
    TriangleMesh mesh = tetrahedron();
    mesh.materials.resize(3);
    mesh.triangle_materials = {0, 1, 0, 1};
    mesh.triangles.insert(mesh.triangles.begin() + 1, Triangle{2, 1, 0});
    mesh.triangle_materials.insert(mesh.triangle_materials.begin() + 1, 2);
    mesh.triangles.push_back({1, 0, 2});
    mesh.triangle_materials.push_back(2);
    const RepairedMesh after = checked(mesh);
    CHECK(after.counts == RepairCounts{.duplicate_triangles = 2, .shells = 1});
    CHECK(after.mesh.triangles == tetrahedron().triangles);
    CHECK(after.mesh.triangle_materials == std::vector<std::uint32_t>{0, 1, 0, 1});
}

TEST_CASE("a closed mesh stays closed where bodies touch, whatever came twice") {
    SECTION("two boxes with a wall between them") {
        const RepairedMesh after = checked(boxes({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}));
        CHECK(after.counts.boundary_loops == 0);
        CHECK(after.counts.duplicate_triangles == 0);
        CHECK(after.counts.shells == 2);
        CHECK(volume_m3(after.mesh) == Approx(2.0));
    }
    SECTION("two boxes that touch along an edge, and a ring that touches itself") {
        const RepairedMesh two = checked(boxes({{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}}));
        CHECK(two.counts.boundary_loops == 0);
        CHECK(two.counts.shells == 2);
        // A ring of boxes without the walls between them that touches itself along an edge.
        TriangleMesh ring = boxes({{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 1.0}, {0.0, 2.0, 1.0}, {0.0, 2.0, 0.0},
            {1.0, 2.0, 0.0}, {1.0, 1.0, 0.0}});
        take_out_walls(ring);
        const RepairedMesh one = checked(ring);
        CHECK(one.counts.boundary_loops == 0);
        CHECK(one.counts.shells == 1);
        CHECK(volume_m3(one.mesh) == Approx(7.0));
    }
    SECTION("a box that was written twice, with a sheet that has a back") {
        TriangleMesh mesh = boxes({{0.0, 0.0, 0.0}});
        mesh.vertices_m.emplace_back(5.0, 0.0, 0.0);
        mesh.vertices_m.emplace_back(5.0, 1.0, 0.0);
        mesh.vertices_m.emplace_back(5.0, 1.0, 1.0);
        mesh.vertices_m.emplace_back(5.0, 0.0, 1.0);
        const std::vector<Triangle> once = mesh.triangles;
        mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
        for (const Triangle& one : {Triangle{8, 9, 10}, Triangle{8, 10, 11}}) {
            mesh.triangles.push_back(one);
            mesh.triangles.push_back({one[0], one[2], one[1]});
        }
        const RepairedMesh after = checked(mesh);
        CHECK(after.counts.boundary_loops == 0);
        CHECK(after.counts.duplicate_triangles == 12);
        // Both ends of the sheet's diagonal are on its rim, so one side gets a vertex in its middle.
        CHECK(after.mesh.triangles.size() == 12 + 4 + 2);
        CHECK(after.counts.shells == 2);
        CHECK(volume_m3(after.mesh) == Approx(1.0));
    }
}

TEST_CASE("boxes at random in a grid stay closed, with and without the walls between them") {
    std::mt19937 random(7);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<glm::dvec3> corners_m;
        for (int cell = 0; cell < 27; ++cell) {
            if (random() % 2 == 0) { corners_m.emplace_back(cell % 3, cell / 3 % 3, cell / 9); }
        }
        TriangleMesh mesh = boxes(corners_m);
        if (trial % 2 == 1) { take_out_walls(mesh); }
        const RepairedMesh after = repaired(mesh);
        CHECK(manifold_fault(after.mesh).empty());
        CHECK(after.counts.boundary_loops == 0);
        CHECK(volume_m3(after.mesh) == Approx(static_cast<double>(corners_m.size())));
    }
}

TEST_CASE("a triangle that is divided at a junction keeps its attributes") {
    TriangleMesh mesh; // a triangle, and one without an area that has a vertex on its side
    mesh.vertices_m = {{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, {1.0, 0.0, 0.0}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
    mesh.texture_coordinates = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
    mesh.corner_texture_coordinates = {{0, 1, 2}, {1, 0, 0}};
    const RepairedMesh after = checked(mesh);
    REQUIRE(after.mesh.triangles.size() == 2);
    REQUIRE(after.mesh.corner_texture_coordinates.size() == 2);
    for (std::size_t t = 0; t < 2; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& at_m = after.mesh.vertices_m[after.mesh.triangles[t][k]];
            const glm::vec2& uv = after.mesh.texture_coordinates[after.mesh.corner_texture_coordinates[t][k]];
            CHECK(uv.x == Approx(at_m.x / 4.0));
            CHECK(uv.y == Approx(at_m.y / 3.0));
        }
    }
}

TEST_CASE("of two directions the one that fewer triangles have is turned, with its normals") {
    TriangleMesh mesh = coloured_cube();
    std::swap(mesh.triangles[0][1], mesh.triangles[0][2]); // its normals still point outwards
    std::swap(mesh.triangles[5][1], mesh.triangles[5][2]);
    mesh.normals.push_back({0.0F, 1.0F, 0.0F});
    mesh.corner_normals[5] = {6, 6, 6}; // these point inwards as the triangle does
    const RepairedMesh after = checked(mesh);
    CHECK(after.counts == RepairCounts{.flipped_triangles = 2, .shells = 1});
    CHECK(after.mesh.triangles == cube().triangles);
    CHECK(volume_m3(after.mesh) == Approx(1.0));
    CHECK(after.mesh.corner_normals[0] == Triangle{0, 0, 0});
    CHECK(after.mesh.normals[after.mesh.corner_normals[5][1]] == glm::vec3(0.0F, -1.0F, 0.0F));
}

TEST_CASE("a shell that is inside out throughout stays so: it may be a hollow") {
    TriangleMesh mesh = tetrahedron();
    for (Triangle& triangle : mesh.triangles) { std::swap(triangle[1], triangle[2]); }
    const RepairedMesh after = checked(mesh);
    CHECK(after.counts == RepairCounts{.shells = 1});
    CHECK(volume_m3(after.mesh) < 0.0);
}

TEST_CASE("a door that touches its sheet along few edges keeps its own side, a flap is turned") {
    const auto sheet_with_door = [](std::uint32_t hinge_edges) {
        TriangleMesh mesh;
        const auto add_squares = [&](std::uint32_t count, const glm::dvec3& along_m) {
            const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
            for (std::uint32_t i = 0; i <= count; ++i) {
                for (std::uint32_t j = 0; j <= count; ++j) {
                    const double x_m = i; // the door's corners beyond the hinge lie off the sheet
                    const bool is_off = along_m.z != 0.0 && j == 0 && i > hinge_edges;
                    mesh.vertices_m.push_back(
                        glm::dvec3(x_m, is_off ? 0.5 : 0.0, 0.0) + along_m * static_cast<double>(j));
                }
            }
            for (std::uint32_t i = 0; i < count; ++i) {
                for (std::uint32_t j = 0; j < count; ++j) {
                    const std::uint32_t a = first + i * (count + 1) + j;
                    const std::uint32_t b = a + count + 1;
                    mesh.triangles.push_back({a, b, b + 1});
                    mesh.triangles.push_back({a, b + 1, a + 1});
                }
            }
        };
        add_squares(12, {0.0, -1.0, 0.0});
        add_squares(6, {0.0, 0.0, 1.0}); // agrees with the sheet if it is turned
        return mesh;
    };
    const RepairedMesh door = checked(sheet_with_door(2));
    CHECK(door.counts.flipped_triangles == 0);
    CHECK(door.counts.shells == 2);
    CHECK(door.counts.split_edges == 2);
    const RepairedMesh flap = checked(sheet_with_door(6));
    CHECK(flap.counts.flipped_triangles == 72);
    CHECK(flap.counts.shells == 1);
}

TEST_CASE("two tetrahedra that touch in a vertex get one each") {
    TriangleMesh mesh = tetrahedron();
    for (const double side : {-1.0}) {
        mesh.vertices_m.emplace_back(side, 0.0, 0.0);
        mesh.vertices_m.emplace_back(0.0, side, 0.0);
        mesh.vertices_m.emplace_back(0.0, 0.0, side);
    }
    for (const Triangle& triangle : tetrahedron().triangles) {
        Triangle other = triangle;
        for (std::uint32_t& vertex : other) { vertex += vertex == 0 ? 0 : 3; }
        mesh.triangles.push_back(other);
    }
    const RepairedMesh after = checked(mesh);
    CHECK(after.counts == RepairCounts{.split_vertices = 1, .shells = 2});
    CHECK(after.mesh.vertices_m.size() == 8);
    CHECK(after.mesh.vertices_m[7] == glm::dvec3(0.0));
    CHECK(after.mesh.triangles[0] == Triangle{0, 2, 1});
}

TEST_CASE("an edge of three triangles is cut: each has it as a boundary") {
    TriangleMesh mesh;
    mesh.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    const RepairedMesh after = checked(mesh);
    CHECK(after.counts == RepairCounts{.split_edges = 1, .split_vertices = 2, .boundary_loops = 3, .shells = 3});
    CHECK(after.mesh.vertices_m.size() == 9);
}

TEST_CASE("a Moebius band of five triangles is cut once") {
    TriangleMesh band;
    for (int v = 0; v < 5; ++v) { band.vertices_m.emplace_back(std::cos(v), std::sin(2.0 * v), 0.3 * v * v); }
    band.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}};
    const RepairedMesh after = checked(band);
    CHECK(after.counts.split_edges == 1);
    CHECK(after.counts.shells == 1);
    CHECK(after.counts.boundary_loops == 1);
    CHECK(after.mesh.vertices_m.size() == 7);
}

TEST_CASE("nothing comes of nothing") {
    CHECK(checked({}).counts == RepairCounts{});
    TriangleMesh dots;
    dots.vertices_m.resize(3);
    dots.triangles = {{0, 1, 2}};
    const RepairedMesh after = checked(dots);
    CHECK(after.mesh.triangles.empty());
    CHECK(after.counts == RepairCounts{.unreferenced_vertices = 1, .duplicate_vertices = 2, .degenerate_triangles = 1});
}

TEST_CASE("the tests' own manifold check knows a manifold and each way to be none") {
    CHECK(manifold_fault(cube()).empty());
    CHECK(manifold_fault(tetrahedron()).empty());
    TriangleMesh open = tetrahedron();
    open.triangles.pop_back();
    CHECK(manifold_fault(open).empty());
    TriangleMesh turned = tetrahedron();
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    CHECK_THAT(manifold_fault(turned), Catch::Contains("comes twice"));
    TriangleMesh bow_tie;
    bow_tie.vertices_m.resize(5);
    bow_tie.triangles = {{0, 1, 2}, {0, 3, 4}};
    CHECK(manifold_fault(bow_tie) == "vertex 0 has several fans");
    bow_tie.triangles.pop_back();
    CHECK(manifold_fault(bow_tie) == "vertex 3 has no triangle");
}
