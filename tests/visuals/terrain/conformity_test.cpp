#include "tests/visuals/terrain/both_meshes.h"
#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <memory>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;
using octant::models::heights::HeightField;

namespace {

struct Size {
    int columns;
    int rows;
    int cases;
};

HeightField random_field(const Size& size, std::uint32_t kind, std::uint64_t seed) {
    switch (kind % 5) {
    case 0:
        return level_field(size.columns, size.rows);
    case 1:
    case 2:
        return rough_field(size.columns, size.rows, seed);
    default:
        return spiky_field(size.columns, size.rows, seed);
    }
}

/// One random field with its tree, and random looks at it.
struct Scene {
    Scene(const Size& size, RoughnessPropagation propagation, std::uint64_t seed)
        : numbers(seed), field(random_field(size, numbers.next(), seed)), colours(numbered_colours(field)),
          tree(field,
              {numbers.coin() ? Roughness::Printed : Roughness::Midpoint, propagation, numbers.coin() ? 2.0 : 1.6}),
          mesher(tree, colours) {}

    glm::dvec3 random_eye() {
        const glm::dvec2 reach = field.half_extent_m() * 1.5;
        return {numbers.between(-reach.x, reach.x), numbers.between(-reach.y, reach.y),
            numbers.between(-10.0, numbers.coin() ? 10.0 : 80.0)};
    }

    QuadtreeDetail random_detail() {
        // Mostly coarse meshes, where levels meet.
        return {numbers.next() % 4 == 0 ? numbers.between(2.0, 64.0) : numbers.between(2.0, 4.0),
            5.0 * numbers.between(0.0, 1.0) * numbers.between(0.0, 1.0),
            numbers.coin() ? FanKind::Partial : FanKind::Full};
    }

    Numbers numbers;
    HeightField field;
    std::vector<std::uint32_t> colours;
    Quadtree tree;
    QuadtreeMesher mesher;
};

/// A triangle's corners, eye subtracted.
Corners corners_of(const SampleTriangle& t, const HeightField& field, const glm::dvec3& eye_m) {
    Corners corners{};
    const std::array<std::uint32_t, 3> samples = {t.a, t.b, t.c};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto columns = static_cast<std::uint32_t>(field.columns());
        corners[k] =
            field.sample_m(static_cast<int>(samples[k] % columns), static_cast<int>(samples[k] / columns)) - eye_m;
    }
    return corners;
}

} // namespace

TEST_CASE("the unculled mesh covers the field once, edge to edge, from any eye at any detail") {
    constexpr std::array<Size, 9> sizes = {{{17, 17, 1000}, {9, 30, 800}, {22, 7, 600}, {33, 26, 800}, {40, 33, 400},
        {65, 12, 300}, {100, 37, 80}, {129, 65, 40}, {200, 200, 10}}};
    int cases = 0;
    int mixed = 0; // neither one fan nor all samples
    std::uint64_t seed = 1;
    for (const Size& size : sizes) {
        std::unique_ptr<Scene> scene;
        for (int k = 0; k < size.cases; ++k, ++cases) {
            if (k % 5 == 0) { scene = std::make_unique<Scene>(size, RoughnessPropagation::CrackFree, ++seed); }
            MeshView view;
            view.eye_m = scene->random_eye();
            const GroundMesh mesh = scene->mesher.mesh(view, scene->random_detail());
            const auto triangles = sample_triangles(mesh, scene->field, view.eye_m);
            mixed += mesh.counters.fans > 1 && mesh.vertices.size() < scene->colours.size() ? 1 : 0;
            if (!ground_triangles_conform(triangles, scene->field)) {
                FAIL(size.columns << " x " << size.rows << ", seed " << seed << ", case " << k);
            }
        }
    }
    CHECK(cases > 4000);
    CHECK(mixed > cases / 2);
}

TEST_CASE("the printed propagation leaves corners on other triangles' edges") {
    int with_cracks = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Scene scene({65, 65, 1}, RoughnessPropagation::Printed, seed);
        MeshView view;
        view.eye_m = scene.random_eye();
        const GroundMesh mesh = scene.mesher.mesh(view, {4.0, 5.0, FanKind::Partial});
        const GroundCheck check = checked_ground(sample_triangles(mesh, scene.field, view.eye_m), scene.field);
        CHECK(check.counter_clockwise);
        with_cracks += check.unmatched_edges > 0 ? 1 : 0;
    }
    CHECK(with_cracks > 10);
}

TEST_CASE("culling drops only triangles that the frustum does not reach, and changes none") {
    constexpr std::array<Size, 4> sizes = {{{33, 33, 0}, {50, 37, 0}, {17, 70, 0}, {90, 64, 0}}};
    std::size_t dropped = 0;
    std::size_t kept = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        const RoughnessPropagation propagation =
            seed % 8 == 0 ? RoughnessPropagation::Printed : RoughnessPropagation::CrackFree;
        Scene scene(sizes[seed % 4], propagation, seed);
        const MeshView view = camera_view(scene.random_eye(), scene.numbers.between(0.0, 6.28),
            scene.numbers.between(-1.2, 0.3), scene.numbers.between(0.1, 1.6));
        const QuadtreeDetail detail = scene.random_detail();
        MeshView everywhere;
        everywhere.eye_m = view.eye_m;
        auto all = sample_triangles(scene.mesher.mesh(everywhere, detail), scene.field, view.eye_m);
        auto seen = sample_triangles(scene.mesher.mesh(view, detail), scene.field, view.eye_m);
        std::sort(all.begin(), all.end());
        std::sort(seen.begin(), seen.end());
        INFO("seed " << seed);
        REQUIRE(std::includes(all.begin(), all.end(), seen.begin(), seen.end()));
        std::vector<SampleTriangle> missing;
        std::set_difference(all.begin(), all.end(), seen.begin(), seen.end(), std::back_inserter(missing));
        for (const SampleTriangle& triangle : missing) {
            if (reaches_into(corners_of(triangle, scene.field, view.eye_m), view)) {
                FAIL("a triangle in sight is missing");
            }
        }
        dropped += missing.size();
        kept += seen.size();
    }
    CHECK(dropped > 2 * kept);
}
