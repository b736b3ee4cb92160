#include "models/polygons/obj_reader.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/planning/transparents.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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

/// The model with an order that is right for every eye at every angle of its rotors.
AircraftModel ordered_aircraft(const PolygonModel& model) {
    visuals::draworder::OrderedModel ordered = visuals::draworder::ordered(model);
    return aircraft_model(std::move(ordered.model), std::move(ordered.order), glm::dvec3(0.0));
}

/// What of one aircraft at the origin an eye in its body axes sees.
struct Painted {
    std::size_t before = 0; ///< triangles of effects before the aircraft
    std::size_t after = 0;
    std::size_t discs = 0; ///< triangles of discs
    int polygons = 0;      ///< of the aircraft itself
    std::optional<AxisAlignedBox> bounds;
    std::vector<float> depths; ///< of the triangles in their order, as OverlayVertex::depth
};

Painted painted(const PolygonModel& model, const glm::dvec3& eye_m, double load_factor = 1.0,
    std::span<const ArticulatedPart> articulated_parts = {}, const SurfaceSettings& surface = {.effects = true}) {
    Scene scene;
    scene.ground = cell_ground(2, 10.0, [](double, double) { return -500.0; });
    scene.add_model(convex_aircraft(model));
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
    Painted painted;
    painted.polygons = std::as_const(fleet).placed().front().polygon_count;
    painted.bounds = transparents.effect_bounds().front();
    const OverlayDraw draw = transparents.draw();
    for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
        painted.depths.push_back(draw.vertices[draw.indices[i]].depth);
    }
    for (const Transparent& one : transparents.list()) {
        using enum Transparent::Place;
        (one.place == InFront     ? painted.after
            : one.place == Behind ? painted.before
                                  : painted.discs) += one.range.count / 3;
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

namespace {

/// A fuselage between two propellers whose planes it crosses, each before its nacelle.
PolygonModel twin() {
    PolygonModel model = box_model({6.0, 0.8, 0.9});
    for (const double side : {-1.0, 1.0}) {
        add_part(model, "nacelle " + std::to_string(side), {0.0, 2.6 * side, 0.2}, {1.5, 0.4, 0.4});
        const glm::dvec3 hub_m(1.8, 2.6 * side, 0.2);
        add_part(model, "propeller " + std::to_string(side), hub_m, {0.03, 1.5, 0.1});
        model.pivots.push_back(
            {static_cast<std::uint32_t>(model.parts.size() - 1), hub_m, {1.0, 0.0, 0.0}, 20.0 * side});
    }
    return model;
}

/// How far along a direction from the eye at the origin a polygon is hit from its front.
std::optional<double> hit(const ViewPolygon& polygon, const glm::dvec3& along) {
    const glm::dvec3& first_m = polygon[0].at_m;
    const glm::dvec3 normal = glm::cross(polygon[1].at_m - first_m, polygon[2].at_m - first_m);
    if (glm::dot(normal, along) >= 0.0) { return std::nullopt; }
    const double away = glm::dot(normal, first_m) / glm::dot(normal, along);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& from_m = polygon[i].at_m;
        const glm::dvec3& to_m = polygon[(i + 1) % polygon.size()].at_m;
        if (glm::dot(glm::cross(to_m - from_m, away * along - from_m), normal) < 0.0) { return std::nullopt; }
    }
    return away > 0.0 ? std::optional(away) : std::nullopt;
}

/// Along lines of sight through discs: how often something is seen before and behind them, and how often that is
/// painted on the wrong side.
struct Passed {
    int before = 0;
    int behind = 0;
    int wrong = 0;
};

void look_through(const PlacedAircraft& aircraft, std::size_t number, PlaceDice& dice, Passed& passed) {
    const PlacedDisc& disc = aircraft.discs[number];
    const WorldCircle circle = place_disc(*aircraft.model, aircraft.parts, disc.disc, disc.side);
    const glm::dvec3 aside = glm::normalize(glm::cross(circle.axis, dice.direction()));
    const glm::dvec3 point_m = circle.centre_m + std::sqrt(dice.between(0.01, 0.99)) * circle.radius_m * aside;
    const auto count = [&](double away, bool is_painted_later) {
        if (std::abs(away - 1.0) < 1e-6) { return; }
        ++(away < 1.0 ? passed.before : passed.behind);
        passed.wrong += (away < 1.0) != is_painted_later ? 1 : 0;
    };
    ViewPolygon polygon;
    for (std::size_t r = 0; r < aircraft.ranges.size(); ++r) {
        const IndexRange& range = aircraft.ranges[r];
        for (const std::uint32_t i :
            aircraft.list.subspan(range.first_polygon, static_cast<std::size_t>(range.polygons))) {
            place_polygon(aircraft, i, polygon);
            if (const auto away = hit(polygon, point_m)) { count(*away, r >= disc.range); }
        }
    }
    for (std::size_t other = 0; other < aircraft.discs.size(); ++other) {
        const WorldCircle met =
            place_disc(*aircraft.model, aircraft.parts, aircraft.discs[other].disc, aircraft.discs[other].side);
        const double away = glm::dot(met.centre_m, met.axis) / glm::dot(point_m, met.axis);
        const bool is_met = away > 0.0 && glm::distance(away * point_m, met.centre_m) < met.radius_m;
        if (other != number && is_met) { count(away, other > number); }
    }
}

Passed look_through_discs(const PolygonModel& model, std::size_t discs) {
    Scene scene = small_scene({ordered_aircraft(model)}, {0});
    const Settings settings = plain_settings();
    Fleet fleet(scene, settings);
    PlaceDice dice(7);
    Passed passed;
    std::size_t most = 0;
    for (int eye = 0; eye < 300; ++eye) {
        std::array states{state_at({0.0, 0.0, 0.0}, dice.attitude())};
        states.front().time_s = dice.between(0.0, 1.0);
        const Camera camera = camera_looking_at(dice.direction() * dice.between(5.0, 40.0), {0.0, 0.0, 0.0});
        fleet.place(frame_view(camera, {640, 480}, 0.0), {.camera = camera, .states = states},
            std::array{std::optional<AxisAlignedBox>()});
        const PlacedAircraft& aircraft = std::as_const(fleet).placed().front();
        most = std::max(most, aircraft.discs.size());
        for (std::size_t disc = 0; disc < aircraft.discs.size(); ++disc) {
            for (int ray = 0; ray < 40; ++ray) { look_through(aircraft, disc, dice, passed); }
        }
    }
    CHECK(most == discs);
    return passed;
}

} // namespace

