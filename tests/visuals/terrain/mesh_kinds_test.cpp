// What holds for meshes by resolution (the paper's quadtree) and by screen-space error (bisection) alike.
#include "tests/visuals/terrain/ground_check.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;
using octant::models::heights::HeightField;

namespace {

struct ByResolution {
    struct Target {
        QuadtreeDetail detail;
        std::optional<TriangleBudget> budget;
    };

    /// Culling drops more than this many times what it keeps.
    static constexpr std::size_t min_dropped = 2;

    ByResolution(const HeightField& field, const QuadtreeOptions& options) : ground(field, options) {}

    const HeightField& field() const { return ground.field; }

    MeshView view(Numbers& numbers) const { return random_view(numbers, field()); }

    /// Mostly for coarse meshes, where levels meet.
    static Target target(Numbers& numbers) {
        Target target{{numbers.next() % 4 == 0 ? numbers.between(2.0, 64.0) : numbers.between(2.0, 4.0),
                          5.0 * numbers.between(0.0, 1.0) * numbers.between(0.0, 1.0),
                          numbers.coin() ? FanKind::Partial : FanKind::Full},
            {}};
        if (numbers.coin()) { target.budget = {10 + static_cast<int>(numbers.next() % 500), 50.0}; }
        return target;
    }

    static Target without_budget(Numbers& numbers) { return {target(numbers).detail, {}}; }

    static Target within(int triangles) { return {{0.0, 20.0, FanKind::Partial}, TriangleBudget{triangles, 500.0}}; }

    static GroundMesh made_by(QuadtreeMesher& mesher, const MeshView& view, const Target& target) {
        return target.budget ? mesher.mesh_within(view, target.detail, *target.budget)
                             : mesher.mesh(view, target.detail);
    }

    GroundMesh mesh(const MeshView& view, const Target& target) { return made_by(ground.mesher, view, target); }

    MeshCopy mesh_by_new_mesher(const MeshView& view, const Target& target) const {
        QuadtreeMesher fresh(ground.tree, ground.colours);
        return MeshCopy(made_by(fresh, view, target));
    }

    std::vector<SampleTriangle> triangles(const GroundMesh& mesh, const MeshView& view) const {
        return sample_triangles(mesh, field(), view.eye_m);
    }

    Ground ground;
};

struct ByError {
    using Target = ErrorTarget;
    static constexpr std::size_t min_dropped = 1;

    ByError(const HeightField& field, const QuadtreeOptions& /*options*/) : ground(field) {}

    const HeightField& field() const { return ground.field; }

    MeshView view(Numbers& numbers) const { return any_view(numbers, field()); }

    static Target target(Numbers& numbers) {
        return {any_error_px(numbers),
            numbers.coin() ? unlimited_triangles : 10 + static_cast<int>(numbers.next() % 500), numbers.coin()};
    }

    static Target without_budget(Numbers& numbers) {
        return {any_error_px(numbers), unlimited_triangles, numbers.next() % 4 != 0};
    }

    static Target within(int triangles) { return {0.01, triangles, true}; }

    GroundMesh mesh(const MeshView& view, const Target& target) { return ground.mesher.mesh(view, target); }

    MeshCopy mesh_by_new_mesher(const MeshView& view, const Target& target) const {
        BisectionMesher fresh(ground.tiles);
        return MeshCopy(fresh.mesh(view, target));
    }

    std::vector<SampleTriangle> triangles(const GroundMesh& mesh, const MeshView& view) const {
        return origin_triangles(mesh, field(), view.eye_m);
    }

