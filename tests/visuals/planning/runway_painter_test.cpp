#include "sim/base/units.h"
#include "visuals/nature/runway.h"
#include "visuals/planning/ground_pieces.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals;
using namespace octant::visuals::planning;

namespace {

constexpr int plenty = 1'000'000;

double rolling(double x_m, double y_m) { return 4.0 * std::sin(x_m / 70.0) + 3.0 * std::cos(y_m / 90.0); }

std::shared_ptr<const models::heights::RunwayStrip> askew() {
    models::heights::RunwayStrip strip;
    strip.begin_m = {-800.0, -420.0};
    strip.heading_rad = rad_from_deg(62.0);
    return std::make_shared<const models::heights::RunwayStrip>(strip);
}

/// A runway on cells of 40 m that do not run along it.
struct PaintedRunway {
    scene::Camera camera;
    std::shared_ptr<const models::heights::RunwayStrip> strip = askew();
    std::unique_ptr<landscape::GroundMesher> mesher = cell_ground(60, 40.0, rolling)->mesher({});
    std::unique_ptr<nature::GroundDecoration> runway =
        nature::runway_decoration(strip, nature::Daylight({rad_from_deg(225.0), rad_from_deg(35.0)}));
    GroundPieces pieces;
    std::vector<models::ColourVertex> vertices;
    std::vector<models::SurfaceClass> surfaces;
    scene::TriangleDraw ground;

    explicit PaintedRunway(const glm::dvec3& eye_m, int most = plenty)
        : camera(scene::camera_looking_at(eye_m, {0.0, 0.0, 0.0})) {
        landscape::GroundCounts counts;
        ground = mesher->triangles({camera, 1.0, 1000}, counts);
        paint(view(), most);
    }

    void paint(const FrameView& seen, int most) {
        pieces.begin({seen, *mesher, ground}, vertices, surfaces);
        pieces.lay(*runway, most);
    }

    FrameView narrow_view() const { return frame_view(camera, {640, 480}, 0.0); }

    /// All of the ground is in it.
    FrameView view() const {
        FrameView all = narrow_view();
        all.frustum = {};
        return all;
    }
};

double side_m(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
    return ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / std::hypot(b.x - a.x, b.y - a.y);
}

/// How far a place lies within a polygon that is counter-clockwise seen from above; less than 0 outside.
double inside_m(std::span<const glm::dvec3> corners, const glm::dvec3& p) {
    double min_m = 1e9;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        min_m = std::min(min_m, side_m(corners[i], corners[(i + 1) % corners.size()], p));
    }
    return min_m;
}

/// The same of a polygon that faces the eye as the eye sees it: the least angle to the planes through the eye and its
/// sides.
double inside_rad(std::span<const glm::dvec3> corners, const glm::dvec3& p) {
    double min_rad = 1e9;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 inward = -glm::cross(corners[i], corners[(i + 1) % corners.size()]);
        min_rad = std::min(min_rad, std::asin(glm::dot(glm::normalize(inward), glm::normalize(p))));
    }
    return min_rad;
}

double area_m2(std::span<const glm::dvec3> corners) {
    double area_m2 = 0.0;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const glm::dvec3 cross = glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
        area_m2 += 0.5 * cross.z;
    }
    return area_m2;
}

} // namespace

TEST_CASE("each piece of a runway lies on its triangle, within it but for rounding, and faces up") {
    const PaintedRunway world({200.0, -300.0, 400.0});
    const double pixel_rad = world.view().pixel_rad;
    REQUIRE(world.pieces.decals().size() > 500);
    ViewPolygon placed;
    for (const GroundDecal& paint : world.pieces.decals()) {
        place_triangle(world.ground, paint.triangle, placed);
        const std::vector<glm::dvec3> under{placed[0].at_m, placed[1].at_m, placed[2].at_m};
        const glm::dvec3 up = glm::normalize(glm::cross(under[1] - under[0], under[2] - under[0]));
        REQUIRE(paint.count >= 3);
        REQUIRE(area_m2(world.pieces.corners_of(paint)) > 0.0);
        for (const glm::dvec3& corner : world.pieces.corners_of(paint)) {
            REQUIRE(inside_rad(under, corner) > -0.0201 * pixel_rad);
            REQUIRE(std::abs(glm::dot(up, corner - under[0])) < 1e-4);
        }
    }
}

