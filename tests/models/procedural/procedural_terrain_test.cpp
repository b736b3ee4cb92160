#include "models/procedural/drainage.h"
#include "models/procedural/procedural_terrain.h"
#include "models/procedural/terrain_grid.h"
#include "models/procedural/terrain_noise.h"
#include "sim/base/hash.h"
#include "sim/base/random_generator.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <hwy/targets.h>
#include <utility>
#include <vector>

using namespace octant;
using namespace octant::models;
using namespace octant::models::heights;
using namespace octant::models::procedural;

namespace {

std::uint64_t hash_of(const HeightField& field) {
    Hash hash;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const float height = field.height_m(column, row);
            std::uint32_t bits = 0;
            std::memcpy(&bits, &height, sizeof bits);
            hash.add_word(bits);
        }
    }
    return hash.value();
}

/// Slopes of all samples in degrees, least first.
std::vector<double> slopes_deg(const HeightField& field) {
    std::vector<double> slopes;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const double up = std::min(1.0F, field.normal_at_sample(column, row).z);
            slopes.push_back(std::acos(up) * 57.29577951308232);
        }
    }
    std::sort(slopes.begin(), slopes.end());
    return slopes;
}

double share_of(const std::vector<double>& sorted, double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

std::vector<double> noise_at(
    const FractalNoise& noise, const std::vector<double>& x_m, const std::vector<double>& y_m) {
    std::vector<double> values(x_m.size());
    noise.at(x_m, y_m, values);
    return values;
}

} // namespace

TEST_CASE("made ground is the same in every build: the hash of its heights is fixed") {
    INFO("other heights need another made_version");
    CHECK(hash_of(procedural_hills({129, 40.0, 1})) == 0x425f6c75ad33e670ULL);
    CHECK(hash_of(procedural_hills({129, 40.0, 2})) == 0xe629b9233d911a32ULL);
    CHECK(hash_of(procedural_canyon({129, 40.0, 1})) == 0x9790aa8e9904017fULL);
    CHECK(hash_of(procedural_canyon({129, 40.0, 2})) == 0xe521718d1369301fULL);
}

TEST_CASE("made ground is known by its names") {
    const auto hills = procedural_terrain("hills", {33, 30.0, 5});
    const auto canyon = procedural_terrain("canyon", {33, 30.0, 5});
    REQUIRE(hills);
    REQUIRE(canyon);
    CHECK(hills->name == "hills");
    CHECK(canyon->name == "canyon");
    CHECK(hills->columns() == 33);
    CHECK(canyon->rows() == 33);
    CHECK(canyon->spacing_m() == 30.0);
    CHECK_FALSE(hills->place);
    CHECK(hash_of(*hills) == hash_of(procedural_hills({33, 30.0, 5})));
    CHECK_FALSE(procedural_terrain("Hills"));
    CHECK_FALSE(procedural_terrain(""));
}

TEST_CASE("hills are gentle: some hundred metres of relief, nine tenths below 20 degrees") {
    for (const std::uint64_t seed : {1U, 2U}) {
        const HeightField field = procedural_hills({257, 80.0, seed});
        CHECK(field.highest_m() - field.lowest_m() > 300.0F);
        CHECK(field.highest_m() - field.lowest_m() < 650.0F);
        CHECK(field.lowest_m() > 0.0F);
        const std::vector<double> slopes = slopes_deg(field);
        CHECK(share_of(slopes, 0.5) > 3.0);
        CHECK(share_of(slopes, 0.9) < 20.0);
        CHECK(slopes.back() < 45.0);
    }
}

TEST_CASE("the canyon cuts a plateau near 2000 m more than 1000 m deep, with cliffs and benches") {
    for (const std::uint64_t seed : {1U, 2U}) {
        const HeightField field = procedural_canyon({513, 40.0, seed});
        CHECK(field.lowest_m() > 800.0F);
        CHECK(field.lowest_m() < 900.0F);
        CHECK(field.highest_m() > 1900.0F);
        CHECK(field.highest_m() < 2200.0F);
        const std::vector<double> slopes = slopes_deg(field);
        CHECK(share_of(slopes, 0.2) < 8.0);
        CHECK(share_of(slopes, 0.95) > 45.0);
    }
}

