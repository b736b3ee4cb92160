#include "models/heights/runway_strip.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace octant;
using namespace octant::models::heights;

namespace {

constexpr double spacing_m = 30.0;

/// 24 x 24 km about the origin.
HeightField field_of(const std::function<double(double x_m, double y_m)>& height_m) {
    constexpr int side = 801;
    std::vector<float> heights_m;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            heights_m.push_back(static_cast<float>(height_m((column - 400) * spacing_m, (row - 400) * spacing_m)));
        }
    }
    return {side, side, spacing_m, heights_m};
}

double rolling_m(double x_m, double y_m) { return 400.0 + 8.0 * std::sin(x_m / 300.0) + 6.0 * std::cos(y_m / 250.0); }

double gap_to(const RunwayStrip& strip, const HeightField& field, const glm::dvec2& place_m) {
    return std::abs(*field.height_at(place_m.x, place_m.y) - strip.plane_m(place_m));
}

} // namespace

TEST_CASE("a runway's own places are told along it and to its left") {
    RunwayStrip strip;
    strip.begin_m = {100.0, 200.0};
    strip.heading_rad = rad_from_deg(90.0);
    CHECK(glm::distance(strip.place({50.0, 10.0}), glm::dvec2(150.0, 210.0)) < 1e-9);
    CHECK(glm::distance(strip.strip_from_world({150.0, 210.0}), glm::dvec2(50.0, 10.0)) < 1e-9);
    CHECK(strip.distance_m({1000.0, 215.0}) == 0.0);
    CHECK(strip.distance_m({1000.0, 232.5}) == Approx(10.0));
    CHECK(strip.distance_m({97.0, 226.5}) == Approx(5.0));
    CHECK(strip.distance_m({1903.0, 173.5}) == Approx(5.0));
}

TEST_CASE("ground is levelled on a runway and 60 m beside it, and kept far from it") {
    const HeightField field = field_of(rolling_m);
    const auto site = runway_site(field, {{{200.0, -100.0}}, rad_from_deg(33.0), 0.0});
    REQUIRE(site);
    CHECK(site->matches_request);
    CHECK(site->earthwork_m > 5.0);
    const HeightField level = levelled(field, site->strip);
    const RunwayStrip& strip = site->strip;
    CHECK(std::abs(strip.rise) <= max_rise);
    for (double along_m = -60.0; along_m <= strip.length_m + 60.0; along_m += 7.0) {
        for (double left_m = -82.5; left_m <= 82.5; left_m += 5.0) {
            if (strip.distance_m(strip.place({along_m, left_m})) <= level_margin_m) {
                REQUIRE(gap_to(strip, level, strip.place({along_m, left_m})) < 1e-3);
            }
        }
    }
    int moved = 0;
    double max_m = 0.0;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const double by_m =
                std::abs(static_cast<double>(level.height_m(column, row)) - field.height_m(column, row));
            const glm::dvec2 at_m(field.sample_m(column, row));
            REQUIRE((by_m == 0.0 || strip.distance_m(at_m) < reach_m(field)));
            max_m = std::max(max_m, by_m);
            moved += by_m > 0.0 ? 1 : 0;
        }
    }
    CHECK(moved > 300);
    CHECK(max_m == Approx(site->earthwork_m).margin(1e-3));
}

TEST_CASE("cuttings and embankments rise by one in seven, and end where they meet the ground") {
    RunwayStrip strip;
    strip.begin_m = {0.0, -900.0};
    strip.height_m = 100.0;
    for (const double own_m : {70.0, 130.0}) {
        const HeightField level = levelled(field_of([&](double, double) { return own_m; }), strip);
        const double towards = own_m < 100.0 ? -1.0 : 1.0;
        const double begins_m = 22.5 + level_margin_m + std::sqrt(2.0) * spacing_m;
        for (double x_m = 150.0; x_m < 300.0; x_m += spacing_m) {
            CHECK(*level.height_at(x_m, 0.0) == Approx(100.0 + towards * (x_m - begins_m) / 7.0).margin(1e-3));
        }
        CHECK(*level.height_at(540.0, 0.0) == own_m);
        double steepest = 0.0;
        for (double x_m = 0.0; x_m < 900.0; x_m += spacing_m) {
            steepest = std::max(
                steepest, std::abs(*level.height_at(x_m + spacing_m, 0.0) - *level.height_at(x_m, 0.0)) / spacing_m);
        }
        CHECK(steepest < 0.17); // one in seven, and the way over to the ground where both end
    }
}

