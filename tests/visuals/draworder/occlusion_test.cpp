#include "sim/base/random_generator.h"
#include "visuals/draworder/occlusion.h"
#include "visuals/separation/convex_separation.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace octant::visuals::draworder;
using namespace octant::visuals::separation;
using octant::Plane;
using octant::RandomGenerator;

namespace {

Face face_of(const std::vector<glm::dvec3>& corners) {
    const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    return outline_face(corners, {normal, -glm::dot(normal, corners[0])}, 1e-6);
}

/// A square in the plane z = height, seen from +z.
Face plate(double height, double x = 0.0, double half = 0.5) {
    return face_of(
        {{x - half, -half, height}, {x + half, -half, height}, {x + half, half, height}, {x - half, half, height}});
}

std::optional<ViewRegion> before(std::optional<ViewRegion> region, const Face& a, const Face& b) {
    for (const Face* face : {&a, &b}) { region = region ? region->cut(*face->plane) : region; }
    return region;
}

bool occludes(const Face& b, const Face& a, const ViewRegion& region = ViewRegion::all_space()) {
    OcclusionTest test(Tolerances{});
    const auto eyes = before(region, a, b);
    std::vector<glm::dvec4> generators;
    if (eyes) { eyes->append_generators(generators); }
    return eyes && test.possible(b, a) && test.occludes(b, a, generators);
}

} // namespace

TEST_CASE("of two parallel plates the nearer hides the farther, never the other way") {
    CHECK(occludes(plate(1.0), plate(0.0)));
    CHECK_FALSE(occludes(plate(0.0), plate(1.0)));
    CHECK(occludes(plate(1.0, 7.0), plate(0.0)));
}

TEST_CASE("a corner on a straight side that drawing in dents is no place for a parting line") {
    // Drawing in moves the sharp first corner sideways, so that the last one, which another polygon's corner has put
    // there, is dented by some 1e-10.
    const glm::dvec3 sharp(0.3857547541, -0.004612480713, 0.0);
    const glm::dvec3 far_end(-0.8117580458, 0.1339747639, 0.0);
    const glm::dvec3 on_side = glm::mix(far_end, sharp, 0.9158);
    const std::vector<glm::dvec3> outline{
        sharp, {0.9206, -0.004612480713, 0.0}, {0.9206, 0.1339747639, 0.0}, far_end, on_side};
    const Tolerances tolerances;
    const Face occluder = outline_face(outline, {{0, 0, 1}, 0.0}, tolerances.inset);
    const std::vector<glm::dvec4> eyes{
        {on_side, 1.0}, {glm::normalize(far_end - on_side), 0.0}, {0.1, 0.995, 0.0, 0.0}};
    CHECK(OcclusionTest(tolerances).occludes(occluder, plate(-1.0), eyes));
}

TEST_CASE("plates side by side hide nothing from eyes that see past the gap") {
    const ViewRegion left = *ViewRegion::all_space().cut({{-1, 0, 0}, -1.0});
    const ViewRegion right = *ViewRegion::all_space().cut({{1, 0, 0}, -1.0});
    CHECK_FALSE(occludes(plate(1.0, 2.0), plate(0.0), left));
    CHECK(occludes(plate(1.0, 2.0), plate(0.0), right));
}

TEST_CASE("two faces of an L hide nothing of one another: each eye sees both") {
    const Face floor = face_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const Face wall = face_of({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}});
    CHECK_FALSE(occludes(floor, wall));
    CHECK_FALSE(occludes(wall, floor));
}

TEST_CASE("a wall turned away from a floor hides what lies behind it") {
    const Face floor = face_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const Face wall = face_of({{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}});
    CHECK(occludes(wall, floor));
    CHECK_FALSE(occludes(floor, wall));
}

TEST_CASE("faces that share an edge or lie in one plane never hide one another") {
    CHECK_FALSE(occludes(plate(0.0, 1.0), plate(0.0)));
    CHECK_FALSE(occludes(plate(0.0, 0.0, 0.2), plate(0.0)));
    const Face roof = face_of({{0.5, -0.5, 0}, {1, -0.5, -0.5}, {1, 0.5, -0.5}, {0.5, 0.5, 0}});
    CHECK_FALSE(occludes(roof, plate(0.0)));
    CHECK_FALSE(occludes(plate(0.0), roof));
}

TEST_CASE("a step hides the tread below it only from eyes low behind the step") {
    const Face tread = plate(0.0, 1.0);
    const Face step = plate(1.0, 0.0);
    CHECK(occludes(step, tread, *ViewRegion::all_space().cut({{-1, 0, 0}, -0.6})));
    CHECK_FALSE(occludes(step, tread, *ViewRegion::all_space().cut({{1, 0, 0}, -0.5})));
}

TEST_CASE("a single eye tells what hides what from there") {
    OcclusionTest test(Tolerances{});
    const auto from = [&](const glm::dvec3& eye) {
        const std::vector<glm::dvec4> eyes{glm::dvec4(eye, 1.0)};
        return test.occludes(plate(1.0, 2.0), plate(0.0), eyes);
    };
    CHECK_FALSE(from({0, 0, 5}));
    CHECK(from({4, 0, 2}));
}

TEST_CASE("the section test agrees with the search for a plane that separates") {
    RandomGenerator dice(12);
    OcclusionTest test(Tolerances{});
    int compared = 0;
    int occluded = 0;
    for (int round = 0; round < 1500; ++round) {
        const auto random_face = [&] {
            const glm::dvec3 middle = dice.direction() * dice.next();
            const glm::dvec3 right = dice.direction() * dice.between(0.1, 0.5);
            const glm::dvec3 up = glm::cross(right, dice.direction());
            return face_of({middle - right, middle - up, middle + right, middle + up});
        };
        const Face a = random_face();
        const Face b = random_face();
        std::optional<ViewRegion> region = ViewRegion::all_space();
        for (int cuts = round % 6; cuts > 0 && region; --cuts) {
            region = region->cut({dice.direction(), dice.between(-0.5, 0.5)});
        }
        region = before(region, a, b);
        if (!region || !test.possible(b, a)) { continue; }
        std::vector<glm::dvec4> eyes;
        region->append_generators(eyes);
        const bool by_section = test.occludes(b, a, eyes);
        CHECK(by_section == !separable(b.corners, a.corners, eyes));
        ++compared;
        occluded += by_section ? 1 : 0;
    }
    CHECK(compared > 300);
    CHECK(occluded > 100);
    CHECK(compared - occluded > 100);
}

TEST_CASE("bodies are separated from plates by a plane or not at all") {
    Face body;
    for (int corner = 0; corner < 8; ++corner) { body.corners.emplace_back(corner % 2, corner / 2 % 2, corner / 4); }
    OcclusionTest test(Tolerances{});
    std::vector<glm::dvec4> eyes;
    ViewRegion::all_space().cut({{0, 0, 1}, 1.0})->append_generators(eyes);
    CHECK(test.occludes(body, plate(-1.0), eyes));
    CHECK_FALSE(separable(body.corners, plate(0.5).corners, {}));
    CHECK(separable(body.corners, plate(-0.5).corners, {}));
}
