#include "tests/order_shapes.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/search_budget.h"
#include "visuals/draworder/view_cell.h"
#include "visuals/draworder/view_space_tree.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <utility>
#include <vector>

using namespace octant::visuals::draworder;
using octant::Plane;
using octant::tests::three_bars;

namespace {

/// Five polygons: 0 and 1 hide one another, 2, 3 and 4 hide one another in a ring, and 1 hides 2.
OcclusionGraph two_rings() {
    OcclusionGraph graph(5);
    graph.add(1, 0);
    graph.add(0, 1);
    graph.add(3, 2);
    graph.add(4, 3);
    graph.add(2, 4);
    graph.add(1, 2);
    return graph;
}

/// Unit squares across x at x = 0, 1, 2, ..., seen from +x.
ModelFaces row_of_plates(std::size_t count) {
    ModelFaces model{
        .faces = {}, .tolerances = {}, .rigid = OcclusionGraph(count), .ignored = OcclusionGraph(count), .notes = {}};
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<double>(i);
        const std::vector<glm::dvec3> corners{{x, 0, 0}, {x, 1, 0}, {x, 1, 1}, {x, 0, 1}};
        model.faces.push_back(outline_face(corners, {{1, 0, 0}, -x}, 1e-6));
    }
    return model;
}

/// The bars as the eye at (1, 1, 1) sees them: each over the next.
PersistentCycle of_bars() { return {{0, 1, 2}, ViewRegion::all_space(), glm::dvec3(5.0)}; }

} // namespace

TEST_CASE("bits that two rows share are counted, however long the rows") {
    for (const std::size_t words : {std::size_t{0}, std::size_t{1}, std::size_t{31}, std::size_t{70}}) {
        const std::vector<std::uint64_t> all(words, ~std::uint64_t{0});
        const std::vector<std::uint64_t> ends(words, 0x8000000000000001);
        CHECK(octant::count_common_bits(all, all) == 64 * words);
        CHECK(octant::count_common_bits(all, ends) == 2 * words);
    }
}

