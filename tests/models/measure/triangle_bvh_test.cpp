#include "models/measure/triangle_bvh.h"
#include "sim/base/thread_pool.h"
#include "tests/models/measure/made_meshes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace octant;
using models::TriangleMesh;
using models::measure::nearest_on_triangle;
using models::measure::NearestOnMesh;
using models::measure::TriangleBvh;

namespace {

double distance2_to(const TriangleMesh& mesh, std::size_t triangle, const glm::dvec3& point) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return nearest_on_triangle(point, mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]).distance2;
}

/// The nearest triangle, of the lowest index, by trying all.
std::pair<std::uint32_t, double> by_all(const TriangleMesh& mesh, const glm::dvec3& point) {
    std::pair<std::uint32_t, double> best{0, distance2_to(mesh, 0, point)};
    for (std::size_t i = 1; i < mesh.triangles.size(); ++i) {
        const double distance2 = distance2_to(mesh, i, point);
        if (distance2 < best.second) { best = {static_cast<std::uint32_t>(i), distance2}; }
    }
    return best;
}

void check_against_all(const TriangleMesh& mesh, std::uint64_t seed, double reach_m) {
    const TriangleBvh bvh(mesh);
    tests::Dice dice(seed);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 point = dice.point(-reach_m, reach_m);
        const auto [triangle, distance2] = by_all(mesh, point);
        const NearestOnMesh found = bvh.nearest(point);
        CHECK(found.triangle == triangle);
        CHECK(found.distance2 == distance2);
        CHECK(std::abs(glm::distance(found.point, point) - std::sqrt(distance2)) <= 1e-12 * reach_m);
    }
}

} // namespace

TEST_CASE("a tree without triangles finds nothing") {
    const TriangleBvh bvh{TriangleMesh{}};
    CHECK(bvh.nearest({1.0, 2.0, 3.0}).triangle == NearestOnMesh::none);
}

TEST_CASE("a tree of one triangle finds it from anywhere") {
    TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    const TriangleBvh bvh(mesh);
    CHECK(bvh.nearest({0.25, 0.25, 2.0}).distance2 == 4.0);
    CHECK(bvh.nearest({-1e6, 0.0, 0.0}).triangle == 0);
    CHECK(bvh.nearest({0.25, 0.25, 2.0}).weights == glm::dvec3(0.5, 0.25, 0.25));
}

TEST_CASE("the nearest triangle is the one found by trying all") {
    check_against_all(tests::scattered(1, 5), 21, 2.0);
    check_against_all(tests::scattered(2, 600), 22, 2.0);
    check_against_all(tests::scattered(3, 300, 3.0), 23, 5.0);
    check_against_all(tests::shaken(tests::plate(12), 4, 0.02), 24, 3.0);
    check_against_all(tests::ball(20), 25, 2.0);
}

TEST_CASE("a mesh of any size is looked through in full, from near and far") {
    for (const double size_m : {1e-12, 1e-3, 1e6, 1e15}) {
        TriangleMesh mesh = tests::shaken(tests::ball(12), 5, 0.02);
        for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m *= size_m; }
        check_against_all(mesh, 41, 2.0 * size_m);
        check_against_all(mesh, 42, 1e3 * size_m);
        check_against_all(mesh, 43, 1e7 * size_m); // single precision tells nothing apart
    }
}

TEST_CASE("needles and specks of triangles are found as any other") {
    TriangleMesh mesh = tests::scattered(14, 200, 1.0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        glm::dvec3& end_m = mesh.vertices_m[c];
        if (i % 3 == 0) {
            end_m = 0.3 * mesh.vertices_m[a] + 0.7 * mesh.vertices_m[b] + 1e-9 * end_m;
        } else if (i % 3 == 1) {
            mesh.vertices_m[b] = mesh.vertices_m[a];
            end_m = mesh.vertices_m[a];
        }
    }
    check_against_all(mesh, 44, 1.5);
}

