#include "models/collapse_sequence.h"
#include "models/heights/height_field_export.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "sim/base/axes.h"
#include "sim/base/random_generator.h"
#include "sim/base/thread_pool.h"
#include "sim/base/units.h"
#include "tests/scratch.h"
#include "ui/settings/settings.h"
#include "ui/world/world.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/planning/planner.h"
#include "visuals/raster/renderer.h"
#include "visuals/refine/progressive_mesh.h"
#include "visuals/scene/camera.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kept_world.h"
#include "small_ground.h"
#include "truth_rays.h"

using namespace octant;
using namespace octant::tests;
namespace landscape = octant::visuals::landscape;
namespace planning = octant::visuals::planning;
namespace raster = octant::visuals::raster;
namespace scene = octant::visuals::scene;
namespace settings = octant::ui::settings;

namespace {

constexpr glm::ivec2 picture_px{192, 128};

settings::RunSettings low_settings(const std::string& terrain, const std::vector<std::string>& aircraft) {
    settings::RunSettings settings;
    settings.path.terrain = terrain;
    settings.path.aircraft = aircraft;
    settings.view.size_px = picture_px;
    settings.ground.triangles = 3000;
    settings.surface.aircraft_error_px = 0.5;
    return settings;
}

/// A world, its planner and a renderer.
struct TruthWorld {
    settings::RunSettings settings;
    ui::world::World world;
    std::vector<scene::ModelBuffers> models;
    std::unique_ptr<planning::Planner> planner;
    std::vector<sim::AircraftState> states;

    scene::Camera last_camera;

    explicit TruthWorld(const settings::RunSettings& wanted) : settings(wanted), world(kept_world(wanted)) {
        use_scene();
    }

    /// Takes over a changed scene.
    void use_scene() {
        models.clear();
        for (const auto& model : world.scene.models) { models.push_back(model->buffers); }
        planner = std::make_unique<planning::Planner>(world.scene, settings);
        states.resize(world.scene.aircraft.size());
    }

    std::unique_ptr<raster::Renderer> renderer(int threads = 1, int samples = 16) const {
        auto made =
            std::make_unique<raster::Renderer>(std::make_shared<ThreadPool>(threads), settings.view.size_px, samples);
        made->load_models(models);
        if (world.scene.ground_texture) { made->load_ground_texture(*world.scene.ground_texture); }
        return made;
    }

    double ground_m(double x_m, double y_m) const { return world.scene.ground->height_at(x_m, y_m).value_or(0.0); }

    /// Puts the aircraft around a place ahead of the camera, `apart_m` from each other.
    void put_aircraft(const scene::Camera& camera, RandomGenerator& dice, double away_m, double apart_m) {
        const glm::dvec3 middle_m = camera.eye_m + away_m * scene::view_direction(camera);
        for (sim::AircraftState& state : states) {
            state = {};
            state.position_m = middle_m + apart_m * glm::dvec3(dice.between(-1.0, 1.0), dice.between(-1.0, 1.0),
                                                        dice.between(-0.5, 0.5));
            state.body_to_world = body_to_world_from_euler(
                {dice.between(0.0, 2.0 * pi), dice.between(-0.6, 0.6), dice.between(-1.0, 1.0)});
            state.time_s = dice.between(0.0, 3.0);
        }
    }

    scene::Camera random_camera(RandomGenerator& dice) const {
        const glm::dvec2 half_m = world.scene.ground->half_extent_m();
        const glm::dvec2 at_m(dice.between(-0.7, 0.7) * half_m.x, dice.between(-0.7, 0.7) * half_m.y);
        const glm::dvec3 eye_m(at_m, ground_m(at_m.x, at_m.y) + std::exp(dice.between(1.5, 6.5)));
        const double heading_rad = dice.between(0.0, 2.0 * pi);
        const glm::dvec3 ahead(std::sin(heading_rad), std::cos(heading_rad), std::tan(dice.between(-0.5, 0.05)));
        return scene::camera_looking_at(eye_m, eye_m + ahead);
    }

