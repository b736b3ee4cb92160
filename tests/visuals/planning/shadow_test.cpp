#include "visuals/landscape/ground_palette.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::landscape;
using namespace octant::visuals::planning;
using namespace octant::visuals::scene;

namespace {

double rolling_m(double x_m, double y_m) { return 3.0 * std::sin(x_m / 12.0) + 2.0 * std::cos(y_m / 9.0); }

struct Shadowed {
    Scene scene;
    Settings settings = plain_settings();
    Camera camera = camera_looking_at({-60, -80, 90}, {0, 0, 0});
    std::vector<sim::AircraftState> states;

    Shadowed() {
        settings.surface.shadows = true;
        scene.ground = cell_ground(40, 10.0, rolling_m);
        scene.add_model(convex_aircraft(box_model({8.0, 2.0, 1.0})));
        scene.aircraft = {0, 0};
        states = {state_at({20, 10, 30}, glm::angleAxis(0.4, glm::normalize(glm::dvec3(1, 2, 3)))),
            state_at({-30, 20, 25}, glm::angleAxis(1.2, glm::normalize(glm::dvec3(3, -2, 1))))};
    }
};

struct Corners {
    std::array<glm::dvec3, 3> at;
};

Corners corners_of(const FramePlan& plan, std::span<const std::uint32_t> indices, std::size_t first) {
    Corners corners;
    const std::size_t own = plan.ground.vertices.size();
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t vertex = indices[first + i];
        corners.at[i] = glm::dvec3(
            vertex < own ? plan.ground.vertices[vertex].position_m : plan.shadow_vertices[vertex - own].position_m);
    }
    return corners;
}

double plan_side(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
    return ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / std::hypot(b.x - a.x, b.y - a.y);
}

double inside_m(const Corners& t, const glm::dvec3& p) {
    return std::min({plan_side(t.at[0], t.at[1], p), plan_side(t.at[1], t.at[2], p), plan_side(t.at[2], t.at[0], p)});
}

double off_plane_m(const Corners& t, const glm::dvec3& p) {
    return glm::dot(glm::normalize(glm::cross(t.at[1] - t.at[0], t.at[2] - t.at[0])), p - t.at[0]);
}

bool is_shadow(const FramePlan& plan, std::uint32_t index) { return index >= plan.ground.vertices.size(); }

std::uint32_t colour_of(const FramePlan& plan, std::uint32_t index) {
    return plan.shadow_vertices[index - plan.ground.vertices.size()].colour;
}

constexpr std::uint32_t darkest = 0xff464646U; ///< where no sun is left

/// Whether a sun ray from a point meets the box of an aircraft: -1 surely not, 1 surely, 0 close.
int in_the_way(const sim::AircraftState& state, const glm::dvec3& point_m, const glm::dvec3& to_sun) {
    const auto intersects = [&](double grown_m) {
        const glm::dquat to_body = glm::inverse(state.body_to_world);
        const glm::dvec3 half_m = glm::dvec3(8.0, 2.0, 1.0) + grown_m;
        const glm::dvec3 from = to_body * (point_m - state.position_m);
        const glm::dvec3 along = to_body * to_sun;
        double entry = 0.0;
        double leave = 1e9;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (-half_m[axis] - from[axis]) / along[axis];
            const double b = (half_m[axis] - from[axis]) / along[axis];
            entry = std::max(entry, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return entry < leave;
    };
    return intersects(-0.01) ? 1 : (intersects(0.01) ? 0 : -1);
}

/// The step that draws shadows on ground that was drawn by depth; null where there is none.
const PaintStep* step_on_ground(const FramePlan& plan) {
    const auto found = std::ranges::find(plan.steps, DepthUse::OnGround, &PaintStep::depth);
    return found == plan.steps.end() ? nullptr : &*found;
}

} // namespace

