#include "visuals/planning/aircraft_model.h"
#include "visuals/planning/refined_aircraft.h"

#include <catch2/catch.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
namespace refine = octant::visuals::refine;
namespace shading = octant::visuals::shading;
namespace planning = octant::visuals::planning;
namespace scene = octant::visuals::scene;

namespace {

constexpr std::uint32_t rim = 24;

/// A fan of 24 triangles about (0, 0, -1), its rim on a circle of 4 m in the plane z = 0, seen from above (z down). The
/// rim is merged pair by pair, three times over: 12, 6 and 3 triangles.
models::CollapseSequence folding_fan() {
    models::CollapseSequence sequence;
    models::TriangleMesh& mesh = sequence.original;
    mesh.name = "fan";
    mesh.vertices_m.emplace_back(0.0, 0.0, -1.0);
    std::vector<std::uint32_t> ring;
    for (std::uint32_t i = 0; i < rim; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / rim;
        ring.push_back(static_cast<std::uint32_t>(mesh.vertices_m.size()));
        mesh.vertices_m.emplace_back(4.0 * std::cos(turn), 4.0 * std::sin(turn), 0.0);
        mesh.triangles.push_back({0, 1 + (i + 1) % rim, 1 + i});
    }
    std::uint32_t apart = 1; // original vertices that one of the ring stands for
    for (const double error_m : {0.02, 0.09, 0.2}) {
        std::vector<std::uint32_t> merged;
        for (std::uint32_t i = 0; i < ring.size(); i += 2) {
            models::Collapse merge{.first = ring[i], .second = ring[i + 1]};
            merge.position_m = mesh.vertices_m[1 + i * apart];
            merge.right = (i + 1) * apart - 1;
            merge.error_m = error_m;
            merged.push_back(static_cast<std::uint32_t>(mesh.vertices_m.size() + sequence.collapses.size()));
            sequence.collapses.push_back(merge);
        }
        ring = merged;
        apart *= 2;
    }
    return sequence;
}

std::shared_ptr<const refine::ProgressiveMesh> hierarchy() {
    return std::make_shared<const refine::ProgressiveMesh>(folding_fan());
}

/// The fan `away_m` below an eye that looks down, in world axes with the eye at the origin.
glm::dmat4 below(double away_m) {
    glm::dmat4 body = glm::translate(glm::dmat4(1.0), {0.0, 0.0, -away_m});
    body[1] = -body[1]; // z down to z up
    body[2] = -body[2];
    return body;
}

planning::FrameView looking_down() {
    planning::FrameView view;
    view.frustum.fill(glm::dvec3(0.0, 0.0, -1.0)); // everything below is inside
    return view;
}

refine::ViewRefinerOptions refining() {
    refine::ViewRefinerOptions options;
    options.error_px = 1.0;
    return options;
}

int triangles_at(double away_m) {
    planning::RefinedAircraft aircraft(hierarchy(), refining(), {});
    aircraft.update(below(away_m), looking_down(), true);
    return aircraft.triangles();
}

std::vector<glm::vec3> places(const scene::RefinedDraw& draw) {
    std::vector<glm::vec3> found;
    for (const scene::ModelVertex& vertex : draw.vertices) { found.push_back(vertex.position_m); }
    return found;
}

int triangles_in(const scene::RefinedDraw& draw) {
    int triangles = 0;
    for (std::size_t i = 0; i + 2 < draw.indices.size(); i += 3) {
        triangles += draw.indices[i] != draw.indices[i + 1] ? 1 : 0;
    }
    return triangles;
}

int smooth_in(const scene::RefinedDraw& draw) {
    int smooth = 0;
    for (std::size_t i = 0; i + 2 < draw.indices.size(); i += 3) {
        const bool is_triangle = draw.indices[i] != draw.indices[i + 1];
        smooth += is_triangle && draw.vertices[draw.indices[i]].polygon == 0 ? 1 : 0;
    }
    return smooth;
}

} // namespace

