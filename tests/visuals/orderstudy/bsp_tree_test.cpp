#include "tests/order_shapes.h"
#include "tests/paper_example.h"
#include "visuals/orderfile/random_ray_test.h"
#include "visuals/orderstudy/bsp_tree.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

using namespace octant;
using namespace octant::visuals::orderfile;
using namespace octant::visuals::orderstudy;

namespace {

std::vector<std::uint32_t> painted(const BspTree& tree, const glm::dvec3& eye_m) {
    std::vector<std::uint32_t> list;
    std::vector<int> pending;
    append_painted(tree, eye_m, list, pending);
    return list;
}

/// Wrong rays of the lists that the tree gives to some eyes, each eye with its own list.
RayTestCounts rays_of(const BspTree& tree) {
    std::vector<std::uint32_t> list;
    const PaintedListOfEye painted_from = [&](const glm::dvec3& eye_m) {
        list = painted(tree, eye_m);
        return std::span<const std::uint32_t>(list);
    };
    const RaySampling samples{
        .eyes = 150, .rays_per_eye = 100, .min_distance_radii = 0.1, .max_distance_radii = 4.0, .seed = 11};
    return count_wrong_rays(tree.model, painted_from, samples);
}

} // namespace

TEST_CASE("the tree of the paper's example needs no cut and has a node for each plane") {
    const BspTree tree = bsp_tree(tests::paper_example());
    CHECK(tree.splits == 0);
    CHECK(tree.nodes.size() == 8); // P7, P8 and P9, P10 share their planes
    CHECK(tree.polygons.size() == 10);
    CHECK(tree.depth <= 8);
    CHECK(painted(tree, {0, 0, 0}).size() == 2); // inside, before the riser and over the tread
}

TEST_CASE("three bars, each over the next, are cut once or more") {
    const BspTree tree = bsp_tree(tests::three_bars());
    CHECK(tree.splits >= 1);
    CHECK(tree.model.polygons.size() == 6 + static_cast<std::size_t>(tree.splits));
    CHECK(tree.model.parents.size() == tree.model.polygons.size());
}

TEST_CASE("a tree paints what faces the eye, far before near, inside the model too") {
    for (const auto& model :
        {tests::paper_example(), tests::u_channel(), tests::three_bars(), tests::fig_14(true), tests::pile(5, 6)}) {
        const BspTree tree = bsp_tree(model);
        auto all = tree.polygons;
        std::ranges::sort(all);
        CHECK(all.size() == tree.model.polygons.size());
        CHECK(std::ranges::adjacent_find(all) == all.end());
        const RayTestCounts count = rays_of(tree);
        INFO(model.name);
        CHECK(count.hits > 1000);
        CHECK(count.wrong == 0);
    }
}
