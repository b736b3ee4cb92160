#include "sim/base/random_generator.h"
#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/planning/ground_pieces.h"
#include "visuals/scene/truth.h"
#include "visuals/terrain/bisection_ground_builder.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

using namespace octant;
using namespace octant::visuals;
using namespace octant::visuals::planning;

namespace {

constexpr int without_limit = 1'000'000;

/// Long valleys from south to north between hills.
models::heights::HeightField valleys() {
    constexpr int samples = 513;
    constexpr double spacing_m = 25.0;
    std::vector<float> heights;
    for (int row = 0; row < samples; ++row) {
        for (int column = 0; column < samples; ++column) {
            const double x_m = column * spacing_m;
            const double y_m = row * spacing_m;
            heights.push_back(static_cast<float>(300.0 + 90.0 * std::sin(x_m / 800.0) + 20.0 * std::sin(y_m / 500.0) +
                                                 4.0 * std::sin(x_m / 60.0) * std::cos(y_m / 75.0)));
        }
    }
    return {samples, samples, spacing_m, std::move(heights)};
}

const std::shared_ptr<const landscape::Ground>& shared_ground() {
    static const auto ground =
        landscape::make_bisection_ground(terrain::make_ground_tiles(valleys()), scene::AirSettings());
    return ground;
}

/// A place 60 m over a road, and where that road leads.
scene::Camera over_a_road(double height_m, std::size_t number = 3) {
    const roads::RoadSection& section = shared_ground()->road_network()->sections()[number];
    const glm::dvec2 from_m = section.levels[0].front().at_m;
    const glm::dvec2 to_m = section.levels[0].back().at_m;
    const double ground_m = shared_ground()->height_at(from_m.x, from_m.y).value();
    return scene::camera_looking_at({from_m, ground_m + height_m}, {to_m, ground_m + 0.2 * height_m});
}

struct PaintedRoads {
    scene::Camera camera;
    std::unique_ptr<landscape::GroundMesher> mesher;
    GroundPieces pieces;
    std::vector<models::ColourVertex> vertices;
    std::vector<models::SurfaceClass> surfaces;
    FrameView view;
    scene::TriangleDraw ground;

    explicit PaintedRoads(const scene::Camera& from, bool things = false, int most = without_limit) : camera(from) {
        landscape::MeshSettings settings;
        settings.ground.near_detail = things;
        settings.ground.scenery = things;
        mesher = shared_ground()->mesher(settings);
        landscape::GroundCounts counts;
        view = frame_view(camera, {640, 480}, 0.0);
        ground = mesher->triangles({camera, view.aspect, 20000}, counts);
        pieces.begin({view, *mesher, ground}, vertices, surfaces);
        pieces.lay(roads(), most);
    }

    nature::GroundDecoration& roads() const { return *mesher->decorations().front(); }
};

/// Whether the eye sees a place through a polygon that faces it.
bool is_before(std::span<const glm::dvec3> corners, const glm::dvec3& sight) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 inward = -glm::cross(corners[i], corners[(i + 1) % corners.size()]);
        if (glm::dot(inward, sight) < -1e-9 * glm::length(inward) * glm::length(sight)) { return false; }
    }
    return true;
}

} // namespace

TEST_CASE("each piece of a road lies in the plane of a triangle of the ground") {
    const PaintedRoads world(over_a_road(60.0), true);
    REQUIRE(world.pieces.decals().size() > 30);
    ViewPolygon placed;
    for (const GroundDecal& paint : world.pieces.decals()) {
        place_triangle(world.ground, paint.triangle, placed);
        const std::vector<glm::dvec3> under{placed[0].at_m, placed[1].at_m, placed[2].at_m};
        const glm::dvec3 up = glm::normalize(glm::cross(under[1] - under[0], under[2] - under[0]));
        CHECK(paint.layer == GroundLayer::Surface);
        CHECK(paint.colour >> 24U == 0);
        for (const glm::dvec3& corner : world.pieces.corners_of(paint)) {
            REQUIRE(std::abs(glm::dot(up, corner - under[0])) < 1e-3);
        }
    }
}

