#pragma once

#include "visuals/refine/active_starts.h"
#include "visuals/refine/dirty_blocks.h"
#include "visuals/refine/earlier_rules.h"
#include "visuals/refine/face_lists.h"
#include "visuals/refine/progressive_mesh.h"
#include "visuals/refine/short_numbers.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::refine {

/// A vertex as it is drawn. 20 bytes.
struct RefinedVertex {
    glm::vec3 position_m{0.0F}; ///< relative to the hierarchy's origin
    PackedNormal normal{};
    std::uint32_t colour = 0; ///< as models::ColourVertex::colour
};

struct RefinerOptions {
    SplitRule rule = SplitRule::Selective;
    bool remember_splits = false; ///< for recent_splits
    bool repair = true;           ///< of fold-overs
    std::shared_ptr<const EarlierRules>
        earlier{}; ///< for the rules Hoppe and Xia only; null = made
};

/// Operations since the front was made.
struct RefinerCounts {
    std::size_t splits = 0;           ///< all of them
    std::size_t forced_by_rule = 0;   ///< of them: needed by the rule before another one
    std::size_t forced_by_repair = 0; ///< of them: done by repair() or needed by its splits
    std::size_t collapses = 0;
    std::size_t blocked = 0; ///< collapses that were not possible when asked for
};

/// One front of active nodes over a shared hierarchy, and the mesh that it stands for: the original
/// faces whose corners lie below three different active nodes. Starts as the base mesh. Splits and
/// collapses come in any order; the mesh stays an oriented manifold of the same topology.
///
/// How many further splits a split may cause, by the rule:
/// - Selective: none, unless both cut vertices of the node lie below one active node. Then that
///   node splits first, and perhaps again, and so on: each one was collapsed later than the one
///   that needs it, so there is an end. A boundary collapse has one cut vertex and causes none.
/// - Hoppe, Xia: every split that brings back what lay around at the collapse.
///
/// Needs no memory after it has once held as many vertices and faces, but for split_all.
class SelectiveRefiner {
public:
    explicit SelectiveRefiner(
        std::shared_ptr<const ProgressiveMesh> mesh, RefinerOptions options = {});

    const ProgressiveMesh& mesh() const { return *mesh_; }

    const RefinerOptions& options() const { return options_; }

    /// Splits an inner node; its ancestors first where they are not split yet. Returns how many
    /// splits were done: 0 when it is split already.
    std::size_t split(std::uint32_t node);

    /// split() of each, in an order of its own that takes the least time. Counts of forced splits
    /// leave out those that were asked for.
    std::size_t split_all(std::span<const std::uint32_t> nodes);

    /// Puts the nodes that split(active_node) would split before that one into `forced`, in order,
    /// the first 200 of them; by the rule Selective.
    void nodes_forced_by(std::uint32_t active_node, std::vector<std::uint32_t>& forced) const;

    /// Back to the base mesh. Keeps the memory; counts go on.
    void restart();

    /// Collapses an inner node whose children are both active. False, and nothing done, where they
    /// are not or where it would spoil the mesh now: a manifold (link condition), or with repair a
    /// face turned over. Worth another try when the neighbourhood has changed.
    bool collapse(std::uint32_t node);

    /// Whether collapse(node) would do it now.
    bool may_collapse(std::uint32_t node);

    /// Inner nodes that were split, in order, since the last forget_recent_splits; none without
    /// options().remember_splits.
    std::span<const std::uint32_t> recent_splits() const { return recent_splits_; }

    void forget_recent_splits() { recent_splits_.clear(); }

    /// Splits the coarsest corner of each face that is turned over against its original, until none
    /// is (only faces changed since the last call are looked at). Returns how many splits were
    /// done. Without options().repair nothing happens. A split made here may be collapsed again.
    /// Corners whose nodes spare(node) is true for are only split where there is no other.
    std::size_t repair(const std::function<bool(std::uint32_t)>& spare = {});

    /// Faces of the active mesh that are turned over: their normal is more than 90 degrees off the
    /// original face's.
    std::size_t turned_faces() const;

    bool is_active(std::uint32_t node) const {
        const std::uint32_t leaf = mesh_->first_leaf(node);
        return starts_.has(leaf) && node_at(slots_[leaf]) == node;
    }

    bool is_split(std::uint32_t node) const { // what is active there lies below it
        const std::uint32_t leaf = mesh_->first_leaf(node);
        return starts_.has(leaf) && node_at(slots_[leaf]) < node;
    }

    /// The active node that a leaf lies below.
    std::uint32_t active_ancestor(std::uint32_t leaf) const { return node_at(slot_above(leaf)); }