    ErrorGround ground;
};

constexpr std::array<FieldSize, 14> kind_sizes = {{{2, 2}, {3, 3}, {17, 17}, {33, 33}, {37, 53}, {53, 37}, {20, 6},
    {5, 41}, {34, 18}, {40, 64}, {9, 30}, {65, 65}, {129, 65}, {150, 100}}};
constexpr std::size_t small_sizes = 11;

QuadtreeOptions crack_free(Numbers& numbers) {
    QuadtreeOptions options = random_options(numbers);
    options.propagation = RoughnessPropagation::CrackFree;
    return options;
}

/// Places where an eye stands on lines between parts of nodes: on a sample, on a column's or row's line inside or
/// beyond the field, and on a diagonal through a sample.
glm::dvec3 eye_on_lines(Numbers& numbers, const HeightField& field) {
    const glm::dvec2 reach = field.half_extent_m() * 1.5;
    const glm::dvec3 anywhere(
        numbers.between(-reach.x, reach.x), numbers.between(-reach.y, reach.y), numbers.between(-20.0, 60.0));
    const glm::dvec3 sample = field.sample_m(static_cast<int>(numbers.next() % static_cast<unsigned>(field.columns())),
        static_cast<int>(numbers.next() % static_cast<unsigned>(field.rows())));
    const double off = numbers.between(-reach.x, reach.x);
    switch (numbers.next() % 4) {
    case 0:
        return {sample.x, sample.y, anywhere.z};
    case 1:
        return {sample.x, anywhere.y, anywhere.z};
    case 2:
        return {anywhere.x, sample.y, anywhere.z};
    default:
        return {sample.x + off, sample.y + (numbers.coin() ? off : -off), sample.z};
    }
}

} // namespace

TEMPLATE_TEST_CASE("the unculled mesh covers the field once, edge to edge, from any eye", "", ByResolution, ByError) {
    int mixed = 0; // neither one fan nor all samples
    int cases = 0;
    for (std::uint64_t seed = 1; seed <= 210; ++seed) {
        Numbers numbers(seed);
        const FieldSize& size = kind_sizes[seed % kind_sizes.size()];
        TestType ground(any_field(size, numbers), crack_free(numbers));
        for (int look = 0; look < 5; ++look, ++cases) {
            const MeshView view = everywhere_from(ground.view(numbers));
            const GroundMesh mesh = ground.mesh(view, TestType::target(numbers));
            INFO("seed " << seed << ", look " << look << ", " << mesh.counters.triangles);
            REQUIRE(ground_triangles_conform(ground.triangles(mesh, view), ground.field()));
            const auto samples = static_cast<std::size_t>(size.columns * size.rows);
            mixed += mesh.counters.fans > 1 && mesh.vertices.size() < samples ? 1 : 0;
        }
    }
    CHECK(mixed > cases / 2);
}