    TruthPicture truth(raster::Renderer& renderer, const planning::PlanRequest& request) {
        const scene::FramePlan& plan = planner->plan(request).plan;
        renderer.draw(plan);
        TruthPicture picture(settings.view.size_px);
        renderer.draw_truth(plan, picture.arrays());
        return picture;
    }
};

/// The way from the eye through a pixel's middle, of depth 1, view axes.
glm::dvec3 way_of(const scene::FramePlan& plan, int column, int row) {
    return {(2.0 * column + 1.0 - picture_px.x) / picture_px.x / static_cast<double>(plan.view_to_clip[0][0]),
        (picture_px.y - 2.0 * row - 1.0) / picture_px.y / static_cast<double>(plan.view_to_clip[1][1]), -1.0};
}

/// A ball of triangles.
models::TriangleMesh ball(double radius_m) {
    constexpr std::uint32_t around = 16;
    constexpr std::uint32_t rings = 7;
    models::TriangleMesh mesh;
    mesh.name = "ball";
    mesh.vertices_m.emplace_back(0.0, 0.0, radius_m);
    for (std::uint32_t ring = 1; ring <= rings; ++ring) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const double down = pi * ring / (rings + 1);
            const double turn = 2.0 * pi * i / around;
            mesh.vertices_m.push_back(radius_m * glm::dvec3(std::sin(down) * std::cos(turn),
                                                     std::sin(down) * std::sin(turn), std::cos(down)));
        }
    }
    mesh.vertices_m.emplace_back(0.0, 0.0, -radius_m);
    const std::uint32_t last = rings * around + 1;
    for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t next = (i + 1) % around;
        mesh.triangles.push_back({0, 1 + i, 1 + next});
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            const std::uint32_t upper = 1 + ring * around;
            const std::uint32_t lower = upper + around;
            mesh.triangles.push_back({upper + i, lower + i, lower + next});
            mesh.triangles.push_back({upper + i, lower + next, upper + next});
        }
        const std::uint32_t lowest = 1 + (rings - 1) * around;
        mesh.triangles.push_back({last, lowest + next, lowest + i});
    }
    return mesh;
}

/// Random views; returns the pixels that are wrong of how many.
RayCheck check_views(TruthWorld& world, int views, std::uint64_t seed, double apart_m) {
    const auto renderer = world.renderer();
    RandomGenerator dice(seed);
    RayCheck sum;
    for (int view = 0; view < views; ++view) {
        const scene::Camera camera = world.random_camera(dice);
        world.put_aircraft(camera, dice, dice.between(25.0, 120.0), apart_m);
        world.last_camera = camera;
        const planning::PlanRequest request{camera, world.states};
        const scene::FramePlan& plan = world.planner->plan(request).plan;
        renderer->draw(plan);
        TruthPicture picture(world.settings.view.size_px);
        renderer->draw_truth(plan, picture.arrays());
        const RayCheck check = check_by_rays(plan, world.models, picture);
        sum.pixels += check.pixels;
        sum.aircraft += check.aircraft;
        sum.wrong += check.wrong;
        for (const glm::ivec2& at : check.wrong_at) {
            UNSCOPED_INFO(fmt::format("view {}: {},{} class {} object {} depth {}", view, at.x, at.y,
                picture.class_id[picture.at(at.x, at.y)], picture.object_id[picture.at(at.x, at.y)],
                picture.depth_m[picture.at(at.x, at.y)]));
        }
    }
    return sum;
}

} // namespace

TEST_CASE("the truth of pictures painted in order is what rays meet") {
    TruthWorld world(low_settings("hills", {"f15", "500md"}));
    const RayCheck check = check_views(world, 8, 1, 30.0);
    CHECK(check.pixels > 8 * 10000);
    CHECK(check.aircraft > 500);
    CHECK(check.wrong == 0);
}

