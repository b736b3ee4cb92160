#include "tests/visuals/terrain/error_ground.h"

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

MeshView everywhere_from(const MeshView& view) {
    MeshView everywhere = view;
    everywhere.frustum_normals.fill(glm::dvec3(0.0));
    return everywhere;
}

ErrorTarget any_target(Numbers& numbers) {
    return {any_error_px(numbers), numbers.coin() ? any_triangles : 10 + static_cast<int>(numbers.next() % 500),
        numbers.coin()};
}

} // namespace

TEST_CASE("the unculled mesh by screen-space error covers the field once, edge to edge") {
    int mixed = 0;
    int cases = 0;
    for (std::uint64_t seed = 1; seed <= 360; ++seed) {
        Numbers numbers(seed);
        const FieldSize& size = sizes[seed % sizes.size()];
        ErrorGround ground(any_field(size.columns, size.rows, numbers));
        const auto samples = static_cast<std::size_t>(size.columns * size.rows);
        for (int look = 0; look < 4; ++look, ++cases) {
            const MeshView view = everywhere_from(any_view(numbers, ground.field));
            const GroundMesh mesh = ground.mesher.mesh(view, any_target(numbers));
            INFO("seed " << seed << ", look " << look << ", " << mesh.counters.triangles);
            REQUIRE(ground_triangles_conform(origin_triangles(mesh, ground.field, view.eye_m), ground.field));
            mixed += mesh.counters.fans > 1 && mesh.vertices.size() < samples ? 1 : 0;
        }
    }
    CHECK(mixed > cases / 2);
}

TEST_CASE("level ground is four triangles, a bump refines the mesh around itself") {
    ErrorGround level(level_field(33, 33));
    MeshView view;
    view.eye_m = {0.0, 0.0, 10.0};
    const GroundMesh splat4 = level.mesher.mesh(view, {0.0, any_triangles, true});
    CHECK(splat4.counters.triangles == 4);
    CHECK(splat4.counters.fans == 1);
    CHECK(splat4.vertices.size() == 5);
    ErrorGround bump(bump_field(33, 13, 21, 2.0F));
    CHECK(bump.mesher.mesh(view, {400.0, any_triangles, true}).counters.triangles == 4);
    const GroundMesh near = bump.mesher.mesh(view, {1.0, any_triangles, false});
    CHECK(near.counters.triangles > 30);
    CHECK(near.counters.triangles < 100);
    CHECK(std::any_of(near.vertices.begin(), near.vertices.end(),
        [](const auto& vertex) { return std::abs(vertex.position_m.z + 8.0F) < 1e-3F; }));
}

TEST_CASE("without any error allowed, all samples beside straight lines are vertices") {
    Numbers numbers(3);
    ErrorGround ground(rough_field(65, 40, 7));
    const MeshView view = everywhere_from(any_view(numbers, ground.field));
    const GroundMesh mesh = ground.mesher.mesh(view, {0.0, any_triangles, true});
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
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Numbers numbers(seed);
        const FieldSize& size = sizes[seed % sizes.size()];
        ErrorGround ground(any_field(size.columns, size.rows, numbers));
        const MeshView view = everywhere_from(any_view(numbers, ground.field));
        const double error_px = any_error_px(numbers);
        const GroundMesh mesh = ground.mesher.mesh(view, {error_px, any_triangles, false});
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

TEST_CASE("culling a mesh by screen-space error drops only what is not in sight") {
    std::size_t dropped = 0;
    std::size_t kept = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        Numbers numbers(seed);
        const FieldSize& size = sizes[2 + seed % (sizes.size() - 2)];
        ErrorGround ground(any_field(size.columns, size.rows, numbers));
        const MeshView view = any_view(numbers, ground.field);
        const MeshView everywhere = everywhere_from(view);
        const ErrorTarget target{any_error_px(numbers), any_triangles, numbers.next() % 4 != 0};
        auto seen = origin_triangles(ground.mesher.mesh(view, target), ground.field, view.eye_m);
        const GroundMesh whole = ground.mesher.mesh(everywhere, target);
        const auto all = origin_triangles(whole, ground.field, view.eye_m);
        std::sort(seen.begin(), seen.end());
        INFO("seed " << seed);
        std::size_t found = 0;
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (std::binary_search(seen.begin(), seen.end(), all[k])) {
                ++found;
            } else if (reaches_into(corners_of(whole, k), view)) {
                FAIL("a triangle in sight is missing");
            }
        }
        REQUIRE(found == seen.size());
        dropped += all.size() - found;
        kept += found;
    }
    CHECK(dropped > kept);
}

