#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/quadtree.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;
using octant::models::heights::HeightField;

namespace {

const float share = static_cast<float>(0.5 + std::sqrt(2.5) / 4.0); // K for C_min = 2

/// Packing raises a roughness by at most 0.05 %.
bool about(float packed, float exact) { return packed >= exact * 0.9999F && packed <= exact * 1.002F; }

} // namespace

TEST_CASE("the smallest fields have one node") {
    for (const auto& [columns, rows] : {std::pair(2, 2), std::pair(3, 2), std::pair(3, 3)}) {
        const HeightField field = level_field(columns, rows);
        const Quadtree tree(field);
        CHECK(tree.levels() == 1);
        CHECK(tree.edge_samples(0) == 2);
        CHECK(tree.nodes().size() == 1);
    }
}

TEST_CASE("only nodes with an area within the field exist") {
    const HeightField field = level_field(10, 4); // 9 x 3 intervals in a square of 16
    const Quadtree tree(field);
    REQUIRE(tree.levels() == 4);
    CHECK(tree.columns(0) == 1);
    CHECK(tree.rows(0) == 1);
    CHECK(tree.columns(1) == 2); // edge 8
    CHECK(tree.rows(1) == 1);
    CHECK(tree.columns(2) == 3); // edge 4
    CHECK(tree.rows(2) == 1);
    CHECK(tree.columns(3) == 5); // edge 2
    CHECK(tree.rows(3) == 2);
    CHECK(tree.nodes().size() == 1 + 2 + 3 + 10);
}

TEST_CASE("a peak in the middle of 5 x 5 samples is half as steep over a side as over a child") {
    const HeightField field = bump_field(5, 2, 2, 1.0F);
    SECTION("mid-point: the root's centre is 1 m off over 4 m, a child's sides 0.5 m over 2 m") {
        const Quadtree tree(field, {Roughness::Midpoint, RoughnessPropagation::CrackFree, 2.0});
        CHECK(about(tree.roughness(1, 0, 0), 0.25F));
        CHECK(about(tree.roughness(1, 1, 1), 0.25F));
        CHECK(about(tree.roughness(0, 0, 0), 0.25F));
    }
    SECTION("literal: the root's corners are level, a child's differ by 1 m over 2 m") {
        const Quadtree tree(field, {Roughness::Printed, RoughnessPropagation::CrackFree, 2.0});
        CHECK(about(tree.roughness(1, 1, 0), 0.5F));
        CHECK(about(tree.roughness(0, 0, 0), share * 0.5F));
    }
    SECTION("printed: the plain maximum reaches the root") {
        const Quadtree tree(field, {Roughness::Printed, RoughnessPropagation::Printed, 2.0});
        CHECK(about(tree.roughness(0, 0, 0), 0.5F));
    }
}

TEST_CASE("a rough node roughens the two parents beyond its outer edges, and no other") {
    const HeightField field = bump_field(9, 3, 3, 1.0F); // centre of node (1, 1) of the last level
    SECTION("crack-free") {
        const Quadtree tree(field);
        CHECK(about(tree.roughness(2, 1, 1), 0.5F));
        CHECK(tree.roughness(2, 2, 1) == 0.0F);
        CHECK(about(tree.roughness(1, 0, 0), share * 0.5F));
        CHECK(about(tree.roughness(1, 1, 0), share * 0.5F));
        CHECK(about(tree.roughness(1, 0, 1), share * 0.5F));
        CHECK(tree.roughness(1, 1, 1) == 0.0F);
        CHECK(about(tree.roughness(0, 0, 0), share * share * 0.5F));
    }
    SECTION("printed") {
        const Quadtree tree(field, {Roughness::Midpoint, RoughnessPropagation::Printed, 2.0});
        CHECK(about(tree.roughness(1, 0, 0), 0.5F));
        CHECK(tree.roughness(1, 1, 0) == 0.0F);
        CHECK(tree.roughness(1, 0, 1) == 0.0F);
        CHECK(about(tree.roughness(0, 0, 0), 0.5F));
    }
}

TEST_CASE("a slope has no mid-point roughness, whatever the field's size") {
    for (const int size : {5, 7, 12}) {
        std::vector<float> heights;
        for (int row = 0; row < size; ++row) {
            for (int column = 0; column < size; ++column) {
                heights.push_back(static_cast<float>(2 * column + 3 * row));
            }
        }
        const HeightField field(size, size, 1.0, heights);
        const Quadtree smooth(field);
        CHECK(smooth.roughness(0, 0, 0) < 1e-4F);
        const Quadtree steep(field, {Roughness::Printed, RoughnessPropagation::CrackFree, 2.0});
        CHECK(about(steep.roughness(steep.levels() - 1, 0, 0), 5.0F)); // 10 m over 2 m
    }
}

TEST_CASE("the height bounds of a node hold its samples") {
    const HeightField field = rough_field(37, 22, 4);
    const Quadtree tree(field);
    const double slack_m = static_cast<double>(field.highest_m() - field.lowest_m()) / 254.0;
    for (int level = 0; level < tree.levels(); ++level) {
        const int edge = tree.edge_samples(level);
        for (int row = 0; row < tree.rows(level); ++row) {
            for (int column = 0; column < tree.columns(level); ++column) {
                double low_m = 1e9;
                double high_m = -1e9;
                for (int j = row * edge; j <= std::min((row + 1) * edge, 21); ++j) {
                    for (int i = column * edge; i <= std::min((column + 1) * edge, 36); ++i) {
                        low_m = std::min(low_m, static_cast<double>(field.height_m(i, j)));
                        high_m = std::max(high_m, static_cast<double>(field.height_m(i, j)));
                    }
                }
                const QuadtreeNode& node = tree.nodes()[tree.index_of(level, column, row)];
                REQUIRE(tree.lowest_m(node) <= low_m + 1e-5);
                REQUIRE(tree.lowest_m(node) >= low_m - slack_m);
                REQUIRE(tree.highest_m(node) >= high_m - 1e-5);
                REQUIRE(tree.highest_m(node) <= high_m + slack_m);
            }
        }
    }
}

TEST_CASE("roughness falls by no more than K towards every parent that a split node needs") {
    const HeightField field = rough_field(70, 45, 9);
    for (const Roughness roughness : {Roughness::Printed, Roughness::Midpoint}) {
        const Quadtree tree(field, {roughness, RoughnessPropagation::CrackFree, 2.0});
        for (int level = 1; level < tree.levels(); ++level) {
            for (int row = 0; row < tree.rows(level); ++row) {
                for (int column = 0; column < tree.columns(level); ++column) {
                    const float needed = share * tree.roughness(level, column, row);
                    const int neighbour_column = column / 2 + (column % 2 == 0 ? -1 : 1);
                    const int above = row / 2 + (row % 2 == 0 ? -1 : 1);
                    REQUIRE(tree.roughness(level - 1, column / 2, row / 2) >= needed);
                    if (neighbour_column >= 0 && neighbour_column < tree.columns(level - 1)) {
                        REQUIRE(tree.roughness(level - 1, neighbour_column, row / 2) >= needed);
                    }
                    if (above >= 0 && above < tree.rows(level - 1)) {
                        REQUIRE(tree.roughness(level - 1, column / 2, above) >= needed);
                    }
                }
            }
        }
    }
}