TEST_CASE("what is before a disc is painted after it and what is behind it before, whatever plane it lies in") {
    for (const PolygonModel& model :
        {models::polygons::read_obj(OCTANT_SOURCE_DIR "/models/500md.obj"), twin(), helicopter(-1.6)}) {
        INFO(model.name << " of " << model.parts.size() << " parts");
        const Passed passed = look_through_discs(model, model.pivots.size());
        CHECK(passed.before > 500);
        CHECK(passed.behind > 500);
        CHECK(passed.wrong == 0);
    }
}

TEST_CASE("fast rotors are discs in place of their blades; slow and held ones and the paper's order have blades") {
    const glm::dvec3 above_m(-20.0, 3.0, -15.0);
    PolygonModel model = helicopter(-1.6);
    const SurfaceSettings usual;
    CHECK(painted(model, above_m, 1.0, {}, usual).discs > 0);
    CHECK(painted(model, above_m, 1.0, {}, usual).polygons == 6);
    CHECK_FALSE(painted(model, above_m, 1.0, {}, usual).bounds); // its blades are in the model's own
    const std::vector<ArticulatedPart> of_another{{1, 0}};
    const std::vector<ArticulatedPart> held{{0, 0}};
    CHECK(painted(model, above_m, 1.0, of_another).discs > 0);
    CHECK(painted(model, above_m, 1.0, held).discs == 0);
    CHECK(painted(model, above_m, 1.0, held).polygons == 12);
    const Painted paper = painted(model, above_m, 1.0, {}, {.order_method = visuals::draworder::OrderMethod::Paper});
    CHECK(paper.discs == 0);
    CHECK(paper.polygons == 12);
    const Painted without = painted(model, above_m, 1.0, {}, {.effects = false});
    CHECK(without.discs == 0);
    CHECK(without.polygons == 12);
    model.pivots.front().turns_per_s = 0.0;
    CHECK(painted(model, above_m, 1.0, {}, usual).discs == 0);
    CHECK(painted(jet(), {-60.0, 3.0, -5.0}, 1.0, {}, usual).after == 0); // plumes need the setting
}

