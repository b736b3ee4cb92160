#include "visuals/planning/scene_order.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>

#include "small_world.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::visuals::overlay;
using namespace octant::visuals::planning;

namespace {

OrientedBox box_around(const glm::dvec3& centre_m, const glm::dvec3& half_m) {
    return {centre_m, glm::dmat3(1.0), half_m};
}

using Groups = std::vector<std::vector<std::uint32_t>>;

Groups arranged(const std::vector<OrientedBox>& boxes) {
    SceneOrder order;
    order.arrange(boxes);
    Groups overlap_groups;
    for (const OverlapGroup& overlap_group : order.overlap_groups()) {
        const auto members = order.members(overlap_group);
        overlap_groups.emplace_back(members.begin(), members.end());
    }
    return overlap_groups;
}

Groups members_of_each(const SceneOrder& order) {
    Groups overlap_groups;
    for (const OverlapGroup& overlap_group : order.overlap_groups()) {
        const auto members = order.members(overlap_group);
        overlap_groups.emplace_back(members.begin(), members.end());
    }
    std::ranges::sort(overlap_groups);
    return overlap_groups;
}

/// Boxes from which each other is reached and that it reaches, in steps that `leads` allows.
Groups groups(std::size_t count, const std::function<bool(std::size_t, std::size_t)>& leads) {
    std::vector<std::vector<char>> reaches(count, std::vector<char>(count, 0));
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < count; ++b) { reaches[a][b] = a == b || leads(a, b) ? 1 : 0; }
    }
    for (std::size_t by = 0; by < count; ++by) {
        for (std::size_t a = 0; a < count; ++a) {
            for (std::size_t b = 0; b < count && reaches[a][by] != 0; ++b) {
                reaches[a][b] = reaches[by][b] != 0 ? 1 : reaches[a][b];
            }
        }
    }
    Groups found;
    for (std::size_t a = 0; a < count; ++a) {
        std::vector<std::uint32_t> group;
        for (std::size_t b = 0; b < count; ++b) {
            if (reaches[a][b] != 0 && reaches[b][a] != 0) { group.push_back(static_cast<std::uint32_t>(b)); }
        }
        if (group.front() == a) { found.push_back(group); }
    }
    return found;
}

/// The groups that no order can do without: boxes that hide one another in a cycle.
Groups cycles_of(const std::vector<OrientedBox>& boxes) {
    return groups(
        boxes.size(), [&](std::size_t a, std::size_t b) { return occlusion_pair(boxes[a], boxes[b]).a_occludes_b; });
}

Groups meeting_groups(const std::vector<OrientedBox>& boxes) {
    return groups(
        boxes.size(), [&](std::size_t a, std::size_t b) { return occlusion_pair(boxes[a], boxes[b]).intersect; });
}

std::size_t largest(const Groups& overlap_groups) {
    std::size_t most = 0;
    for (const auto& overlap_group : overlap_groups) { most = std::max(most, overlap_group.size()); }
    return most;
}

/// Pairs of boxes of which the one painted first hides part of the other.
int wrong_pairs(const std::vector<OrientedBox>& boxes, const SceneOrder& order) {
    int wrong = 0;
    const auto overlap_groups = order.overlap_groups();
    for (std::size_t first = 0; first < overlap_groups.size(); ++first) {
        for (const OverlapGroup& later : overlap_groups.subspan(first + 1)) {
            for (const std::uint32_t a : order.members(overlap_groups[first])) {
                for (const std::uint32_t b : order.members(later)) {
                    wrong += occlusion_pair(boxes[a], boxes[b]).a_occludes_b ? 1 : 0;
                }
            }
        }
    }
    return wrong;
}

} // namespace

TEST_CASE("boxes apart come farthest first") {
    const glm::dvec3 half(1.0);
    CHECK(arranged({box_around({0, 10, 0}, half), box_around({0, 50, 0}, half), box_around({0, -30, 0}, half)}) ==
          Groups{{1}, {2}, {0}});
    CHECK(arranged({}).empty());
}

TEST_CASE("a large near box comes last though its middle is farther") {
    // Middles 45 m and 40 m away; the large one's side is 5 m from the eye, beside the small one.
    CHECK(arranged({box_around({0, 45, 0}, {1, 40, 1}), box_around({5, 40, 0}, {1, 1, 1})}) == Groups{{1}, {0}});
}

