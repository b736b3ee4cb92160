#include "sim/base/units.h"
#include "visuals/nature/runway.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using octant::rad_from_deg;
using namespace octant::visuals::nature;

namespace {

constexpr float length_m = 1800.0F;

std::vector<RunwayRectangle> markings(double heading_deg) {
    std::vector<RunwayRectangle> patches = runway_rectangles(1800.0, 45.0, rad_from_deg(heading_deg));
    std::erase_if(patches, [](const RunwayRectangle& patch) { return !patch.is_painted; });
    return patches;
}

/// The patches of such a size that begin between two places along the runway, from left to right.
std::vector<RunwayRectangle> of_size(
    std::vector<RunwayRectangle> patches, const glm::vec2& size_m, float from_m, float to_m) {
    std::erase_if(patches, [&](const RunwayRectangle& patch) {
        const glm::vec2 off_m = glm::abs(patch.max_m - patch.min_m - size_m);
        return off_m.x > 1e-3F || off_m.y > 1e-3F || patch.min_m.x < from_m || patch.min_m.x > to_m;
    });
    std::ranges::sort(patches, {}, [](const RunwayRectangle& patch) { return -patch.min_m.y; });
    return patches;
}

double area_m2(const RunwayRectangle& patch) {
    const glm::vec2 size_m = patch.max_m - patch.min_m;
    return static_cast<double>(size_m.x) * static_cast<double>(size_m.y);
}

} // namespace

TEST_CASE("a runway's ends are called by tenths of their headings") {
    using Names = std::array<std::string, 2>;
    CHECK(runway_numbers(rad_from_deg(70.0)) == Names{"07", "25"});
    CHECK(runway_numbers(rad_from_deg(74.9)) == Names{"07", "25"});
    CHECK(runway_numbers(rad_from_deg(247.0)) == Names{"25", "07"});
    CHECK(runway_numbers(rad_from_deg(0.0)) == Names{"36", "18"});
    CHECK(runway_numbers(rad_from_deg(-4.0)) == Names{"36", "18"});
    CHECK(runway_numbers(rad_from_deg(-90.0)) == Names{"27", "09"});
    CHECK(runway_numbers(rad_from_deg(359.0)) == Names{"36", "18"});
}

TEST_CASE("a runway's surface is all of it once, and markings lie on it apart from each other") {
    double surface_m2 = 0.0;
    const std::vector<RunwayRectangle> all = runway_rectangles(1800.0, 45.0, rad_from_deg(83.0));
    for (const RunwayRectangle& patch : all) {
        CHECK(patch.min_m.x >= 0.0F);
        CHECK(patch.max_m.x <= length_m);
        CHECK(std::max(-patch.min_m.y, patch.max_m.y) <= 22.5F);
        CHECK(patch.max_m.x - patch.min_m.x <= 150.001F);
        CHECK(area_m2(patch) > 0.5);
        surface_m2 += patch.is_painted ? 0.0 : area_m2(patch);
    }
    CHECK(surface_m2 == Approx(1800.0 * 45.0));
    for (std::size_t a = 0; a < all.size(); ++a) {
        for (std::size_t b = a + 1; b < all.size(); ++b) {
            if (all[a].is_painted == all[b].is_painted) {
                const glm::vec2 overlap_m = glm::min(all[a].max_m, all[b].max_m) - glm::max(all[a].min_m, all[b].min_m);
                REQUIRE(std::min(overlap_m.x, overlap_m.y) <= 1e-3F);
            }
        }
    }
}

TEST_CASE("markings are as long, wide and far apart as Annex 14 has them") {
    const std::vector<RunwayRectangle> all = markings(83.0);
    const auto stripes = of_size(all, {30.0F, 1.75F}, 0.0F, 900.0F);
    REQUIRE(stripes.size() == 12);
    for (std::size_t i = 0; i + 1 < stripes.size(); ++i) {
        CHECK(stripes[i].min_m.x == 6.0F);
        const float apart_m = stripes[i].min_m.y - stripes[i + 1].max_m.y;
        CHECK(apart_m == Approx(i == 5 ? 3.5 : 1.75).margin(1e-4));
    }
    const auto aim = of_size(all, {45.0F, 9.0F}, 0.0F, 900.0F);
    REQUIRE(aim.size() == 2);
    CHECK(aim[0].min_m.x == 300.0F);
    CHECK(aim[0].min_m.y - aim[1].max_m.y == Approx(22.0));
    CHECK(of_size(all, {22.5F, 1.8F}, 150.0F, 150.0F).size() == 6);
    CHECK(of_size(all, {22.5F, 1.8F}, 450.0F, 450.0F).size() == 4);
    CHECK(of_size(all, {22.5F, 1.8F}, 600.0F, 600.0F).size() == 4);
    CHECK(of_size(all, {22.5F, 1.8F}, 0.0F, length_m).size() == 28);
    CHECK(of_size(all, {150.0F, 0.9F}, 0.0F, length_m).size() == 24); // both sides, in parts
}

TEST_CASE("the centre line is even from one number to the other") {
    std::vector<RunwayRectangle> dashes = of_size(markings(83.0), {30.0F, 0.9F}, 0.0F, length_m);
    std::ranges::sort(dashes, {}, [](const RunwayRectangle& patch) { return patch.min_m.x; });
    REQUIRE(dashes.size() > 30);
    const float step_m = dashes[1].min_m.x - dashes[0].min_m.x;
    CHECK(step_m >= 50.0F);
    CHECK(step_m <= 75.0F);
    for (std::size_t i = 0; i + 1 < dashes.size(); ++i) {
        CHECK(dashes[i + 1].min_m.x - dashes[i].min_m.x == Approx(step_m).margin(1e-2));
    }
    CHECK(dashes.front().min_m.x + dashes.back().max_m.x == Approx(length_m).margin(1e-2));
}

TEST_CASE("who turns around finds the same runway but for its number") {
    // 83 and 263 degrees are 08 and 26: the first runway's far end is the second one's near end.
    const std::vector<RunwayRectangle> there = markings(83.0);
    const std::vector<RunwayRectangle> back = markings(263.0);
    REQUIRE(there.size() == back.size());
    for (const RunwayRectangle& patch : there) {
        const glm::vec2 end(length_m, 0.0F);
        CHECK(std::ranges::any_of(back, [&](const RunwayRectangle& other) {
            const glm::vec2 off_m =
                glm::abs(other.min_m - (end - patch.max_m)) + glm::abs(other.max_m - (end - patch.min_m));
            return off_m.x + off_m.y < 1e-2F;
        }));
    }
    CHECK(markings(83.0).size() != markings(113.0).size()); // 08 and 11 have other strokes
}
