#pragma once

#include "visuals/refine/active_leaf_set.h"
#include "visuals/refine/progressive_mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace octant::visuals::refine {

/// A node as a file describes it. The leaves [begin, end) of the whole hierarchy lie below it.
struct TreeNode {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    glm::vec3 position_m{0.0F};
    PackedNormal normal;
    PackedColour colour;
};

/// A face as a file describes it.
struct TreeFace {
    /// Leaves of the whole hierarchy; a node not yet split stands for all leaves below it.
    std::array<std::uint32_t, 3> corners{};
    std::uint16_t material = 0;
};

/// A vertex split as a file describes it: of the active node whose leaves begin at `begin`. The leaves of its second
/// child begin at `middle`.
struct TreeSplit {
    std::uint32_t begin = 0;
    std::uint32_t middle = 0;
    float error_m = 0.0F;
    TreeNode first;
    TreeNode second;
    std::optional<TreeFace> left;
    std::optional<TreeFace> right;
};

/// A hierarchy that grows split by split from its roots, coarsest first, and may end anywhere: what a reader builds
/// while it reads. Each step returns whether the data is one that a hierarchy can have; after a false the tree must not
/// be used.
class ProgressiveTree {
public:
    bool add_root(const TreeNode& root);

    /// To be called after the last root. Returns whether the roots' ranges cover all leaves, each once.
    bool roots_cover_leaves(std::uint32_t leaves);

    bool add_base_face(const TreeFace& face);

    bool add_split(const TreeSplit& split);

    std::size_t split_count() const { return splits_.size(); }

    /// Whether there is nothing left to split and all faces have been added.
    bool is_complete(std::size_t leaves, std::size_t faces) const {
        return nodes_.size() - splits_.size() == leaves && faces_.size() == faces;
    }

    /// Sets the original numbers of leaves and faces, in the order in which they were added. Returns whether each is a
    /// permutation.
    bool number(std::vector<std::uint32_t> vertices, std::vector<std::uint32_t> faces);

    /// The hierarchy as far as it has grown. Without number() its leaves and faces are numbered in the order in which
    /// they come.
    ProgressiveMeshData parts() const;

private:
    /// A split that was made, by indices into nodes_ and faces_.
    struct GrownSplit {
        std::uint32_t node = 0;
        /// The index of the first child; the second child is the next one.
        std::uint32_t first_child = 0;
        std::uint32_t left_face = none;
        std::uint32_t right_face = none;
        float error_m = 0.0F;
    };

    std::uint32_t add_face(const TreeFace& face);
    bool is_cut_apart(const TreeSplit& split, std::uint32_t end) const;
    std::vector<std::uint32_t> final_numbers() const;

    std::vector<TreeNode> nodes_; ///< The roots, then the two children of each split.
    std::uint32_t leaves_ = 0;    ///< The number of leaves of the whole hierarchy.
    std::vector<std::uint32_t> root_begins_;
    std::vector<GrownSplit> splits_;
    std::vector<TreeFace> faces_;
    /// The active nodes by their first leaves.
    std::unordered_map<std::uint32_t, std::uint32_t> active_;
    ActiveLeafSet starts_; ///< The first leaves of the active nodes.
    std::vector<std::uint32_t> vertex_numbers_;
    std::vector<std::uint32_t> face_numbers_;
};

} // namespace octant::visuals::refine
