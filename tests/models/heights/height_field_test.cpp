#include "models/heights/height_field.h"
#include "models/heights/height_voids.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace octant::models;
using namespace octant::models::heights;

namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// 3 x 2 samples 10 m apart: south row 0 1 4, north row 2 3 8.
HeightField small_field() { return {3, 2, 10.0, {0, 1, 4, 2, 3, 8}}; }

} // namespace

TEST_CASE("a field puts its first sample at the south-west corner and its centre at the origin") {
    const HeightField field = small_field();
    CHECK(field.columns() == 3);
    CHECK(field.rows() == 2);
    CHECK(field.half_extent_m() == glm::dvec2(10.0, 5.0));
    CHECK(field.sample_m(0, 0) == glm::dvec3(-10.0, -5.0, 0.0));
    CHECK(field.sample_m(2, 1) == glm::dvec3(10.0, 5.0, 8.0));
    CHECK(field.lowest_m() == 0.0F);
    CHECK(field.highest_m() == 8.0F);
    CHECK_FALSE(field.place);
    CHECK(field.filled_voids == 0);
}

TEST_CASE("heights between samples are bilinear up to the rim and nothing lies beyond it") {
    const HeightField field = small_field();
    CHECK(*field.height_at(-10.0, -5.0) == 0.0);
    CHECK(*field.height_at(10.0, 5.0) == 8.0);
    CHECK(*field.height_at(0.0, 0.0) == Approx(2.0));
    CHECK(*field.height_at(-5.0, 0.0) == Approx(1.5));
    CHECK(*field.height_at(5.0, 2.5) == Approx(0.25 * 2.5 + 0.75 * 5.5));
    CHECK_FALSE(field.height_at(10.001, 0.0));
    CHECK_FALSE(field.height_at(0.0, -5.001));
    CHECK_FALSE(field.height_at(std::nan(""), 0.0));
}

TEST_CASE("normals are central differences inside and one-sided at the rim") {
    const HeightField field(3, 3, 2.0, {0, 1, 4, 0, 1, 4, 6, 7, 10});
    const auto check = [&field](int column, int row, double east, double north) {
        const glm::vec3 normal = field.normal_at_sample(column, row);
        const double length = std::sqrt(east * east + north * north + 1.0);
        CHECK(normal.x == Approx(-east / length).margin(1e-6));
        CHECK(normal.y == Approx(-north / length).margin(1e-6));
        CHECK(normal.z == Approx(1.0 / length));
    };
    check(1, 1, (4.0 - 0.0) / 4.0, (7.0 - 1.0) / 4.0);
    check(0, 0, (1.0 - 0.0) / 2.0, 0.0);
    check(2, 2, (10.0 - 7.0) / 2.0, (10.0 - 4.0) / 2.0);
}

TEST_CASE("a void of one sample gets the mean of its four neighbours") {
    HeightGrid grid = {3, 3, {9, 2, 9, 4, none, 8, 9, 6, 9}};
    CHECK(fill_voids(grid) == 1);
    CHECK(grid.heights_m == std::vector<float>{9, 2, 9, 4, 5, 8, 9, 6, 9});
}

TEST_CASE("a void in a slope is filled with the slope") {
    HeightGrid grid = {33, 33, {}};
    for (int row = 0; row < 33; ++row) {
        for (int column = 0; column < 33; ++column) {
            const bool hole = column >= 9 && column < 21 && row >= 10 && row < 24;
            grid.heights_m.push_back(hole ? none : static_cast<float>(3 * column - 2 * row));
        }
    }
    CHECK(fill_voids(grid) == 12L * 14L);
    for (int row = 0; row < 33; ++row) {
        for (int column = 0; column < 33; ++column) {
            CHECK(grid.at(column, row) == Approx(3 * column - 2 * row).margin(1.0));
        }
    }
}

TEST_CASE("filled heights stay within the known ones, whatever the pattern of voids") {
    for (const int rows : {2, 3, 7, 64}) {
        HeightGrid grid = {61, rows, {}};
        long voids = 0;
        for (int i = 0; i < 61 * rows; ++i) {
            const bool known = (i * 7919 + i / 13) % 29 == 4;
            voids += known ? 0 : 1;
            grid.heights_m.push_back(known ? static_cast<float>(i % 50) : none);
        }
        const std::vector<float> before = grid.heights_m;
        CHECK(fill_voids(grid) == voids);
        for (std::size_t i = 0; i < before.size(); ++i) {
            CHECK(grid.heights_m[i] >= 0.0F);
            CHECK(grid.heights_m[i] <= 49.0F);
            CHECK((std::isnan(before[i]) || before[i] == grid.heights_m[i]));
        }
    }
}

TEST_CASE("a grid of voids alone is left as it is, a full one too") {
    HeightGrid voids = {2, 2, {none, none, none, none}};
    CHECK(fill_voids(voids) == 4);
    CHECK(std::isnan(voids.at(1, 1)));
    HeightGrid full = {2, 2, {1, 2, 3, 4}};
    CHECK(fill_voids(full) == 0);
    CHECK(full.heights_m == std::vector<float>{1, 2, 3, 4});
}