/// A map of 13 by 13 km: sea at a height of 0 in the west, level fields and low hills in the east. Made once.
std::string coast_map() {
    static const std::string file = [] {
        constexpr int side = 257;
        std::vector<float> heights_m;
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column) {
                const double inland = std::max(column - 90, 0);
                const double hills = 6.0 * std::sin(column / 11.0) * std::cos(row / 17.0) + 8.0;
                heights_m.push_back(static_cast<float>(std::min(inland / 10.0, 1.0) * hills));
            }
        }
        const std::filesystem::path map = scratch_folder() / "coast.tif";
        models::heights::write_height_field(map, {side, side, 50.0, heights_m});
        return map.string();
    }();
    return file;
}

TEST_CASE("classes are where the world has such things") {
    settings::RunSettings wanted = low_settings(coast_map(), {"f15"});
    wanted.ground.earth_curvature = false;
    TruthWorld world(wanted);
    const landscape::Ground& ground = *world.world.scene.ground;
    const auto renderer = world.renderer();
    const auto roads = ground.road_network();
    REQUIRE(roads != nullptr);
    RandomGenerator dice(11);
    std::array<int, 9> counts{};
    std::vector<std::uint32_t> numbers;
    int wrong = 0;
    for (int view = 0; view < 30; ++view) {
        const scene::Camera camera = world.random_camera(dice);
        world.put_aircraft(camera, dice, 60.0, 5.0);
        const scene::FramePlan& plan = world.planner->plan({camera, world.states}).plan;
        renderer->draw(plan);
        TruthPicture truth(picture_px);
        renderer->draw_truth(plan, truth.arrays());
        const glm::dmat3 from_view = glm::inverse(glm::dmat3(glm::mat3(plan.world_to_view)));
        for (int row = 0; row < picture_px.y; ++row) {
            for (int column = 0; column < picture_px.x; ++column) {
                const std::size_t pixel = truth.at(column, row);
                ++counts[truth.class_id[pixel]];
                const auto surface = static_cast<scene::SurfaceClass>(truth.class_id[pixel]);
                const glm::dvec3 at_m =
                    from_view * (way_of(plan, column, row) * static_cast<double>(truth.depth_m[pixel])) + camera.eye_m;
                const auto ground_m = ground.height_at(at_m.x, at_m.y);
                if (!ground_m) { continue; } // beyond the map, or sky
                switch (surface) {
                case scene::SurfaceClass::Water:
                    wrong += at_m.x > -1800.0 ? 1 : 0;
                    break;
                case scene::SurfaceClass::Terrain:
                    wrong += at_m.x < -2000.0 ? 1 : 0;
                    break;
                case scene::SurfaceClass::Tree:
                case scene::SurfaceClass::Building:
                    CHECK(at_m.z > *ground_m - 4.0);
                    CHECK(at_m.z < *ground_m + 22.0);
                    CHECK(glm::distance(at_m, camera.eye_m) < 1000.0);
                    break;
                case scene::SurfaceClass::Road:
                    numbers.clear();
                    roads->sections_in_box(glm::dvec2(at_m) - 1.0, glm::dvec2(at_m) + 1.0, numbers);
                    CHECK_FALSE(numbers.empty());
                    break;
                case scene::SurfaceClass::Aircraft:
                    CHECK(glm::distance(at_m, world.states[0].position_m) < 15.0);
                    break;
                default:
                    break;
                }
            }
        }
    }
    // Far triangles are larger than the shore is exact.
    CHECK(wrong < (counts[1] + counts[2]) / 50);
    for (const scene::SurfaceClass surface :
        {scene::SurfaceClass::Sky, scene::SurfaceClass::Terrain, scene::SurfaceClass::Water, scene::SurfaceClass::Road,
            scene::SurfaceClass::Building, scene::SurfaceClass::Tree, scene::SurfaceClass::Aircraft}) {
        INFO(fmt::format("class {}", static_cast<int>(surface)));
        CHECK(counts[static_cast<std::size_t>(surface)] > 20);
    }
}