TEST_CASE("a nearer eye sees more triangles of a refined aircraft, up to all of them") {
    CHECK(triangles_at(1e6) == 3);
    CHECK(triangles_at(120.0) == 6);
    CHECK(triangles_at(60.0) == 12);
    CHECK(triangles_at(5.0) == 24);
}

TEST_CASE("a standing eye gives a refined aircraft no work, an aircraft seen first is fit at once") {
    planning::RefinedAircraft aircraft(hierarchy(), refining(), {});
    const auto first = aircraft.update(below(60.0), looking_down(), true);
    CHECK(first.splits + first.collapses + first.moving == 0);
    CHECK(first.settled);
    const int triangles = aircraft.triangles();
    for (int frame = 0; frame < 5; ++frame) {
        const auto done = aircraft.update(below(60.0), looking_down(), false);
        CHECK(done.splits + done.collapses + done.moving == 0);
        CHECK(aircraft.triangles() == triangles);
    }
    CHECK(aircraft.update(below(20.0), looking_down(), false).splits > 0);
}

TEST_CASE("as many triangles are smooth as asked for; a flat one begins with a vertex of its own that "
          "has its normal and the mean of its corners' colours") {
    for (const int smooth : {0, 1, 5, 12}) {
        planning::RefinedAircraft aircraft(hierarchy(), refining(), {});
        aircraft.update(below(60.0), looking_down(), true);
        REQUIRE(aircraft.triangles() == 12);
        shading::ShadingLight light;
        light.to_light = glm::normalize(glm::vec3(1.0F, 0.3F, -1.0F));
        aircraft.shade({0.0, 0.0, -60.0}, light, smooth);
        const scene::RefinedDraw draw = aircraft.draw();
        CHECK(smooth_in(draw) == smooth);
        for (std::size_t i = 0; i + 2 < draw.indices.size(); i += 3) {
            const std::array<scene::ModelVertex, 3> corners{
                draw.vertices[draw.indices[i]], draw.vertices[draw.indices[i + 1]], draw.vertices[draw.indices[i + 2]]};
            const glm::vec3 normal = glm::normalize(glm::cross(
                corners[1].position_m - corners[0].position_m, corners[2].position_m - corners[0].position_m));
            CHECK(normal.z < 0.0F); // up
            if (corners[0].polygon == 1) {
                CHECK(glm::distance(corners[0].face_normal, normal) < 1e-5F);
                CHECK(corners[0].face_colour == 0xffffffffU);
                CHECK(std::ranges::count(draw.indices, draw.indices[i]) == 1);
            }
        }
    }
}

TEST_CASE("a frame in which nothing moves changes no triangle's shading") {
    planning::RefinedAircraft aircraft(hierarchy(), refining(), {});
    shading::ShadingLight light;
    light.to_light = glm::normalize(glm::vec3(1.0F, 0.3F, -1.0F));
    aircraft.update(below(60.0), looking_down(), true);
    aircraft.shade({0.0, 0.0, -60.0}, light, 4);
    const scene::RefinedDraw first = aircraft.draw();
    const std::vector<std::uint32_t> before(first.indices.begin(), first.indices.end());
    aircraft.update(below(60.0), looking_down(), false);
    aircraft.shade({0.0, 0.0, -60.0}, light, 4);
    const scene::RefinedDraw second = aircraft.draw();
    CHECK(before == std::vector<std::uint32_t>(second.indices.begin(), second.indices.end()));
    CHECK(first.vertices.size() == second.vertices.size());
}

