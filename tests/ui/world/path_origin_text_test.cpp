#include "sim/base/earth_frame.h"
#include "ui/world/flight.h"

#include <catch2/catch.hpp>

using octant::GeoPosition;
using octant::TransverseMercator;
using octant::ui::world::path_origin_from_text;

TEST_CASE("a place in metres is taken as it is") {
    CHECK(path_origin_from_text("1200,-300.5", nullptr, {5000, 5000}) == glm::dvec2(1200, -300.5));
    CHECK(path_origin_from_text("49.3,-123.1", nullptr, {5000, 5000}) == glm::dvec2(49.3, -123.1));
    const TransverseMercator map({49.0, -123.0});
    CHECK(path_origin_from_text("1200,300", &map, {5000, 5000}) == glm::dvec2(1200, 300));
}

TEST_CASE("a place in degrees is found on a map with a place") {
    const TransverseMercator map({49.0, -123.0});
    for (const char* text : {"49.01N,123.01W", "49.01,-123.01"}) {
        const glm::dvec2 place = path_origin_from_text(text, &map, {5000, 5000});
        CHECK(place.y == Approx(1112).margin(5));
        CHECK(place.x == Approx(-731).margin(5));
    }
}

TEST_CASE("a place that is neither is refused") {
    CHECK_THROWS_WITH(path_origin_from_text("here", nullptr, {1, 1}),
        "--place: expected X,Y in metres or LAT,LON in degrees, got 'here'");
    CHECK_THROWS_WITH(path_origin_from_text("1,2,3", nullptr, {1, 1}), Catch::Contains("expected X,Y"));
    CHECK_THROWS_WITH(path_origin_from_text("49N,123", nullptr, {1, 1}), Catch::Contains("expected X,Y"));
    CHECK_THROWS_WITH(path_origin_from_text("-49N,123W", nullptr, {1, 1}), Catch::Contains("expected X,Y"));
    CHECK_THROWS_WITH(path_origin_from_text("nan,0", nullptr, {1, 1}), Catch::Contains("expected X,Y"));
    CHECK_THROWS_WITH(path_origin_from_text("49N,123W", nullptr, {1, 1}),
        "--place: expected X,Y in metres on a map without a place on the earth, got '49N,123W'");
    const TransverseMercator map(GeoPosition{49, -123});
    CHECK_THROWS_WITH(path_origin_from_text("99N,123W", &map, {1, 1}), Catch::Contains("latitude up to 90"));
}
