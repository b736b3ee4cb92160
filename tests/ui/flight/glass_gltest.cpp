#include "models/meshfile/level_chain.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/random_generator.h"
#include "tests/scratch.h"
#include "tests/ui/flight/kept_world.h"
#include "tests/ui/flight/layer_rays.h"
#include "ui/flight/renderer_choice.h"
#include "ui/world/mesh_loader.h"
#include "visuals/planning/planner.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/scene/camera.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::tests;
namespace planning = octant::visuals::planning;
namespace scene = octant::visuals::scene;
namespace settings = octant::ui::settings;

namespace {

/// How an aircraft is drawn.
struct GlassCase {
    std::string file;
    scene::HiddenSurface hidden_surface = scene::HiddenSurface::Octant;
    settings::RendererKind renderer = settings::RendererKind::Raster;
    double error_px = 0.25; ///< large: by its far polygons at any distance
    int views = 8;
    int aircraft = 1; ///< several stand in one another
};

LayerCheck check_views(const GlassCase& tried) {
    settings::RunSettings wanted;
    wanted.path.terrain = "none";
    wanted.path.aircraft = std::vector<std::string>(static_cast<std::size_t>(tried.aircraft), tried.file);
    wanted.view.size_px = {160, 120};
    wanted.surface.hidden_surface = tried.hidden_surface;
    wanted.surface.aircraft_error_px = tried.error_px;
    wanted.surface.textures = false;
    wanted.surface.effects = false;
    wanted.surface.order_cache = "none";
    wanted.shading.kind = scene::AircraftShading::Flat;
    wanted.drawing.renderer = tried.renderer;
    wanted.drawing.raster_threads = 1;
    const ui::world::World world = kept_world(wanted);
    std::vector<scene::ModelBuffers> models;
    for (const auto& model : world.scene.models) { models.push_back(model->buffers); }
    const auto renderer = ui::flight::make_renderer(wanted);
    renderer->load_models(models);
    planning::Planner planner(world.scene, wanted);
    std::vector<sim::AircraftState> states(world.scene.aircraft.size());
    RandomGenerator dice(7);
    const double radius_m = world.scene.model_of(0).subject.radius_m;
    LayerCheck all;
    for (int view = 0; view < tried.views; ++view) {
        for (std::size_t i = 0; i < states.size(); ++i) {
            states[i].position_m = glm::dvec3(0.0, 0.4 * radius_m * static_cast<double>(i), 3000.0);
        }
        const glm::dvec3 eye_m = states[0].position_m + dice.between(1.3, 4.0) * radius_m * dice.direction();
        scene::FramePlan plan = planner.plan({scene::camera_looking_at(eye_m, states[0].position_m), states}).plan;
        keep_only_aircraft(plan);
        renderer->draw(plan);
        scene::Picture picture;
        renderer->finish_and_read(picture);
        all += check_layers(plan, models, picture);
    }
    return all;
}

std::string found(const std::string& name) { return OCTANT_SOURCE_DIR "/tests/data/aircraft/glass/" + name; }

} // namespace

TEST_CASE("glass of few and of many polygons is seen through from every side, near, far away and by depth") {
    const std::string name = GENERATE("glass.obj", "canfirst.ac", "glassfine.obj");
    for (const auto renderer : {settings::RendererKind::Raster, settings::RendererKind::Gl}) {
        for (const auto hidden : {scene::HiddenSurface::Octant, scene::HiddenSurface::DepthBuffer}) {
            for (const double error_px : {0.01, 1000.0}) {
                INFO(name << ", renderer " << static_cast<int>(renderer) << ", hidden surfaces "
                          << static_cast<int>(hidden) << ", " << error_px << " px");
                const LayerCheck check = check_views(
                    {.file = found(name), .hidden_surface = hidden, .renderer = renderer, .error_px = error_px});
                INFO(fmt::format("{}", fmt::join(check.first_wrong, "\n")));
                CHECK(check.layered > 500);
                CHECK(check.wrong == 0);
            }
        }
    }
}

