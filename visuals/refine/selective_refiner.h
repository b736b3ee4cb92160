#pragma once

#include "visuals/refine/face_lists.h"
#include "visuals/refine/progressive_mesh.h"
#include "visuals/refine/progressive_tree.h"

#include <glm/vec3.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::refine {

/// An array of numbers below 2^24 in three bytes each.
class Uint24Array {
public:
    /// Makes an array of `count` zeros.
    void assign(std::size_t count) { bytes_.assign(3 * count + 1, 0); }

    std::uint32_t operator[](std::size_t at) const {
        std::uint32_t number = 0;
        std::memcpy(&number, &bytes_[3 * at], 4);
        return number & 0xffffffU;
    }

    void set(std::size_t at, std::uint32_t number) { std::memcpy(&bytes_[3 * at], &number, 3); }

    std::size_t bytes() const { return bytes_.capacity(); }

private:
    static_assert(std::endian::native == std::endian::little);

    /// There is one more byte at the end, because numbers are read four bytes at a time.
    std::vector<std::uint8_t> bytes_;
};

/// A half-open range [first, end) of indices into an array.
struct SlotRange {
    std::size_t first = 0;
    std::size_t end = 0;

    bool operator==(const SlotRange&) const = default;
};

/// Remembers which blocks of an array were written since take() was last called, so that only these are uploaded to the
/// graphics card.
class DirtyBlocks {
public:
    static constexpr std::size_t block_size = 64;

    void mark(std::size_t place) {
        const std::size_t block = place / block_size;
        if (block >= marks_.size()) { marks_.resize(block + 1, 0); }
        marks_[block] = 1;
    }

    /// Marks the block of a place when `written` is true, without a branch. The block must have been marked at some
    /// time before, so that its mark exists.
    void mark_if(std::size_t place, bool written) { marks_[place / block_size] |= static_cast<std::uint8_t>(written); }

    /// Puts the maximal runs of marked blocks into `ranges`, ascending and cut off at `size` places, and clears all
    /// marks.
    void take(std::size_t size, std::vector<SlotRange>& ranges) {
        ranges.clear();
        for (std::size_t block = 0; block < marks_.size(); ++block) {
            if (marks_[block] == 0) { continue; }
            marks_[block] = 0;
            const std::size_t first = block * block_size;
            const std::size_t end = first + block_size < size ? first + block_size : size;
            if (!ranges.empty() && ranges.back().end == first) {
                ranges.back().end = end;
            } else if (first < end) {
                ranges.push_back({first, end});
            }
        }
    }

    std::size_t bytes() const { return marks_.capacity(); }

private:
    std::vector<std::uint8_t> marks_;
};

/// A vertex as it is drawn, in the layout that the graphics card takes. 20 bytes.
struct RefinedVertex {
    glm::vec3 position_m{0.0F}; ///< Relative to the hierarchy's origin.
    PackedNormal normal{};
    std::uint32_t colour = 0; ///< Packed as models::ColourVertex::colour is.
};

class SelectiveRefiner;

/// The node that an earlier rule wants split before an active node may split; `none` when there is none.
using RequiredSplit = std::function<std::uint32_t(const SelectiveRefiner& refiner, std::uint32_t active_node)>;

/// How a front splits.
struct RefinerOptions {
    RequiredSplit required_split{}; ///< Empty: Kim and Lee's rule, which asks for nothing but two cut vertices.
    bool records_splits = false;    ///< Fills recent_splits().
    bool repair = true;             ///< Mends fold-overs and refuses collapses that would make any.
};

/// How many operations were done since the front was made.
struct RefinerCounts {
    std::size_t splits = 0;           ///< All vertex splits.
    std::size_t forced_by_rule = 0;   ///< Those that the rule demanded before another one.
    std::size_t forced_by_repair = 0; ///< Those done by repair() or demanded by its splits.
    std::size_t collapses = 0;
    std::size_t blocked = 0; ///< Collapses that were asked for and refused.
};

