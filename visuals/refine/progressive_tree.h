#pragma once

#include "visuals/refine/progressive_mesh.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace octant::visuals::refine {

/// A set of numbers below a bound that quickly finds the largest member not above a given number (a predecessor query).
/// It is a bitmap with summary levels: one bit for each number, above every 64 of these one bit that says whether any
/// of them is set, and so on up to a single word. It is small enough to stay in the processor's cache.
///
/// SelectiveRefiner keeps the first leaf of each active node in it. The active nodes partition the leaves into runs of
/// consecutive numbers, so the active ancestor of a leaf is the node whose run begins last at or before it. This is the
/// paper's ActiveAncestor without a climb from parent to parent.
class ActiveLeafSet {
public:
    /// Empties the set. From now on numbers below `bound` may be added; there are at most six levels.
    void assign(std::size_t bound) {
        std::size_t words = 0;
        levels_ = 0;
        do {
            bound = bound / word_bits + 1;
            begins_[levels_] = words;
            ++levels_;
            words += bound;
        } while (bound > 1);
        words_.assign(words, 0);
    }

    bool has(std::uint32_t number) const { return (words_[number / word_bits] >> (number % word_bits) & 1U) != 0; }

    void add(std::uint32_t number) {
        for (std::size_t level = 0; level < levels_; ++level) {
            std::uint64_t& word = words_[begins_[level] + number / word_bits];
            const bool was_empty = word == 0;
            word |= std::uint64_t{1} << number % word_bits;
            if (!was_empty) { return; }
            number /= word_bits;
        }
    }

    void remove(std::uint32_t number) {
        for (std::size_t level = 0; level < levels_; ++level) {
            std::uint64_t& word = words_[begins_[level] + number / word_bits];
            word &= ~(std::uint64_t{1} << number % word_bits);
            if (word != 0) { return; }
            number /= word_bits;
        }
    }

    /// The largest member that is not above `number`. 0 must be a member, so that there always is one.
    std::uint32_t last_up_to(std::uint32_t number) const {
        std::uint64_t word = bits_up_to(words_[number / word_bits], number);
        std::size_t level = 0;
        while (word == 0) {
            number = number / word_bits - 1;
            ++level;
            word = bits_up_to(words_[begins_[level] + number / word_bits], number);
        }
        number = last_in(word, number / word_bits);
        while (level > 0) {
            --level;
            number = last_in(words_[begins_[level] + number], number);
        }
        return number;
    }

    std::size_t bytes() const { return words_.capacity() * sizeof(std::uint64_t); }

private:
    static constexpr std::uint32_t word_bits = 64;

    /// The bits of a word up to and including that of `number`.
    static std::uint64_t bits_up_to(std::uint64_t word, std::uint32_t number) {
        return word & ~std::uint64_t{0} >> (word_bits - 1 - number % word_bits);
    }

    /// The number that the highest set bit of the word with index `at` stands for.
    static std::uint32_t last_in(std::uint64_t word, std::uint32_t at) {
        return word_bits * at + word_bits - 1 - static_cast<std::uint32_t>(std::countl_zero(word));
    }

    /// All levels one after the other, the bits of the numbers themselves first.
    std::vector<std::uint64_t> words_;
    std::array<std::size_t, 6> begins_{}; ///< The index in words_ at which each level begins.
    std::size_t levels_ = 0;
};

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