TEST_CASE("glass of a chain of levels and of a progressive mesh is seen through as that of their model") {
    const std::string name = GENERATE("glass.obj", "glassfine.obj");
    const models::TriangleMesh mesh = ui::world::load_mesh(found(name));
    models::meshfile::LevelChain chain;
    chain.levels.push_back({mesh, 0.0});
    chain.polygons = models::polygons::polygons_from_mesh(mesh);
    chain.polygons_error_m = 0.5; // far away
    const std::string as_chain = (scratch_folder() / (name + ".chain")).string();
    models::meshfile::write_chain(as_chain, chain);
    const std::string as_hierarchy = (scratch_folder() / (name + ".pm")).string();
    visuals::refine::write_progressive(
        as_hierarchy, *ui::world::make_refine_mesh({.file = name, .quiet = true}, mesh).mesh);
    for (const std::string& file : {as_chain, as_hierarchy}) {
        for (const auto renderer : {settings::RendererKind::Raster, settings::RendererKind::Gl}) {
            for (const auto hidden : {scene::HiddenSurface::Octant, scene::HiddenSurface::DepthBuffer}) {
                for (const double error_px : {0.01, 1000.0}) {
                    INFO(file << ", renderer " << static_cast<int>(renderer) << ", hidden surfaces "
                              << static_cast<int>(hidden) << ", " << error_px << " px");
                    const LayerCheck check = check_views(
                        {.file = file, .hidden_surface = hidden, .renderer = renderer, .error_px = error_px});
                    INFO(fmt::format("{}", fmt::join(check.first_wrong, "\n")));
                    CHECK(check.layered > 500);
                    CHECK(check.wrong == 0);
                }
            }
        }
    }
}

TEST_CASE("aircraft with glass that stand in one another are drawn by depth, and their glass over them") {
    const LayerCheck check = check_views({.file = found("glass.obj"), .views = 12, .aircraft = 2});
    CHECK(check.layered > 500);
    CHECK(check.wrong < check.layered / 20); // the glass of one aircraft is not sorted into that of another
}

// OCTANT_GLASS_AIRCRAFT="one.ac:other.glb" OCTANT_GLASS_VIEWS=40: a table of what any aircraft look like.
TEST_CASE("glass of any aircraft is right", "[.strangers]") {
    const char* const files = std::getenv("OCTANT_GLASS_AIRCRAFT");
    const char* const views = std::getenv("OCTANT_GLASS_VIEWS");
    std::string rest = files == nullptr ? "" : files;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        const std::string file = rest.substr(0, end);
        rest.erase(0, end + 1);
        for (const auto hidden : {scene::HiddenSurface::Octant, scene::HiddenSurface::DepthBuffer}) {
            for (const auto renderer : {settings::RendererKind::Raster, settings::RendererKind::Gl}) {
                for (const double error_px : {0.25, 1000.0}) {
                    LayerCheck check;
                    try {
                        check =
                            check_views({file, hidden, renderer, error_px, views == nullptr ? 10 : std::atoi(views)});
                    } catch (const std::exception& fault) {
                        std::fputs(fmt::format("{}: {}\n", file, fault.what()).c_str(), stdout);
                        continue;
                    }
                    std::fputs(
                        fmt::format("{} {} {} {}: {} pixels, {} layered, {} deep, {} wrong", file,
                            hidden == scene::HiddenSurface::Octant ? "order" : "depth",
                            renderer == settings::RendererKind::Gl ? "gl" : "raster", error_px < 1.0 ? "near" : "far",
                            check.pixels, check.layered, check.deepest, check.wrong)
                            .c_str(),
                        stdout);
                    for (const std::string& wrong : check.first_wrong) { std::fputs(("\n  " + wrong).c_str(), stdout); }
                    std::fputs("\n", stdout);
                    CHECK(check.wrong == 0);
                }
            }
        }
    }
}
