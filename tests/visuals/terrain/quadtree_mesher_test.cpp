#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <utility>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;
using octant::models::ColourVertex;
using octant::models::heights::HeightField;

namespace {

MeshView from(double x_m, double y_m, double z_m) {
    MeshView view;
    view.eye_m = glm::dvec3(x_m, y_m, z_m);
    return view;
}

constexpr QuadtreeDetail coarsest{2.0, 5.0, FanKind::Partial};

/// Level of the fan that covers the cell north-east of a sample; -1 where none does.
std::vector<int> levels_of_cells(const Ground& ground) {
    const int columns = ground.field.columns() - 1;
    const int rows = ground.field.rows() - 1;
    std::vector<int> levels(static_cast<std::size_t>(columns * rows), -1);
    for (const GroundFan& fan : ground.mesher.fans()) {
        const int half = ground.tree.edge_samples(fan.level) / 2;
        for (int q = 0; q < 4; ++q) {
            if (((fan.split | fan.hidden) >> q & 1) != 0) { continue; }
            const int west = (2 * fan.column + q % 2) * half;
            const int south = (2 * fan.row + q / 2) * half;
            for (int row = south; row < std::min(south + half, rows); ++row) {
                for (int column = west; column < std::min(west + half, columns); ++column) {
                    levels[static_cast<std::size_t>(row * columns + column)] = fan.level;
                }
            }
        }
    }
    return levels;
}

} // namespace

TEST_CASE("two by two samples are two triangles") {
    Ground ground(level_field(2, 2));
    const GroundMesh mesh = ground.mesher.mesh(from(0.0, 0.0, 1.0), coarsest);
    CHECK(mesh.counters.triangles == 2);
    CHECK(mesh.vertices.size() == 4);
    CHECK(ground_triangles_conform(sample_triangles(mesh, ground.field, {0.0, 0.0, 1.0}), ground.field));
}

TEST_CASE("level ground far below is one fan with the middles of the field's sides") {
    Ground ground(level_field(17, 17));
    const GroundMesh mesh = ground.mesher.mesh(from(0.0, 0.0, 1000.0), coarsest);
    CHECK(mesh.counters.fans == 1);
    CHECK(mesh.counters.triangles == 8);
    CHECK(mesh.vertices.size() == 9);
}

TEST_CASE("a child splits when its centre is nearer than C times its edge") {
    Ground ground(level_field(5, 5)); // children with an edge of 2 m split within 4 m
    SECTION("all four seen from the middle") {
        const GroundMesh mesh = ground.mesher.mesh(from(0.0, 0.0, 1.0), coarsest);
        CHECK(mesh.counters.fans == 4);
        CHECK(mesh.counters.triangles == 32);
        CHECK(mesh.vertices.size() == 25);
    }
    SECTION("three seen from a corner: the far one is 4.24 m away") {
        const GroundMesh mesh = ground.mesher.mesh(from(-2.0, -2.0, 0.0), coarsest);
        CHECK(mesh.counters.fans == 4);
        CHECK(mesh.counters.triangles == 8 + 7 + 7 + 2);
        CHECK(mesh.vertices.size() == 20);
        REQUIRE(ground.mesher.fans().size() == 4);
        CHECK(ground.mesher.fans()[0].split == 7);
    }
    SECTION("full fans: all or nothing by the root's own distance") {
        QuadtreeDetail detail = coarsest;
        detail.fans = FanKind::Full; // the root splits within 8 m of its centre
        CHECK(ground.mesher.mesh(from(-2.0, -2.0, 7.0), detail).counters.triangles == 32);
        CHECK(ground.mesher.mesh(from(-2.0, -2.0, 8.0), detail).counters.triangles == 8);
    }
}

TEST_CASE("height above ground counts as distance, not height above datum") {
    std::vector<float> heights(25, 500.0F);
    Ground ground(HeightField(5, 5, 1.0, heights));
    CHECK(ground.mesher.mesh(from(0.0, 0.0, 501.0), coarsest).counters.triangles == 32);
    CHECK(ground.mesher.mesh(from(0.0, 0.0, 550.0), coarsest).counters.triangles == 8);
}