TEST_CASE("short triangles of next to no height are found from far away") {
    tests::Dice dice(51);
    TriangleMesh mesh;
    for (int i = 0; i < 400; ++i) {
        const double edge = std::pow(10.0, -3.0 - 3.0 * (i % 20) / 20.0);
        const double height = std::pow(10.0, -14.0 + 5.0 * (i % 7) / 7.0);
        const glm::dvec3 a = dice.point(-1.0, 1.0);
        const glm::dvec3 along = edge * dice.point(-1.0, 1.0);
        mesh.vertices_m.insert(mesh.vertices_m.end(), {a, a + along, a + 0.3 * along + height * dice.point(-1.0, 1.0)});
        const auto first = static_cast<std::uint32_t>(3 * i);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    check_against_all(mesh, 52, 1.5);
}

TEST_CASE("a tree of a few triangles finds each, and what touches a place at no distance") {
    for (int count = 1; count <= 6; ++count) {
        TriangleMesh mesh = tests::plate(2);
        mesh.triangles.resize(static_cast<std::size_t>(count));
        check_against_all(mesh, 53, 2.0);
        const TriangleBvh bvh(mesh);
        const glm::dvec3 vertex_m = mesh.vertices_m[mesh.triangles.back()[1]];
        CHECK(bvh.nearest(vertex_m, 0.0).distance2 == 0.0);
        int near = 0;
        bvh.for_each_near(vertex_m, std::numeric_limits<double>::infinity(), [&](std::uint32_t) { ++near; });
        CHECK(near == count);
        int touching = 0;
        bvh.for_each_near(vertex_m, 0.0, [&](std::uint32_t) { ++touching; });
        CHECK(touching >= 1);
    }
}

TEST_CASE("of several triangles at the same distance the lowest index is found") {
    TriangleMesh mesh = tests::plate(8);
    const std::size_t once = mesh.triangles.size();
    for (std::size_t i = 0; i < once; ++i) { // the same again, in the opposite order
        mesh.triangles.push_back(mesh.triangles[once - 1 - i]);
    }
    check_against_all(mesh, 31, 1.5);
    const TriangleBvh bvh(mesh);
    for (const glm::dvec3& vertex_m : mesh.vertices_m) { // each belongs to up to 12
        CHECK(bvh.nearest(vertex_m).triangle == by_all(mesh, vertex_m).first);
    }
}

TEST_CASE("a hundred triangles in one place make a tree like any other") {
    TriangleMesh mesh = tests::plate(1);
    mesh.triangles.assign(100, models::Triangle{0, 1, 3});
    mesh.triangles[70] = {0, 3, 2};
    const TriangleBvh bvh(mesh);
    CHECK(bvh.nearest({0.9, 0.1, 1.0}).triangle == 0);
    CHECK(bvh.nearest({0.1, 0.9, 1.0}).triangle == 70);
}

TEST_CASE("a mesh far from the origin is measured as well as one at it") {
    TriangleMesh mesh = tests::shaken(tests::plate(10), 6, 0.02);
    const glm::dvec3 far(4.5e6, -7e5, 3000.0);
    TriangleMesh moved = mesh;
    for (glm::dvec3& vertex_m : moved.vertices_m) { vertex_m += far; }
    const TriangleBvh near_bvh(mesh);
    const TriangleBvh far_bvh(moved);
    tests::Dice dice(8);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 point = dice.point(-0.5, 1.5);
        const double here_m = std::sqrt(near_bvh.nearest(point).distance2);
        const double there_m = std::sqrt(far_bvh.nearest(point + far).distance2);
        CHECK(std::abs(here_m - there_m) < 1e-8);
        CHECK(far_bvh.nearest(point + far).triangle == by_all(moved, point + far).first);
    }
}

TEST_CASE("nothing is found farther away than was asked for") {
    const TriangleMesh mesh = tests::plate(4);
    const TriangleBvh bvh(mesh);
    CHECK(bvh.nearest({0.5, 0.5, 2.0}, 1.99).triangle == NearestOnMesh::none);
    CHECK(bvh.nearest({0.5, 0.5, 2.0}, 2.01).distance2 == 4.0);
}

TEST_CASE("every triangle within reach is among the near ones") {
    const TriangleMesh mesh = tests::scattered(9, 400);
    const TriangleBvh bvh(mesh);
    tests::Dice dice(10);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 point = dice.point(-1.0, 1.0);
        std::vector<std::uint32_t> near;
        bvh.for_each_near(point, 0.3, [&](std::uint32_t triangle) { near.push_back(triangle); });
        std::ranges::sort(near);
        CHECK(std::ranges::adjacent_find(near) == near.end());
        CHECK(near.size() < mesh.triangles.size() / 2);
        for (std::uint32_t j = 0; j < mesh.triangles.size(); ++j) {
            if (distance2_to(mesh, j, point) <= 0.09) { CHECK(std::ranges::binary_search(near, j)); }
        }
    }
}

TEST_CASE("many threads may ask one tree") {
    const TriangleMesh mesh = tests::ball(24);
    const TriangleBvh bvh(mesh);
    tests::Dice dice(12);
    std::vector<glm::dvec3> points(2000);
    std::ranges::generate(points, [&] { return dice.point(-1.5, 1.5); });
    std::vector<NearestOnMesh> found(points.size());
    parallel_for(points.size(), 4, [&](std::size_t i, std::size_t) { found[i] = bvh.nearest(points[i]); });
    for (std::size_t i = 0; i < points.size(); ++i) { CHECK(found[i].triangle == bvh.nearest(points[i]).triangle); }
}