TEST_CASE("the truth of a canyon by arid colours, a runway and a mesh that intersects the ground is what rays meet") {
    settings::RunSettings wanted = low_settings("canyon", {"f15-detailed", "500md-detailed"});
    wanted.ground.airfield = true;
    TruthWorld world(wanted);
    const RayCheck check = check_views(world, 6, 2, 10.0);
    CHECK(check.aircraft > 500);
    CHECK(check.wrong == 0);
}

TEST_CASE("aircraft that intersect each other have the truth that rays meet") {
    TruthWorld world(low_settings("hills", {"f15", "500md", "f15"}));
    const RayCheck check = check_views(world, 6, 3, 4.0);
    CHECK(check.aircraft > 2000);
    CHECK(check.wrong == 0);
}

TEST_CASE("a mesh that is refined in each frame and intersects aircraft has the truth that rays meet") {
    TruthWorld world(low_settings("hills", {"f15", "500md"}));
    models::CollapseSequence sequence;
    sequence.original = ball(6.0);
    models::polygons::PolygonModel polygons = models::polygons::polygons_from_mesh(sequence.original);
    visuals::draworder::DrawOrder order = visuals::draworder::file_order(polygons);
    planning::AircraftModel model = planning::aircraft_model(std::move(polygons), std::move(order), glm::dvec3(0.0));
    planning::add_progressive(model, std::make_shared<const visuals::refine::ProgressiveMesh>(sequence), 0.5);
    world.world.scene.aircraft.push_back(world.world.scene.add_model(std::move(model)));
    world.use_scene();
    const RayCheck check = check_views(world, 6, 7, 5.0);
    CHECK(check.aircraft > 3000);
    CHECK(check.wrong == 0);
    const scene::FramePlan& plan = world.planner->plan({world.last_camera, world.states}).plan;
    CHECK(plan.refined.size() == 1);
}

TEST_CASE("the cockpit counts as the first aircraft, in front of the others") {
    settings::RunSettings wanted = low_settings("hills", {"f15", "500md"});
    wanted.view.kind = scene::View::Cockpit;
    wanted.view.head_up_display = false;
    TruthWorld world(wanted);
    REQUIRE(world.world.scene.cockpit.has_value());
    const auto renderer = world.renderer();
    RandomGenerator dice(13);
    int cockpit = 0;
    for (int view = 0; view < 4; ++view) {
        scene::Camera camera = world.random_camera(dice);
        camera.near_m = 0.05;
        world.put_aircraft(camera, dice, 40.0, 5.0);
        world.states[0].position_m = camera.eye_m;
        world.states[0].body_to_world = camera.view_to_world * glm::inverse(scene::body_from_view());
        const scene::FramePlan& plan = world.planner->plan({camera, world.states}).plan;
        renderer->draw(plan);
        TruthPicture truth(picture_px);
        renderer->draw_truth(plan, truth.arrays());
        const RayCheck check = check_by_rays(plan, world.models, truth);
        CHECK(check.wrong == 0);
        for (std::size_t i = 0; i < truth.object_id.size(); ++i) {
            cockpit += truth.object_id[i] == 1 && truth.depth_m[i] < 3.0F ? 1 : 0;
        }
    }
    CHECK(cockpit > 4000);
}