/// A front of active nodes over a shared hierarchy, and the active mesh that it stands for: those original faces whose
/// corners lie below three different active nodes. It starts as the base mesh. Splits and collapses may come in any
/// order; the mesh stays an oriented manifold of the same topology.
///
/// A split forces none, unless both cut vertices of the node lie below one active node. Then that node splits first,
/// and so on. The chain ends, because each node in it was collapsed later than the one that needs it. The collapse of a
/// boundary edge has one cut vertex and forces none. Earlier rules (classic_split_rules.h) force more.
///
/// Vertices and faces live in numbered slots and places that are used again; a split changes only the faces around its
/// vertex. No memory is allocated once the front has been as large before, except by split_all.
class SelectiveRefiner {
public:
    explicit SelectiveRefiner(std::shared_ptr<const ProgressiveMesh> mesh, RefinerOptions options = {});

    const ProgressiveMesh& mesh() const { return *mesh_; }

    const RefinerOptions& options() const { return options_; }

    /// Splits an inner node, and before it those of its ancestors that are not split yet. Returns how many splits were
    /// done; 0 when the node is split already.
    std::size_t split(std::uint32_t node);

    /// Splits each of these inner nodes, in the fastest order. Returns how many splits were done. In the counts a split
    /// is forced only if it was not asked for.
    std::size_t split_all(std::span<const std::uint32_t> nodes);

    /// Puts the nodes that split(active_node) would split before that one into `forced`, in order, without those of
    /// an earlier rule. At most 200 are found.
    void find_forced_splits(std::uint32_t active_node, std::vector<std::uint32_t>& forced) const;

    /// Returns to the base mesh. Memory is kept and the counts go on.
    void restart();

    /// Collapses the two children of an inner node into it. Does nothing and returns false when they are not both
    /// active, when the result would not be a manifold (link condition), or, with repair, when a face would turn over.
    /// It can succeed later, after the neighbourhood has changed.
    bool collapse(std::uint32_t node);

    /// Whether collapse(node) would succeed now.
    bool can_collapse(std::uint32_t node);

    /// The inner nodes that were split since clear_recent_splits was last called, in order. Needs
    /// options().records_splits.
    std::span<const std::uint32_t> recent_splits() const { return recent_splits_; }

    void clear_recent_splits() { recent_splits_.clear(); }

    /// Splits the coarsest corner of each face that is turned over against its original, until there is none. Only
    /// faces that changed since the last call are looked at. Returns how many splits were done. Does nothing without
    /// options().repair. Nodes for which is_protected(node) is true are split only where no other corner can be.
    std::size_t repair(const std::function<bool(std::uint32_t)>& is_protected = {});

    /// How many faces of the active mesh are turned over: their normals are more than 90 degrees off those of their
    /// original faces.
    std::size_t flipped_faces() const;

    bool is_active(std::uint32_t node) const {
        const std::uint32_t leaf = mesh_->first_leaf(node);
        return starts_.has(leaf) && node_at(slots_[leaf]) == node;
    }

    /// Whether a node is above the front: the active node at its first leaf then lies below it and has a smaller
    /// number.
    bool is_split(std::uint32_t node) const {
        const std::uint32_t leaf = mesh_->first_leaf(node);
        return starts_.has(leaf) && node_at(slots_[leaf]) < node;
    }

    /// The active node that a leaf lies below (ActiveAncestor in the paper).
    std::uint32_t active_ancestor(std::uint32_t leaf) const { return node_at(slot_above(leaf)); }

    std::size_t active_count() const { return active_count_; }

    std::size_t face_count() const { return faces_.face_count(); }

    const RefinerCounts& counts() const { return counts_; }

    /// The slot of an active node: its index in vertices(). When a node is split, its first child takes over its slot;
    /// of a node that is split it is the slot of the active node at its first leaf.
    std::uint32_t slot(std::uint32_t node) const { return slots_[mesh_->first_leaf(node)]; }

    /// The active node in a slot; `none` for an empty slot.
    std::uint32_t node_at(std::uint32_t slot) const { return faces_.vertex_label(slot); }