TEST_CASE("a levelled field is the same place on the earth") {
    HeightField field = field_of(rolling_m);
    field.name = "rolling";
    field.place = GeoPosition{46.0, 7.0};
    field.filled_voids = 3;
    const HeightField level = levelled(field, {});
    CHECK(level.name == "rolling");
    REQUIRE(level.place);
    CHECK(level.place->latitude_deg == 46.0);
    CHECK(level.filled_voids == 3);
    CHECK(level.columns() == field.columns());
}

TEST_CASE("a runway follows a gentle slope and cuts through a steep one") {
    const RunwayRequest north{{{0.0, 0.0}}, 0.0, 0.0};
    const auto gentle = runway_site(field_of([](double, double y_m) { return 300.0 + 0.006 * y_m; }), north);
    REQUIRE(gentle);
    CHECK(gentle->strip.rise == Approx(0.006).margin(1e-6));
    CHECK(gentle->earthwork_m < 0.01);
    CHECK(gentle->strip.begin_m.y == Approx(-300.0));
    const auto steep = runway_site(field_of([](double, double y_m) { return 800.0 + 0.02 * y_m; }), north);
    REQUIRE(steep);
    CHECK(steep->strip.rise == Approx(max_rise));
    CHECK(steep->earthwork_m == Approx(10.0).margin(2.0));
}

TEST_CASE("where the ground is too rough another place near it is found") {
    // Ridges 120 m high but for a plain in the east.
    const auto ridges = [](double x_m, double y_m) {
        return x_m > 3000.0 ? 500.0 : 500.0 + 60.0 * std::sin(x_m / 150.0) * std::sin(y_m / 180.0);
    };
    const HeightField field = field_of(ridges);
    const RunwayRequest wish{{{0.0, 0.0}}, rad_from_deg(70.0), 0.0};
    const auto site = runway_site(field, wish);
    REQUIRE(site);
    CHECK(site->earthwork_m <= max_earthwork_m);
    CHECK_FALSE(site->matches_request);
    CHECK(site->strip.distance_m({0.0, 0.0}) > 2500.0);
    CHECK(site->strip.distance_m({0.0, 0.0}) < runway_search_radius_m);
    CHECK(runway_site(field, wish)->strip == site->strip);

    // A path that leads there has it nearer to where it comes by.
    const auto ahead = runway_site(field, {{{0.0, 0.0}, {4000.0, 4000.0}}, 0.0, 0.0});
    REQUIRE(ahead);
    CHECK(ahead->strip.distance_m({4000.0, 4000.0}) < 1000.0);

    const auto none = runway_site(field, {{{-9000.0, 0.0}}, 0.0, 0.0});
    REQUIRE(none);
    CHECK(none->earthwork_m > max_earthwork_m);
}

TEST_CASE("no runway lies in water or beyond the edge of the map") {
    const auto lake = [](double x_m, double) { return x_m < 1000.0 ? 0.0 : 12.0; };
    const auto ashore = runway_site(field_of(lake), {{{0.0, 0.0}}, 0.0, 0.0});
    REQUIRE(ashore);
    CHECK(ashore->strip.begin_m.x > 1000.0);
    CHECK_FALSE(runway_site(field_of([](double, double) { return -2.0; }), {{{0.0, 0.0}}, 0.0, 0.0}));
    const auto at_the_edge = runway_site(field_of(rolling_m), {{{0.0, 11500.0}}, 0.0, 0.0});
    REQUIRE(at_the_edge);
    CHECK(at_the_edge->strip.place({1860.0, 0.0}).y <= 12000.0);
    CHECK(at_the_edge->earthwork_m <= max_earthwork_m);
}