TEST_CASE("components are the rings of a graph, and edges between them do not count") {
    const CyclicPart cycles = cyclic_part_of(two_rings());
    CHECK(cycles.edges == 5);
    CHECK(cycles.polygons == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
    CHECK(cycles.components.size() == 2);
    CHECK(std::ranges::count(cycles.components, std::vector<std::uint32_t>{0, 1}) == 1);
    CHECK(std::ranges::count(cycles.components, std::vector<std::uint32_t>{2, 3, 4}) == 1);
    CHECK_FALSE(cycles.inner.occludes(1, 2));
    const std::vector<std::uint32_t> without_four{0, 1, 2, 3};
    CHECK(cyclic_part_of(two_rings(), without_four).polygons == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("the shortest ring is found, each hidden by the next") {
    const std::vector<std::uint32_t> all{0, 1, 2, 3, 4};
    CHECK(shortest_cycle(two_rings(), all) == std::vector<std::uint32_t>{0, 1});
    const std::vector<std::uint32_t> three{2, 3, 4};
    CHECK(shortest_cycle(two_rings(), three) == three);
    OcclusionGraph line(3);
    line.add(1, 0);
    line.add(2, 1);
    CHECK(shortest_cycle(line, std::vector<std::uint32_t>{0, 1, 2}).empty());
}

TEST_CASE("edges on cycles are counted without polygons and pairs that are gone") {
    const std::vector<std::uint32_t> all{0, 1, 2, 3, 4};
    const octant::BitSet none(5);
    octant::BitSet four(5);
    four.add(4);
    octant::BitSet one(5);
    one.add(1);
    octant::BitSet zero(5);
    zero.add(0);
    CyclicEdgeCounter rings;
    CHECK(rings.count(two_rings(), all, none, none, none) == 5);
    CHECK(rings.count(two_rings(), all, none, none, four) == 2);
    CHECK(rings.count(two_rings(), all, one, zero, none) == 3);
    CHECK(rings.count(two_rings(), all, one, zero, four) == 0);
}

TEST_CASE("sides of a plane: before, behind, across, and on it") {
    const ModelFaces model = row_of_plates(3);
    const std::vector<std::uint32_t> all{0, 1, 2};
    const PolygonsByPlaneSide on_middle = sides_of({{1, 0, 0}, -1}, model, all);
    CHECK_FALSE(on_middle.sets.front_or_on.has(0));
    CHECK(on_middle.sets.front_or_on.has(1));
    CHECK(on_middle.sets.back_or_on.has(1));
    CHECK(on_middle.sets.front_or_on.has(2));
    CHECK(on_middle.back_facing_behind.has(1));
    CHECK_FALSE(on_middle.back_facing_in_front.has(1));
    const PolygonsByPlaneSide across = sides_of({{0, 1, 0}, -0.5}, model, all);
    CHECK_FALSE(across.sets.front_or_on.has(0));
    CHECK_FALSE(across.sets.back_or_on.has(0));
}

TEST_CASE("of three bars in a ring one is cut along the plane of another") {
    WorkingModel work(three_bars(), glm::dvec3(0.0));
    work.resolve(of_bars());
    REQUIRE(work.sibling_pieces.size() == 1);
    CHECK(work.sibling_pieces[0] < 3);
    CHECK(work.faces.faces.size() == 7);
}

TEST_CASE("models that need too many splits, planes or entries are given up") {
    WorkingModel bars(three_bars(), glm::dvec3(0.0));
    bars.sibling_pieces.resize(113);
    CHECK_THROWS_AS(bars.resolve(of_bars()), SearchGivenUp);
    WorkingModel pile(octant::tests::pile(7, 6), glm::dvec3(0.0));
    OcclusionGraphBuilder graphs(pile.faces);
    const ViewCell root = view_cell(graphs, ViewRegion::all_space());
    CHECK_THROWS_AS(view_space_tree(pile, root, {.max_depth = 2}), SearchGivenUp);
    CHECK(view_space_tree(pile, root, {}).lists.size() > 4);
    CHECK_NOTHROW(check_entries(8'000'000));
    CHECK_THROWS_AS(check_entries(8'000'001), SearchGivenUp);
}

TEST_CASE("a tree that splits more than another order is given up, and only then asks how much") {
    SearchBudget budget(20.0);
    int asked = 0;
    const auto at_most = [&](int splits) {
        return [&asked, splits] {
            ++asked;
            return splits;
        };
    };
    const std::size_t splits = best_tree(three_bars(), budget, at_most(1000)).work.sibling_pieces.size();
    REQUIRE(splits > 0);
    CHECK(asked > 0);
    const int enough = static_cast<int>(splits);
    CHECK(best_tree(three_bars(), budget, at_most(enough)).work.sibling_pieces.size() == splits);
    try {
        best_tree(three_bars(), budget, at_most(enough - 1));
        FAIL("a tree was found");
    } catch (const SearchGivenUp& given_up) { CHECK(given_up.is_worse_than_best); }
    asked = 0;
    CHECK(best_tree(octant::tests::u_channel(), budget, at_most(0)).work.sibling_pieces.empty());
    CHECK(asked == 0);
}

TEST_CASE("the planes of a region bound it, however nearly some of them coincide") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int points = 0;
    int outside = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        std::vector<Plane> cuts;
        std::optional<ViewRegion> region = ViewRegion::all_space();
        const double spread = std::pow(10.0, -6.5 + 3.0 * unit(random)); // of planes that all but coincide
        for (int i = 0; i < 14; ++i) {
            const double angle_rad = 0.3927 * std::round(8.0 * unit(random));
            const double c = std::cos(angle_rad);
            const double s = std::sin(angle_rad);
            const glm::dvec3 off{unit(random), unit(random), unit(random)};
            const glm::dvec3 normal =
                glm::normalize((i % 3 == 2 ? glm::dvec3(0.0, c, s) : glm::dvec3(c, 0.0, s)) + spread * off);
            const glm::dvec3 through = unit(random) > 0.0 ? glm::dvec3(0.0) : glm::dvec3(0.5, 0.25, 0.1);
            Plane plane{normal, spread * unit(random) - glm::dot(normal, through)};
            if (!region->intersects_front_of(plane)) { plane = {-plane.normal, -plane.offset_m}; }
            if (std::optional<ViewRegion> cut = region->cut(plane)) {
                region = std::move(cut);
                cuts.push_back(plane);
            }
        }
        const std::vector<Plane> bounds = region->planes();
        for (int i = 0; i < 400; ++i) {
            const glm::dvec3 at = 3.0 * glm::dvec3(unit(random), unit(random), unit(random));
            const auto lowest_over = [&](const std::vector<Plane>& planes) {
                double lowest = 10.0;
                for (const Plane& plane : planes) {
                    lowest = std::min(lowest, glm::dot(plane.normal, at) + plane.offset_m);
                }
                return lowest;
            };
            if (lowest_over(bounds) < 0.0) { continue; }
            ++points;
            if (lowest_over(cuts) < -1e-6) { ++outside; }
        }
    }
    CHECK(points > 1000);
    CHECK(outside == 0);
}