TEST_CASE("shading follows a mesh that is refined further, and turns all smooth and back") {
    planning::RefinedAircraft aircraft(hierarchy(), refining(), {});
    shading::ShadingLight light;
    light.to_light = glm::normalize(glm::vec3(1.0F, 0.3F, -1.0F));
    aircraft.update(below(60.0), looking_down(), true);
    aircraft.shade({0.0, 0.0, -60.0}, light, 4);
    CHECK(smooth_in(aircraft.draw()) == 4);
    for (int frame = 0; frame < 40; ++frame) {
        aircraft.update(below(5.0), looking_down(), false);
        aircraft.shade({0.0, 0.0, -5.0}, light, 7);
        CHECK(smooth_in(aircraft.draw()) == 7);
    }
    CHECK(aircraft.triangles() == 24);
    aircraft.shade({0.0, 0.0, -5.0}, light, 24);
    CHECK(smooth_in(aircraft.draw()) == 24);
    aircraft.shade({0.0, 0.0, -5.0}, light, 0);
    CHECK(smooth_in(aircraft.draw()) == 0);
    aircraft.shade({0.0, 0.0, -5.0}, light, 7);
    CHECK(smooth_in(aircraft.draw()) == 7);
}

TEST_CASE("a refined mesh shows its levels: white where it is as its file, else by its error") {
    scene::ShadingSettings shading;
    shading.show_model = scene::ModelDisplay::Levels;
    planning::RefinedAircraft fine(hierarchy(), refining(), shading);
    fine.update(below(5.0), looking_down(), true);
    for (const scene::ModelVertex& vertex : fine.draw().vertices) { CHECK(vertex.colour == 0xffffffffU); }
    CHECK(planning::level_colour(0.0, 4.0) == 0xffffffffU);
    CHECK(planning::level_colour(0.09, 4.0) != visuals::planning::level_colour(0.2, 4.0));
    CHECK(planning::level_colour(0.09, 4.0) == visuals::planning::level_colour(0.9, 40.0));
}

TEST_CASE("aircraft that share a hierarchy have fronts of their own") {
    const auto shared = hierarchy();
    planning::RefinedAircraft near_by(shared, refining(), {});
    planning::RefinedAircraft far_off(shared, refining(), {});
    near_by.update(below(5.0), looking_down(), true);
    far_off.update(below(1e6), looking_down(), true);
    CHECK(near_by.triangles() == 24);
    CHECK(far_off.triangles() == 3);
    planning::RefinedAircraft alone(shared, refining(), {});
    alone.update(below(5.0), looking_down(), true);
    CHECK(places(near_by.draw()) == places(alone.draw()));
    CHECK(shared.use_count() == 4);
}

TEST_CASE("triangles of a creased mesh have the normals of their own faces, and share vertices elsewhere") {
    models::CollapseSequence sequence = folding_fan();
    models::TriangleMesh& mesh = sequence.original;
    for (const models::Triangle& triangle : mesh.triangles) { // flat triangles
        mesh.normals.emplace_back(models::normal_of(mesh, triangle));
        const auto normal = static_cast<std::uint32_t>(mesh.normals.size() - 1);
        mesh.corner_normals.push_back({normal, normal, normal});
    }
    const auto shared = std::make_shared<const refine::ProgressiveMesh>(sequence);
    const auto creases = refine::mesh_creases(*shared, refine::creased_normals(mesh));
    REQUIRE(creases != nullptr);
    planning::RefinedAircraft aircraft(shared, refining(), {}, {}, creases);
    aircraft.update(below(5.0), looking_down(), true);
    const scene::RefinedDraw draw = aircraft.draw();
    REQUIRE(draw.indices.size() == 3 * rim);
    for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return draw.vertices[draw.indices[i + k]]; };
        const glm::vec3 own =
            glm::normalize(glm::cross(at(1).position_m - at(0).position_m, at(2).position_m - at(0).position_m));
        for (std::size_t k = 0; k < 3; ++k) { CHECK(glm::dot(at(k).normal, own) > 0.998F); }
    }
    planning::RefinedAircraft smooth(shared, refining(), {});
    smooth.update(below(5.0), looking_down(), true);
    CHECK(smooth.draw().vertices.size() < draw.vertices.size());
}

