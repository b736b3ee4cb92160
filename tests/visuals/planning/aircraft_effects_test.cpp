#include "visuals/planning/transparents.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;
using models::polygons::PolygonModel;

namespace {

/// Adds one more box as a part of its own.
void add_part(PolygonModel& model, const std::string& name, const glm::dvec3& at_m, const glm::dvec3& half_m) {
    const PolygonModel box = box_model(half_m);
    const auto vertices = static_cast<std::uint32_t>(model.vertices_m.size());
    const auto corners = static_cast<std::uint32_t>(model.corner_vertices.size());
    model.parts.push_back(name);
    for (const glm::dvec3& vertex_m : box.vertices_m) { model.vertices_m.push_back(vertex_m + at_m); }
    for (const std::uint32_t corner : box.corner_vertices) { model.corner_vertices.push_back(corner + vertices); }
    for (models::polygons::Polygon polygon : box.polygons) {
        polygon.first_corner += corners;
        polygon.part = static_cast<std::uint32_t>(model.parts.size() - 1);
        model.polygons.push_back(polygon);
    }
}

PolygonModel jet() {
    PolygonModel model = box_model({8.0, 5.0, 1.0});
    add_part(model, "nozzle_right", {-8.5, 1.0, 0.0}, {0.5, 0.6, 0.6});
    add_part(model, "nozzle_left", {-8.5, -1.0, 0.0}, {0.5, 0.6, 0.6});
    return model;
}

PolygonModel helicopter(double rotor_down_m) {
    PolygonModel model = box_model({4.0, 0.8, 1.0});
    add_part(model, "rotor", {0.0, 0.0, rotor_down_m}, {4.0, 0.1, 0.02});
    model.pivots.push_back({1, {0.0, 0.0, rotor_down_m}, {0.0, 0.0, -1.0}, 8.0});
    return model;
}

/// Triangles before and after the aircraft, for an eye at a place of its body axes, and those without a place.
struct Painted {
    std::size_t before = 0;
    std::size_t after = 0;
    std::size_t unordered = 0;
    std::optional<AxisAlignedBox> bounds;
    std::vector<float> depths; ///< of the triangles in their order, as OverlayVertex::depth
};

Painted painted(const PolygonModel& model, const glm::dvec3& eye_m, double load_factor = 1.0,
    std::span<const ArticulatedPart> articulated_parts = {}, const SurfaceSettings& surface = {.effects = true},
    bool has_mesh = false) {
    Scene scene;
    scene.ground = cell_ground(2, 10.0, [](double, double) { return -500.0; });
    AircraftModel aircraft = convex_aircraft(model);
    const models::TriangleMesh mesh = models::polygons::mesh_from_polygons(model);
    if (has_mesh) { add_levels(aircraft, std::vector{MeshSource{&mesh, 0.0}}, 0.1); }
    scene.add_model(std::move(aircraft));
    scene.aircraft = {0};
    Settings settings = plain_settings();
    settings.surface = surface;
    const Camera camera = camera_looking_at(eye_m, {0.0, 0.0, 0.0});
    FramePlan plan;
    plan.world_to_view = world_to_view(camera);
    plan.view_to_clip = view_to_clip(camera, 1.0);
    std::array states{state_at({0.0, 0.0, 0.0})};
    states.front().load_factor = load_factor;
    const PlanRequest request{.camera = camera, .states = states, .articulated_parts = articulated_parts};
    const FrameView view = frame_view(camera, {400, 400}, 0.0);
    Transparents transparents(scene, settings, visuals::nature::Daylight({}));
    Fleet fleet(scene, settings);
    fleet.place(view, request, transparents.effect_bounds());
    transparents.make(view, request, fleet, plan);
    Painted painted{0, 0, 0, transparents.effect_bounds().front(), {}};
    const OverlayDraw draw = transparents.draw();
    for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
        painted.depths.push_back(draw.vertices[draw.indices[i]].depth);
    }
    for (const Transparent& one : transparents.list()) {
        using enum Transparent::Place;
        (one.place == InFront     ? painted.after
            : one.place == Behind ? painted.before
                                  : painted.unordered) += one.range.count / 3;
    }
    return painted;
}

} // namespace