TEST_CASE("one bump refines the mesh around itself") {
    Ground ground(bump_field(65, 13, 45, 8.0F));
    const MeshView view = from(0.0, 0.0, 200.0);
    const GroundMesh mesh = ground.mesher.mesh(view, {2.0, 50.0, FanKind::Partial});
    CHECK(ground_triangles_conform(sample_triangles(mesh, ground.field, view.eye_m), ground.field));
    const std::vector<int> levels = levels_of_cells(ground);
    CHECK(levels[45 * 64 + 13] == 5); // the last
    CHECK(levels[5 * 64 + 60] <= 2);
    QuadtreeDetail ignored = {2.0, 0.0, FanKind::Partial};
    CHECK(ground.mesher.mesh(view, ignored).counters.triangles == 8);
}

TEST_CASE("neighbouring fans differ by one level at most") {
    Numbers numbers(11);
    int steps_seen = 0;
    for (int run = 0; run < 100; ++run) {
        const QuadtreeOptions options{
            numbers.coin() ? Roughness::Printed : Roughness::Midpoint, RoughnessPropagation::CrackFree, 2.0};
        Ground ground(rough_field(64, 41, numbers.next()), options);
        const MeshView view =
            from(numbers.between(-40.0, 40.0), numbers.between(-30.0, 30.0), numbers.between(0.0, 60.0));
        ground.mesher.mesh(view,
            {numbers.between(2.0, 8.0), numbers.between(0.0, 5.0), numbers.coin() ? FanKind::Partial : FanKind::Full});
        const std::vector<int> levels = levels_of_cells(ground);
        REQUIRE(*std::min_element(levels.begin(), levels.end()) >= 0);
        for (std::size_t cell = 0; cell < levels.size(); ++cell) {
            const bool last_column = cell % 63 == 62;
            const int east = last_column ? 0 : levels[cell + 1] - levels[cell];
            const int north = cell + 63 < levels.size() ? levels[cell + 63] - levels[cell] : 0;
            steps_seen += std::max(std::abs(east), std::abs(north));
            if (std::max(std::abs(east), std::abs(north)) > 1) { FAIL("run " << run << ", cell " << cell); }
        }
    }
    CHECK(steps_seen > 1000);
}

TEST_CASE("vertices are the samples with the eye subtracted, each once, in their colours") {
    Ground ground(rough_field(20, 13, 3));
    const MeshView view = from(3.25, -100.5, 7.0);
    const GroundMesh mesh = ground.mesher.mesh(view, {1000.0, 0.0, FanKind::Partial});
    REQUIRE(mesh.vertices.size() == 20 * 13);
    CHECK(mesh.counters.triangles == 2 * 19 * 12);
    std::vector<bool> seen(20 * 13, false);
    for (const ColourVertex& vertex : mesh.vertices) {
        const std::uint32_t sample = (vertex.colour - 3U) / 7U;
        const glm::dvec3 world = ground.field.sample_m(static_cast<int>(sample % 20), static_cast<int>(sample / 20));
        CHECK(vertex.position_m == glm::vec3(world - view.eye_m));
        CHECK_FALSE(seen[sample]);
        seen[sample] = true;
    }
}

TEST_CASE("a lens that magnifies twice refines like twice the resolution") {
    Ground ground(rough_field(65, 65, 8));
    MeshView view = from(10.0, 10.0, 30.0);
    const int plain = ground.mesher.mesh(view, {8.0, 3.0, FanKind::Partial}).counters.triangles;
    view.magnification = 2.0;
    CHECK(ground.mesher.mesh(view, {4.0, 3.0, FanKind::Partial}).counters.triangles == plain);
    CHECK(ground.mesher.mesh(view, {8.0, 3.0, FanKind::Partial}).counters.triangles > plain);
}

TEST_CASE("a mesher used before makes the same mesh as a new one") {
    Ground used(rough_field(50, 33, 5));
    Numbers numbers(17);
    for (int frame = 0; frame < 30; ++frame) {
        const glm::dvec3 eye(numbers.between(-30.0, 30.0), numbers.between(-20.0, 20.0), numbers.between(0.0, 40.0));
        const MeshView view = camera_view(eye, numbers.between(0.0, 6.3), -0.4, 1.0);
        const QuadtreeDetail detail{
            numbers.between(2.0, 10.0), numbers.between(0.0, 5.0), numbers.coin() ? FanKind::Partial : FanKind::Full};
        QuadtreeMesher fresh(used.tree, used.colours);
        const GroundMesh expected = fresh.mesh(view, detail);
        const GroundMesh got = used.mesher.mesh(view, detail);
        REQUIRE(std::equal(got.indices.begin(), got.indices.end(), expected.indices.begin(), expected.indices.end()));
        REQUIRE(got.vertices.size() == expected.vertices.size());
        REQUIRE(std::memcmp(got.vertices.data(), expected.vertices.data(), got.vertices.size_bytes()) == 0);
    }
}

