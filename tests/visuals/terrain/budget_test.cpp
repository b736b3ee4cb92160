#include "models/heights/height_source.h"
#include "tests/real_files.h"
#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

namespace {

/// Ground as of a real map, flown over low; steps of N are small against 3000 triangles.
Ground wide_ground() { return Ground(rough_field(257, 257, 6)); }

constexpr TriangleBudget wide_budget{3000, 500.0};

} // namespace

TEST_CASE("a budget is kept by hand's count on four quadrants") {
    // Children with an edge of 2 m, their centres 1.41 (once), 3.16 (twice) and 4.24 m from the corner: 0.5, 1.6 and
    // 2.1 edges. C = 2 has 24 triangles in 4 fans, C above 2.12 has 32.
    Ground ground(level_field(5, 5));
    MeshView view;
    view.eye_m = {-2.0, -2.0, 0.0};
    const QuadtreeDetail detail{0.0, 5.0, FanKind::Partial};
    CHECK(ground.mesher.mesh_within(view, detail, {24, 500.0}).counters.triangles == 24);
    const GroundMesh short_of_32 = ground.mesher.mesh_within(view, detail, {31, 500.0});
    CHECK(short_of_32.counters.triangles == 24);
    CHECK(short_of_32.resolution == Approx(std::sqrt(4.5)));
    const GroundMesh all = ground.mesher.mesh_within(view, detail, {32, 500.0});
    CHECK(all.counters.triangles == 32);
    CHECK(all.resolution == 500.0);
    SECTION("nothing is coarser than the smallest C") {
        const GroundMesh over = ground.mesher.mesh_within(view, detail, {10, 500.0});
        CHECK(over.counters.triangles == 24);
        CHECK(over.resolution == 2.0);
    }
    SECTION("nothing is finer than the largest C") {
        const GroundMesh under = ground.mesher.mesh_within(view, detail, {1000, 2.1});
        CHECK(under.counters.triangles == 24);
        CHECK(under.resolution == Approx(2.1));
    }
    SECTION("full fans come all at once, within 4 m times C of the root's centre") {
        const QuadtreeDetail full{0.0, 5.0, FanKind::Full};
        view.eye_m = {-2.0, -2.0, 16.0};
        CHECK(ground.mesher.mesh_within(view, full, {31, 500.0}).counters.triangles == 8);
        CHECK(ground.mesher.mesh_within(view, full, {32, 500.0}).counters.triangles == 32);
    }
}

TEST_CASE("the counted steps are those of the meshes, for all grounds, views and fans") {
    int within = 0;
    int spent = 0;
    for (std::uint64_t seed = 1; seed <= 80; ++seed) {
        Numbers numbers(seed);
        const int columns = 20 + static_cast<int>(numbers.next() % 110);
        const int rows = 20 + static_cast<int>(numbers.next() % 110);
        Ground ground(numbers.coin() ? rough_field(columns, rows, seed) : spiky_field(columns, rows, seed),
            random_options(numbers));
        QuadtreeMesher plain(ground.tree, ground.colours);
        for (int k = 0; k < 20; ++k) {
            const MeshView view = random_view(numbers, ground.field);
            QuadtreeDetail detail{0.0, numbers.between(0.0, 10.0), numbers.coin() ? FanKind::Partial : FanKind::Full};
            const TriangleBudget budget{10 + static_cast<int>(numbers.next() % 1500), numbers.coin() ? 500.0 : 20.0};
            const MeshCopy got(ground.mesher.mesh_within(view, detail, budget));
            detail.resolution = got.resolution;
            INFO("seed " << seed << ", case " << k);
            REQUIRE(got == MeshCopy(plain.mesh(view, detail)));
            const bool coarsest = got.resolution <= 1.000001 * ground.tree.options().min_resolution;
            REQUIRE((got.triangles <= budget.triangles || coarsest));
            within += coarsest ? 0 : 1;
            if (got.resolution < 0.999 * budget.max_resolution && got.triangles <= budget.triangles) {
                detail.resolution *= 1.0 + 2e-7; // beyond the next step, which is too high
                REQUIRE(plain.mesh(view, detail).counters.triangles > budget.triangles);
                ++spent;
            }
        }
    }
    CHECK(within > 800);
    CHECK(spent > 200);
}

TEST_CASE("a larger budget never coarsens the mesh") {
    Ground ground = wide_ground();
    const QuadtreeDetail detail{0.0, 20.0, FanKind::Partial};
    MeshCopy last(ground.mesher.mesh_within(circling(7), detail, {100, 500.0}));
    for (int triangles = 150; triangles < 200000; triangles += triangles / 7) {
        const MeshCopy mesh(ground.mesher.mesh_within(circling(7), detail, {triangles, 500.0}));
        CHECK(mesh.resolution >= last.resolution);
        CHECK(mesh.triangles >= last.triangles);
        last = mesh;
    }
    CHECK(last.resolution == 500.0);
}

TEST_CASE("a lens that magnifies spends the same budget at a smaller C") {
    Ground ground = wide_ground();
    const QuadtreeDetail detail{0.0, 20.0, FanKind::Partial};
    MeshView view = circling(3);
    const MeshCopy plain(ground.mesher.mesh_within(view, detail, wide_budget));
    view.magnification = 2.0;
    const GroundMesh magnified = ground.mesher.mesh_within(view, detail, wide_budget);
    CHECK(magnified.counters.triangles == plain.triangles);
    CHECK(magnified.resolution == Approx(plain.resolution / 2.0));
}

TEST_CASE("over real maps every mesh spends its budget to a tenth of a percent") {
    for (const char* const name : {"gcanyon_1025.tif", "pugetsound_1025.tif"}) {
        const auto file = octant::tests::real_file("terrain/" + std::string(name));
        if (!file) { return; }
        Ground ground(octant::models::heights::read_height_field(*file, {30.0, 1.0}));
        for (const int triangles : {20000, 32000}) {
            double missing = 0.0;
            int min = triangles;
            for (int frame = 0; frame < 40; ++frame) {
                const double angle = frame * 0.025;
                const glm::dvec2 at_m =
                    0.5 * ground.field.half_extent_m() * glm::dvec2(std::cos(angle), std::sin(angle));
                const double ground_m = ground.field.height_at(at_m.x, at_m.y).value_or(0.0);
                const MeshView view = camera_view({at_m.x, at_m.y, ground_m + 200.0}, angle + 1.57, -0.1, 0.785);
                const int got = ground.mesher.mesh_within(view, {0.0, 20.0, FanKind::Partial}, {triangles, 500.0})
                                    .counters.triangles;
                REQUIRE(got <= triangles);
                min = std::min(min, got);
                missing += triangles - got;
            }
            INFO(name);
            CHECK(missing / 40 < 0.0005 * triangles);
            CHECK(min > 0.999 * triangles);
        }
    }
}