TEST_CASE("both ways to remove hidden surfaces give the same truth") {
    settings::RunSettings wanted = low_settings("hills", {"f15", "500md"});
    TruthWorld painted(wanted);
    wanted.surface.hidden_surface = scene::HiddenSurface::DepthBuffer;
    TruthWorld depth_buffered(wanted);
    const auto renderer = painted.renderer();
    const auto other = depth_buffered.renderer();
    RandomGenerator dice(4);
    int differing = 0;
    for (int view = 0; view < 6; ++view) {
        const scene::Camera camera = painted.random_camera(dice);
        painted.put_aircraft(camera, dice, 60.0, 15.0);
        const planning::PlanRequest request{camera, painted.states};
        const TruthPicture a = painted.truth(*renderer, request);
        const TruthPicture b = depth_buffered.truth(*other, request);
        for (std::size_t i = 0; i < a.depth_m.size(); ++i) {
            const bool same_depth =
                a.depth_m[i] == b.depth_m[i] || std::abs(a.depth_m[i] - b.depth_m[i]) <= 2e-6F * std::abs(a.depth_m[i]);
            const bool same = a.class_id[i] == b.class_id[i] && a.object_id[i] == b.object_id[i] && same_depth;
            differing += same ? 0 : 1;
        }
    }
    // Corners of pieces are rounded for themselves where aircraft are cut.
    CHECK(differing <= 6 * picture_px.x * picture_px.y / 2000);
}

TEST_CASE("the truth has the same bytes on any number of threads, and says the same where pixels show others") {
    TruthWorld world(low_settings("hills", {"f15", "500md"}));
    RandomGenerator dice(5);
    const scene::Camera camera = world.random_camera(dice);
    world.put_aircraft(camera, dice, 60.0, 15.0);
    scene::Camera before = camera;
    before.eye_m -= glm::dvec3(2.0, 1.0, 0.5);
    const planning::PlanRequest request{
        .camera = camera, .states = world.states, .previous = planning::PreviousFrame{before, world.states}};
    const scene::FramePlan& plan = world.planner->plan(request).plan;
    const auto truth_by = [&](int threads, std::span<const glm::vec2> at_px) {
        const auto renderer = world.renderer(threads);
        renderer->prepare_truth(plan);
        TruthPicture picture(world.settings.view.size_px);
        renderer->draw_truth(plan, picture.arrays(), at_px);
        return picture;
    };
    const TruthPicture one = truth_by(1, {});
    for (const int threads : {2, 3, 4}) { CHECK(truth_by(threads, {}) == one); }
    std::vector<glm::vec2> own_px;
    for (int row = 0; row < picture_px.y; ++row) {
        for (int column = 0; column < picture_px.x; ++column) { own_px.emplace_back(column, row); }
    }
    CHECK(truth_by(1, own_px) == one);
    CHECK(truth_by(3, own_px) == one);
    std::ranges::for_each(own_px, [](glm::vec2& at) { at += glm::vec2(1.25F, -0.25F); });
    const TruthPicture shifted = truth_by(2, own_px);
    int continued = 0;
    for (int row = 1; row < picture_px.y; ++row) {
        CHECK(std::isinf(shifted.depth_m[shifted.at(picture_px.x - 1, row)]));
        CHECK(std::isnan(shifted.flow_px[shifted.at(picture_px.x - 1, row)].x));
        for (int column = 0; column + 2 < picture_px.x; ++column) {
            const std::size_t here = one.at(column, row);
            const std::size_t there = one.at(column + 1, row);
            REQUIRE(shifted.class_id[here] == one.class_id[there]);
            REQUIRE(shifted.normal[here] == one.normal[there]);
            // Between the depths of pixels of one plane.
            if (one.normal[there] != one.normal[there + 1] || one.class_id[there] == 0) { continue; }
            const double mean =
                0.75 / static_cast<double>(one.depth_m[there]) + 0.25 / static_cast<double>(one.depth_m[there + 1]);
            const std::size_t above = one.at(column + 1, row - 1);
            const bool is_level = std::abs(1.0 / static_cast<double>(one.depth_m[above]) -
                                           1.0 / static_cast<double>(one.depth_m[there])) < 1e-9;
            if (is_level) { CHECK(std::abs(mean * static_cast<double>(shifted.depth_m[here]) - 1.0) < 1e-3); }
            ++continued;
        }
    }
    CHECK(continued > 1000);
}

