#include "visuals/planning/ground_frame.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace octant;
using namespace octant::visuals::planning;

namespace {

constexpr double pixel_rad = 1e-3;

/// Triangles kept of one triangle on level ground `height_m` above the eye, counter-clockwise seen from above.
std::size_t kept_of_one(float height_m, float far_m = 100.0F) {
    const std::vector<models::ColourVertex> vertices = {
        {{-10.0F, far_m, height_m}, 0}, {{10.0F, far_m, height_m}, 0}, {{0.0F, far_m + 10.0F, height_m}, 0}};
    const std::vector<std::uint32_t> indices = {0, 1, 2};
    std::vector<std::uint32_t> kept;
    return front_facing({{vertices, indices}, {}, {}}, pixel_rad, kept).indices.size() / 3;
}

} // namespace

TEST_CASE("ground below the eye is kept and ground above the eye is dropped") {
    CHECK(kept_of_one(-20.0F) == 1);
    CHECK(kept_of_one(20.0F) == 0);
}

TEST_CASE("ground seen edge-on is kept from either side") {
    CHECK(kept_of_one(0.0F) == 1);
    CHECK(kept_of_one(1e-4F) == 1);
    // A hundredth of a pixel of height at this distance is within a renderer's rounding.
    CHECK(kept_of_one(0.001F, 1000.0F) == 1);
    CHECK(kept_of_one(30.0F, 1000.0F) == 0);
}

TEST_CASE("kept triangles stay in their order with their corners") {
    const std::vector<models::ColourVertex> vertices = {
        {{-1.0F, 9.0F, -5.0F}, 0}, {{1.0F, 9.0F, -5.0F}, 0}, {{0.0F, 12.0F, -5.0F}, 0}, {{0.0F, 12.0F, 5.0F}, 0}};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 1, 1, 2, 0};
    std::vector<std::uint32_t> kept;
    front_facing({{vertices, indices}, {}, {}}, pixel_rad, kept);
    CHECK(kept == std::vector<std::uint32_t>{0, 1, 2, 1, 2, 0});
}