TEST_CASE("the river crosses the middle of the canyon whatever the size") {
    for (const int size : {2, 17, 65}) {
        const HeightField field = procedural_canyon({size, 20.0, 3});
        CHECK(*field.height_at(0.0, 0.0) < 900.0);
    }
    CHECK(procedural_hills({2, 20.0, 3}).highest_m() < 1000.0F);
}

TEST_CASE("no lattice shows: neighbouring differences along rows and columns are alike") {
    const HeightField field = procedural_hills({257, 40.0, 4});
    double east = 0.0;
    double north = 0.0;
    for (int row = 0; row + 1 < 257; ++row) {
        for (int column = 0; column + 1 < 257; ++column) {
            const double here = field.height_m(column, row);
            east += std::abs(field.height_m(column + 1, row) - here);
            north += std::abs(field.height_m(column, row + 1) - here);
        }
    }
    CHECK(east / north == Approx(1.0).epsilon(0.3));
}

TEST_CASE("tributaries run downhill into the river") {
    const std::vector<Reach> reaches = canyon_network(8000.0, 1);
    long rising = 0;
    for (const Reach& reach : reaches) {
        CHECK(reach.from_m >= reach.to_m);
        CHECK(reach.to_m >= 0.0);
        rising += reach.from_m > 0.0 ? 1 : 0;
    }
    CHECK(rising > 100);
}

TEST_CASE("a pit is filled to its lowest rim and water then leaves it") {
    // A bowl of 5 x 5 whose rim is 9 except for one gap of height 4.
    TerrainGrid ground(5, 10.0);
    std::vector<char> outlet(25, 0);
    for (int row = 0; row < 5; ++row) {
        for (int column = 0; column < 5; ++column) {
            const bool rim = column == 0 || row == 0 || column == 4 || row == 4;
            ground.values[ground.index(column, row)] = rim ? 9.0 : 1.0;
            outlet[ground.index(column, row)] = rim ? 1 : 0;
        }
    }
    ground.values[ground.index(4, 2)] = 4.0;
    fill_pits(ground, outlet);
    CHECK(ground.at(2, 2) == Approx(4.0).margin(0.001));
    CHECK(ground.at(2, 2) > 4.0);
    const Drainage water = compute_drainage(ground, outlet, 1);
    CHECK(water.area_m2[ground.index(4, 2)] + water.area_m2[ground.index(4, 1)] + water.area_m2[ground.index(4, 3)] ==
          Approx(12 * 100.0));
    REQUIRE(water.upstream.size() == 25);
    std::vector<char> seen(25, 0);
    for (const int cell : water.upstream) {
        const auto i = static_cast<std::size_t>(cell);
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        CHECK((receiver == i || seen[receiver] != 0));
        seen[i] = 1;
    }
}

TEST_CASE("on a plane water runs in the direction of descent on average") {
    // Falls two cells east for each cell north.
    TerrainGrid ground(81, 1.0);
    std::vector<char> outlet(81 * 81, 0);
    for (int row = 0; row < 81; ++row) {
        for (int column = 0; column < 81; ++column) {
            ground.values[ground.index(column, row)] = 500.0 - 2.0 * column - row;
        }
    }
    const Drainage water = compute_drainage(ground, outlet, 7);
    double east = 0.0;
    double north = 0.0;
    for (int row = 5; row < 75; ++row) {
        for (int column = 5; column < 75; ++column) {
            const int receiver = water.receiver[ground.index(column, row)];
            east += receiver % 81 - column;
            north += receiver / 81 - row;
        }
    }
    CHECK(north / east == Approx(0.5).margin(0.02));
}

TEST_CASE("a stream in balance has the slope of its steepness over the root of its area") {
    // A strip that drains along one line: cell i carries the area of all cells above it.
    TerrainGrid ground(12, 100.0);
    std::vector<char> outlet(144, 0);
    for (int row = 0; row < 12; ++row) {
        outlet[ground.index(0, row)] = 1;
        for (int column = 0; column < 12; ++column) { ground.values[ground.index(column, row)] = column; }
    }
    const std::vector<double> uplift(144, 1.0);
    for (int step = 0; step < 400; ++step) { erode(ground, compute_drainage(ground, outlet, 1), uplift, {5.0, 80.0}); }
    const Drainage water = compute_drainage(ground, outlet, 1);
    for (int column = 1; column < 12; ++column) {
        const std::size_t i = ground.index(column, 6);
        const auto receiver = static_cast<std::size_t>(water.receiver[i]);
        const double slope = (ground.values[i] - ground.values[receiver]) / water.length_m[i];
        CHECK(slope == Approx(80.0 / std::sqrt(water.area_m2[i])).epsilon(1e-3));
    }
}

