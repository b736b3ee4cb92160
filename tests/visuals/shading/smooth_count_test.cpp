#include "visuals/shading/smooth_count.h"

#include <catch2/catch.hpp>

using namespace octant::visuals::shading;

TEST_CASE("all polygons are smooth to the near distance, none from the far one, half between") {
    const ShadingRange range{.near_m = 100.0, .far_m = 300.0};
    CHECK(smooth_count(0.0, range, 416) == 416);
    CHECK(smooth_count(100.0, range, 416) == 416);
    CHECK(smooth_count(200.0, range, 416) == 208); // where the printed formula has its pole
    CHECK(smooth_count(250.0, range, 416) == 104);
    CHECK(smooth_count(300.0, range, 416) == 0);
    CHECK(smooth_count(1e9, range, 416) == 0);
}

TEST_CASE("three levels of distance are all, half and none smooth") {
    const ShadingRange range{.near_m = 0.0, .far_m = 100.0, .levels = 3};
    CHECK(smooth_count(24.0, range, 10) == 10);
    CHECK(smooth_count(26.0, range, 10) == 5);
    CHECK(smooth_count(74.0, range, 10) == 5);
    CHECK(smooth_count(76.0, range, 10) == 0);
}

TEST_CASE("the paper's telephone has 9 smooth ones of 415 polygons, its desktop all") {
    CHECK(device_smooth_count(0.028, 415) == 9);
    CHECK(device_smooth_count(1.0, 415) == 415);
    CHECK(device_smooth_count(0.0, 415) == 0);
}

TEST_CASE("a faster device never has fewer smooth polygons") {
    int before = 0;
    for (int percent = 0; percent <= 100; ++percent) {
        const int now = device_smooth_count(percent / 100.0, 416);
        CHECK(now >= before);
        before = now;
    }
}
