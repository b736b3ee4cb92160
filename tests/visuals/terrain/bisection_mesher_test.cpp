#include "tests/visuals/terrain/ground_check.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;
using octant::models::heights::HeightField;

namespace {

constexpr std::array<FieldSize, 12> sizes = {{{2, 2}, {3, 3}, {17, 17}, {33, 33}, {37, 53}, {53, 37}, {20, 6}, {5, 41},
    {65, 65}, {40, 64}, {129, 129}, {150, 100}}};

} // namespace

TEST_CASE("level ground is four triangles, a bump refines the mesh around itself") {
    ErrorGround level(level_field(33, 33));
    MeshView view;
    view.eye_m = {0.0, 0.0, 10.0};
    const GroundMesh coarse = level.mesher.mesh(view, {0.0, unlimited_triangles, true});
    CHECK(coarse.counters.triangles == 4);
    CHECK(coarse.counters.fans == 1);
    CHECK(coarse.vertices.size() == 5);
    ErrorGround bump(bump_field(33, 13, 21, 2.0F));
    CHECK(bump.mesher.mesh(view, {400.0, unlimited_triangles, true}).counters.triangles == 4);
    const GroundMesh near = bump.mesher.mesh(view, {1.0, unlimited_triangles, false});
    CHECK(near.counters.triangles > 30);
    CHECK(near.counters.triangles < 100);
    CHECK(std::any_of(near.vertices.begin(), near.vertices.end(),
        [](const auto& vertex) { return std::abs(vertex.position_m.z + 8.0F) < 1e-3F; }));
}

TEST_CASE("without any error allowed, all samples beside straight lines are vertices") {
    Numbers numbers(3);
    ErrorGround ground(rough_field(65, 40, 7));
    const MeshView view = everywhere_from(any_view(numbers, ground.field));
    const GroundMesh mesh = ground.mesher.mesh(view, {0.0, unlimited_triangles, true});
    CHECK(mesh.error_px == 0.0);
    const auto heights_m = drawn_heights_m(mesh, ground.field, {0.0, 0.0, view.eye_m.z});
    const double radius_m = view.earth_radius_m;
    double worst_m = 0.0;
    for (std::size_t k = 0; k < heights_m.size(); ++k) {
        const glm::dvec3 sample_m = ground.field.sample_m(static_cast<int>(k % 65), static_cast<int>(k / 65));
        const glm::dvec2 off_m(sample_m - view.eye_m);
        const double drop_m = radius_m > 0.0 ? 0.5 * glm::dot(off_m, off_m) / radius_m : 0.0;
        worst_m = std::max(worst_m, std::abs(heights_m[k] + drop_m - sample_m.z));
    }
    CHECK(worst_m < 1e-3);
}

TEST_CASE("no sample is seen farther from the mesh than the error asked for") {
    double worst = 0.0;
    for (std::uint64_t seed = 1; seed <= 130; ++seed) {
        Numbers numbers(seed);
        const FieldSize& size = sizes[seed % sizes.size()];
        ErrorGround ground(any_field(size, numbers));
        const MeshView view = everywhere_from(any_view(numbers, ground.field));
        const double error_px = any_error_px(numbers);
        const GroundMesh mesh = ground.mesher.mesh(view, {error_px, unlimited_triangles, false});
        const auto heights_m = drawn_heights_m(mesh, ground.field, {0.0, 0.0, view.eye_m.z});
        const double curvature = view.earth_radius_m > 0.0 ? 0.5 / view.earth_radius_m : 0.0;
        for (std::size_t k = 0; k < heights_m.size(); ++k) {
            const auto columns = static_cast<std::size_t>(size.columns);
            const glm::dvec3 off_m =
                ground.field.sample_m(static_cast<int>(k % columns), static_cast<int>(k / columns)) - view.eye_m;
            const double drop_m = curvature * glm::dot(glm::dvec2(off_m), glm::dvec2(off_m));
            const double error_m = std::abs(heights_m[k] - (off_m.z + view.eye_m.z - drop_m));
            const double distance_m = std::max(glm::length(off_m), 1.0);
            worst = std::max(worst, (error_m - 1e-4) / distance_m * view.focal_px / error_px);
        }
        INFO("seed " << seed);
        REQUIRE(worst <= 1.0);
    }
    CHECK(worst > 0.5);
}

TEST_CASE("the steps counted by error are those of the meshes, for all grounds and views") {
    constexpr int ample = 1'000'000; // with a budget, vertices have a larger morph margin than without
    int within = 0;
    int spent = 0;
    for (std::uint64_t seed = 1; seed <= 80; ++seed) {
        Numbers numbers(seed);
        const int columns = 20 + static_cast<int>(numbers.next() % 110);
        const int rows = 20 + static_cast<int>(numbers.next() % 110);
        ErrorGround ground(any_field({columns, rows}, numbers));
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
    CHECK(within > 1000);
    CHECK(spent > 200);
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