    /// The vertex array for drawing, indexed by slot, empty slots included.
    std::span<const RefinedVertex> vertices() const { return vertices_; }

    /// The index list for drawing: three slots for each place, counter-clockwise seen from outside. Places without a
    /// face are (0, 0, 0).
    std::span<const std::uint32_t> indices() const { return faces_.indices(); }

    /// The number of the original face at a place of the index list; `none` for an empty place.
    std::uint32_t face_at(std::size_t place) const { return faces_.label(static_cast<std::uint32_t>(place)); }

    /// Sets a vertex as it is drawn, for geomorphs. The next split or collapse of its node puts it back to the node's
    /// position.
    void set_drawn_vertex(std::uint32_t slot, const RefinedVertex& vertex);

    /// The vertex of a node at the node's own position.
    RefinedVertex vertex_of(std::uint32_t node) const;

    /// Puts the ranges of slots whose vertices were written since the last call into `ranges`.
    void take_dirty_vertices(std::vector<SlotRange>& ranges);
    /// Puts the ranges of places whose faces were written since the last call into `ranges`.
    void take_dirty_faces(std::vector<SlotRange>& ranges);

    /// The memory of the front without vertices(), its part that grows with the hierarchy included.
    std::size_t bytes() const;

private:
    /// The slot of a leaf's active ancestor.
    std::uint32_t slot_above(std::uint32_t leaf) const { return slots_[starts_.last_up_to(leaf)]; }

    /// The first leaves of the active cut vertices val and var of a node that is to be split. They are `none` and `none
    /// - 1` where the boundary has no cut vertex, so that they never compare as equal.
    struct Cuts {
        std::uint32_t left = none;
        std::uint32_t right = none;
    };

    Cuts active_cuts(std::uint32_t node) const;
    std::uint32_t new_slot();
    void put(std::uint32_t slot, std::uint32_t node, const NodeGeometry& shape);
    std::size_t split_single(std::uint32_t node, std::vector<std::uint32_t>* forced);
    void split_with_prerequisites(std::uint32_t node, std::vector<std::uint32_t>* forced);
    void apply_split(std::uint32_t node, const Cuts& cuts);
    void apply_collapse(std::uint32_t node);
    void mark_changed(std::uint32_t slot);
    bool satisfies_link_condition(std::uint32_t first_slot, std::uint32_t second_slot);
    void mark(std::uint32_t slot, std::uint32_t bits);
    void unmark(std::uint32_t slot, std::uint32_t bits);
    void clear_link_marks(std::uint32_t slot);
    const glm::vec3& position_at(std::uint32_t corner) const;
    bool flips_faces(std::uint32_t slot, std::uint32_t other, std::uint32_t node) const;
    void repair_around(std::uint32_t slot, const std::function<bool(std::uint32_t)>& is_protected);
    std::uint32_t ancestor_after(std::uint32_t leaf, std::span<const std::uint32_t> split) const;
    bool is_flipped(std::uint32_t place) const;
    std::uint32_t coarsest_corner(std::uint32_t place, const std::function<bool(std::uint32_t)>& is_protected) const;

    std::shared_ptr<const ProgressiveMesh> mesh_;
    RefinerOptions options_;
    /// Its vertices are slots labelled with their nodes; its faces are labelled with the original faces.
    FaceLists faces_;
    std::vector<RefinedVertex> vertices_; ///< One for each slot.
    ActiveLeafSet starts_;                ///< The first leaves of the active nodes.
    /// For the first leaf of each active node its slot; other entries mean nothing.
    Uint24Array slots_;
    std::vector<std::uint32_t> stack_;   ///< Nodes that wait to be split; the last one is next.
    std::vector<std::uint32_t> path_;    ///< Scratch memory of split_with_prerequisites.
    std::vector<std::uint32_t> changed_; ///< The slots whose faces repair() must check.
    std::vector<std::uint32_t> recent_splits_;
    DirtyBlocks dirty_vertices_;
    DirtyBlocks dirty_faces_;
    RefinerCounts counts_;
    std::size_t active_count_ = 0;
};

} // namespace octant::visuals::refine
