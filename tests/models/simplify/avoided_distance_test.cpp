#include "models/measure/mesh_distance.h"
#include "models/measure/triangle_bvh.h"
#include "models/simplify/collapse_run.h"
#include "models/simplify/passes.h"
#include "models/simplify/target_mesh.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

double hausdorff_m(const TriangleMesh& a, const TriangleMesh& b) {
    return measure::distance(a, b, {.tightness = 1.02, .negligible_m = 1e-6, .samples = 0})
        .most_hausdorff_m();
}

/// A ball with small bumps all over, no two alike.
TriangleMesh bumpy_ball() {
    TriangleMesh mesh = ball(24);
    for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v) {
        const double turn = static_cast<double>(v);
        mesh.vertices_m[v] *= 1.0 + 0.02 * std::sin(7.0 * turn) * std::cos(3.3 * turn);
    }
    return mesh;
}

TriangleMesh collapsed(const TriangleMesh& fine, double avoided_m) {
    const WorkingUnits units = WorkingUnits::of(fine, 0.1);
    WorkingSurface surface(fine, units);
    const TargetMesh target(fine, units);
    const measure::TriangleBvh tree(target.places, target.triangles);
    TrackedPoints points(target, 5'000);
    CollapsingSurface collapsing(surface, units, {});
    SimplifyOptions options;
    options.avoided_m = avoided_m;
    CollapseRun run(collapsing, Chooser::Distances, &points, &tree, options);
    run.run({.vertices = {}, .faces = fine.triangles.size() / 2, .error_m = {}}, nullptr);
    return surface.to_mesh(fine, units);
}

TriangleMesh no_revision(
    const TriangleMesh& mesh,
    const TriangleMesh& /*original*/,
    const SimplifyOptions& /*options*/,
    const Revision& /*revision*/) {
    return mesh;
}

/// The original with one vertex moved outwards.
Simplified with_peak(TriangleMesh original, double height_m) {
    Simplified result;
    result.mesh = original;
    glm::dvec3& top_m = result.mesh.vertices_m.front();
    top_m += height_m * glm::normalize(top_m);
    result.sequence.original = std::move(original);
    result.sequence.collapses.emplace_back();
    return result;
}

} // namespace

TEST_CASE("collapses lead less far away where far distances are avoided") {
    const TriangleMesh fine = bumpy_ball();
    const TriangleMesh free = collapsed(fine, std::numeric_limits<double>::infinity());
    const double free_m = hausdorff_m(fine, free);
    const TriangleMesh careful = collapsed(fine, 0.7 * free_m);
    CHECK(careful.triangles.size() == free.triangles.size());
    CHECK(is_manifold(careful));
    CHECK(hausdorff_m(fine, careful) < 0.9 * free_m);
}

TEST_CASE("a goal is reached also where all collapses lead too far") {
    const TriangleMesh fine = bumpy_ball();
    CHECK(collapsed(fine, 1e-9).triangles.size() == fine.triangles.size() / 2);
}

TEST_CASE("of small meshes the best pass is followed by ones that avoid its largest distance") {
    constexpr double usual_m = 0.1;
    SimplifyOptions options;
    options.goal.faces = ball(12).triangles.size();
    std::size_t careful = 0;
    const OnePass one_pass = [&](TriangleMesh original, const SimplifyOptions& how, Chooser) {
        careful += std::isinf(how.avoided_m) ? 0U : 1U;
        return with_peak(std::move(original), std::min(usual_m, how.avoided_m));
    };
    const Simplified best = best_of_passes(ball(12), options, {one_pass, no_revision});
    CHECK(careful > 0);
    CHECK(hausdorff_m(ball(12), best.mesh) < 0.7 * usual_m);
    careful = 0;
    options.quality = Quality::Fast;
    best_of_passes(ball(12), options, {one_pass, no_revision});
    CHECK(careful == 0);
}

TEST_CASE("of small meshes the best result is revised as long as that makes it better") {
    constexpr double usual_m = 0.1;
    SimplifyOptions options;
    options.goal.faces = ball(12).triangles.size();
    const OnePass one_pass = [&](TriangleMesh original, const SimplifyOptions&, Chooser) {
        return with_peak(std::move(original), usual_m);
    };
    std::size_t revisions = 0;
    double height_m = usual_m;
    const Revise lower =
        [&](const TriangleMesh&, const TriangleMesh& original, const auto&, const auto&) {
            ++revisions;
            height_m *= 0.9;
            return with_peak(original, height_m).mesh;
        };
    const Simplified best = best_of_passes(ball(12), options, {one_pass, lower});
    CHECK(revisions > 5);
    CHECK(hausdorff_m(ball(12), best.mesh) == Approx(height_m).epsilon(0.05));
    const Revise higher =
        [&](const TriangleMesh&, const TriangleMesh& original, const auto&, const auto&) {
            return with_peak(original, 2.0 * usual_m).mesh;
        };
    const Simplified kept = best_of_passes(ball(12), options, {one_pass, higher});
    CHECK(hausdorff_m(ball(12), kept.mesh) == Approx(usual_m).epsilon(0.05));
    INFO("a mesh of too many triangles is no result");
    const Revise larger = [&](const TriangleMesh&, const TriangleMesh&, const auto&, const auto&) {
        return ball(24);
    };
    const Simplified small = best_of_passes(ball(12), options, {one_pass, larger});
    CHECK(small.mesh.triangles.size() == ball(12).triangles.size());
    options.quality = Quality::Fast;
    revisions = 0;
    best_of_passes(ball(12), options, {one_pass, lower});
    CHECK(revisions == 0);
}