namespace {

constexpr std::uint32_t box_triangles = 12;
constexpr std::uint32_t mantle_sides = 16;

void add_normal(models::TriangleMesh& mesh, const std::array<glm::dvec3, 3>& normals) {
    const auto first = static_cast<std::uint32_t>(mesh.normals.size());
    for (const glm::dvec3& normal : normals) { mesh.normals.emplace_back(glm::normalize(normal)); }
    mesh.corner_normals.push_back({first, first + 1, first + 2});
}

/// A cube of 2 m about the origin, then beside it the mantle of an upright cylinder and then its caps. The normals make
/// the mantle round and all edges of cube and caps sharp; edges share vertices.
models::TriangleMesh box_and_cylinder() {
    models::TriangleMesh mesh;
    mesh.name = "box-and-cylinder";
    for (const double z : {1.0, -1.0}) {
        for (const glm::dvec2& at : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
            mesh.vertices_m.emplace_back(at, z);
        }
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
    for (std::uint32_t side = 0; side < 4; ++side) {
        const std::uint32_t next = (side + 1) % 4;
        mesh.triangles.push_back({side, side + 4, next + 4});
        mesh.triangles.push_back({side, next + 4, next});
    }
    for (const models::Triangle& triangle : mesh.triangles) {
        const glm::dvec3 normal = models::normal_of(mesh, triangle);
        add_normal(mesh, {normal, normal, normal});
    }
    const glm::dvec3 axis_m(0.0, 3.0, 0.0);
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (std::uint32_t side = 0; side < mantle_sides; ++side) {
        const double turn = 2.0 * std::numbers::pi * side / mantle_sides;
        for (const double z : {1.0, -1.0}) {
            mesh.vertices_m.push_back(axis_m + glm::dvec3(std::cos(turn), std::sin(turn), z));
        }
    }
    const auto lower = [&](std::uint32_t side) { return first + 2 * (side % mantle_sides); };
    for (std::uint32_t side = 0; side < mantle_sides; ++side) {
        for (const auto& triangle : {models::Triangle{lower(side), lower(side) + 1, lower(side + 1) + 1},
                 models::Triangle{lower(side), lower(side + 1) + 1, lower(side + 1)}}) {
            mesh.triangles.push_back(triangle);
            std::array<glm::dvec3, 3> round{};
            for (std::size_t k = 0; k < 3; ++k) {
                round.at(k) = mesh.vertices_m[triangle.at(k)] - axis_m;
                round.at(k).z = 0.0;
            }
            add_normal(mesh, round);
        }
    }
    for (std::uint32_t side = 1; side + 1 < mantle_sides; ++side) {
        mesh.triangles.push_back({lower(0), lower(side), lower(side + 1)});
        add_normal(mesh, {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)});
        mesh.triangles.push_back({lower(0) + 1, lower(side + 1) + 1, lower(side) + 1});
        add_normal(mesh, {glm::dvec3(0, 0, -1), glm::dvec3(0, 0, -1), glm::dvec3(0, 0, -1)});
    }
    return mesh;
}

/// Whether a drawn triangle is one of the mantle: it has corners at both ends of the cylinder's radius.
bool is_of_mantle(const std::array<scene::ModelVertex, 3>& corners) {
    const auto on_mantle = [](const scene::ModelVertex& corner) { return corner.position_m.y > 1.5F; };
    const auto [lowest, highest] =
        std::minmax({corners[0].position_m.z, corners[1].position_m.z, corners[2].position_m.z});
    return std::ranges::all_of(corners, on_mantle) && lowest != highest;
}

struct ShadedTriangles {
    int mantle = 0;       ///< smooth ones
    int sharp = 0;        ///< smooth ones of the cube and of the caps
    bool is_round = true; ///< smooth ones of the mantle have its normals
};

/// What of the box and cylinder is smooth where so many triangles may be.
ShadedTriangles shaded_box_and_cylinder(scene::HybridRule rule, int smooth) {
    const models::TriangleMesh mesh = box_and_cylinder();
    const auto whole = std::make_shared<const refine::ProgressiveMesh>(models::CollapseSequence{mesh, {}});
    const auto creases = refine::mesh_creases(*whole, refine::creased_normals(mesh));
    scene::ShadingSettings settings;
    settings.rule = rule;
    planning::RefinedAircraft aircraft(whole, refining(), settings, {}, creases);
    aircraft.update(below(20.0), looking_down(), true);
    shading::ShadingLight light;
    light.specular = 0.0F;
    light.to_light = glm::normalize(glm::vec3(1.0F, 0.0F, -1.0F));
    aircraft.shade({20.0, 0.0, -20.0}, light, smooth);
    const scene::RefinedDraw draw = aircraft.draw();
    ShadedTriangles found;
    for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return draw.vertices[draw.indices[i + k]]; };
        const std::array<scene::ModelVertex, 3> corners{at(0), at(1), at(2)};
        if (corners[0].polygon != 0) { continue; }
        const bool is_mantle = is_of_mantle(corners);
        ++(is_mantle ? found.mantle : found.sharp);
        for (const scene::ModelVertex& corner : corners) {
            const glm::vec3 round = glm::normalize(corner.position_m - glm::vec3(0.0F, 3.0F, corner.position_m.z));
            found.is_round = found.is_round && (!is_mantle || glm::dot(corner.normal, round) > 0.999F);
        }
    }
    return found;
}

} // namespace