TEST_CASE("shadow pieces lie on the triangle before them, inside it, and face up") {
    Shadowed world;
    Planner planner(world.scene, world.settings);
    const PlannedFrame frame = planner.plan({world.camera, world.states});
    const FramePlan& plan = frame.plan;
    REQUIRE(frame.counts.shadow_triangles > 10);
    CHECK(step_on_ground(plan) == nullptr);
    Corners under;
    int pieces = 0;
    for (std::size_t i = 0; i < plan.ground.indices.size(); i += 3) {
        const Corners corners = corners_of(plan, plan.ground.indices, i);
        if (!is_shadow(plan, plan.ground.indices[i])) {
            under = corners;
            continue;
        }
        ++pieces;
        for (const glm::dvec3& corner : corners.at) {
            CHECK(std::abs(off_plane_m(under, corner)) < 1e-3);
            CHECK(inside_m(under, corner) > -1e-3);
        }
        CHECK(plan_side(corners.at[0], corners.at[1], corners.at[2]) > -1e-3);
    }
    CHECK(pieces == frame.counts.shadow_triangles);
}

TEST_CASE("ground is in shadow where the sun's ray meets an aircraft and nowhere else") {
    Shadowed world;
    Planner planner(world.scene, world.settings);
    const FramePlan& plan = planner.plan({world.camera, world.states}).plan;
    const glm::dvec3 to_sun(direction_to_sun(world.settings.air));
    PlaceDice dice(11);
    int dark = 0;
    for (std::size_t i = 0; i < plan.ground.indices.size(); i += 3) {
        if (is_shadow(plan, plan.ground.indices[i])) { continue; }
        const Corners t = corners_of(plan, plan.ground.indices, i);
        for (int k = 0; k < 10; ++k) {
            const double u = dice.next();
            const double v = dice.next() * (1.0 - u);
            const glm::dvec3 p = t.at[0] + (t.at[1] - t.at[0]) * u + (t.at[2] - t.at[0]) * v;
            double covered_m = -1e9; // how deep inside a piece of the whole shadow
            for (std::size_t n = i + 3; n < plan.ground.indices.size() && is_shadow(plan, plan.ground.indices[n]);
                 n += 3) {
                if (colour_of(plan, plan.ground.indices[n]) != darkest) { continue; } // of a penumbra
                covered_m = std::max(covered_m, inside_m(corners_of(plan, plan.ground.indices, n), p));
            }
            int expected = -1;
            for (const sim::AircraftState& state : world.states) {
                expected = std::max(expected, in_the_way(state, p + world.camera.eye_m, to_sun));
            }
            if (expected != 0 && inside_m(t, p) > 0.01) {
                CHECK((expected == 1) == (covered_m > -1e-3));
                dark += expected == 1 ? 1 : 0;
            }
        }
    }
    CHECK(dark > 20);
}

TEST_CASE("the whole of a shadow has one darkness and says for textures what light is left") {
    for (const bool textured : {false, true}) {
        Shadowed world;
        world.camera = camera_looking_at({-600, -800, 900}, {0, 0, 0}); // no penumbra is seen from here
        if (textured) {
            world.scene.ground_texture = std::make_shared<const GroundTexture>(
                GroundTexture{.albedo = {1, 1, {9, 9, 9}}, .normal = {1, 1, {128, 128}}});
        }
        Planner planner(world.scene, world.settings);
        const FramePlan& plan = planner.plan({world.camera, world.states}).plan;
        CHECK(!plan.shadow_vertices.empty());
        for (const models::ColourVertex& vertex : plan.shadow_vertices) {
            CHECK(vertex.colour == (textured ? 0x8c464646U : darkest));
        }
    }
}

namespace {

/// The colour of the last shadow piece that is painted on a place of level ground, 0 where there is none.
std::uint32_t painted_at(const FramePlan& plan, const glm::dvec3& place_m) {
    std::uint32_t seen = 0;
    for (std::size_t i = 0; i < plan.ground.indices.size(); i += 3) {
        if (is_shadow(plan, plan.ground.indices[i]) &&
            inside_m(corners_of(plan, plan.ground.indices, i), place_m) > 0.0) {
            seen = colour_of(plan, plan.ground.indices[i]);
        }
    }
    return seen;
}

} // namespace

