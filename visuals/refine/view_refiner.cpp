// View-dependent refinement frame by frame, with J. Kim and S. Lee's splits (2001, section 4) and
// H. Hoppe's criterion (1997, section 4).
//
// A frame splits every active node whose projected error exceeds error_px, the largest error first,
// and merges siblings whose parent would show less than merge_error_ratio of it, the smallest error
// first. Three things keep nodes from being split and merged in turns: the gap between the two
// thresholds, weights that look ahead by an angle (merge_angle_margin_rad), and a rest of some frames after
// each operation.
//
// Merging takes several frames: geomorphs first carry both vertices to the parent's position, then
// the edge is collapsed. If the error grows in the meantime, they turn back.
#include "visuals/refine/view_refiner.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace octant::visuals::refine {

ViewRefiner::ViewRefiner(
    std::shared_ptr<const ProgressiveMesh> mesh, const ViewRefinerOptions& options)
    : options_(options)
    , refiner_(std::move(mesh), {.records_splits = true, .repair = options.repair})
    , moves_(options.geomorph) {}

RefinedFrame ViewRefiner::update(const RefineView& view) {
    if (settled_ && has_view_ && view == view_) {
        return {};
    }
    view_ = view;
    has_view_ = true;
    ++frame_;
    waiting_ = false;
    const RefinerCounts before = refiner_.counts();
    collect_candidates();
    split_worst();
    refiner_.repair([this](std::uint32_t node) { return needs_resting(node); });
    start_moves();
    reverse_moves();
    merge_smallest();
    RefinedFrame frame;
    frame.moving = options_.geomorphs ? moves_.move(refiner_, view) : 0;
    frame.splits = refiner_.counts().splits - before.splits;
    frame.collapses = refiner_.counts().collapses - before.collapses;
    settled_ = frame.splits + frame.collapses + frame.moving == 0 && !waiting_;
    frame.settled = settled_;
    return frame;
}

void ViewRefiner::refine_fully(const RefineView& view) {
    // Repair and merging could otherwise undo each other's work for ever.
    constexpr int max_rounds = 100;
    const ViewRefinerOptions kept = options_;
    options_.geomorphs = false;
    options_.operations = std::numeric_limits<std::size_t>::max();
    options_.merge_delay_frames = 0;
    settled_ = false;
    for (int round = 0; round < max_rounds && !update(view).settled; ++round) {
    }
    options_ = kept;
}

/// Fills splits_ with the nodes to split, and merges_ with the parents whose children may be
/// merged.
void ViewRefiner::collect_candidates() {
    splits_.clear();
    merges_.clear();
    const ProgressiveMesh& mesh = refiner_.mesh();
    for (std::uint32_t slot = 0; slot < refiner_.vertices().size(); ++slot) {
        const std::uint32_t node = refiner_.node_at(slot);
        if (node == none) {
            continue;
        }
        consider_split(node);
        const std::uint32_t parent = mesh.parent(node);
        if (parent == none || mesh.split_of(parent).first != node ||
            !refiner_.is_active(mesh.split_of(parent).second)) {
            continue;
        }
        if (!keeps_split(parent)) {
            merges_.push_back({merged_error_px(parent), parent});
        }
    }
}

/// Adds a node to splits_ when its error is too large.
void ViewRefiner::consider_split(std::uint32_t node) {
    if (refiner_.mesh().is_leaf(node)) {
        return;
    }
    const double shown_px = error_px(node);
    if (shown_px > options_.error_px) {
        splits_.push_back({shown_px, node});
        std::ranges::push_heap(splits_, [](const Candidate& a, const Candidate& b) {
            return a.error_px != b.error_px ? a.error_px < b.error_px : a.node < b.node;
        });
    }
}

/// Splits the nodes of splits_, largest error first, and considers their children in turn.
void ViewRefiner::split_worst() {
    const auto less = [](const Candidate& a, const Candidate& b) {
        return a.error_px != b.error_px ? a.error_px < b.error_px : a.node < b.node;
    };
    std::size_t left = options_.operations;
    while (!splits_.empty() && left > 0) {
        std::ranges::pop_heap(splits_, less);
        const auto [shown_px, node] = splits_.back();
        splits_.pop_back();
        if (!refiner_.is_active(node)) {
            continue; // It has been split already, because another node forced it.
        }
        if (shown_px <= options_.resplit_error_ratio * options_.error_px && needs_resting(node)) {
            waiting_ = true;
            continue;
        }
        refiner_.split(node);
        --left;
        const VertexSplit split = refiner_.mesh().split_of(node);
        for (const std::uint32_t child : {split.first, split.second}) {
            if (refiner_.is_active(child)) {
                consider_split(child);
            }
        }
    }
    waiting_ = waiting_ || !splits_.empty();
}

