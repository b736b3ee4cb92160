#include "models/measure/mesh_distance.h"
#include "models/measure/triangle_bvh.h"
#include "models/simplify/aims.h"
#include "models/simplify/simplify.h"
#include "models/simplify/triangle_samples.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <utility>
#include <vector>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

/// A square of edge 1 at that height, seen from above or from below.
void add_square(TriangleMesh& mesh, double z_m, bool seen_from_above) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
        mesh.vertices_m.emplace_back(x, y, z_m);
    }
    for (const auto& [b, c] : {std::pair{1U, 2U}, {2U, 3U}}) {
        mesh.triangles.push_back({first, first + b, first + c});
        if (!seen_from_above) {
            std::swap(mesh.triangles.back()[1], mesh.triangles.back()[2]);
        }
    }
}

double rms_m(const TriangleMesh& a, const TriangleMesh& b) {
    return measure::distance(a, b, {.tightness = 1.05, .negligible_m = 1e-4, .samples = 20'000})
        .rms_m();
}

} // namespace

TEST_CASE("the first samples of the spread sequence fill a triangle evenly, however many") {
    for (const std::size_t count : {12U, 50U, 400U}) {
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 w = spread_weights(i);
            CHECK((w.x >= 0.0 && w.y >= 0.0 && w.z >= 0.0));
            CHECK(w.x + w.y + w.z == Approx(1.0));
            sum += w;
        }
        const double mean_off =
            glm::distance(sum / static_cast<double>(count), glm::dvec3(1.0 / 3.0));
        CHECK(mean_off < 2.0 / static_cast<double>(count));
    }
}

TEST_CASE("samples aim at the side of a sheet that faces as they do, not at the nearer one") {
    TriangleMesh sheet;
    add_square(sheet, 0.0, false);
    add_square(sheet, 0.1, true);
    TriangleMesh inside;
    add_square(inside, 0.025, true);
    WorkingUnits units; // as it is
    const TargetMesh target(sheet, units);
    WorkingSurface surface(inside, units);
    const measure::TriangleBvh bvh(target.places, sheet.triangles);
    SampleAims aims(2);
    aims.take(surface, {target, bvh}, 1);
    VertexFit fit;
    aims.add_to(fit, 0, surface.corner_places(0), 0);
    CHECK(fit.way().z > 0.03);
    const auto at_height = [&surface](double z_m) {
        auto corners = surface.corner_places(0);
        for (glm::dvec3& corner : corners) {
            corner.z = z_m;
        }
        return corners;
    };
    CHECK(aims.cost(0, at_height(0.1)) < 1e-12);
    CHECK(aims.cost(0, at_height(0.025)) < aims.cost(0, at_height(0.0)));
    CHECK(aims.true_cost({target, bvh}, at_height(0.0)) < 1e-12);
}

TEST_CASE("the fast way's short polish lessens the distance") {
    for (const TriangleMesh& fine : {ball(40), ring(40, 24)}) {
        SimplifyOptions options;
        options.quality = Quality::Fast;
        options.goal.faces = 300;
        const CollapseSequence sequence = fast_sequence(fine, options);
        const TriangleMesh before = mesh_after(sequence, sequence.collapses.size());
        const TriangleMesh after = simplified(fine, options).mesh;
        REQUIRE(after.triangles.size() == before.triangles.size());
        CHECK(is_manifold(after));
        CHECK(rms_m(fine, after) < 0.95 * rms_m(fine, before));
    }
}