TEST_CASE("half of a penumbra lies around a shadow, as wide as the sun makes it, and darkens inwards") {
    Scene scene;
    scene.ground = cell_ground(40, 20.0, [](double, double) { return 0.0; });
    scene.add_model(convex_aircraft(box_model({30.0, 30.0, 1.0})));
    scene.aircraft = {0};
    Settings settings = plain_settings();
    settings.surface.shadows = true;
    settings.air.sun_elevation_deg = 90.0;
    Planner planner(scene, settings);
    const Camera camera = camera_looking_at({60.0, 0.0, 60.0}, {30.0, 0.0, 0.0});
    for (const double height_m : {40.0, 200.0, 600.0}) {
        const std::vector states{state_at({0.0, 0.0, height_m})};
        const FramePlan& plan = planner.plan({camera, states}).plan;
        const double width_m = 0.5 * 0.0093 * height_m;
        /// At a distance from the shadow's own edge, in widths.
        const auto red_at = [&](double widths) {
            const std::uint32_t colour = painted_at(plan, glm::dvec3(30.0 + widths * width_m, 0.7, 0.0) - camera.eye_m);
            return colour == 0 ? 255U : colour & 255U;
        };
        CHECK(red_at(-0.1) == (darkest & 255U));
        CHECK(red_at(0.02) > (darkest & 255U));
        CHECK(red_at(0.45) < 255U);
        CHECK(red_at(1.01) == 255U);
        for (int tenths = 0; tenths < 9; ++tenths) {
            CHECK(red_at(0.1 * tenths + 0.05) <= red_at(0.1 * tenths + 0.15));
        }
    }
}

TEST_CASE("a shadow whose penumbra is wider than the aircraft's parts fades, and no aircraft's lightens another's") {
    Scene scene;
    scene.ground = cell_ground(40, 20.0, [](double, double) { return 0.0; });
    scene.add_model(convex_aircraft(box_model({5.0, 5.0, 1.0})));
    scene.aircraft = {0, 0};
    Settings settings = plain_settings();
    settings.surface.shadows = true;
    settings.air.sun_elevation_deg = 90.0;
    Planner planner(scene, settings);
    const Camera camera = camera_looking_at({60.0, 0.0, 60.0}, {0.0, 0.0, 0.0});
    const auto at = [&](std::vector<double> heights_m) {
        std::vector<sim::AircraftState> states;
        for (const double height_m : heights_m) { states.push_back(state_at({0.0, 0.0, height_m})); }
        const FramePlan plan = planner.plan({camera, states}).plan;
        return painted_at(plan, glm::dvec3(0.3, 0.7, 0.0) - camera.eye_m) & 255U;
    };
    const std::uint32_t low = at({20.0, 22.0});
    CHECK(low == 0x46U);
    CHECK(at({1500.0, 1510.0}) > low);
    for (const auto& both : {std::vector{20.0, 1500.0}, {1500.0, 20.0}}) { CHECK(at(both) == low); }
}

TEST_CASE("a fast rotor casts the faint shadow of a disc, the same at every angle") {
    Shadowed world;
    models::polygons::PolygonModel rotor = box_model({6.0, 0.2, 0.02});
    rotor.pivots.push_back({0, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 8.0});
    world.scene.models.clear();
    world.scene.add_model(convex_aircraft(rotor));
    world.scene.aircraft = {0};
    world.states = {state_at({20, 10, 30})};
    const auto shadow_at = [&](double time_s) {
        world.states.front().time_s = time_s;
        Planner planner(world.scene, world.settings);
        const FramePlan& plan = planner.plan({world.camera, world.states}).plan;
        std::vector<glm::vec3> places_m;
        for (const models::ColourVertex& vertex : plan.shadow_vertices) { places_m.push_back(vertex.position_m); }
        for (const std::uint32_t index : plan.ground.indices) {
            if (!is_shadow(plan, index)) { continue; }
            const std::uint32_t light = colour_of(plan, index) & 255U; // the ground's is 128
            CHECK(light > 0x46U + 30U);
            CHECK(light < 128U);
        }
        return places_m;
    };
    const std::vector<glm::vec3> still_m = shadow_at(0.0);
    CHECK(still_m.size() > 20);
    CHECK(shadow_at(0.03) == still_m); // a quarter turn
    world.scene.models.clear();
    rotor.pivots.clear();
    world.scene.add_model(convex_aircraft(rotor));
    Planner planner(world.scene, world.settings);
    const FramePlan& plan = planner.plan({world.camera, world.states}).plan;
    CHECK(std::ranges::any_of(plan.shadow_vertices, [](const auto& vertex) { return vertex.colour == darkest; }));
}