TEST_CASE("a runway goes on beyond a triangle's sides, its markings farther than its surface") {
    const PaintedRunway world({200.0, -300.0, 400.0});
    const double pixel_rad = world.view().pixel_rad;
    const auto patches = nature::runway_rectangles(1800.0, 45.0, world.strip->heading_rad);
    const auto is_within = [&](const glm::dvec3& at_m, const nature::RunwayRectangle& patch) {
        const glm::dvec2 on_m = world.strip->strip_from_world(glm::dvec2(at_m + world.camera.eye_m));
        return glm::all(glm::greaterThan(on_m, glm::dvec2(patch.min_m) + 0.5)) &&
               glm::all(glm::lessThan(on_m, glm::dvec2(patch.max_m) - 0.5));
    };
    const auto covers = [&](std::uint32_t triangle, bool marking, const glm::dvec3& sight) {
        return std::ranges::any_of(world.pieces.decals(), [&](const GroundDecal& paint) {
            return paint.triangle == triangle && (paint.layer == GroundLayer::Marking) == marking &&
                   inside_rad(world.pieces.corners_of(paint), sight) > 0.0;
        });
    };
    std::set<std::uint32_t> triangles;
    for (const GroundDecal& paint : world.pieces.decals()) { triangles.insert(paint.triangle); }
    int on_surface = 0;
    int on_marking = 0;
    ViewPolygon placed;
    for (const std::uint32_t triangle : triangles) {
        place_triangle(world.ground, triangle, placed);
        for (int place = 0; place < 60; ++place) {
            const glm::dvec3& from_m = placed[static_cast<std::size_t>(place % 3)].at_m;
            const glm::dvec3& to_m = placed[static_cast<std::size_t>((place + 1) % 3)].at_m;
            const glm::dvec3 at_m = glm::mix(from_m, to_m, (place / 3 + 0.5) / 20.0);
            const glm::dvec3 outward = glm::normalize(glm::cross(from_m, to_m)) * pixel_rad;
            for (const nature::RunwayRectangle& patch : patches) {
                if (is_within(at_m, patch)) {
                    ++(patch.is_painted ? on_marking : on_surface);
                    const double beyond_px = patch.is_painted ? 0.0199 : 0.0099;
                    REQUIRE(covers(triangle, patch.is_painted, glm::normalize(at_m) + outward * beyond_px));
                }
            }
        }
    }
    CHECK(on_surface > 1000);
    CHECK(on_marking > 50);
}

TEST_CASE("the pieces cover a runway once but for rounding and leave no gap") {
    const PaintedRunway world({200.0, -300.0, 400.0});
    double surface_m2 = 0.0;
    double marked_m2 = 0.0;
    for (const GroundDecal& paint : world.pieces.decals()) {
        (paint.layer == GroundLayer::Surface ? surface_m2 : marked_m2) += area_m2(world.pieces.corners_of(paint));
    }
    CHECK(surface_m2 > 1800.0 * 45.0);
    CHECK(surface_m2 < 1.005 * 1800.0 * 45.0);
    double expected_m2 = 0.0;
    for (const nature::RunwayRectangle& patch : nature::runway_rectangles(1800.0, 45.0, world.strip->heading_rad)) {
        const glm::vec2 size_m = patch.max_m - patch.min_m;
        expected_m2 += patch.is_painted ? static_cast<double>(size_m.x * size_m.y) : 0.0;
    }
    CHECK(marked_m2 > expected_m2);
    CHECK(marked_m2 < 1.01 * expected_m2);
    PlaceDice dice(3);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 at_m(dice.between(0.5, 1799.5), dice.between(-22.0, 22.0));
        const glm::dvec3 place = glm::dvec3(world.strip->place(at_m), 0.0) - world.camera.eye_m;
        const auto covers = [&](const GroundDecal& paint) {
            return paint.layer == GroundLayer::Surface && inside_m(world.pieces.corners_of(paint), place) > -1e-6;
        };
        REQUIRE(std::ranges::any_of(world.pieces.decals(), covers));
    }
}