TEST_CASE("of a cube and a cylinder with sharp edges only the cylinder's mantle is smooth: edges are no curves") {
    constexpr int facing = mantle_sides - 2; // two triangles a side, but for those seen edge on
    REQUIRE(box_and_cylinder().triangles.size() == box_triangles + 2 * mantle_sides + 2 * (mantle_sides - 2));
    for (const int smooth : {1, 4, facing}) {
        const ShadedTriangles by_error = shaded_box_and_cylinder(scene::HybridRule::Error, smooth);
        CHECK(by_error.mantle == smooth);
        CHECK(by_error.sharp == 0);
        CHECK(by_error.is_round);
    }
    // As printed, light at the vertices decides, and the mean normals at the cube's corners differ most.
    CHECK(shaded_box_and_cylinder(scene::HybridRule::Paper, facing).sharp > 0);
}

TEST_CASE("far away, where its polygons are good enough, a refined aircraft is drawn as them") {
    planning::AircraftModel model = convex_aircraft(box_model({4.0, 4.0, 1.0}));
    planning::add_progressive(model, hierarchy(), 0.5);
    const auto drawn_at = [&](double away_m) { return planning::select_level(model.errors_m, away_m * 0.001, -1); };
    REQUIRE(model.errors_m.size() == 2);
    CHECK(drawn_at(100.0) == 0);
    CHECK(drawn_at(1000.0) == static_cast<int>(model.polygon_representation()));
}