    /// Its place in the arrays below.
    std::uint32_t slot_above(std::uint32_t leaf) const {
        return slots_[starts_.at_or_before(leaf)];
    }

    std::size_t active_count() const { return active_count_; }

    std::size_t face_count() const { return faces_.face_count(); }

    const RefinerCounts& counts() const { return counts_; }

    /// Place of an active node in the arrays below. A node's first child takes its place over.
    std::uint32_t slot(std::uint32_t active_node) const {
        return slots_[mesh_->first_leaf(active_node)];
    }

    /// The same for a split node: the place of the active node at its first leaf.
    std::uint32_t slot_below(std::uint32_t split_node) const { return slot(split_node); }

    /// none for a place without a vertex.
    std::uint32_t node_at(std::uint32_t slot) const { return faces_.vertex_label(slot); }

    /// By slot, places without a vertex included.
    std::span<const RefinedVertex> vertices() const { return vertices_; }

    /// Three a face, counter-clockwise from outside; places without a face are (0, 0, 0).
    std::span<const std::uint32_t> indices() const { return faces_.indices(); }

    /// Number of the original face at a place of the indices; none without one.
    std::uint32_t face_at(std::size_t place) const {
        return faces_.label(static_cast<std::uint32_t>(place));
    }

    /// Moves a vertex as it is drawn (geomorphs); a split or collapse puts it where its node is.
    void draw_at(std::uint32_t slot, const RefinedVertex& vertex);

    /// The vertex of a node where it belongs.
    RefinedVertex vertex_of(std::uint32_t node) const;

    /// Ranges of `vertices` and of places (three `indices` each) written since the last call.
    void take_dirty_vertices(std::vector<PlaceRange>& ranges);
    void take_dirty_faces(std::vector<PlaceRange>& ranges);

    /// Memory of the front without `vertices`; its part that grows with the hierarchy included.
    std::size_t bytes() const;

private:
    /// First leaves of the active nodes beside both children of a node that is to be split; none
    /// and none - 1 beyond a boundary.
    struct Cuts {
        std::uint32_t left = none;
        std::uint32_t right = none;
    };

    Cuts active_cuts(std::uint32_t node) const;
    std::uint32_t needed_before(std::uint32_t node) const;
    std::uint32_t needed_by_hoppe(std::uint32_t node) const;
    std::uint32_t needed_by_xia(std::uint32_t node) const;
    std::uint32_t new_slot();
    void put(std::uint32_t slot, std::uint32_t node, const NodeShape& shape);
    std::size_t split_one(std::uint32_t node, std::vector<std::uint32_t>* forced);
    void split_with_others(std::uint32_t node, std::vector<std::uint32_t>* forced);
    void split_now(std::uint32_t node, const Cuts& cuts);
    void collapse_now(std::uint32_t node);
    void note_change(std::uint32_t slot);
    bool links_allow(std::uint32_t first_slot, std::uint32_t second_slot);
    void mark(std::uint32_t slot, std::uint32_t bits);
    void unmark(std::uint32_t slot, std::uint32_t bits);
    void clear_link_marks(std::uint32_t slot);
    const glm::vec3& position_at(std::uint32_t corner) const;
    bool turns_faces(std::uint32_t slot, std::uint32_t other, std::uint32_t node) const;
    void repair_around(std::uint32_t slot, const std::function<bool(std::uint32_t)>& spare);
    std::uint32_t ancestor_after(std::uint32_t leaf, std::span<const std::uint32_t> split) const;
    bool is_turned(std::uint32_t place) const;
    std::uint32_t
    coarsest_corner(std::uint32_t place, const std::function<bool(std::uint32_t)>& spare) const;

    std::shared_ptr<const ProgressiveMesh> mesh_;
    RefinerOptions options_;
    FaceLists faces_; ///< vertices are slots labelled with their nodes, faces with the originals
    std::vector<RefinedVertex> vertices_; ///< one a slot
    ActiveStarts starts_;                 ///< first leaves of active nodes
    ShortNumbers slots_;                  ///< by first leaf, of active nodes; else anything
    std::vector<std::uint32_t> stack_;    ///< nodes to split, the next one last
    std::vector<std::uint32_t> path_;     ///< of split_with_others
    std::vector<std::uint32_t> changed_;  ///< slots whose faces repair() looks at
    std::vector<std::uint32_t> recent_splits_;
    DirtyBlocks dirty_vertices_;
    DirtyBlocks dirty_faces_;
    RefinerCounts counts_;
    std::size_t active_count_ = 0;
};

} // namespace octant::visuals::refine