TEST_CASE("boxes whose spheres meet follow the plane between them") {
    // A long box lies right behind a small plate; by its power it would be painted last.
    const OrientedBox plate = box_around({0, 10, 0}, {1, 0.1, 1});
    const OrientedBox beam = box_around({0, 10.8, 0}, {20, 0.5, 0.5});
    CHECK(arranged({plate, beam}) == Groups{{1}, {0}});
    CHECK(arranged({beam, plate}) == Groups{{0}, {1}});
}

TEST_CASE("boxes that intersect become one group and draw in what meets the two together") {
    const glm::dvec3 half(2.0);
    CHECK(arranged({box_around({0, 10, 0}, half), box_around({40, 10, 0}, half), box_around({3, 13, 0}, half)}) ==
          Groups{{1}, {0, 2}});
}

TEST_CASE("three bars each before the next become one group, a chain of them does not") {
    // Seen along y: each bar's one end lies before its neighbour, its other end behind the other.
    const auto bar = [](double turn_rad, double lean_rad) {
        const glm::dquat turn = glm::angleAxis(turn_rad, glm::dvec3(0, 1, 0));
        const glm::dquat lean = glm::angleAxis(lean_rad, glm::dvec3(0, 0, 1));
        return OrientedBox{
            glm::dvec3(0, 100, 0) + turn * glm::dvec3(0, 0, 4), glm::mat3_cast(turn * lean), {10, 0.3, 0.5}};
    };
    const double third = 2.0943951023931953;
    CHECK(arranged({bar(0.0, 0.3), bar(third, 0.3), bar(2.0 * third, 0.3)}) == Groups{{0, 1, 2}});
    CHECK(arranged({bar(0.0, 0.3), bar(third, 0.3)}).size() == 2);
}

TEST_CASE("a box between two that meet is not in their group") {
    // The corner between the two holds a third box, inside the box around both.
    const Groups overlap_groups = arranged(
        {box_around({0, 40, 0}, {10, 1, 1}), box_around({-10, 50, 0}, {1, 10, 1}), box_around({5, 50, 0}, {1, 1, 1})});
    CHECK(overlap_groups == Groups{{2}, {0, 1}});
}

TEST_CASE("what two that meet hide and are hidden by joins them") {
    const Groups overlap_groups = arranged({box_around({0, 40, 0}, {10, 1, 1}), box_around({-10, 50, 0}, {1, 10, 1}),
        box_around({-5, 60, 0}, {15, 1, 1}), box_around({0, 50, 0}, {1, 1, 1})});
    CHECK(overlap_groups == Groups{{0, 1, 2, 3}});
}

TEST_CASE("no group hides part of a later one, and each is as small as can be") {
    PlaceDice dice(3);
    SceneOrder order;
    for (int scene = 0; scene < 100; ++scene) {
        std::vector<OrientedBox> boxes;
        for (int i = 0; i < 12; ++i) {
            boxes.push_back({dice.in_box(glm::dvec3(60)) + glm::dvec3(0, 80, 0), glm::mat3_cast(dice.attitude()),
                {15.0, 4.0, 2.0}});
        }
        order.arrange(boxes);
        CHECK(wrong_pairs(boxes, order) == 0);
        CHECK(members_of_each(order) == cycles_of(boxes));
    }
}

TEST_CASE("125 boxes close together in any attitudes make only the groups that they must") {
    PlaceDice dice(1);
    std::vector<OrientedBox> boxes;
    for (int i = 0; i < 125; ++i) {
        boxes.push_back({20.0 * glm::dvec3(i % 5, i / 5 % 5, i / 25) + glm::dvec3(90, 70, -80),
            glm::mat3_cast(dice.attitude()), {9.7, 6.5, 2.8}});
    }
    SceneOrder order;
    order.arrange(boxes);
    CHECK(wrong_pairs(boxes, order) == 0);
    const Groups overlap_groups = members_of_each(order);
    CHECK(overlap_groups == cycles_of(boxes));
    CHECK(largest(meeting_groups(boxes)) > 1);
    CHECK(largest(overlap_groups) <= 2 * largest(meeting_groups(boxes)));
}