TEST_CASE("what is clear of refined aircraft is drawn after all of them, the farthest first by depth") {
    planning::AircraftModel model = convex_aircraft(box_model({4.0, 4.0, 1.0}));
    planning::add_progressive(model, hierarchy(), 0.2);
    models::polygons::PolygonModel pane;
    pane.vertices_m = {{0, 0, -2}, {1, 0, -2}, {0, 1, -2}};
    pane.corner_vertices = {0, 2, 1};
    pane.polygons = {{0, 3, 0, 0}};
    pane.materials = {{.name = "glass", .opacity = 0.4F}};
    pane.parts = {"glass"};
    planning::add_glass(model, pane, visuals::draworder::file_order(pane), std::vector<glm::vec3>(3));
    planning::Scene scene = small_scene({std::move(model)}, {0, 0});
    const auto hidden = GENERATE(scene::HiddenSurface::Octant, scene::HiddenSurface::DepthBuffer);
    const std::size_t nearest = GENERATE(0U, 1U);
    std::array states{state_at({0, 34, 0}), state_at({0, 34, 0})};
    states[nearest] = state_at({0, 30, 0}); // they meet
    {
        scene::Settings settings = plain_settings();
        settings.surface.hidden_surface = hidden;
        planning::Planner planner(scene, settings);
        const scene::FramePlan& plan = planner.plan({scene::camera_looking_at({0, 0, 0}, {0, 30, 0}), states}).plan;
        REQUIRE(plan.aircraft.size() == 2);
        REQUIRE(plan.steps.size() >= 4);
        const auto last = std::span(plan.steps).last(2);
        for (const scene::PaintStep& step : plan.steps) {
            const bool is_last = &step >= last.data();
            CHECK((step.opacity == 0.4F) == is_last);
            CHECK((step.content == scene::PaintStep::Content::Aircraft) == is_last);
        }
        CHECK(last[0].depth == scene::DepthUse::Nearest);
        REQUIRE(last[0].count == 1);
        REQUIRE(last[1].count == 1);
        const auto first_part = [&](const scene::PaintStep& step) { return plan.aircraft[step.first].first_part; };
        CHECK((first_part(last[0]) > first_part(last[1])) == (nearest == 0));
    }
}

TEST_CASE("parts of a refined aircraft move as its motion has it, the same in each picture of a state") {
    planning::AircraftModel model = convex_aircraft(box_model({4.0, 4.0, 1.0}));
    planning::add_progressive(model, hierarchy(), 0.2);
    models::TriangleMesh flap;
    flap.vertices_m = {{-5, 0, 0}, {-9, 1, 0}, {-9, -1, 0}};
    flap.triangles = {{0, 1, 2}, {0, 2, 1}};
    models::PartMove turn;
    turn.control = models::FlightControl::Roll;
    turn.point_m = {-5.0, 0.0, 0.0};
    turn.direction = {0.0, 1.0, 0.0};
    turn.amounts = {{-1.0, -1.0}, {1.0, 1.0}};
    models::PartMove gear;
    gear.kind = models::PartMove::Kind::Show;
    gear.control = models::FlightControl::Gear;
    gear.amounts = {{0.0, 0.0}, {1.0, 1.0}};
    const std::array<planning::MovingPartMesh, 2> parts{{{&flap, std::nullopt, {turn}}, {&flap, std::nullopt, {gear}}}};
    planning::add_moving_parts(model, parts);
    CHECK(model.part_count() == 3);
    CHECK(model.hull.min_m.x == Approx(-9.0));
    CHECK(model.hull.min_m.z <= -4.0 * std::sin(1.0));

    planning::Scene scene = small_scene({std::move(model)}, {0});
    const scene::Settings settings = plain_settings();
    const auto tip_in = [&](double roll_radps) {
        planning::Planner planner(scene, settings);
        std::array states{state_at({0, 30, 0})};
        states[0].velocity_mps = {0.0, 200.0, 0.0}; // with the gear up
        states[0].turn_rate_radps.x = roll_radps;
        const scene::FramePlan& plan = planner.plan({scene::camera_looking_at({0, 0, 0}, {0, 30, 0}), states}).plan;
        REQUIRE(plan.aircraft.size() == 1);
        const scene::AircraftDraw& draw = plan.aircraft[0];
        const scene::ModelBuffers& buffers = scene.models[0]->buffers;
        const scene::ModelVertex& tip = buffers.vertices[buffers.indices[draw.first_index + 1]];
        const scene::ModelVertex& wheel = buffers.vertices[buffers.indices[draw.first_index + 7]];
        const glm::mat4 to_body = glm::inverse(plan.parts[draw.first_part]);
        const glm::vec4 hidden = to_body * plan.parts[draw.first_part + wheel.part] * glm::vec4(wheel.position_m, 1.0F);
        CHECK(glm::length(glm::vec3(hidden)) < 1e-5F);
        return glm::vec3(to_body * plan.parts[draw.first_part + tip.part] * glm::vec4(tip.position_m, 1.0F));
    };
    CHECK(tip_in(0.0).z == Approx(0.0).margin(1e-5));
    CHECK(tip_in(1.0).z == Approx(4.0 * std::sin(std::sqrt(0.5))));
    CHECK(tip_in(-1.0).z == Approx(-4.0 * std::sin(std::sqrt(0.5))));
}

