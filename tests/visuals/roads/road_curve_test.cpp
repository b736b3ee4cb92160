#include "visuals/roads/road_network.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace octant;
using namespace octant::visuals::roads;

namespace {

const std::function<bool(const glm::dvec2&)> anywhere = [](const glm::dvec2&) { return true; };

std::vector<glm::dvec2> winding(int places) {
    std::vector<glm::dvec2> places_m;
    for (int i = 0; i < places; ++i) { places_m.emplace_back(100.0 * i, 100.0 * std::round(3.0 * std::sin(i / 3.0))); }
    return places_m;
}

/// The least distance of a place from a line: that from each stretch falls, then rises along it.
double off_line_m(const glm::dvec2& at_m, const std::vector<glm::dvec2>& line_m) {
    double min_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < line_m.size(); ++i) {
        double low = 0.0;
        double high = 1.0;
        const auto off_m = [&](double share) { return glm::distance(at_m, glm::mix(line_m[i - 1], line_m[i], share)); };
        for (int halving = 0; halving < 60; ++halving) {
            const double third = (high - low) / 3.0;
            if (off_m(low + third) < off_m(high - third)) {
                high -= third;
            } else {
                low += third;
            }
        }
        min_m = std::min(min_m, off_m(low));
    }
    return min_m;
}

double sharpest_turn_deg(const std::vector<glm::dvec2>& line_m) {
    double most = 0.0;
    for (std::size_t i = 2; i < line_m.size(); ++i) {
        const glm::dvec2 before = glm::normalize(line_m[i - 1] - line_m[i - 2]);
        const glm::dvec2 after = glm::normalize(line_m[i] - line_m[i - 1]);
        most = std::max(most, std::acos(std::clamp(glm::dot(before, after), -1.0, 1.0)));
    }
    return most * 180.0 / 3.14159265358979;
}

} // namespace

TEST_CASE("a road is rounded between ends that stay, and turns by little from point to point") {
    const std::vector<glm::dvec2> places_m = winding(40);
    const std::vector<glm::dvec2> line_m = smooth_centre_line(places_m, 100.0, anywhere);
    CHECK(line_m.front() == places_m.front());
    CHECK(line_m.back() == places_m.back());
    CHECK(sharpest_turn_deg(line_m) < 12.0);
    for (const glm::dvec2& place_m : places_m) { CHECK(off_line_m(place_m, line_m) < 60.0); }
}

TEST_CASE("where rounding would cut a corner that is denied, it keeps to the places") {
    const std::vector<glm::dvec2> corner_m = {{0.0, 0.0}, {100.0, 0.0}, {200.0, 0.0}, {200.0, 100.0}, {200.0, 200.0}};
    const auto on_places = [&](const glm::dvec2& at_m) { return off_line_m(at_m, corner_m) < 5.0; };
    CHECK_FALSE(std::ranges::all_of(smooth_centre_line(corner_m, 100.0, anywhere), on_places));
    const std::vector<glm::dvec2> kept_m = smooth_centre_line(corner_m, 100.0, on_places);
    CHECK_FALSE(kept_m.empty());
    CHECK(std::ranges::all_of(kept_m, on_places));
    const auto nowhere = [](const glm::dvec2&) { return false; };
    CHECK(smooth_centre_line(corner_m, 100.0, nowhere).empty());
}

TEST_CASE("enough points of a line leave it nowhere farther off than asked") {
    const std::vector<glm::dvec2> line_m = smooth_centre_line(winding(30), 100.0, anywhere);
    std::size_t before = line_m.size() + 1;
    for (const double error_m : {0.05, 0.5, 5.0, 50.0}) {
        const std::vector<std::size_t> kept = simplify_line(line_m, error_m, 1e9);
        CHECK(kept.front() == 0);
        CHECK(kept.back() == line_m.size() - 1);
        CHECK(std::ranges::is_sorted(kept));
        CHECK(kept.size() < before);
        before = kept.size();
        std::vector<glm::dvec2> fewer_m;
        for (const std::size_t i : kept) { fewer_m.push_back(line_m[i]); }
        for (const glm::dvec2& at_m : line_m) { REQUIRE(off_line_m(at_m, fewer_m) < error_m + 1e-6); }
    }
}

TEST_CASE("stretches are no longer than asked where there are points between") {
    std::vector<glm::dvec2> line_m;
    for (int i = 0; i <= 37; ++i) { line_m.emplace_back(10.0 * i, 0.0); }
    const std::vector<std::size_t> kept = simplify_line(line_m, 1.0, 45.0);
    CHECK(kept.back() == 37);
    CHECK(kept.size() < 18);
    for (std::size_t i = 1; i < kept.size(); ++i) {
        CHECK(kept[i] > kept[i - 1]);
        CHECK(kept[i] - kept[i - 1] <= 4);
    }
    CHECK(simplify_line(line_m, 1.0, 1.0).size() == line_m.size());
}

TEST_CASE("pieces follow one another without a gap in all levels") {
    std::vector<RoadSection> sections;
    const std::vector<glm::dvec2> line_m = smooth_centre_line(winding(30), 100.0, anywhere);
    append_sections(line_m, sections);
    REQUIRE(sections.size() > 3);
    for (std::size_t i = 1; i < sections.size(); ++i) {
        for (const auto& before : sections[i - 1].levels) {
            for (const auto& after : sections[i].levels) {
                REQUIRE(before.size() >= 2);
                REQUIRE(after.size() >= 2);
                REQUIRE(before.back().at_m == after.front().at_m);
                REQUIRE(before.back().to_left_edge_m == after.front().to_left_edge_m);
            }
        }
    }
    CHECK(glm::distance(sections.front().levels[0].front().at_m, line_m.front()) == Approx(half_width_m));
    CHECK(glm::distance(sections.back().levels[0].back().at_m, line_m.back()) == Approx(half_width_m));
}

TEST_CASE("edges lie half a width from the middle line, and every stretch is convex") {
    std::vector<RoadSection> sections;
    append_sections(smooth_centre_line(winding(60), 100.0, anywhere), sections);
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    for (const RoadSection& section : sections) {
        for (const std::vector<RoadPoint>& level : section.levels) {
            for (std::size_t i = 1; i < level.size(); ++i) {
                const glm::dvec2 along = glm::normalize(level[i].at_m - level[i - 1].at_m);
                REQUIRE(cross(along, level[i].to_left_edge_m) == Approx(half_width_m).epsilon(0.06));
                const std::array<glm::dvec2, 4> corners = {level[i - 1].at_m - level[i - 1].to_left_edge_m,
                    level[i].at_m - level[i].to_left_edge_m, level[i].at_m + level[i].to_left_edge_m,
                    level[i - 1].at_m + level[i - 1].to_left_edge_m};
                for (std::size_t c = 0; c < 4; ++c) {
                    const glm::dvec2 side = corners[(c + 1) % 4] - corners[c];
                    REQUIRE(cross(side, corners[(c + 2) % 4] - corners[(c + 1) % 4]) > 0.0);
                }
            }
        }
    }
}