TEST_CASE("the flow of each point leads to where it was in the previous picture") {
    TruthWorld world(low_settings("hills", {"500md", "f15"}));
    const auto renderer = world.renderer();
    RandomGenerator dice(6);
    int parts = 0;
    int points = 0;
    for (int view = 0; view < 4; ++view) {
        const scene::Camera camera = world.random_camera(dice);
        world.put_aircraft(camera, dice, 25.0, 6.0);
        scene::Camera before = camera;
        before.eye_m += glm::dvec3(0.3, -0.2, 0.1);
        before.view_to_world = before.view_to_world * glm::angleAxis(0.01, glm::normalize(glm::dvec3(1.0, 2.0, -1.0)));
        std::vector<sim::AircraftState> earlier = world.states;
        for (sim::AircraftState& state : earlier) {
            state.position_m -= glm::dvec3(0.2, 0.1, -0.1);
            state.time_s -= 0.002; // a hundredth of a turn of the rotor
            state.body_to_world = state.body_to_world * glm::angleAxis(0.02, glm::dvec3(0.0, 0.6, 0.8));
        }
        const planning::PlanRequest request{
            .camera = camera, .states = world.states, .previous = planning::PreviousFrame{before, earlier}};
        const scene::FramePlan now = world.planner->plan(request).plan;
        const std::vector<glm::mat4> parts_now = now.parts;
        renderer->prepare_truth(now);
        TruthPicture truth(picture_px);
        renderer->draw_truth(now, truth.arrays());
        // The parts as a plan of the earlier frame has them.
        planning::Planner other(world.world.scene, world.settings);
        const scene::FramePlan& then = other.plan({before, earlier}).plan;
        REQUIRE(then.parts.size() == parts_now.size());
        const glm::dmat4 then_clip = glm::dmat4(then.view_to_clip) * glm::dmat4(then.world_to_view);
        const glm::dmat3 to_view = glm::dmat3(glm::mat3(now.world_to_view));
        for (int row = 0; row < picture_px.y; ++row) {
            for (int column = 0; column < picture_px.x; ++column) {
                const std::size_t pixel = truth.at(column, row);
                if (truth.class_id[pixel] == 0 || truth.class_id[pixel] > 7) { continue; }
                const auto depth_m = static_cast<double>(truth.depth_m[pixel]);
                const glm::dvec3 way = way_of(now, column, row);
                const glm::dvec3 at_m = glm::inverse(to_view) * (way * depth_m);
                const auto place_of = [&](const glm::dvec3& place_m) {
                    const glm::dvec4 clip = then_clip * glm::dvec4(place_m, 1.0);
                    return glm::dvec2((clip.x / clip.w + 1.0) * 0.5 * picture_px.x - 0.5,
                        (1.0 - clip.y / clip.w) * 0.5 * picture_px.y - 0.5);
                };
                const auto is_there = [&](const glm::dvec3& place_m) {
                    const glm::dvec2 flow = glm::dvec2(column, row) - place_of(place_m);
                    return glm::distance(flow, glm::dvec2(truth.flow_px[pixel])) < 0.02;
                };
                ++points;
                if (truth.object_id[pixel] == 0) {
                    CHECK(is_there(at_m + camera.eye_m - before.eye_m));
                    continue;
                }
                // One of the parts of the aircraft must have moved it so.
                bool found = false;
                bool of_part = false;
                for (std::size_t part = 0; part < parts_now.size() && !found; ++part) {
                    const glm::dmat4 moved = glm::dmat4(then.parts[part]) * glm::inverse(glm::dmat4(parts_now[part]));
                    found = is_there(glm::dvec3(moved * glm::dvec4(at_m, 1.0)));
                    of_part = part != 0 && parts_now[part] != parts_now[0];
                }
                parts += found && of_part ? 1 : 0;
                CHECK(found);
            }
        }
    }
    CHECK(points > 40000);
    CHECK(parts > 100);
}

