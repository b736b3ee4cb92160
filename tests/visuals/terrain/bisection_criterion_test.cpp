#include "tests/visuals/terrain/ground_check.h"

#include <catch2/catch.hpp>

#include <array>
#include <limits>
#include <vector>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;

namespace {

/// Critical values of all nodes of all levels.
struct AllCriticals {
    AllCriticals(const BisectionCriterion& rule, const GroundTiles& ground) {
        const GroundLayout& layout = ground.layout();
        std::vector<VerticalDistances> distances; // of the last level with ranges, in the end
        for (int level = 0; level < ground.levels(); ++level) {
            const GroundLayout::Level& at = layout.level(level);
            if (level <= layout.range_level()) { distances.clear(); }
            for (int row = 0; row < at.rows; ++row) {
                for (int column = 0; column < at.columns; ++column) {
                    if (level <= layout.range_level()) {
                        distances.push_back(rule.vertical_distances_of(level, column, row));
                    }
                }
            }
            const int finer = std::max(level - layout.range_level(), 0);
            const int blocks = layout.level(std::min(level, layout.range_level())).columns;
            auto& criticals = of_level.emplace_back();
            for (int row = 0; row < at.rows; ++row) {
                for (int column = 0; column < at.columns; ++column) {
                    const auto block = static_cast<std::size_t>((row >> finer) * blocks + (column >> finer));
                    criticals.push_back(rule.criticals_of({level, column, row, &distances[block]}));
                }
            }
            columns.push_back(at.columns);
            rows.push_back(at.rows);
        }
    }

    const FanCriticalValues& at(std::size_t level, int column, int row) const {
        return of_level[level][static_cast<std::size_t>(row * columns[level] + column)];
    }

    float centre(std::size_t level, int column, int row) const {
        const auto quadrant = static_cast<std::size_t>((column & 1) | (row & 1) << 1);
        return level == 0 ? 0.0F : at(level - 1, column / 2, row / 2).quadrant[quadrant];
    }

    bool has_child(std::size_t level, int column, int row, unsigned quadrant) const {
        return level + 1 == of_level.size() || (2 * column + static_cast<int>(quadrant & 1U) < columns[level + 1] &&
                                                   2 * row + static_cast<int>(quadrant >> 1U) < rows[level + 1]);
    }

    std::vector<std::vector<FanCriticalValues>> of_level;
    std::vector<int> columns;
    std::vector<int> rows;
};

} // namespace

TEST_CASE("critical values never shrink from a sample to one that needs it, to the last bit") {
    constexpr std::array<FieldSize, 5> sizes = {{{129, 129}, {257, 65}, {100, 70}, {37, 210}, {33, 33}}};
    long tested = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Numbers numbers(seed);
        const FieldSize& size = sizes[seed % sizes.size()];
        ErrorGround ground(any_field(size, numbers));
        BisectionCriterion rule(ground.tiles);
        MeshView view = any_view(numbers, ground.field);
        if (numbers.coin()) {
            const glm::dvec3 sample_m = ground.field.sample_m(size.columns / 2, size.rows / 3);
            view.eye_m = {sample_m.x, sample_m.y, view.eye_m.z};
        }
        rule.set_view(view, numbers.coin() ? 1.0 : numbers.between(0.0, 1.0));
        const AllCriticals all(rule, ground.tiles);
        INFO("seed " << seed);
        for (std::size_t level = 0; level < all.of_level.size(); ++level) {
            for (int row = 0; row < all.rows[level]; ++row) {
                for (int column = 0; column < all.columns[level]; ++column, ++tested) {
                    const FanCriticalValues& own = all.at(level, column, row);
                    const float centre = all.centre(level, column, row);
                    for (std::size_t k = 0; k < 4; ++k) {
                        REQUIRE(own.middle[k] >= centre);
                        for (const unsigned q : {fan_edges[k].quadrant_a, fan_edges[k].quadrant_b}) {
                            REQUIRE((own.quadrant[q] >= own.middle[k] || !all.has_child(level, column, row, q)));
                        }
                    }
                    if (column + 1 < all.columns[level]) {
                        REQUIRE(own.middle[1] == all.at(level, column + 1, row).middle[3]);
                    }
                    if (row + 1 < all.rows[level]) {
                        REQUIRE(own.middle[2] == all.at(level, column, row + 1).middle[0]);
                    }
                }
            }
        }
    }
    CHECK(tested > 100000);
}

TEST_CASE("a critical value is the squared distance to the region of influence over the error") {
    ErrorGround ground(bump_field(5, 2, 2, 8.0F));
    BisectionCriterion rule(ground.tiles);
    MeshView view;
    view.eye_m = {-5.0, 2.0, 11.0}; // 3 m west of the corner, 3 m above the bump
    rule.set_view(view);
    const VerticalDistances distances = rule.vertical_distances_of(0, 0, 0);
    CHECK(distances.squared_m2[0] == 9.0F);
    FanCriticalValues criticals = rule.criticals_of({0, 0, 0, &distances});
    // 3 m to each side of the middle of the south side, 2 m east and 1 m south of the eye. Beside the bump the ground
    // lies 4 m below the slope from there up to it.
    const float middle_m = ground.tiles.codes().metres(ground.tiles.error_code(0, NodePart::South, 0, 0));
    const ErrorCodes& codes = ground.tiles.codes();
    CHECK((middle_m >= 4.0F && middle_m <= codes.metres(codes.code_of(4.9F))));
    CHECK(criticals.middle[0] == Approx(14.0F / (middle_m * middle_m)));
    // 2 m to each side of the centre of the south-west quarter, as far from the eye.
    const float error_m = criticals.quadrant_error_m[0];
    CHECK(criticals.quadrant[0] == Approx(14.0F / (error_m * error_m)));
    ErrorGround level(level_field(5, 5));
    BisectionCriterion of_level(level.tiles);
    of_level.set_view(view);
    const VerticalDistances none = of_level.vertical_distances_of(0, 0, 0);
    criticals = of_level.criticals_of({0, 0, 0, &none});
    CHECK(criticals.middle[0] == std::numeric_limits<float>::infinity());
    CHECK(rule.error_px_of(rule.limit_of(1.5)) == Approx(1.5));
    CHECK(rule.limit_of(1.0) == Approx(869.1 * 869.1));
    CHECK(rule.root_error_m() == codes.metres(codes.code_of(8.0F)));
}
