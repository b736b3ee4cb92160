#include "visuals/refine/progressive_tree.h"

#include <catch2/catch.hpp>

#include <utility>

using namespace octant::visuals::refine;

namespace {

/// Roots of two leaves each.
ProgressiveTree pairs(std::uint32_t roots) {
    ProgressiveTree tree;
    for (std::uint32_t root = 0; root < roots; ++root) {
        TreeNode node;
        node.begin = 2 * root;
        node.end = 2 * root + 2;
        CHECK(tree.add_root(node));
    }
    CHECK(tree.roots_cover_leaves(2 * roots));
    return tree;
}

/// Of the pair that begins at a leaf, with faces on both sides towards other leaves.
TreeSplit split_of(std::uint32_t begin, std::uint32_t left_leaf, std::uint32_t right_leaf) {
    TreeSplit split;
    split.begin = begin;
    split.middle = begin + 1;
    split.left = TreeFace{{begin, begin + 1, left_leaf}};
    split.right = TreeFace{{begin + 1, begin, right_leaf}};
    return split;
}

} // namespace

TEST_CASE("a split between two other vertices is one that a hierarchy can have") {
    ProgressiveTree tree = pairs(3);
    CHECK(tree.add_split(split_of(0, 2, 4)));
    CHECK(tree.add_split(split_of(2, 0, 1)));
}

TEST_CASE("a split with one and the same vertex on both sides is refused") {
    CHECK_FALSE(pairs(3).add_split(split_of(0, 2, 2)));
    CHECK_FALSE(pairs(3).add_split(split_of(0, 2, 3)));
}

TEST_CASE("two splits that wait for one another are refused") {
    ProgressiveTree tree = pairs(2);
    CHECK_FALSE(tree.add_split(split_of(0, 2, 3)));
}
