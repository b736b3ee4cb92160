#include "visuals/scene/mesh_levels.h"
#include "visuals/scene/refined_aircraft.h"

#include <catch2/catch.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
namespace refine = octant::visuals::refine;
namespace scene = octant::visuals::scene;

namespace {

constexpr std::uint32_t rim = 24;

/// A fan of 24 triangles about (0, 0, -1), its rim on a circle of 4 m in the plane z = 0, seen from
/// above (z down). The rim is merged pair by pair, three times over: 12, 6 and 3 triangles.
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
            merged.push_back(
                static_cast<std::uint32_t>(mesh.vertices_m.size() + sequence.collapses.size()));
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

scene::RefineLook looking_down() {
    scene::RefineLook look;
    look.ahead = {0.0, 0.0, -1.0};
    look.frustum.fill(glm::dvec3(0.0, 0.0, -1.0)); // everything below is inside
    return look;
}

scene::Settings refining() {
    scene::Settings settings = plain_settings();
    settings.aircraft_error_px = 1.0;
    return settings;
}

int triangles_at(double away_m) {
    scene::RefinedAircraft aircraft(hierarchy(), refining());
    aircraft.update(below(away_m), looking_down(), true);
    return aircraft.triangles();
}

std::vector<glm::vec3> places(const scene::RefinedDraw& draw) {
    std::vector<glm::vec3> found;
    for (const scene::ModelVertex& vertex : draw.vertices) {
        found.push_back(vertex.position_m);
    }
    return found;
}

} // namespace

TEST_CASE("a nearer eye sees more triangles of a refined aircraft, up to all of them") {
    CHECK(triangles_at(1e6) == 3);
    CHECK(triangles_at(120.0) == 6);
    CHECK(triangles_at(60.0) == 12);
    CHECK(triangles_at(5.0) == 24);
}

TEST_CASE(
    "a standing eye gives a refined aircraft no work, an aircraft seen first is fit at once") {
    scene::RefinedAircraft aircraft(hierarchy(), refining());
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

TEST_CASE("flat, each triangle has vertices of its own with its own normal; smooth, they share") {
    scene::RefinedAircraft aircraft(hierarchy(), refining());
    aircraft.update(below(60.0), looking_down(), true);
    const auto triangles = static_cast<std::size_t>(aircraft.triangles());
    const scene::RefinedDraw flat = aircraft.draw(false);
    REQUIRE(flat.indices.size() == 3 * triangles);
    REQUIRE(flat.vertices.size() == 3 * triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
        const std::array<scene::ModelVertex, 3> corners{
            flat.vertices[flat.indices[3 * t]],
            flat.vertices[flat.indices[3 * t + 1]],
            flat.vertices[flat.indices[3 * t + 2]]};
        const glm::vec3 normal = glm::normalize(glm::cross(
            corners[1].position_m - corners[0].position_m,
            corners[2].position_m - corners[0].position_m));
        CHECK(normal.z < 0.0F); // up
        CHECK(glm::distance(corners[0].face_normal, normal) < 1e-5F);
    }
    const scene::RefinedDraw smooth = aircraft.draw(true);
    CHECK(smooth.vertices.size() < 3 * triangles);
    CHECK(*std::max_element(smooth.indices.begin(), smooth.indices.end()) < smooth.vertices.size());
}

TEST_CASE("aircraft that share a hierarchy have fronts of their own") {
    const auto shared = hierarchy();
    scene::RefinedAircraft near_by(shared, refining());
    scene::RefinedAircraft far_off(shared, refining());
    near_by.update(below(5.0), looking_down(), true);
    far_off.update(below(1e6), looking_down(), true);
    CHECK(near_by.triangles() == 24);
    CHECK(far_off.triangles() == 3);
    scene::RefinedAircraft alone(shared, refining());
    alone.update(below(5.0), looking_down(), true);
    CHECK(places(near_by.draw(true)) == places(alone.draw(true)));
    CHECK(shared.use_count() == 4);
}

TEST_CASE("far away, where its polygons are good enough, a refined aircraft is drawn as them") {
    scene::AircraftModel model = convex_aircraft(box_model({4.0, 4.0, 1.0}));
    scene::add_progressive(model, hierarchy(), 0.5);
    const auto drawn_at = [&](double away_m) {
        return scene::chosen_level(model.errors_m, away_m * 0.001, -1);
    };
    REQUIRE(model.errors_m.size() == 2);
    CHECK(drawn_at(100.0) == 0);
    CHECK(drawn_at(1000.0) == static_cast<int>(model.as_polygons()));
}