TEST_CASE("markings farthest off are left out where triangles are few, and the surface is whole") {
    const glm::dvec3 eye_m(-700.0, -380.0, 60.0);
    const PaintedRunway all(eye_m);
    constexpr int most = 200;
    const PaintedRunway few(eye_m, most);
    const auto surface_m2 = [](const PaintedRunway& world) {
        double sum_m2 = 0.0;
        for (const GroundDecal& paint : world.pieces.decals()) {
            sum_m2 += paint.layer == GroundLayer::Surface ? area_m2(world.pieces.corners_of(paint)) : 0.0;
        }
        return sum_m2;
    };
    const auto farthest_marking_m = [](const PaintedRunway& world) {
        double farthest_m = 0.0;
        for (const GroundDecal& paint : world.pieces.decals()) {
            if (paint.layer == GroundLayer::Marking) {
                farthest_m = std::max(farthest_m, glm::length(world.pieces.corners_of(paint)[0]));
            }
        }
        return farthest_m;
    };
    CHECK(farthest_marking_m(few) > 100.0);
    CHECK(farthest_marking_m(few) < 0.7 * farthest_marking_m(all));
    CHECK(surface_m2(few) == surface_m2(all));
    CHECK(surface_m2(few) > 0.8 * 1800.0 * 45.0); // slopes that face away are not painted
    CHECK(few.pieces.decal_triangles() < all.pieces.decal_triangles());
    const double pixel_rad = few.view().pixel_rad;
    CHECK(few.runway->max_patch_triangles(eye_m, pixel_rad, 20000) >= most);
    CHECK(few.runway->max_patch_triangles({0.0, 0.0, 20000.0}, pixel_rad, 20000) < most);
}

TEST_CASE("a runway is painted on triangles that may be in view and on no others") {
    PaintedRunway world({-900.0, -300.0, 60.0});
    const auto painted = [&] {
        std::set<std::uint32_t> triangles;
        for (const GroundDecal& paint : world.pieces.decals()) { triangles.insert(paint.triangle); }
        return triangles;
    };
    const std::set<std::uint32_t> all = painted();
    const FrameView view = world.narrow_view();
    world.paint(view, plenty);
    const std::set<std::uint32_t> seen = painted();
    CHECK(seen.size() > 20);
    CHECK(seen.size() < all.size());
    for (const std::uint32_t triangle : all) {
        ViewPolygon corners;
        place_triangle(world.ground, triangle, corners);
        const bool is_beyond = std::ranges::any_of(view.frustum, [&](const glm::dvec3& inwards) {
            return std::ranges::all_of(
                corners, [&](const ViewVertex& corner) { return glm::dot(inwards, corner.at_m) < 0.0; });
        });
        CHECK((seen.contains(triangle) || is_beyond));
    }
}

TEST_CASE("what looks narrow takes the surface's colour before it is left out") {
    // Of pieces that begin nearer than this.
    const auto colours_of = [](const PaintedRunway& world, double nearer_m) {
        std::set<std::uint32_t> colours;
        for (const GroundDecal& paint : world.pieces.decals()) {
            CHECK(paint.colour >> 24U == 0); // neither pattern nor texture
            if (glm::length(world.pieces.corners_of(paint)[0]) < nearer_m) { colours.insert(paint.colour); }
        }
        return colours;
    };
    CHECK(colours_of(PaintedRunway({0.0, 0.0, 200.0}), 260.0).size() == 2);
    CHECK(colours_of(PaintedRunway({0.0, 0.0, 1500.0}), 1e9).size() > 2);
    CHECK(colours_of(PaintedRunway({0.0, 0.0, 40000.0}), 1e9).size() == 1);
}
