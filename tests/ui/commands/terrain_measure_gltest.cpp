#include "models/procedural/procedural_terrain.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "ui/terrain/terrain_check.h"
#include "visuals/scene/camera.h"
#include "visuals/terrain/quadtree.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::terrain;
using octant::visuals::terrain::GroundMetric;

namespace {

models::heights::HeightField small_ground(const std::string& kind) {
    models::procedural::ProceduralTerrainOptions made;
    made.size = 257;
    return *models::procedural::procedural_terrain(kind, made);
}

} // namespace

TEST_CASE("one in fifty of ten thousand random views shows no crack and no hole") {
    for (const std::string kind : {"hills", "canyon"}) {
        const LoadedGround ground(small_ground(kind));
        for (const GroundMetric mesh : {GroundMetric::ScreenError, GroundMetric::Midpoint}) {
            GroundMeshOptions options;
            options.lod.metric = mesh;
            options.geomorphs = true;
            const auto maker = make_mesh_maker(ground, options);
            TerrainCheck check;
            check.views = 10000;
            check.every = 50;
            check.draw_every = 5;
            check.by_error = mesh == GroundMetric::ScreenError;
            check.quiet = true;
            const TerrainCheckResult faults = check_terrain(*maker, check);
            INFO(kind << ": " << faults.edges.text() << ", " << faults.key_pixels);
            CHECK(faults.views == 200);
            CHECK(faults.drawn == 40);
            CHECK(faults.triangles > 10000);
            CHECK(faults.cracked_views == 0);
        }
    }
}

TEST_CASE("the key colour is seen through missing triangles and through printed cracks") {
    namespace terrain = visuals::terrain;
    const models::heights::HeightField field = small_ground("canyon");
    terrain::QuadtreeOptions printed;
    printed.propagation = terrain::RoughnessPropagation::Printed;
    const terrain::Quadtree tree(field, printed);
    const std::vector<std::uint32_t> colours(257 * 257, 0xffffffffU);
    terrain::QuadtreeMesher mesher(tree, colours);
    CrackFinder pictures({320, 180}, field.half_extent_m());
    const auto camera = visuals::scene::camera_looking_at({0.0, -500.0, 2500.0}, {0.0, 0.0, 0.0});
    GroundViewOptions seen;
    const terrain::MeshView view = mesh_view(camera, seen);
    int cracks = 0;
    for (const double resolution : {3.0, 6.0, 12.0}) {
        cracks += pictures.cracks(mesher.mesh(view, {resolution, 5.0, terrain::FanKind::Partial}), camera);
    }
    CHECK(cracks > 0);
    terrain::GroundMesh holed = mesher.mesh(view, {12.0, 0.0, terrain::FanKind::Partial});
    const int before = pictures.cracks(holed, camera);
    std::vector<std::uint32_t> indices(holed.indices.begin(), holed.indices.end());
    const auto middle = static_cast<std::ptrdiff_t>(indices.size() / 6 * 3);
    indices.erase(indices.begin() + middle, indices.begin() + middle + 90);
    holed.indices = indices;
    CHECK(pictures.cracks(holed, camera) > before);
}