TEST_CASE("with a depth buffer shadows come apart from the ground") {
    Shadowed world;
    world.settings.surface.hidden_surface = HiddenSurface::DepthBuffer;
    Planner planner(world.scene, world.settings);
    const PlannedFrame frame = planner.plan({world.camera, world.states});
    const FramePlan& plan = frame.plan;
    const PaintStep* const step = step_on_ground(plan);
    REQUIRE(step != nullptr);
    CHECK(step->content == PaintStep::Content::GroundRepaint);
    CHECK(step->count / 3 == static_cast<std::uint32_t>(frame.counts.shadow_triangles));
    CHECK(frame.counts.shadow_triangles > 10);
    CHECK(std::ranges::none_of(plan.ground.indices, [&](std::uint32_t index) { return is_shadow(plan, index); }));
}

TEST_CASE("a low sun, a shadow out of view or too small and a switch give no shadows") {
    const auto shadow_triangles = [](const std::function<void(Shadowed&)>& change) {
        Shadowed world;
        change(world);
        Planner planner(world.scene, world.settings);
        return planner.plan({world.camera, world.states}).counts.shadow_triangles;
    };
    CHECK(shadow_triangles([](Shadowed&) {}) > 0);
    CHECK(shadow_triangles([](Shadowed& w) { w.settings.air.sun_elevation_deg = 2.0; }) == 0);
    CHECK(shadow_triangles([](Shadowed& w) { w.settings.surface.shadows = false; }) == 0);
    CHECK(shadow_triangles([](Shadowed& w) { w.camera = camera_looking_at({-60, -80, 90}, {-200, -300, 0}); }) == 0);
    CHECK(shadow_triangles([](Shadowed& w) { w.camera = camera_looking_at({0, 0, 6000}, {0, 0, 0}); }) == 0);
}

TEST_CASE("the far model casts the shadow where its error cannot be seen there, and nowhere else") {
    constexpr glm::dvec3 own_half_m(8.0, 2.0, 1.0);
    constexpr glm::dvec3 far_half_m(7.8, 1.9, 0.9);
    Settings settings = plain_settings();
    settings.surface.shadows = true;
    settings.air.sun_elevation_deg = 80.0;
    const auto shadow_of = [&](const glm::dvec3& half_m, bool has_far_model, double height_m) {
        Scene scene;
        scene.ground = cell_ground(40, 10.0, rolling_m);
        scene.add_model(convex_aircraft(box_model(half_m)));
        scene.aircraft = {0};
        if (has_far_model) {
            scene.add_model(convex_aircraft(box_model(far_half_m)));
            scene.far_models.push_back({0, 1, 0.3});
        }
        Planner planner(scene, settings);
        const std::vector states{state_at({0.0, 0.0, height_m})};
        const Camera camera = camera_looking_at({0.0, -25.0, height_m + 10.0}, {0.0, -20.0, 0.0});
        std::vector<glm::vec3> corners_m;
        for (const auto& vertex : planner.plan({camera, states}).plan.shadow_vertices) {
            corners_m.push_back(vertex.position_m);
        }
        return corners_m;
    };
    for (const double height_m : {30.0, 400.0}) { REQUIRE(shadow_of(own_half_m, true, height_m).size() > 8); }
    CHECK(shadow_of(own_half_m, true, 30.0) == shadow_of(own_half_m, false, 30.0));
    CHECK(shadow_of(own_half_m, true, 400.0) == shadow_of(far_half_m, false, 400.0));
    CHECK(shadow_of(far_half_m, false, 400.0) != shadow_of(own_half_m, false, 400.0));
}