TEST_CASE("no triangle of a mesh by screen-space error hides one drawn after it") {
    long triangles_seen = 0;
    for (std::uint64_t seed = 1; seed <= 250; ++seed) {
        Numbers numbers(seed);
        const FieldSize& size = sizes[seed % 10];
        ErrorGround ground(any_field(size.columns, size.rows, numbers));
        MeshView view = any_view(numbers, ground.field);
        if (numbers.coin()) { // on a sample, where lines between parts of nodes meet
            const glm::dvec3 sample_m = ground.field.sample_m(size.columns / 2, size.rows / 3);
            view.eye_m = {sample_m.x, sample_m.y, view.eye_m.z};
        }
        const ErrorTarget target = any_target(numbers);
        const GroundMesh mesh = ground.mesher.mesh(view, target);
        auto painted = origin_triangles(mesh, ground.field, view.eye_m);
        INFO("seed " << seed << ", " << painted.size() << " triangles");
        REQUIRE(wrongly_ordered_rays(painted, ground.field, view.eye_m) == 0);
        triangles_seen += mesh.counters.triangles;
        view.order = PaintOrder::FrontToBack;
        std::reverse(painted.begin(), painted.end());
        REQUIRE(origin_triangles(ground.mesher.mesh(view, target), ground.field, view.eye_m) == painted);
    }
    CHECK(triangles_seen > 20000);
}

TEST_CASE("the triangles of a mesh by screen-space error in a box are found in drawing order") {
    long found_count = 0;
    long wanted_count = 0;
    long triangle_count = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Numbers numbers(seed);
        const FieldSize& size = sizes[seed % sizes.size()];
        ErrorGround ground(any_field(size.columns, size.rows, numbers));
        const MeshView view = any_view(numbers, ground.field);
        const GroundMesh mesh = ground.mesher.mesh(view, any_target(numbers));
        const glm::dvec2 reach = ground.field.half_extent_m();
        const SearchBox box{
            {numbers.between(-reach.x, reach.x), numbers.between(-reach.y, reach.y), numbers.between(-10.0, 10.0)},
            {numbers.between(0.5, 8.0), numbers.between(0.5, 8.0), numbers.between(1.0, 20.0)}};
        const auto meets = [&](const glm::dvec3& min_m, const glm::dvec3& max_m) { return box.meets(min_m, max_m); };
        std::vector<std::uint32_t> found;
        ground.mesher.triangles_in(meets, found);
        INFO("seed " << seed);
        wanted_count += checked_count_in(box, mesh, view.eye_m, found);
        found_count += static_cast<long>(found.size());
        triangle_count += mesh.counters.triangles;
    }
    CHECK(wanted_count > 1000);
    CHECK(found_count < triangle_count / 2);
}

TEST_CASE("no triangles are in boxes before the first mesh, none in none, all in all") {
    ErrorGround ground(rough_field(37, 53, 9));
    const auto everywhere = [](const glm::dvec3&, const glm::dvec3&) { return true; };
    std::vector<std::uint32_t> found;
    ground.mesher.triangles_in(everywhere, found);
    CHECK(found.empty());
    MeshView view;
    view.eye_m = {4.0, 4.0, 10.0};
    const GroundMesh mesh = ground.mesher.mesh(view, {5.0, any_triangles, true});
    ground.mesher.triangles_in([](const auto&, const auto&) { return false; }, found);
    CHECK(found.empty());
    ground.mesher.triangles_in(everywhere, found);
    REQUIRE(found.size() == mesh.indices.size() / 3);
    CHECK(std::is_sorted(found.begin(), found.end()));
}