TEST_CASE("a road near the eye is painted wherever the ground below it is in view") {
    const PaintedRoads world(over_a_road(60.0));
    RandomGenerator dice(3);
    int seen = 0;
    ViewPolygon placed;
    const auto& sections = shared_ground()->road_network()->sections();
    for (int i = 0; i < 20000; ++i) {
        const auto number = static_cast<std::size_t>(dice.between(0.0, static_cast<double>(sections.size())));
        const std::vector<roads::RoadPoint>& line = sections[number].levels[0];
        const auto stretch = 1 + static_cast<std::size_t>(dice.between(0.0, static_cast<double>(line.size() - 1)));
        const double share = dice.next();
        const double aside = dice.between(-0.9, 0.9);
        const glm::dvec2 plan =
            glm::mix(line[stretch - 1].at_m, line[stretch].at_m, share) +
            aside * glm::mix(line[stretch - 1].to_left_edge_m, line[stretch].to_left_edge_m, share) -
            glm::dvec2(world.camera.eye_m);
        if (glm::length(plan) > 600.0) { continue; }
        for (std::uint32_t t = 0; t < world.ground.indices.size() / 3; ++t) {
            place_triangle(world.ground, t, placed);
            const auto [a, b, c] = std::array{placed[0].at_m, placed[1].at_m, placed[2].at_m};
            const auto side = [&](const glm::dvec3& p, const glm::dvec3& q) {
                return (q.x - p.x) * (plan.y - p.y) - (q.y - p.y) * (plan.x - p.x);
            };
            if (side(a, b) < 0.0 || side(b, c) < 0.0 || side(c, a) < 0.0) { continue; }
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            const double z_m = a.z - (normal.x * (plan.x - a.x) + normal.y * (plan.y - a.y)) / normal.z;
            const glm::dvec3 at_m(plan, z_m);
            const bool in_view =
                std::ranges::all_of(world.view.frustum, [&](const glm::dvec3& in) { return glm::dot(in, at_m) > 0.0; });
            if (!in_view || glm::dot(normal, a) >= 0.0) { continue; }
            ++seen;
            REQUIRE(std::ranges::any_of(world.pieces.decals(), [&](const GroundDecal& paint) {
                return paint.triangle == t && is_before(world.pieces.corners_of(paint), at_m);
            }));
        }
    }
    CHECK(seen > 100);
}

TEST_CASE("no road is painted on trees and houses, and none of them stands on one") {
    const PaintedRoads world(over_a_road(25.0), true);
    int things = 0;
    for (std::uint32_t t = 0; t < world.ground.indices.size() / 3; ++t) {
        const std::uint32_t* const corners = &world.ground.indices[std::size_t{3} * t];
        const bool is_scenery = scene::surface_of(world.ground, {}, corners) != models::SurfaceClass::Terrain;
        if (!is_scenery) { continue; }
        ++things;
        for (const GroundDecal& paint : world.pieces.decals()) { REQUIRE(paint.triangle != t); }
        const glm::dvec2 foot_m =
            glm::dvec2(world.camera.eye_m) + glm::dvec2(world.ground.vertices[world.ground.indices[3 * t]].position_m);
        REQUIRE_FALSE(shared_ground()->road_network()->is_near(foot_m, roads::half_width_m));
    }
    CHECK(things > 50);
}

TEST_CASE("roads take no more triangles than they may, and leave out the farthest") {
    const scene::Camera camera = over_a_road(60.0);
    const PaintedRoads all(camera);
    constexpr int most = 60;
    const PaintedRoads few(camera, false, most);
    REQUIRE(all.pieces.decal_triangles() > 2 * most);
    CHECK(few.pieces.decal_triangles() <= most);
    CHECK(few.pieces.decal_triangles() > most - 12);
    const auto farthest_m = [](const PaintedRoads& world) {
        double farthest = 0.0;
        for (const GroundDecal& paint : world.pieces.decals()) {
            farthest = std::max(farthest, glm::length(world.pieces.corners_of(paint)[0]));
        }
        return farthest;
    };
    CHECK(farthest_m(few) < 0.7 * farthest_m(all));
    CHECK(PaintedRoads(camera, false, 0).pieces.decals().empty());
    const auto max_triangles = [&](const glm::dvec3& eye_m, double pixel_share) {
        return all.roads().max_patch_triangles(eye_m, pixel_share * all.view.pixel_rad, 20000);
    };
    CHECK(max_triangles(camera.eye_m, 1.0) > 0);
    CHECK(max_triangles({1e6, 1e6, 500.0}, 1.0) == 0);
    const glm::dvec3 high_m = camera.eye_m + glm::dvec3(0.0, 0.0, 15000.0);
    CHECK(max_triangles(high_m, 1.0) == 0);
    CHECK(max_triangles(high_m, 0.2) > 0); // through a long lens
}

TEST_CASE("a road fades into the ground before it is too narrow to be painted") {
    const PaintedRoads near(over_a_road(60.0));
    scene::Camera high = over_a_road(5000.0);
    const PaintedRoads far(high);
    high.eye_m.z += 30000.0;
    CHECK(PaintedRoads(high).pieces.decals().empty());
    REQUIRE_FALSE(far.pieces.decals().empty());
    // Asphalt is grey, what grows is not.
    const auto greenness = [](const PaintedRoads& world, double nearer_m) {
        double sum = 0.0;
        int count = 0;
        for (const GroundDecal& paint : world.pieces.decals()) {
            if (glm::length(world.pieces.corners_of(paint)[0]) < nearer_m) {
                const auto red = static_cast<double>(paint.colour & 0xffU);
                sum += static_cast<double>(paint.colour >> 8U & 0xffU) - red;
                ++count;
            }
        }
        REQUIRE(count > 0);
        return sum / count;
    };
    CHECK(greenness(near, 500.0) < 1.0);
    CHECK(greenness(far, 1e9) > 3.0);
}
