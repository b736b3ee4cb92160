#include "tests/visuals/terrain/error_ground.h"

#include <catch2/catch.hpp>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

TEST_CASE("the steps counted by error are those of the meshes, for all grounds and views") {
    constexpr int ample = 1'000'000; // with a budget, vertices have more room than without
    int within = 0;
    int spent = 0;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        Numbers numbers(seed);
        const int columns = 20 + static_cast<int>(numbers.next() % 110);
        const int rows = 20 + static_cast<int>(numbers.next() % 110);
        ErrorGround ground(any_field(columns, rows, numbers));
        BisectionMesher plain(ground.tiles);
        for (int k = 0; k < 15; ++k) {
            const MeshView view = any_view(numbers, ground.field);
            const ErrorTarget target{
                numbers.coin() ? 0.01 : 2.0, 10 + static_cast<int>(numbers.next() % 1500), numbers.coin()};
            const MeshCopy got(ground.mesher.mesh(view, target));
            INFO("seed " << seed << ", case " << k << ", error " << got.error_px);
            REQUIRE(got.triangles <= target.max_triangles);
            REQUIRE(MeshCopy(plain.mesh(view, {got.error_px, ample, target.geomorphs})) == got);
            ++within;
            if (got.error_px > 1.001 * target.error_px) {
                const double less_px = got.error_px * (1.0 - 2e-7); // beyond the next step
                REQUIRE(plain.mesh(view, {less_px, ample, target.geomorphs}).counters.triangles > target.max_triangles);
                ++spent;
            }
        }
    }
    CHECK(within > 2000);
    CHECK(spent > 400);
}

TEST_CASE("a mesh within a budget by error does not depend on the meshes before") {
    ErrorGround ground(rough_field(257, 257, 6));
    Numbers numbers(5);
    for (int frame = 0; frame < 150; ++frame) {
        const MeshView view = any_view(numbers, ground.field);
        const ErrorTarget target{numbers.coin() ? 0.01 : 3.0, 200 + static_cast<int>(numbers.next() % 20000), true};
        BisectionMesher fresh(ground.tiles);
        const MeshCopy expected(fresh.mesh(view, target));
        REQUIRE(MeshCopy(ground.mesher.mesh(view, target)) == expected);
        REQUIRE(MeshCopy(ground.mesher.mesh(view, target)) == expected);
    }
}

TEST_CASE("along a path every mesh by error spends its budget to a few triangles") {
    ErrorGround ground(rough_field(257, 257, 6));
    double missing = 0.0;
    for (int frame = 0; frame < 300; ++frame) {
        const GroundMesh mesh = ground.mesher.mesh(circling(frame), {0.01, 3000, true});
        REQUIRE(mesh.counters.triangles <= 3000);
        REQUIRE(mesh.counters.triangles >= 2970);
        missing += 3000 - mesh.counters.triangles;
    }
    CHECK(missing / 300 < 0.002 * 3000);
}

TEST_CASE("a view that swings from ground to sky and back spends its error budget at once") {
    ErrorGround ground(rough_field(257, 257, 6));
    for (int swing = 0; swing < 10; ++swing) {
        for (int frame = 0; frame < 3; ++frame) {
            CHECK(ground.mesher.mesh(into_the_sky(), {0.5, 3000, true}).counters.triangles < 20);
        }
        const GroundMesh mesh = ground.mesher.mesh(circling(swing), {0.01, 3000, true});
        REQUIRE(mesh.counters.triangles <= 3000);
        REQUIRE(mesh.counters.triangles >= 2970);
        REQUIRE(mesh.counters.nodes_visited < 60000);
    }
}

TEST_CASE("the smallest error asked for ends the refinement, the root is always there") {
    ErrorGround ground(rough_field(257, 257, 6));
    const GroundMesh coarse = ground.mesher.mesh(circling(1), {8.0, 30000, true});
    CHECK(coarse.error_px == Approx(8.0));
    CHECK(coarse.counters.triangles < 3000);
    MeshView view;
    view.eye_m = {0.0, 0.0, 20.0};
    CHECK(ground.mesher.mesh(view, {1.0, 1, true}).counters.triangles == 4);
}
