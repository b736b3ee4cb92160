#include "visuals/scene/scene_order.h"

#include <catch2/catch.hpp>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::scene;

namespace {

HullBox box_at(const glm::dvec3& centre_m, const glm::dvec3& half_m) {
    return {centre_m, glm::dmat3(1.0), half_m};
}

std::vector<std::vector<std::uint32_t>> arranged(const std::vector<HullBox>& boxes) {
    SceneOrder order;
    order.arrange(boxes);
    std::vector<std::vector<std::uint32_t>> knots;
    for (const Knot& knot : order.knots()) {
        const auto members = order.members(knot);
        knots.emplace_back(members.begin(), members.end());
    }
    return knots;
}

using Knots = std::vector<std::vector<std::uint32_t>>;

} // namespace

TEST_CASE("boxes apart come farthest first") {
    const glm::dvec3 half(1.0);
    CHECK(
        arranged({box_at({0, 10, 0}, half), box_at({0, 50, 0}, half), box_at({0, -30, 0}, half)}) ==
        Knots{{1}, {2}, {0}});
    CHECK(arranged({}).empty());
}

TEST_CASE("a large near box comes last though its middle is farther") {
    // Middles 45 m and 40 m away; the large one's side is 5 m from the eye, beside the small one.
    CHECK(
        arranged({box_at({0, 45, 0}, {1, 40, 1}), box_at({5, 40, 0}, {1, 1, 1})}) ==
        Knots{{1}, {0}});
}

TEST_CASE("boxes whose spheres meet follow the plane between them") {
    // A long box lies right behind a small plate; by its power it would be painted last.
    const HullBox plate = box_at({0, 10, 0}, {1, 0.1, 1});
    const HullBox beam = box_at({0, 10.8, 0}, {20, 0.5, 0.5});
    CHECK(arranged({plate, beam}) == Knots{{1}, {0}});
    CHECK(arranged({beam, plate}) == Knots{{0}, {1}});
}

TEST_CASE("boxes that meet become one knot and draw in what meets the two together") {
    const glm::dvec3 half(2.0);
    CHECK(
        arranged({box_at({0, 10, 0}, half), box_at({40, 10, 0}, half), box_at({3, 13, 0}, half)}) ==
        Knots{{1}, {0, 2}});
}

TEST_CASE("three bars each before the next become one knot, a chain of them does not") {
    // Seen along y: each bar's one end lies before its neighbour, its other end behind the other.
    const auto bar = [](double turn_rad, double lean_rad) {
        const glm::dquat turn = glm::angleAxis(turn_rad, glm::dvec3(0, 1, 0));
        const glm::dquat lean = glm::angleAxis(lean_rad, glm::dvec3(0, 0, 1));
        return HullBox{
            glm::dvec3(0, 100, 0) + turn * glm::dvec3(0, 0, 4),
            glm::mat3_cast(turn * lean),
            {10, 0.3, 0.5}};
    };
    const double third = 2.0943951023931953;
    CHECK(arranged({bar(0.0, 0.3), bar(third, 0.3), bar(2.0 * third, 0.3)}) == Knots{{0, 1, 2}});
    CHECK(arranged({bar(0.0, 0.3), bar(third, 0.3)}).size() == 2);
}

TEST_CASE("no knot hides part of a later one") {
    Dice dice(3);
    SceneOrder order;
    for (int scene = 0; scene < 100; ++scene) {
        std::vector<HullBox> boxes;
        for (int i = 0; i < 12; ++i) {
            boxes.push_back(
                {dice.in_box(glm::dvec3(60)) + glm::dvec3(0, 80, 0),
                 glm::mat3_cast(dice.attitude()),
                 {15.0, 4.0, 2.0}});
        }
        order.arrange(boxes);
        const auto knots = order.knots();
        std::size_t members = 0;
        for (std::size_t a = 0; a < knots.size(); ++a) {
            members += order.members(knots[a]).size();
            for (std::size_t b = a + 1; b < knots.size(); ++b) {
                const HidingPair pair = hiding_pair(knots[a].box, knots[b].box);
                CHECK_FALSE(pair.meet);
                CHECK_FALSE(pair.a_hides_b);
            }
        }
        CHECK(members == boxes.size());
    }
}