TEST_CASE("without a previous picture there is no flow, and an aircraft that was absent has none") {
    TruthWorld world(low_settings("hills", {"f15"}));
    const auto renderer = world.renderer();
    RandomGenerator dice(8);
    const scene::Camera camera = world.random_camera(dice);
    world.put_aircraft(camera, dice, 30.0, 1.0);
    const TruthPicture still = world.truth(*renderer, {camera, world.states});
    CHECK(std::ranges::all_of(still.flow_px, [](const glm::vec2& flow) { return std::isnan(flow.x); }));
    std::vector<sim::AircraftState> absent = world.states;
    absent[0].is_present = false;
    const TruthPicture came = world.truth(
        *renderer, {.camera = camera, .states = world.states, .previous = planning::PreviousFrame{camera, absent}});
    int aircraft = 0;
    for (std::size_t i = 0; i < came.flow_px.size(); ++i) {
        const bool is_aircraft = came.object_id[i] == 1;
        aircraft += is_aircraft ? 1 : 0;
        CHECK(std::isnan(came.flow_px[i].x) == is_aircraft);
        if (!is_aircraft) { CHECK(glm::length(came.flow_px[i]) < 1e-3F); }
    }
    CHECK(aircraft > 50);
}

TEST_CASE("the coverage of a pixel is the share that its object fills") {
    settings::RunSettings wanted = low_settings("hills", {"f15", "500md"});
    TruthWorld world(wanted);
    RandomGenerator dice(9);
    const scene::Camera camera = world.random_camera(dice);
    world.put_aircraft(camera, dice, 60.0, 15.0);
    const scene::FramePlan& plan = world.planner->plan({camera, world.states}).plan;
    const auto renderer = world.renderer();
    renderer->draw(plan);
    TruthPicture truth(picture_px);
    renderer->draw_truth(plan, truth.arrays());
    // The same plan in a picture of eight times the size, each pixel one sample.
    constexpr int scale = 8;
    raster::Renderer large(std::make_shared<ThreadPool>(1), picture_px * scale, 1);
    large.load_models(world.models);
    large.prepare_truth(plan);
    TruthPicture fine(picture_px * scale);
    large.draw_truth(plan, fine.arrays());
    double error = 0.0;
    int partly = 0;
    for (int row = 0; row < picture_px.y; ++row) {
        for (int column = 0; column < picture_px.x; ++column) {
            const std::size_t pixel = truth.at(column, row);
            int same = 0;
            for (int k = 0; k < scale * scale; ++k) {
                const std::size_t part = fine.at(column * scale + k % scale, row * scale + k / scale);
                same += fine.class_id[part] == truth.class_id[pixel] && fine.object_id[part] == truth.object_id[pixel];
            }
            const double share = same / static_cast<double>(scale * scale);
            const auto own = static_cast<double>(truth.coverage[pixel]);
            if (share == 1.0) { CHECK(own == 1.0); }
            partly += share < 1.0 ? 1 : 0;
            error += std::abs(share - own);
            CHECK(std::abs(share - own) < 0.35);
        }
    }
    CHECK(partly > 200);
    CHECK(error / partly < 0.06);
}

TEST_CASE("clouds count where they hide half of what is behind them, at the depth of their layer") {
    settings::RunSettings wanted = low_settings("hills", {"f15"});
    wanted.air.clouds = 0.6;
    TruthWorld world(wanted);
    const auto renderer = world.renderer();
    const glm::dvec3 eye_m(0.0, 0.0, world.ground_m(0.0, 0.0) + 50.0);
    scene::Camera camera = scene::camera_looking_at(eye_m, eye_m + glm::dvec3(0.2, 1.0, 0.6));
    world.states[0].is_present = false;
    const scene::FramePlan& plan = world.planner->plan({camera, world.states}).plan;
    renderer->draw(plan);
    TruthPicture truth(picture_px);
    renderer->draw_truth(plan, truth.arrays());
    const glm::dmat3 from_view = glm::inverse(glm::dmat3(glm::mat3(plan.world_to_view)));
    int clouds = 0;
    int sky = 0;
    for (int row = 0; row < picture_px.y; ++row) {
        for (int column = 0; column < picture_px.x; ++column) {
            const std::size_t pixel = truth.at(column, row);
            sky += truth.class_id[pixel] == 0 ? 1 : 0;
            if (truth.class_id[pixel] != static_cast<std::uint8_t>(scene::SurfaceClass::Cloud)) { continue; }
            ++clouds;
            const glm::dvec3 way = way_of(plan, column, row);
            const glm::dvec3 at_m = from_view * (way * static_cast<double>(truth.depth_m[pixel]));
            const double sunk_m = (at_m.x * at_m.x + at_m.y * at_m.y) /
                                  (2.0 * std::max(static_cast<double>(plan.truth.water.earth_radius_m), 1e6));
            CHECK(std::abs(at_m.z + sunk_m - static_cast<double>(plan.truth.cloud_height_m)) < 2.0);
        }
    }
    CHECK(clouds > 1000);
    CHECK(sky > 1000);
}