TEST_CASE("what turns beside a refined aircraft is drawn after it by the same depth, turned") {
    models::polygons::PolygonModel polygons = box_model({4.0, 4.0, 1.0});
    polygons.parts.emplace_back("propeller");
    polygons.pivots.push_back({1, {5.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.25});
    planning::AircraftModel model = convex_aircraft(polygons);
    planning::add_progressive(model, hierarchy(), 0.2);
    models::TriangleMesh blade;
    blade.vertices_m = {{5, 0, 0}, {5, 1, 6}, {5, -1, 6}};
    blade.triangles = {{0, 1, 2}, {0, 2, 1}};
    const std::array<planning::MovingPartMesh, 1> parts{{{&blade, 0, {}}}};
    planning::add_moving_parts(model, parts);
    CHECK(model.hull.max_m.y == Approx(std::sqrt(37.0))); // wherever the blade points
    CHECK(model.hull.min_m.z == Approx(-std::sqrt(37.0)));

    planning::Scene scene = small_scene({std::move(model)}, {0});
    for (const auto kind : {scene::AircraftShading::Hybrid, scene::AircraftShading::Flat}) {
        scene::Settings settings = plain_settings();
        settings.shading.kind = kind;
        planning::Planner planner(scene, settings);
        std::array states{state_at({0, 30, 0})};
        states[0].time_s = 1.0; // a quarter turn
        const planning::PlannedFrame frame = planner.plan({scene::camera_looking_at({0, 0, 0}, {0, 30, 0}), states});
        const scene::FramePlan& plan = frame.plan;
        REQUIRE(plan.steps.size() == 3);
        CHECK(plan.steps[0].content == scene::PaintStep::Content::ClearDepth);
        CHECK(plan.steps[1].content == scene::PaintStep::Content::Refined);
        REQUIRE(plan.refined.size() == 1);
        CHECK(frame.counts.aircraft_polygons == triangles_in(plan.refined[0]) + 2);
        CHECK(plan.steps[2].content == scene::PaintStep::Content::Aircraft);
        CHECK(plan.steps[2].depth == scene::DepthUse::Nearest);
        REQUIRE(plan.aircraft.size() == 1);
        const scene::AircraftDraw& draw = plan.aircraft[0];
        CHECK(draw.index_count == 6);
        CHECK(plan.smooth[draw.first_smooth] % 2 == (kind == scene::AircraftShading::Flat ? 0 : 1));
        const scene::ModelBuffers& buffers = scene.models[0]->buffers;
        const scene::ModelVertex& tip = buffers.vertices[buffers.indices[draw.first_index + 1]];
        CHECK(tip.part == 1);
        const glm::vec3 turned(plan.parts[draw.first_part + tip.part] * glm::vec4(tip.position_m, 1.0F));
        const glm::vec3 still(plan.parts[draw.first_part] * glm::vec4(5.0F, -6.0F, 1.0F, 1.0F));
        CHECK(glm::distance(turned, still) < 1e-4F);
    }
}

namespace {

/// A box with a blade of two polygons that turns fast before it, and a progressive mesh of the box.
planning::AircraftModel propeller_aircraft() {
    models::polygons::PolygonModel polygons = box_model({4.0, 4.0, 1.0});
    const auto first = static_cast<std::uint32_t>(polygons.vertices_m.size());
    polygons.parts.emplace_back("propeller");
    polygons.pivots.push_back({1, {5.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 30.0});
    for (const glm::dvec3& at_m : {glm::dvec3(5, -0.2, 0.5), glm::dvec3(5, 0.2, 0.5), glm::dvec3(5, 0, 6)}) {
        polygons.vertices_m.push_back(at_m);
    }
    for (const std::array<std::uint32_t, 3>& corners : {std::array{0U, 1U, 2U}, std::array{0U, 2U, 1U}}) {
        polygons.polygons.push_back({static_cast<std::uint32_t>(polygons.corner_vertices.size()), 3, 0, 1});
        for (const std::uint32_t corner : corners) { polygons.corner_vertices.push_back(first + corner); }
    }
    planning::AircraftModel model = convex_aircraft(polygons);
    planning::add_progressive(model, hierarchy(), 0.2);
    return model;
}

} // namespace

TEST_CASE("blades that turn fast are not drawn by depth either, but their disc is, after all that is opaque") {
    planning::AircraftModel model = propeller_aircraft();
    models::TriangleMesh propeller; // a blade of two triangles, and a hub of two between them
    propeller.vertices_m = {{5, -0.2, 0.5}, {5, 0.2, 0.5}, {5, 0, 6}, {5.5, -0.5, -0.5}, {5.5, 0.5, -0.5},
        {5.5, 0.5, 0.5}, {5.5, -0.5, 0.5}};
    propeller.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 2, 1}, {3, 5, 6}};
    const std::array<planning::MovingPartMesh, 1> parts{{{&propeller, 0, {}}}};
    planning::add_moving_parts(model, parts);
    CHECK(model.turning.polygons == 2);
    planning::Scene scene = small_scene({std::move(model)}, {0});
    scene::Settings settings = plain_settings();
    const std::vector<planning::ArticulatedPart> held{{0, 0}};
    for (const bool is_held : {false, true}) {
        planning::Planner planner(scene, settings);
        const std::array states{state_at({0, 30, 0})};
        const scene::Camera camera = scene::camera_looking_at({20, 0, -5}, {0, 30, 0});
        planning::PlanRequest request{camera, states};
        if (is_held) { request.articulated_parts = held; }
        const scene::FramePlan& plan = planner.plan(request).plan;
        std::uint32_t indices = 0;
        for (const scene::AircraftDraw& draw : plan.aircraft) { indices += draw.index_count; }
        CHECK(indices == (is_held ? 12 : 6));
        CHECK((plan.steps.back().content == scene::PaintStep::Content::Transparent) == !is_held);
        CHECK(plan.steps.back().depth == scene::DepthUse::Nearest);
    }
}

