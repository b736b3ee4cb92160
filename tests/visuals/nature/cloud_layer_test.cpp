#include "visuals/nature/cloud_layer.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

using namespace octant::visuals::nature;

namespace {

constexpr double layer_m = 2000.0;

/// Cloud triangles over a place, and the density between their corners.
struct Above {
    int triangles = 0;
    double density = 0.0;
};

Above above(const CloudLayer::Triangles& clouds, const glm::dvec2& place_m) {
    Above found;
    for (std::size_t i = 0; i + 2 < clouds.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return clouds.vertices[clouds.indices[i + k]]; };
        const auto at = [&](std::size_t k) { return glm::dvec2(corner(k).position_m); };
        const auto area = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
        const double whole = area(at(1) - at(0), at(2) - at(0));
        const double first = area(at(1) - place_m, at(2) - place_m) / whole;
        const double second = area(at(2) - place_m, at(0) - place_m) / whole;
        const double third = 1.0 - first - second;
        if (std::min({first, second, third}) > 0.0) {
            ++found.triangles;
            found.density = first * (corner(0).colour >> 24U) + second * (corner(1).colour >> 24U) +
                            third * (corner(2).colour >> 24U);
        }
    }
    return found;
}

/// Places all over the layer's nearer part, none on an edge.
template <class Visit>
void for_places(const Visit& visit) {
    for (double x_m = -9013.7; x_m < 9000.0; x_m += 751.3) {
        for (double y_m = -9011.9; y_m < 9000.0; y_m += 753.9) { visit(glm::dvec2(x_m, y_m)); }
    }
}

} // namespace

TEST_CASE("clouds cover the share of the sky that they are asked for, each place once") {
    for (const double cover : {0.2, 0.5, 0.8}) {
        CloudLayer layer(cover);
        int places = 0;
        int covered = 0;
        for (const glm::dvec2 eye_m : {glm::dvec2(0.0, 0.0), {16e3, 0.0}, {0.0, 16e3}, {16e3, 16e3}}) {
            const auto clouds = layer.seen_from({eye_m, 0.0}, layer_m, 0.0);
            for_places([&](const glm::dvec2& place_m) {
                const Above found = above(clouds, place_m);
                CHECK(found.triangles <= 1);
                ++places;
                covered += found.density > 118.0 ? 1 : 0;
            });
        }
        CHECK(covered / static_cast<double>(places) == Approx(cover).margin(0.1));
    }
    CloudLayer none(0.0);
    CHECK(none.seen_from({0.0, 0.0, 0.0}, layer_m, 0.0).indices.empty());
}

TEST_CASE("clouds stand still over the ground while the eye moves below them") {
    CloudLayer layer(0.5);
    const glm::dvec3 eye_m(300.0, 500.0, 100.0);
    const glm::dvec3 on_m(32.0, 11.0, 5.0); // less than a cell, across an edge of the lattice
    std::vector<double> before;
    const auto here = layer.seen_from(eye_m, layer_m, 0.0);
    for_places([&](const glm::dvec2& place_m) { before.push_back(above(here, place_m - glm::dvec2(eye_m)).density); });
    const auto there = layer.seen_from(eye_m + on_m, layer_m, 0.0);
    std::size_t number = 0;
    double worst = 0.0;
    for_places([&](const glm::dvec2& place_m) {
        const double now = above(there, place_m - glm::dvec2(eye_m + on_m)).density;
        worst = std::max(worst, std::abs(now - before[number++]));
    });
    CHECK(worst < 12.0); // of 255
}

TEST_CASE("an eye in the layer sees nothing of it, one far from it all") {
    CloudLayer layer(0.6);
    const auto most = [&](double eye_m) {
        std::uint32_t densest = 0;
        for (const auto& vertex : layer.seen_from({0.0, 0.0, eye_m}, layer_m, 6.4e6).vertices) {
            densest = std::max(densest, vertex.colour >> 24U);
        }
        return densest;
    };
    CHECK(most(layer_m + 10.0) == 0);
    CHECK(most(layer_m - 80.0) < most(layer_m - 400.0));
    CHECK(most(layer_m - 400.0) > 200);
    CHECK(most(layer_m + 400.0) > 200);
}

TEST_CASE("clouds lie at their height, sink over a round earth and end where they must") {
    CloudLayer layer(0.7);
    const glm::dvec3 eye_m(0.0, 0.0, 500.0);
    constexpr double earth_m = 6.371e6;
    for (const auto& vertex : layer.seen_from(eye_m, layer_m, earth_m).vertices) {
        const glm::dvec3 at_m(vertex.position_m);
        const double away_m2 = at_m.x * at_m.x + at_m.y * at_m.y;
        CHECK(at_m.z == Approx(layer_m - eye_m.z - away_m2 / (2.0 * earth_m)).margin(0.01));
        if (std::sqrt(away_m2) > CloudLayer::reach_m) { CHECK(vertex.colour >> 24U == 0); }
    }
}

TEST_CASE("clouds are white at noon, dark where thick from below, warm under a low sun") {
    const auto mean_colour = [](double elevation_rad, double eye_m) {
        CloudLayer layer(0.7);
        layer.set_daylight(Daylight({0.4, elevation_rad, {0.62F, 0.72F, 0.84F}}));
        glm::dvec3 sum(0.0);
        double weight = 0.0;
        for (const auto& vertex : layer.seen_from({0.0, 0.0, eye_m}, layer_m, 0.0).vertices) {
            const double density = vertex.colour >> 24U;
            sum += density * glm::dvec3(vertex.colour & 255U, vertex.colour >> 8U & 255U, vertex.colour >> 16U & 255U);
            weight += 255.0 * density;
        }
        return sum / weight;
    };
    const glm::dvec3 from_above = mean_colour(1.0, 5000.0);
    const glm::dvec3 from_below = mean_colour(1.0, 0.0);
    const glm::dvec3 evening = mean_colour(0.06, 5000.0);
    CHECK(from_above.y > 0.75);
    CHECK(from_below.y < from_above.y - 0.1);
    CHECK(evening.x / evening.z > from_above.x / from_above.z + 0.1);
}