TEST_CASE("the truth of two hundred views is what rays meet", "[.many]") {
    RayCheck sum;
    std::uint64_t seed = 100;
    for (const std::string& terrain : {std::string("hills"), std::string("canyon"), coast_map(), small_map()}) {
        for (const scene::HiddenSurface way : {scene::HiddenSurface::Octant, scene::HiddenSurface::DepthBuffer}) {
            settings::RunSettings wanted = low_settings(terrain, {"f15", "500md", "f15-detailed"});
            wanted.surface.hidden_surface = way;
            wanted.ground.airfield = terrain == "hills";
            TruthWorld world(wanted);
            const RayCheck check = check_views(world, 25, ++seed, 12.0);
            sum.pixels += check.pixels;
            sum.aircraft += check.aircraft;
            sum.wrong += check.wrong;
            fmt::print("{} {}: {} pixels, {} of aircraft, {} wrong\n", terrain, static_cast<int>(way), check.pixels,
                check.aircraft, check.wrong);
        }
    }
    CHECK(sum.wrong == 0);
}

TEST_CASE("truth speed", "[.speed]") {
    settings::RunSettings wanted = low_settings("hills", {"f15-detailed"});
    wanted.view.size_px = {128, 128};
    TruthWorld world(wanted);
    const auto renderer = world.renderer();
    RandomGenerator dice(4);
    std::array<double, 6> seconds{};
    const auto cpu_s = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
    const int views = 300;
    TruthPicture picture(world.settings.view.size_px);
    for (int view = 0; view < views; ++view) {
        const scene::Camera camera = world.random_camera(dice);
        world.put_aircraft(camera, dice, 60.0, 5.0);
        scene::Camera before = camera;
        before.eye_m -= glm::dvec3(1.0);
        const planning::PlanRequest request{
            .camera = camera, .states = world.states, .previous = planning::PreviousFrame{before, world.states}};
        world.planner->plan(request);
        double last = cpu_s();
        const auto stage = [&](std::size_t i) {
            const double now = cpu_s();
            seconds[i] += now - last;
            last = now;
        };
        const scene::FramePlan& plan = world.planner->plan(request).plan;
        stage(0);
        renderer->draw(plan);
        stage(1);
        scene::TruthArrays to = picture.arrays();
        to.coverage = nullptr;
        to.previous_px = nullptr;
        renderer->draw_truth(plan, to);
        stage(2);
        to.flow_px = nullptr;
        renderer->draw_truth(plan, to);
        stage(3);
        renderer->draw_truth(plan, {.class_id = picture.class_id.data()});
        stage(4);
        renderer->draw_truth(plan, picture.arrays());
        stage(5);
    }
    fmt::print("ms: plan {:.3f}, draw {:.3f}, truth {:.3f}, without flow {:.3f}, class {:.3f}, with coverage {:.3f}\n",
        seconds[0] / views * 1e3, seconds[1] / views * 1e3, seconds[2] / views * 1e3, seconds[3] / views * 1e3,
        seconds[4] / views * 1e3, seconds[5] / views * 1e3);
}
