#include "models/procedural/procedural_models.h"
#include "sim/base/units.h"
#include "visuals/shading/dynamic_mesh_shading.h"
#include "visuals/shading/vertex_normals.h"

#include <catch2/catch.hpp>

#include <numeric>
#include <vector>

using namespace octant;
using namespace octant::visuals::shading;

namespace {

const ShadingLight light{.to_light = {0.0F, 0.0F, 1.0F}, .ambient = 0.1F, .diffuse = 0.9F, .specular = 0.0F};
const glm::dvec3 eye_m(40.0, 10.0, 30.0);

/// The torus' quads as two triangles each, as a mesh that stays and as one that changes.
struct Torus {
    ShadedPolygons shaded;
    std::vector<std::uint32_t> labels;

    Torus() {
        const models::polygons::PolygonModel quads = models::procedural::torus();
        models::TriangleMesh mesh;
        mesh.vertices_m = quads.vertices_m;
        for (std::size_t i = 0; i < quads.polygons.size(); ++i) {
            const auto corners = quads.corners(i);
            mesh.triangles.push_back({corners[0], corners[1], corners[2]});
            mesh.triangles.push_back({corners[0], corners[2], corners[3]});
        }
        shaded = shaded_polygons(mesh, corner_normals(mesh, rad_from_deg(60.0)));
        labels.resize(shaded.size());
        std::iota(labels.begin(), labels.end(), 0U);
    }

    DynamicMesh mesh() const { return {shaded.points, shaded.corner_points, labels, labels.size(), shaded.centre_m}; }
};

std::vector<std::uint8_t> copied(std::span<const std::uint8_t> marks) { return {marks.begin(), marks.end()}; }

} // namespace

TEST_CASE("of a mesh that does not change the same triangles are smooth as of a model that stays") {
    const Torus torus;
    for (const ShadingRule rule : {ShadingRule::Error, ShadingRule::Paper}) {
        DynamicMeshSelector changing(without_hysteresis(rule));
        ShadingSelector staying(torus.shaded, without_hysteresis(rule));
        for (const int wanted : {0, 1, 40, 200, 415}) {
            const auto count = static_cast<std::size_t>(wanted);
            const auto expected = staying.choose(eye_m, light, wanted).smooth;
            changing.choose(torus.mesh(), eye_m, light, count, true);
            // Rounding may tell ranks that are equal in truth apart in another way.
            int differ = 0;
            for (std::size_t i = 0; i < expected.size(); ++i) { differ += expected[i] != changing.smooth()[i] ? 1 : 0; }
            CHECK(differ <= 4);
            CHECK(std::accumulate(changing.smooth().begin(), changing.smooth().end(), 0) == wanted);
        }
    }
}

TEST_CASE("places without a triangle are never smooth") {
    Torus torus;
    for (std::size_t place = 0; place < torus.labels.size(); place += 2) {
        torus.shaded.corner_points[3 * place] = 0;
        torus.shaded.corner_points[3 * place + 1] = 0;
        torus.shaded.corner_points[3 * place + 2] = 0;
    }
    DynamicMesh mesh = torus.mesh();
    mesh.triangle_count = torus.labels.size() / 2;
    for (const ShadingRule rule : {ShadingRule::Error, ShadingRule::Paper}) {
        DynamicMeshSelector selector(without_hysteresis(rule));
        selector.choose(mesh, eye_m, light, mesh.triangle_count, true);
        for (std::size_t place = 0; place < torus.labels.size(); ++place) {
            CHECK(selector.smooth()[place] == place % 2);
        }
    }
}

TEST_CASE("nothing is chosen anew until eye, light, count or triangles are others") {
    const Torus torus;
    DynamicMeshSelector selector;
    CHECK(selector.choose(torus.mesh(), eye_m, light, 100, false));
    CHECK_FALSE(selector.choose(torus.mesh(), eye_m, light, 100, false));
    CHECK_FALSE(selector.choose(torus.mesh(), eye_m * 1.001, light, 100, false));
    CHECK(selector.choose(torus.mesh(), eye_m, light, 101, false));
    CHECK(selector.choose(torus.mesh(), eye_m, light, 101, true));
    CHECK(selector.choose(torus.mesh(), -eye_m, light, 101, false));
    ShadingLight turned = light;
    turned.to_light = {1.0F, 0.0F, 0.0F};
    CHECK(selector.choose(torus.mesh(), -eye_m, turned, 101, false));
}

TEST_CASE("a triangle that stays is held, one that takes its place is not") {
    Torus torus;
    ShadingRuleSettings settings = without_hysteresis(ShadingRule::Error);
    settings.hysteresis = 1e6F;
    DynamicMeshSelector selector(settings);
    selector.choose(torus.mesh(), eye_m, light, 50, true);
    const auto first = copied(selector.smooth());
    const glm::dvec3 elsewhere_m(38.0, 20.0, 28.0); // all of them still face the eye or nearly
    selector.choose(torus.mesh(), elsewhere_m, light, 50, true);
    int held = 0;
    for (std::size_t i = 0; i < first.size(); ++i) { held += first[i] != 0 && selector.smooth()[i] != 0 ? 1 : 0; }
    CHECK(held >= 45);
    for (std::uint32_t& label : torus.labels) { label += 1000; }
    selector.choose(torus.mesh(), elsewhere_m, light, 50, true);
    DynamicMeshSelector fresh(settings);
    fresh.choose(torus.mesh(), elsewhere_m, light, 50, true);
    CHECK(copied(selector.smooth()) == copied(fresh.smooth()));
}