namespace {

/// A cube of which each side is cut into this number of squares a row.
models::polygons::PolygonModel gridded_box(double half_m, int squares) {
    models::polygons::PolygonModel box = box_model(glm::dvec3(half_m));
    models::polygons::PolygonModel model = box;
    model.vertices_m.clear();
    model.corner_vertices.clear();
    model.polygons.clear();
    for (std::size_t side = 0; side < box.polygons.size(); ++side) {
        const auto corners = box.corners(side);
        const glm::dvec3& from_m = box.vertices_m[corners[0]];
        const glm::dvec3 along_m = (box.vertices_m[corners[1]] - from_m) / static_cast<double>(squares);
        const glm::dvec3 across_m = (box.vertices_m[corners[3]] - from_m) / static_cast<double>(squares);
        for (int i = 0; i < squares * squares; ++i) {
            model.polygons.push_back({static_cast<std::uint32_t>(model.corner_vertices.size()), 4, 0, 0});
            for (const auto& [column, row] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
                model.corner_vertices.push_back(static_cast<std::uint32_t>(model.vertices_m.size()));
                model.vertices_m.push_back(
                    from_m + along_m * double(i % squares + column) + across_m * double(i / squares + row));
            }
        }
    }
    return model;
}

} // namespace

TEST_CASE("a penumbra adds few pieces to a shadow and is the same for any number of polygons") {
    constexpr int squares = 48;
    const Camera near = camera_looking_at({70.0, 50.0, 60.0}, {50.0, 70.0, 20.0});
    const Camera far = camera_looking_at({50.0, 50.0, 2000.0}, {50.0, 70.0, 0.0}); // no penumbra is seen from here
    std::array<std::unique_ptr<Planner>, 2> planners;
    std::array<Scene, 2> scenes;
    Settings settings = plain_settings();
    settings.surface.shadows = true;
    settings.air.sun_elevation_deg = 60.0;
    const glm::dvec3 to_sun(direction_to_sun(settings.air));
    for (const std::size_t planner : {0U, 1U}) {
        Scene& scene = scenes.at(planner);
        scene.ground = cell_ground(4, 400.0, [](double, double) { return 0.0; });
        scene.add_model(convex_aircraft(gridded_box(8.0, planner == 0 ? 1 : squares)));
        scene.aircraft = {0};
        planners.at(planner) = std::make_unique<Planner>(scene, settings);
    }
    const glm::dvec3 middle_m(50.0, 70.0, 0.0);
    const auto plan_of = [&](std::size_t planner, double path_m, const Camera& camera) -> PlannedFrame {
        const std::vector states{state_at(middle_m + path_m * to_sun)};
        return planners.at(planner)->plan({camera, states});
    };
    const double hard = plan_of(1, 30.0, far).counts.shadow_triangles;
    CHECK(hard >= 2 * 2 * squares * squares); // top and at least a side
    // At first the outline's squares alone are added, each by itself; then they, and in the end all squares, are
    // smaller than a cell.
    for (const auto& [path_m, most_in_hard] : {std::pair(60.0, 1.5), {400.0, 1.5}, {2000.0, 0.5}}) {
        CAPTURE(path_m);
        const PlannedFrame soft = plan_of(1, path_m, near);
        CHECK(soft.counts.shadow_triangles > 20);
        CHECK(soft.counts.shadow_triangles <= most_in_hard * hard);
        const PlannedFrame simple = plan_of(0, path_m, near);
        int difference = 0;
        int penumbra = 0;
        for (int place = -60; place <= 60; ++place) {
            const glm::dvec3 at_m = middle_m + glm::dvec3(0.41 * place + 0.03, 0.37, 0.0) - near.eye_m;
            const auto red_of = [&](const FramePlan& plan) {
                const std::uint32_t colour = painted_at(plan, at_m);
                return colour == 0 ? 0x80 : static_cast<int>(colour & 255U);
            };
            const int red = red_of(soft.plan);
            difference += std::abs(red - red_of(simple.plan));
            penumbra += red > static_cast<int>(darkest & 255U) ? 1 : 0;
        }
        CHECK(penumbra > 0);
        CHECK(difference <= 121); // one grey level a place
    }
}