TEST_CASE("a plume is painted after the aircraft for eyes behind it, else before") {
    const Painted from_behind = painted(jet(), {-60.0, 3.0, -5.0});
    CHECK(from_behind.before == 0);
    CHECK(from_behind.after > 20);
    const Painted from_ahead = painted(jet(), {60.0, 3.0, -5.0});
    CHECK(from_ahead.before > 20);
    CHECK(from_ahead.after == 0);
    CHECK(from_ahead.bounds->min_m.x < -11.0);
}

TEST_CASE("vapour lies beyond each wingtip and only under load") {
    const Painted with = painted(jet(), {10.0, 60.0, -5.0}, 6.0);
    const Painted without = painted(jet(), {10.0, 60.0, -5.0});
    CHECK(with.after > without.after);   // of the right wingtip
    CHECK(with.before > without.before); // of the left one
}

TEST_CASE("a disc is painted beside its aircraft where a plane parts it from the rest, else by depth on meshes") {
    const glm::dvec3 above_m(-20.0, 3.0, -15.0);
    const PolygonModel model = helicopter(-1.6);
    CHECK(painted(model, above_m).after > 0);
    CHECK(painted(model, above_m).before == 0);
    CHECK(painted(model, {-20.0, 3.0, 15.0}).before > 0);
    CHECK(painted(model, {-20.0, 3.0, 15.0}).after == 0);
    const PolygonModel amid = helicopter(0.0);
    CHECK(painted(amid, above_m).after + painted(amid, above_m).before + painted(amid, above_m).unordered == 0);
    CHECK(painted(amid, above_m, 1.0, {}, {.effects = true}, true).unordered > 0);
    CHECK(painted(model, above_m, 1.0, {}, {.effects = true}, true).unordered == 0);
}

TEST_CASE("fast rotors have discs without a setting; slow and held ones and the paper's order have none") {
    const glm::dvec3 above_m(-20.0, 3.0, -15.0);
    PolygonModel model = helicopter(-1.6);
    const SurfaceSettings usual;
    CHECK(painted(model, above_m, 1.0, {}, usual).after > 0);
    const std::optional<AxisAlignedBox> bounds = painted(model, above_m, 1.0, {}, usual).bounds;
    REQUIRE(bounds);
    CHECK(glm::distance(bounds->min_m, glm::dvec3(-4.0, -4.0, -1.66)) < 0.01); // flat, just above the blades
    CHECK(glm::distance(bounds->max_m, glm::dvec3(4.0, 4.0, -1.66)) < 0.01);
    const std::vector<ArticulatedPart> of_another{{1, 0}};
    const std::vector<ArticulatedPart> held{{0, 0}};
    CHECK(painted(model, above_m, 1.0, of_another).after > 0);
    CHECK(painted(model, above_m, 1.0, held).after == 0);
    CHECK(painted(model, above_m, 1.0, {}, {.order_method = visuals::draworder::OrderMethod::Paper}).after == 0);
    model.pivots.front().turns_per_s = 0.0;
    CHECK(painted(model, above_m, 1.0, {}, usual).after == 0);
    CHECK(painted(jet(), {-60.0, 3.0, -5.0}, 1.0, {}, usual).after == 0); // plumes need the setting
}

