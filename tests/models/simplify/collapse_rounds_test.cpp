#include "models/collapse_sequence.h"
#include "models/measure/mesh_distance.h"
#include "models/simplify/collapse_rounds.h"
#include "models/simplify/collapse_run.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <utility>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

/// What is left after rounds down to some triangles, and what led there.
struct Rounded {
    TriangleMesh mesh;
    CollapseSequence sequence;
};

Rounded rounded(const TriangleMesh& original, const RoundOptions& options) {
    const WorkingUnits units = WorkingUnits::of(original, 0.1);
    WorkingSurface surface(original, units);
    CollapsingSurface collapsing(surface, units, cost_weights);
    collapse_in_rounds(collapsing, options);
    return {surface.to_mesh(original, units), {original, std::move(collapsing.collapses())}};
}

double rms_m(const TriangleMesh& a, const TriangleMesh& b) {
    return measure::distance(a, b, {.tightness = 1.5, .samples = 20'000}).rms_m();
}

} // namespace

TEST_CASE("rounds of collapses keep the kind of surface and are recorded in the first numbers") {
    for (const TriangleMesh& fine : {ball(40), ring(40, 24), machined_part(12), strip(20, 20)}) {
        const Rounded left = rounded(fine, {.faces = 500});
        CHECK(left.mesh.triangles.size() <= 500);
        CHECK(left.mesh.triangles.size() >= 499);
        CHECK(is_manifold(left.mesh));
        CHECK(euler_number(left.mesh) == euler_number(fine));
        const TriangleMesh replayed = mesh_after(left.sequence, left.sequence.collapses.size());
        CHECK(replayed.triangles.size() == left.mesh.triangles.size());
        CHECK(is_manifold(replayed));
        CHECK(rms_m(replayed, left.mesh) < 1e-12);
    }
}

TEST_CASE("rounds give the same on any number of threads") {
    const TriangleMesh fine = ball(60);
    const Rounded alone = rounded(fine, {.faces = 700, .threads = 1});
    const Rounded together = rounded(fine, {.faces = 700, .threads = 3});
    CHECK(same_bytes(alone.mesh, together.mesh));
}

TEST_CASE("what rounds begin is not much worse at the end than the cheapest edge each time") {
    const TriangleMesh fine = machined_part(24);
    const WorkingUnits units = WorkingUnits::of(fine, 0.1);
    const auto left = [&](bool in_rounds) {
        WorkingSurface surface(fine, units);
        CollapsingSurface collapsing(surface, units, cost_weights);
        if (in_rounds) {
            collapse_in_rounds(collapsing, {.faces = fine.triangles.size() / 4});
        }
        CollapseRun run(collapsing, Chooser::Quadrics, nullptr, nullptr, {});
        run.run({.vertices = {}, .faces = 200, .error_m = {}}, nullptr);
        return surface.to_mesh(fine, units);
    };
    const TriangleMesh begun = left(true);
    const TriangleMesh greedy = left(false);
    REQUIRE(begun.triangles.size() == greedy.triangles.size());
    CHECK(rms_m(fine, begun) < 1.2 * rms_m(fine, greedy));
}