TEST_CASE(
    "what fills its circle, as the fan of a jet, is drawn as it stands, and so is a hub without the roots of blades") {
    PolygonModel fan = box_model({4.0, 0.8, 1.0});
    add_part(fan, "fan", {4.5, 0.0, 0.0}, {0.1, 0.7, 0.7});
    fan.pivots.push_back({1, {4.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, 80.0});
    const glm::dvec3 ahead_m(20.0, 3.0, -5.0);
    CHECK(painted(fan, ahead_m).discs == 0);
    CHECK(painted(fan, ahead_m).polygons == 12);
    PolygonModel with_hub = helicopter(-1.6);
    add_part(with_hub, "hub", {0.0, 0.0, -1.7}, {0.4, 0.4, 0.1});
    add_part(with_hub, "root of a blade", {0.7, 0.0, -1.6}, {0.4, 0.05, 0.05}); // no farther out than a large hub
    for (std::size_t i = 12; i < 24; ++i) { with_hub.polygons[i].part = 1; }    // one part with the blades
    CHECK(painted(with_hub, {-20.0, 3.0, -15.0}).discs > 0);
    CHECK(painted(with_hub, {-20.0, 3.0, -15.0}).polygons == 6 + 7); // body, hub and the end within it
}

TEST_CASE("blades and spinner that turn in one place have one disc, two rotors one each") {
    const glm::dvec3 above_m(-20.0, 3.0, -15.0);
    PolygonModel model = helicopter(-1.6);
    const std::size_t one = painted(model, above_m).discs;
    const auto add_rotor = [&](const glm::dvec3& at_m, const glm::dvec3& half_m) {
        add_part(model, "rotor " + std::to_string(model.parts.size()), at_m, half_m);
        model.pivots.push_back({static_cast<std::uint32_t>(model.parts.size() - 1), at_m, {0.0, 0.0, -1.0}, 8.0});
    };
    add_rotor({0.0, 0.0, -1.6}, {0.1, 4.0, 0.02}); // a second pair of blades
    add_rotor({0.0, 0.0, -1.7}, {0.3, 0.3, 0.1});  // the cap of the hub
    CHECK(painted(model, above_m).discs == one);
    CHECK(painted(model, above_m).polygons == 12); // the body and the cap
    add_rotor({9.0, 0.0, -1.6}, {0.1, 4.0, 0.02});
    CHECK(painted(model, above_m).discs > one + one / 2);
}

TEST_CASE("without a painting order the far one of two discs is first, whichever comes first in the model") {
    PolygonModel model = helicopter(-1.6);
    const glm::dvec3 at_m(9.0, 0.0, -1.6);
    add_part(model, "fore rotor", at_m, {0.1, 4.0, 0.02});
    model.pivots.push_back({static_cast<std::uint32_t>(model.parts.size() - 1), at_m, {0.0, 0.0, -1.0}, 8.0});
    const SurfaceSettings by_depth{.hidden_surface = HiddenSurface::DepthBuffer};
    for (const double eye_x_m : {-30.0, 40.0}) {
        const std::vector<float> depths = painted(model, {eye_x_m, 3.0, -15.0}, 1.0, {}, by_depth).depths;
        REQUIRE(depths.size() > 100);
        CHECK(depths.front() < depths.back());
    }
}

TEST_CASE("a disc has finer circles near the eye and is gone far away") {
    const PolygonModel model = helicopter(-1.6);
    const std::size_t near = painted(model, {-10.0, 3.0, -10.0}).discs;
    const std::size_t far = painted(model, {-100.0, 3.0, -100.0}).discs;
    CHECK(near > far);
    CHECK(far > 0);
    CHECK(painted(model, {-100.0, 3.0, -100.0}).polygons == 6);
    const glm::dvec3 farther_m(-240.0, 3.0, -240.0); // where it fades the blades are there, too
    CHECK(painted(model, farther_m).discs > 0);
    CHECK(painted(model, farther_m).polygons == 12);
    CHECK(painted(model, {-800.0, 3.0, -800.0}).discs == 0);
    CHECK(painted(model, {-800.0, 3.0, -800.0}).polygons == 12);
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
        scene.add_model(ordered_aircraft(helicopter(rotor_down_m)));
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
    CHECK(letters.find("cdat") != std::string::npos);
    CHECK(letters.find('A') == std::string::npos); // between its polygons and those of the ground there is no place
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
