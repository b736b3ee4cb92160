#include "tests/visuals/terrain/both_meshes.h"
#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;
using octant::models::heights::HeightField;

namespace {

HeightField random_field(const FieldSize& size, Numbers& numbers) {
    switch (numbers.next() % 4) {
    case 0:
        return level_field(size.columns, size.rows);
    case 1:
        return spiky_field(size.columns, size.rows, numbers.next());
    default:
        return rough_field(size.columns, size.rows, numbers.next());
    }
}

/// Beside random places, those where an eye stands on lines between parts of nodes.
glm::dvec3 random_eye(Numbers& numbers, const HeightField& field) {
    const glm::dvec2 reach = field.half_extent_m() * 1.5;
    const glm::dvec3 anywhere(
        numbers.between(-reach.x, reach.x), numbers.between(-reach.y, reach.y), numbers.between(-20.0, 60.0));
    const int column = static_cast<int>(numbers.next() % static_cast<unsigned>(field.columns()));
    const int row = static_cast<int>(numbers.next() % static_cast<unsigned>(field.rows()));
    const glm::dvec3 sample = field.sample_m(column, row);
    switch (numbers.next() % 6) {
    case 0: // on a sample
        return {sample.x, sample.y, anywhere.z};
    case 1: // on a column's line, inside or beyond the field
        return {sample.x, anywhere.y, anywhere.z};
    case 2:
        return {anywhere.x, sample.y, anywhere.z};
    case 3: { // on a diagonal through a sample
        const double off = numbers.between(-reach.x, reach.x);
        return {sample.x + off, sample.y + (numbers.coin() ? off : -off), sample.z};
    }
    default:
        return anywhere;
    }
}

QuadtreeDetail random_detail(Numbers& numbers) {
    return {numbers.between(2.0, 6.0), numbers.between(0.0, 5.0), numbers.coin() ? FanKind::Partial : FanKind::Full};
}

MeshView random_look(Numbers& numbers, const HeightField& field) {
    MeshView view;
    view.eye_m = random_eye(numbers, field);
    if (numbers.coin()) {
        view =
            camera_view(view.eye_m, numbers.between(0.0, 6.28), numbers.between(-1.2, 0.4), numbers.between(0.3, 1.6));
    }
    return view;
}

GroundMesh random_mesh(QuadtreeMesher& mesher, const MeshView& view, Numbers& numbers) {
    const QuadtreeDetail detail = random_detail(numbers);
    const TriangleBudget budget{10 + static_cast<int>(numbers.next() % 500), 50.0};
    return numbers.coin() ? mesher.mesh(view, detail) : mesher.mesh_within(view, detail, budget);
}

constexpr std::array<FieldSize, 10> sizes = {
    {{2, 2}, {3, 3}, {17, 17}, {33, 33}, {37, 53}, {53, 37}, {20, 6}, {5, 41}, {34, 18}, {40, 64}}};

} // namespace

TEST_CASE("no triangle hides one drawn after it, from any eye, on fields of any size") {
    long triangles_seen = 0;
    int rugged = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        Numbers numbers(seed);
        Ground ground(random_field(sizes[seed % sizes.size()], numbers), random_options(numbers));
        for (int look = 0; look < 4; ++look) {
            const MeshView view = random_look(numbers, ground.field);
            const GroundMesh mesh = random_mesh(ground.mesher, view, numbers);
            const auto triangles = sample_triangles(mesh, ground.field, view.eye_m);
            INFO("seed " << seed << ", look " << look << ", " << triangles.size() << " triangles");
            REQUIRE(wrongly_ordered_rays(triangles, ground.field, view.eye_m) == 0);
            triangles_seen += mesh.counters.triangles;
            rugged += mesh.counters.fans > 5 ? 1 : 0;
        }
    }
    CHECK(triangles_seen > 100000);
    CHECK(rugged > 500);
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

TEST_CASE("front to back is exactly the reverse of back to front") {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Numbers numbers(seed);
        Ground ground(random_field(sizes[seed % sizes.size()], numbers), random_options(numbers));
        MeshView view = random_look(numbers, ground.field);
        const QuadtreeDetail detail = random_detail(numbers);
        auto painted = sample_triangles(ground.mesher.mesh(view, detail), ground.field, view.eye_m);
        view.order = PaintOrder::FrontToBack;
        const GroundMesh mesh = ground.mesher.mesh(view, detail);
        const auto reverse = sample_triangles(mesh, ground.field, view.eye_m);
        std::reverse(painted.begin(), painted.end());
        INFO("seed " << seed);
        REQUIRE(reverse == painted);
        REQUIRE(mesh.counters.triangles == static_cast<int>(painted.size()));
        std::sort(painted.begin(), painted.end());
        REQUIRE(std::adjacent_find(painted.begin(), painted.end()) == painted.end());
    }
}

TEST_CASE("the triangles in a box are found in drawing order, few others with them") {
    long found_count = 0;
    long wanted_count = 0;
    long triangle_count = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Numbers numbers(seed);
        Ground ground(random_field(sizes[seed % sizes.size()], numbers), random_options(numbers));
        MeshView view = random_look(numbers, ground.field);
        view.order = numbers.coin() ? PaintOrder::BackToFront : PaintOrder::FrontToBack;
        const GroundMesh mesh = random_mesh(ground.mesher, view, numbers);
        const SearchBox box{random_eye(numbers, ground.field),
            {numbers.between(0.5, 8.0), numbers.between(0.5, 8.0), numbers.between(1.0, 30.0)}};
        const auto meets = [&](const glm::dvec3& min_m, const glm::dvec3& max_m) { return box.meets(min_m, max_m); };
        std::vector<std::uint32_t> found = {7};
        ground.mesher.triangles_in(meets, found);
        REQUIRE(found.front() == 7);
        found.erase(found.begin());
        INFO("seed " << seed);
        wanted_count += checked_count_in(box, mesh, view.eye_m, found);
        found_count += static_cast<long>(found.size());
        triangle_count += mesh.counters.triangles;
    }
    CHECK(wanted_count > 1000);
    CHECK(found_count < triangle_count / 2);
}

TEST_CASE("all triangles are in all boxes, none in none, and none before the first mesh") {
    Ground ground(rough_field(37, 53, 9));
    const auto everywhere = [](const glm::dvec3&, const glm::dvec3&) { return true; };
    std::vector<std::uint32_t> found;
    ground.mesher.triangles_in(everywhere, found);
    CHECK(found.empty());
    MeshView view;
    view.eye_m = {4.0, 4.0, 10.0};
    const GroundMesh mesh = ground.mesher.mesh(view, {4.0, 2.0, FanKind::Partial});
    int asked = 0;
    ground.mesher.triangles_in(
        [&](const glm::dvec3&, const glm::dvec3&) {
            ++asked;
            return false;
        },
        found);
    CHECK(found.empty());
    CHECK(asked == 1); // the root's box stands for all
    ground.mesher.triangles_in(everywhere, found);
    REQUIRE(found.size() == mesh.indices.size() / 3);
    for (std::size_t k = 0; k < found.size(); ++k) { REQUIRE(found[k] == k); }
}