TEST_CASE("a mesh is counted as it is then made, at a given resolution and within a budget") {
    for (const auto& [columns, rows] : {std::pair(129, 129), std::pair(100, 71)}) {
        Ground ground(rough_field(columns, rows, 6));
        Ground made(rough_field(columns, rows, 6));
        const auto check_counted = [&](const CountedMesh& counted, const GroundMesh& expected) {
            CHECK(counted.counters.triangles == static_cast<int>(expected.indices.size() / 3));
            CHECK(counted.counters.fans == expected.counters.fans);
            CHECK(counted.counters.nodes_visited == expected.counters.nodes_visited);
            CHECK(counted.resolution == expected.resolution);
            const GroundMesh after = ground.mesher.counted_mesh();
            CHECK(after.counters.triangles == expected.counters.triangles);
            CHECK(after.counters.fans == expected.counters.fans);
            CHECK(std::ranges::equal(after.indices, expected.indices));
        };
        for (int k = 0; k < 12; ++k) {
            const MeshView view = camera_view({20.0 * k - 110.0, 9.0 * k - 70.0, 15.0}, 0.6 * k, -0.2, 0.9);
            const QuadtreeDetail detail{4.0 + 3.0 * k, 3.0, FanKind::Partial};
            check_counted(ground.mesher.count(view, detail), made.mesher.mesh(view, detail));
            const TriangleBudget budget{200 + 300 * k, 1000.0};
            check_counted(
                ground.mesher.count_within(view, detail, budget), made.mesher.mesh_within(view, detail, budget));
        }
    }
}

TEST_CASE("a settled resolution meets the triangle target at once") {
    Ground ground(rough_field(129, 129, 6));
    const MeshView view = camera_view({-50.0, -50.0, 15.0}, 0.8, -0.2, 0.9);
    const QuadtreeDetail detail{0.0, 3.0, FanKind::Partial};
    for (const double target : {1500.0, 3000.0, 6000.0}) {
        QuadtreeDetail settled = detail;
        settled.resolution = resolution_for_target(ground.mesher, view, detail, target, 1000.0);
        const GroundMesh mesh = ground.mesher.mesh(view, settled);
        CHECK(mesh.counters.triangles == Approx(target).epsilon(0.01));
    }
    CHECK(resolution_for_target(ground.mesher, view, detail, 1.0, 1000.0) == 2.0);
    CHECK(resolution_for_target(ground.mesher, view, detail, 1e6, 1000.0) == 1000.0);
}

TEST_CASE("the check of painting orders finds two triangles the wrong way round") {
    Ground ground(rough_field(33, 33, 4));
    MeshView view;
    view.eye_m = {3.3, -40.0, 10.0};
    const GroundMesh mesh = ground.mesher.mesh(view, {3.0, 2.0, FanKind::Partial});
    auto triangles = sample_triangles(mesh, ground.field, view.eye_m);
    REQUIRE(wrongly_ordered_rays(triangles, ground.field, view.eye_m) == 0);
    std::swap(triangles.front(), triangles.back());
    CHECK(wrongly_ordered_rays(triangles, ground.field, view.eye_m) > 0);
}

TEST_CASE("eight triangles around a centre come from opposite the eye round to it") {
    Ground ground(level_field(3, 3));
    MeshView view;
    view.eye_m = {-2.0, -5.0, 1.0}; // sees the half of the south side that is in the west
    const GroundMesh mesh = ground.mesher.mesh(view, {2.0, 1.0, FanKind::Partial});
    REQUIRE(mesh.counters.triangles == 8);
    const auto triangles = sample_triangles(mesh, ground.field, view.eye_m);
    CHECK(triangles.front() == SampleTriangle{4, 8, 7}); // centre, north-east, north
    CHECK(triangles.back() == SampleTriangle{0, 1, 4});  // south-west, south, centre
}
