#pragma once

#include "visuals/refine/active_starts.h"
#include "visuals/refine/progressive_mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace octant::visuals::refine {

/// A node as a file tells of it; leaves [begin, end) of the whole hierarchy lie below it.
struct TreeNode {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    glm::vec3 position_m{0.0F};
    PackedNormal normal;
    PackedColour colour;
};

struct TreeFace {
    std::array<std::uint32_t, 3> corners{}; ///< leaves of the whole hierarchy
    std::uint16_t material = 0;
};

/// Of the node whose leaves begin at `begin`; its second child's begin at `middle`.
struct TreeSplit {
    std::uint32_t begin = 0;
    std::uint32_t middle = 0;
    float error_m = 0.0F;
    TreeNode first;
    TreeNode second;
    std::optional<TreeFace> left;
    std::optional<TreeFace> right;
};

/// A hierarchy that grows split by split from its roots, coarsest first, and may end anywhere.
/// Every step says whether it is one that a hierarchy can have; after a false it is of no use.
class ProgressiveTree {
public:
    bool add_root(const TreeNode& root);

    /// Behind the last root: whether they hold all leaves.
    bool roots_cover(std::uint32_t leaves);

    bool add_base_face(const TreeFace& face);

    bool add_split(const TreeSplit& split);

    std::size_t split_count() const { return splits_.size(); }

    /// Whether nothing is left to split and all faces are there.
    bool is_whole(std::size_t leaves, std::size_t faces) const {
        return nodes_.size() - splits_.size() == leaves && faces_.size() == faces;
    }

    /// Numbers of leaves and faces (as added) in the original mesh.
    bool number(std::vector<std::uint32_t> vertices, std::vector<std::uint32_t> faces);

    /// The hierarchy as far as it has grown; without numbers its leaves and faces are numbered as
    /// they come.
    ProgressiveParts parts() const;

private:
    struct Grown {
        std::uint32_t node = 0;
        std::uint32_t first_child = 0; ///< the second is the next one
        std::uint32_t left_face = none;
        std::uint32_t right_face = none;
        float error_m = 0.0F;
    };

    std::uint32_t add_face(const TreeFace& face);
    bool is_cut_apart(const TreeSplit& split, std::uint32_t end) const;
    std::vector<std::uint32_t> final_numbers() const;

    std::vector<TreeNode> nodes_; ///< roots, then two a split
    std::uint32_t leaves_ = 0;    ///< of the whole hierarchy
    std::vector<std::uint32_t> root_begins_;
    std::vector<Grown> splits_;
    std::vector<TreeFace> faces_;
    std::unordered_map<std::uint32_t, std::uint32_t> active_; ///< node by its first leaf
    ActiveStarts starts_;                                     ///< the first leaves
    std::vector<std::uint32_t> vertex_numbers_;
    std::vector<std::uint32_t> face_numbers_;
};

} // namespace octant::visuals::refine