TEMPLATE_TEST_CASE(
    "culling drops only triangles that the frustum does not reach, and changes none", "", ByResolution, ByError) {
    std::size_t dropped = 0;
    std::size_t kept = 0;
    for (std::uint64_t seed = 1; seed <= 320; ++seed) {
        Numbers numbers(seed);
        TestType ground(any_field(kind_sizes[2 + seed % (kind_sizes.size() - 2)], numbers), random_options(numbers));
        const MeshView view = ground.view(numbers);
        if (everywhere_from(view) == view) { continue; }
        const auto target = TestType::without_budget(numbers);
        auto seen = ground.triangles(ground.mesh(view, target), view);
        std::sort(seen.begin(), seen.end());
        const GroundMesh whole = ground.mesh(everywhere_from(view), target);
        const auto all = ground.triangles(whole, view);
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
    CHECK(dropped > TestType::min_dropped * kept);
}

TEMPLATE_TEST_CASE(
    "no triangle hides one drawn after it, and front to back is the reverse", "", ByResolution, ByError) {
    long triangles_seen = 0;
    int rugged = 0;
    long wrong_in_reverse = 0; // shows that wrong orders are found
    for (std::uint64_t seed = 1; seed <= 220; ++seed) {
        Numbers numbers(seed);
        TestType ground(any_field(kind_sizes[seed % small_sizes], numbers), random_options(numbers));
        for (int look = 0; look < 3; ++look) {
            MeshView view = ground.view(numbers);
            if (numbers.coin()) { view.eye_m = eye_on_lines(numbers, ground.field()); }
            const auto target = TestType::target(numbers);
            const GroundMesh mesh = ground.mesh(view, target);
            auto painted = ground.triangles(mesh, view);
            INFO("seed " << seed << ", look " << look << ", " << painted.size() << " triangles");
            REQUIRE(wrongly_ordered_rays(painted, ground.field(), view.eye_m) == 0);
            triangles_seen += mesh.counters.triangles;
            rugged += mesh.counters.fans > 5 ? 1 : 0;
            view.order = PaintOrder::FrontToBack;
            std::reverse(painted.begin(), painted.end());
            if (look == 0) { wrong_in_reverse += wrongly_ordered_rays(painted, ground.field(), view.eye_m); }
            REQUIRE(ground.triangles(ground.mesh(view, target), view) == painted);
            std::sort(painted.begin(), painted.end());
            REQUIRE(std::adjacent_find(painted.begin(), painted.end()) == painted.end());
        }
    }
    CHECK(triangles_seen > 40000);
    CHECK(rugged > 200);
    CHECK(wrong_in_reverse > 1000);
}

TEMPLATE_TEST_CASE(
    "the triangles in a box are found in drawing order, few others with them", "", ByResolution, ByError) {
    long found_count = 0;
    long wanted_count = 0;
    long triangle_count = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Numbers numbers(seed);
        TestType ground(any_field(kind_sizes[seed % small_sizes], numbers), random_options(numbers));
        MeshView view = ground.view(numbers);
        view.order = numbers.coin() ? PaintOrder::BackToFront : PaintOrder::FrontToBack;
        const GroundMesh mesh = ground.mesh(view, TestType::target(numbers));
        const glm::dvec2 reach = ground.field().half_extent_m();
        const SearchBox box{
            {numbers.between(-reach.x, reach.x), numbers.between(-reach.y, reach.y), numbers.between(-10.0, 10.0)},
            {numbers.between(0.5, 8.0), numbers.between(0.5, 8.0), numbers.between(1.0, 20.0)}};
        std::vector<std::uint32_t> found = {7};
        ground.ground.mesher.triangles_in(
            [&](const glm::dvec3& min_m, const glm::dvec3& max_m) { return box.meets(min_m, max_m); }, found);
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

TEMPLATE_TEST_CASE(
    "all triangles are in all boxes, none in none, and none before the first mesh", "", ByResolution, ByError) {
    TestType ground(rough_field(37, 53, 9), {});
    auto& mesher = ground.ground.mesher;
    const auto everywhere = [](const glm::dvec3&, const glm::dvec3&) { return true; };
    std::vector<std::uint32_t> found;
    mesher.triangles_in(everywhere, found);
    CHECK(found.empty());
    MeshView view;
    view.eye_m = {4.0, 4.0, 10.0};
    const GroundMesh mesh = ground.mesh(view, TestType::within(300));
    int asked = 0;
    mesher.triangles_in([&](const auto&, const auto&) { return ++asked < 0; }, found);
    CHECK(found.empty());
    CHECK(asked == 1); // the root's box stands for all
    mesher.triangles_in(everywhere, found);
    REQUIRE(found.size() == mesh.indices.size() / 3);
    for (std::size_t k = 0; k < found.size(); ++k) { REQUIRE(found[k] == k); }
}

TEMPLATE_TEST_CASE("a mesh within a budget does not depend on the meshes before", "", ByResolution, ByError) {
    TestType ground(rough_field(257, 257, 6), {});
    Numbers numbers(5);
    for (int frame = 0; frame < 60; ++frame) {
        const MeshView view = ground.view(numbers);
        const auto target = TestType::within(200 + static_cast<int>(numbers.next() % 20000));
        const MeshCopy expected = ground.mesh_by_new_mesher(view, target);
        REQUIRE(MeshCopy(ground.mesh(view, target)) == expected);
        REQUIRE(MeshCopy(ground.mesh(view, target)) == expected);
    }
}

TEMPLATE_TEST_CASE("along a path and after looks at the sky every mesh spends its budget to a few triangles", "",
    ByResolution, ByError) {
    TestType ground(rough_field(257, 257, 6), {});
    double missing = 0.0;
    constexpr int frames = 150;
    for (int frame = 0; frame < frames; ++frame) {
        if (frame % 15 == 0) { CHECK(ground.mesh(into_the_sky(), TestType::within(3000)).counters.triangles < 20); }
        const GroundMesh mesh = ground.mesh(circling(frame), TestType::within(3000));
        REQUIRE(mesh.counters.triangles <= 3000);
        REQUIRE(mesh.counters.triangles >= 2970);
        REQUIRE(mesh.counters.nodes_visited < 60000);
        missing += 3000 - mesh.counters.triangles;
    }
    CHECK(missing / frames < 0.002 * 3000);
}