TEST_CASE("blades and spinner that turn in one place have one disc, two rotors one each") {
    const glm::dvec3 above_m(-20.0, 3.0, -15.0);
    PolygonModel model = helicopter(-1.6);
    const std::size_t one = painted(model, above_m).after;
    const auto add_rotor = [&](const glm::dvec3& at_m, const glm::dvec3& half_m) {
        add_part(model, "rotor " + std::to_string(model.parts.size()), at_m, half_m);
        model.pivots.push_back({static_cast<std::uint32_t>(model.parts.size() - 1), at_m, {0.0, 0.0, -1.0}, 8.0});
    };
    add_rotor({0.0, 0.0, -1.6}, {0.1, 4.0, 0.02}); // a second pair of blades
    add_rotor({0.0, 0.0, -1.7}, {0.3, 0.3, 0.1});  // the cap of the hub
    CHECK(painted(model, above_m).after == one);
    add_rotor({9.0, 0.0, -1.6}, {0.1, 4.0, 0.02});
    CHECK(painted(model, above_m).after > one + one / 2);
}

TEST_CASE("of two rotors the far one's disc is painted first, whichever comes first in the model") {
    PolygonModel model = helicopter(-1.6);
    const glm::dvec3 at_m(9.0, 0.0, -1.6);
    add_part(model, "fore rotor", at_m, {0.1, 4.0, 0.02});
    model.pivots.push_back({static_cast<std::uint32_t>(model.parts.size() - 1), at_m, {0.0, 0.0, -1.0}, 8.0});
    for (const double eye_x_m : {-30.0, 40.0}) {
        const std::vector<float> depths = painted(model, {eye_x_m, 3.0, -15.0}).depths;
        REQUIRE(depths.size() > 100);
        CHECK(depths.front() < depths.back());
    }
}

TEST_CASE("a disc has finer circles near the eye and is gone far away") {
    const PolygonModel model = helicopter(-1.6);
    const std::size_t near = painted(model, {-10.0, 3.0, -10.0}).after;
    const std::size_t far = painted(model, {-100.0, 3.0, -100.0}).after;
    CHECK(near > far);
    CHECK(far > 0);
    CHECK(painted(model, {-800.0, 3.0, -800.0}).after == 0);
}

TEST_CASE("afterburners follow thrust, vapour follows load") {
    const sim::AircraftKind* const f15 = sim::find_aircraft_kind("f15");
    sim::AircraftState state = state_at({0.0, 0.0, 500.0});
    state.velocity_mps = {200.0, 0.0, 0.0};
    state.load_factor = 1.0;
    CHECK(strength_of(f15, state).burner == 0.0);
    CHECK(strength_of(f15, state).vapour == 0.0);
    // At 6.5 g and a constant speed the drag is far above the dry thrust of 0.6 x 195 kN ...
    state.load_factor = 6.5;
    CHECK(strength_of(f15, state).burner > 0.9);
    CHECK(strength_of(f15, state).vapour == 1.0);
    // ... but not where the speed pays for it.
    state.speed_rate_mps2 = -9.0;
    CHECK(strength_of(f15, state).burner == 0.0);
    // A climb of 45 degrees: 118 kN of weight and some 25 kN of drag at a constant speed; none where speed is lost as
    // fast as gravity takes it.
    state.load_factor = 0.7;
    state.velocity_mps = {150.0, 0.0, 150.0};
    state.speed_rate_mps2 = 0.0;
    CHECK(strength_of(f15, state).burner > 0.3);
    CHECK(strength_of(nullptr, state).burner > 0.3);
    CHECK(strength_of(sim::find_aircraft_kind("500md"), state).burner == 0.0);
    CHECK(strength_of(f15, state).vapour == 0.0);
    state.speed_rate_mps2 = -7.0;
    CHECK(strength_of(f15, state).burner == 0.0);
    // A dive of 20 degrees that gains 10 m/s every second needs 113 kN beside 33 kN of drag.
    state.load_factor = 0.94;
    state.velocity_mps = {206.7, 0.0, -75.2};
    state.speed_rate_mps2 = 10.0;
    CHECK(strength_of(f15, state).burner > 0.9);
}

namespace {

/// Helicopters over level ground.
struct Helicopters {
    Scene scene;
    Settings settings = plain_settings();
    std::vector<sim::AircraftState> states;