TEST_CASE("a mesh that fills the circle of the polygons' blades is drawn as it stands, and has no disc") {
    planning::AircraftModel model = propeller_aircraft();
    CHECK(model.discs.size() == 1);
    models::TriangleMesh fan; // reaches beyond the blades of the polygons
    fan.vertices_m = {{5, 0, 0}};
    for (std::uint32_t i = 0; i < 12; ++i) {
        const double turn = std::numbers::pi / 6.0 * i;
        fan.vertices_m.emplace_back(5.0, 6.5 * std::cos(turn), 6.5 * std::sin(turn));
        fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % 12});
    }
    const std::array<planning::MovingPartMesh, 1> parts{{{&fan, 0, {}}}};
    planning::add_moving_parts(model, parts);
    CHECK(model.turning.polygons == 12);
    CHECK(model.discs.empty());
    CHECK(model.opacity_runs.empty());
    planning::Scene scene = small_scene({std::move(model)}, {0});
    const scene::Settings settings = plain_settings();
    planning::Planner planner(scene, settings);
    const std::array states{state_at({0, 30, 0})};
    const scene::FramePlan& plan = planner.plan({scene::camera_looking_at({20, 0, -5}, {0, 30, 0}), states}).plan;
    CHECK(std::ranges::none_of(plan.steps,
        [](const scene::PaintStep& step) { return step.content == scene::PaintStep::Content::Transparent; }));
}