TEST_CASE("noise is zero at lattice points, bounded, smooth and without a mean") {
    const FractalNoise noise = {5, 1.0, 1, 0.5};
    constexpr std::size_t count = 20000;
    std::vector<double> x(count);
    std::vector<double> y(count);
    for (std::size_t i = 0; i < count; ++i) {
        x[i] = 0.137 * static_cast<double>(i);
        y[i] = 0.071 * static_cast<double>(i) - 300.0;
    }
    const std::vector<double> values = noise_at(noise, x, y);
    for (double& place : x) { place += 1e-4; }
    const std::vector<double> beside = noise_at(noise, x, y);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        CHECK(std::abs(values[i]) < 1.7);
        CHECK(std::abs(beside[i] - values[i]) < 1e-3);
        sum += values[i];
    }
    CHECK(std::abs(sum / count) < 0.02);
    CHECK(noise_at(noise, {3.0}, {-4.0})[0] == 0.0);
    CHECK(noise_at(noise, {3.5}, {-4.0}) != noise_at({6, 1.0, 1, 0.5}, {3.5}, {-4.0}));
}

TEST_CASE("noise is the same one by one and many at once") {
    const FractalNoise noise = {11, 300.0, 4, 0.5};
    std::vector<double> x;
    std::vector<double> y;
    for (int i = 0; i < 21; ++i) {
        x.push_back(37.0 * i - 200.0);
        y.push_back(19.0 * i);
    }
    const std::vector<double> values = noise_at(noise, x, y);
    for (std::size_t i = 0; i < x.size(); ++i) { CHECK(noise_at(noise, {x[i]}, {y[i]})[0] == values[i]); }
}

TEST_CASE("all instruction sets make the same ground") {
    const std::uint64_t hills = hash_of(procedural_hills({65, 60.0, 3}));
    const std::uint64_t canyon = hash_of(procedural_canyon({65, 60.0, 3}));
    const std::int64_t all = hwy::SupportedTargets();
    int sets = 0;
    for (int bit = 0; bit < 63; ++bit) {
        const std::int64_t target = std::int64_t{1} << bit;
        if ((all & target) != 0) {
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            CAPTURE(hwy::TargetName(target));
            CHECK(hash_of(procedural_hills({65, 60.0, 3})) == hills);
            CHECK(hash_of(procedural_canyon({65, 60.0, 3})) == canyon);
            ++sets;
        }
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    CHECK(sets >= 2);
}

TEST_CASE("water is let out of pits where the plainest way of filling them lets it out") {
    // Every cell looks at its neighbours until nothing changes.
    RandomGenerator dice(3);
    TerrainGrid ground(23, 50.0);
    for (double& height_m : ground.values) { height_m = std::floor(dice.between(0.0, 40.0)); }
    std::vector<char> outlet(ground.values.size(), 0);
    outlet[ground.index(0, 7)] = 1;
    outlet[ground.index(22, 22)] = 1;
    std::vector<double> plain(ground.values.size(), 1e9);
    for (bool changes = true; std::exchange(changes, false);) {
        for (int row = 0; row < 23; ++row) {
            for (int column = 0; column < 23; ++column) {
                const std::size_t i = ground.index(column, row);
                double lowest_m = outlet[i] != 0 ? ground.values[i] : 1e9;
                for (int y = std::max(row - 1, 0); y <= std::min(row + 1, 22); ++y) {
                    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, 22); ++x) {
                        lowest_m = std::min(lowest_m, std::max(ground.values[i], plain[ground.index(x, y)] + 5e-4));
                    }
                }
                changes = changes || lowest_m < plain[i];
                plain[i] = std::min(plain[i], lowest_m);
            }
        }
    }
    fill_pits(ground, outlet);
    CHECK(ground.values == plain);
}