    explicit Helicopters(const std::vector<glm::dvec3>& places_m, double rotor_down_m = -1.6) {
        scene.ground = cell_ground(20, 10.0, [](double, double) { return 0.0; });
        scene.add_model(convex_aircraft(helicopter(rotor_down_m)));
        for (const glm::dvec3& place_m : places_m) {
            scene.aircraft.push_back(0);
            states.push_back(state_at(place_m, {0.0, 1.0, 0.0, 0.0})); // upright, heading east
        }
    }
};

/// The contents of a plan's steps, one letter each: A aircraft, T transparent,
/// t transparent by depth, d depth alone, c depth cleared, a aircraft by depth, G any other.
std::string letters_of(const FramePlan& plan) {
    std::string letters;
    for (const PaintStep& step : plan.steps) {
        const bool by_depth = step.depth == DepthUse::Nearest;
        switch (step.content) {
        case PaintStep::Content::ClearDepth:
            letters += 'c';
            break;
        case PaintStep::Content::Aircraft:
            letters += by_depth ? 'a' : 'A';
            break;
        case PaintStep::Content::Transparent:
            letters += by_depth ? 't' : 'T';
            break;
        default:
            letters += step.depth == DepthUse::DepthOnly ? 'd' : 'G';
        }
    }
    return letters;
}

std::string letters_of(Helicopters& world, const Camera& camera) {
    Planner planner(world.scene, world.settings);
    return letters_of(planner.plan({camera, world.states}).plan);
}

} // namespace

TEST_CASE("a disc follows its aircraft for eyes above it and comes before it for eyes below, both without depth") {
    Helicopters world({{0.0, 0.0, 60.0}});
    CHECK(letters_of(world, camera_looking_at({-30.0, 5.0, 90.0}, {0.0, 0.0, 60.0})) == "GAT");
    CHECK(letters_of(world, camera_looking_at({-30.0, 5.0, 40.0}, {0.0, 0.0, 60.0})) == "GTA");
}

TEST_CASE("a disc is hidden by the ground that reaches into its aircraft's box") {
    Helicopters world({{0.0, 0.0, 0.5}}); // the skids are in the ground
    const std::string letters = letters_of(world, camera_looking_at({-30.0, 5.0, 20.0}, {0.0, 0.0, 0.5}));
    INFO(letters);
    CHECK(letters.find("cdt") != std::string::npos);
    CHECK(letters.find('a') == std::string::npos); // the aircraft itself is painted in order
}

TEST_CASE("aircraft in one another's boxes have depth with their discs, those apart have none") {
    const Camera camera = camera_looking_at({-30.0, 5.0, 90.0}, {0.0, 0.0, 60.0});
    Helicopters close({{0.0, 0.0, 60.0}, {3.0, 0.0, 61.0}});
    CHECK(letters_of(close, camera) == "Gcatt");
    Helicopters apart({{0.0, 0.0, 60.0}, {30.0, 0.0, 61.0}});
    CHECK(letters_of(apart, camera) == "GATAT");
}

TEST_CASE("with a depth buffer discs come last, from far to near") {
    Helicopters world({{0.0, 0.0, 60.0}, {30.0, 0.0, 61.0}});
    world.settings.surface.hidden_surface = HiddenSurface::DepthBuffer;
    const Camera camera = camera_looking_at({-30.0, 5.0, 90.0}, {0.0, 0.0, 60.0});
    Planner planner(world.scene, world.settings);
    const FramePlan& plan = planner.plan({camera, world.states}).plan;
    REQUIRE(letters_of(plan).ends_with("tt"));
    const auto depth_of = [&](const PaintStep& step) {
        return plan.overlay.vertices[plan.overlay.indices[step.first]].depth;
    };
    CHECK(depth_of(plan.steps.rbegin()[1]) < depth_of(plan.steps.back()));
}