/// Starts geomorphs for all nodes that were split in this frame.
void ViewRefiner::start_moves() {
    split_frames_.resize(refiner_.vertices().size(), 0);
    for (const std::uint32_t node : refiner_.recent_splits()) {
        const VertexSplit split = refiner_.mesh().split_of(node);
        split_frames_[refiner_.slot_below(split.first)] = frame_;
        split_frames_[refiner_.slot_below(split.second)] = frame_;
        if (options_.geomorphs) {
            moves_.start(refiner_, node);
        }
    }
    refiner_.clear_recent_splits();
}

/// Sends vertices back that travel to a merge which is no longer wanted or no longer possible.
void ViewRefiner::reverse_moves() {
    turning_.clear();
    moves_.each([&](std::uint32_t slot, std::uint32_t target) {
        const std::uint32_t node = refiner_.node_at(slot);
        if (target == node) {
            return;
        }
        const VertexSplit split = refiner_.mesh().split_of(target);
        if (!refiner_.is_active(split.first) || !refiner_.is_active(split.second) ||
            error_px(target) > options_.error_px || !refiner_.can_collapse(target)) {
            turning_.push_back(slot);
        }
    });
    for (const std::uint32_t slot : turning_) {
        moves_.retarget(refiner_, slot, refiner_.node_at(slot));
    }
}

/// Merges the candidates of merges_, smallest error first.
void ViewRefiner::merge_smallest() {
    std::ranges::sort(merges_, [](const Candidate& a, const Candidate& b) {
        return a.error_px != b.error_px ? a.error_px < b.error_px : a.node > b.node;
    });
    std::size_t left = options_.operations;
    for (const Candidate& candidate : merges_) {
        const VertexSplit split = refiner_.mesh().split_of(candidate.node);
        if (!refiner_.is_active(split.first) || !refiner_.is_active(split.second)) {
            continue; // A child has been split in the meantime.
        }
        if (left == 0 || is_merge_delayed(candidate.node)) {
            waiting_ = true;
        } else if (merge(candidate.node)) {
            --left;
        }
    }
}

/// Whether one of a node's children came by a split within the last merge_delay_frames.
bool ViewRefiner::is_merge_delayed(std::uint32_t node) const {
    const VertexSplit split = refiner_.mesh().split_of(node);
    const std::uint32_t came =
        std::max(split_frames_[refiner_.slot(split.first)], split_frames_[refiner_.slot(split.second)]);
    return came != 0 && frame_ - came <= static_cast<std::uint32_t>(options_.merge_delay_frames);
}

/// Whether an active node came by a merge within the last merge_delay_frames.
bool ViewRefiner::is_split_delayed(std::uint32_t node) const {
    const std::uint32_t slot = refiner_.slot(node);
    return slot < merged_.size() && merged_[slot].node == node &&
           frame_ - merged_[slot].frame <= static_cast<std::uint32_t>(options_.merge_delay_frames);
}

/// Whether splitting an active node would split one that rests after its merge: itself or a forced
/// one.
bool ViewRefiner::needs_resting(std::uint32_t node) {
    if (is_split_delayed(node)) {
        return true;
    }
    refiner_.find_forced_splits(node, forced_);
    return std::ranges::any_of(forced_, [this](std::uint32_t forced) {
        return refiner_.is_active(forced) && is_split_delayed(forced);
    });
}

/// Merges a node's children, or with geomorphs sends them to the node's position until they have
/// arrived. Returns false when that is not possible now.
bool ViewRefiner::merge(std::uint32_t node) {
    const VertexSplit split = refiner_.mesh().split_of(node);
    const std::uint32_t first = refiner_.slot(split.first);
    const std::uint32_t second = refiner_.slot(split.second);
    const bool there = moves_.target(first) == node && moves_.target(second) == node &&
                       moves_.has_arrived(first) && moves_.has_arrived(second);
    if (!options_.geomorphs || there) {
        if (!refiner_.collapse(node)) {
            return false;
        }
        moves_.forget(first);
        moves_.forget(second);
        split_frames_[first] = 0;
        merged_.resize(split_frames_.size());
        merged_[first] = {node, frame_};
        return true;
    }
    if (!refiner_.can_collapse(node)) {
        return false;
    }
    moves_.retarget(refiner_, first, node);
    moves_.retarget(refiner_, second, node);
    return true;
}

} // namespace octant::visuals::refine
