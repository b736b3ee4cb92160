// View-dependent refinement frame by frame, with J. Kim and S. Lee's splits (2001, section 4) and H. Hoppe's criterion
// (1997, section 4).
//
// A frame splits every active node whose projected error exceeds error_px, the largest error first, and collapses
// siblings whose parent would show less than collapse_error_ratio of it, the smallest error first. Three things keep
// nodes from being split and collapsed in turns: the gap between the two thresholds, weights that look ahead by an
// angle (collapse_angle_margin_rad), and a rest of some frames after each operation.
//
// A collapse takes several frames: geomorphs first carry both vertices to the parent's position, then the edge is
// collapsed. If the error grows in the meantime, they turn back.
#include "visuals/refine/view_refiner.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace octant::visuals::refine {

// Geomorphs after H. Hoppe, "Progressive Meshes", 1996, section 3.1: positions, normals and colours are mixed linearly
// between two places.
//
// Deviation: the share of the way follows from the screen, not from the clock. In each frame a vertex covers at most
// step_px pixels, as seen from the present eye, so that near vertices take longer than far ones and no motion catches
// the eye.

namespace {

std::uint32_t mixed_colour(std::uint32_t from, std::uint32_t to, double share) {
    std::uint32_t mixed = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) {
        const double a = from >> shift & 255U;
        const double b = to >> shift & 255U;
        mixed |= static_cast<std::uint32_t>(std::lround(a + share * (b - a))) << shift;
    }
    return mixed;
}

RefinedVertex mixed(const RefinedVertex& from, const RefinedVertex& to, double share) {
    const auto part = static_cast<float>(share);
    const glm::vec3 normal = glm::mix(unpacked(from.normal), unpacked(to.normal), part);
    return {glm::mix(from.position_m, to.position_m, part), glm::length(normal) > 0.01F ? packed(normal) : to.normal,
        mixed_colour(from.colour, to.colour, share)};
}

/// How far a vertex may move in one frame, metres, so that it moves by `step_px` pixels at most in any direction.
/// Outside the picture the scale of its corners is used, about 60 degrees off the middle.
double step_m(const glm::dvec3& from_eye_m, const RefineView& view, double step_px) {
    const double distance_m = std::max(glm::length(from_eye_m), view.near_m);
    const double depth_m = std::max(glm::dot(from_eye_m, view.forward), 0.5 * distance_m);
    return step_px * depth_m * depth_m / (view.focal_px * distance_m);
}

} // namespace

Geomorphs::Move* Geomorphs::find(std::uint32_t slot) {
    return slot < places_.size() && places_[slot] != none ? &moves_[places_[slot]] : nullptr;
}

const Geomorphs::Move* Geomorphs::find(std::uint32_t slot) const {
    return slot < places_.size() && places_[slot] != none ? &moves_[places_[slot]] : nullptr;
}

namespace {

/// The place on a chart of a list that has it.
const glm::vec2& place_in(std::span<const ChartPlace> places, std::uint32_t chart) {
    const auto at = std::ranges::lower_bound(places, chart, {}, &ChartPlace::chart);
    assert(at != places.end() && at->chart == chart);
    return at->place;
}

} // namespace

/// Where the vertex of a node is drawn on all charts that the node touches, by a move (null: it rests); none without
/// textures.
std::vector<ChartPlace> Geomorphs::drawn_places(std::uint32_t node, const Move* move) const {
    if (textures_ == nullptr) { return {}; }
    const auto own = textures_->places_of(node);
    std::vector<ChartPlace> drawn(own.begin(), own.end());
    for (ChartPlace& at : drawn) {
        if (move == nullptr) { continue; }
        at.place = glm::mix(place_in(move->from_places, at.chart),
            place_in(textures_->places_of(move->target), at.chart), static_cast<float>(move->share));
    }
    return drawn;
}

glm::vec2 Geomorphs::place(const SelectiveRefiner& refiner, std::uint32_t slot, std::uint32_t chart) const {
    const Move* move = find(slot);
    if (move == nullptr) { return place_in(textures_->places_of(refiner.node_at(slot)), chart); }
    return glm::mix(place_in(move->from_places, chart), place_in(textures_->places_of(move->target), chart),
        static_cast<float>(move->share));
}

void Geomorphs::add(const Move& move) {
    if (Move* known = find(move.slot)) {
        *known = move;
        return;
    }
    if (move.slot >= places_.size()) { places_.resize(move.slot + 1, none); }
    places_[move.slot] = static_cast<std::uint32_t>(moves_.size());
    moves_.push_back(move);
}

void Geomorphs::forget(std::uint32_t slot) {
    if (find(slot) == nullptr) { return; }
    const std::uint32_t place = places_[slot];
    places_[slot] = none;
    if (place + 1 < moves_.size()) {
        moves_[place] = moves_.back();
        places_[moves_[place].slot] = place;
    }
    moves_.pop_back();
}

RefinedVertex Geomorphs::drawn(const SelectiveRefiner& refiner, const Move& move) const {
    return mixed(move.from, refiner.vertex_of(move.target), move.share);
}

void Geomorphs::start(const SelectiveRefiner& refiner, std::uint32_t split_node) {
    const VertexSplit split = refiner.mesh().split_of(split_node);
    const std::uint32_t first = refiner.slot(split.first);
    const Move* known = find(first);
    const RefinedVertex from = known != nullptr ? drawn(refiner, *known) : refiner.vertex_of(split_node);
    const std::vector<ChartPlace> places = drawn_places(split_node, known);
    add({first, split.first, from, 0.0, places});
    add({refiner.slot(split.second), split.second, from, 0.0, places});
}

void Geomorphs::retarget(const SelectiveRefiner& refiner, std::uint32_t slot, std::uint32_t target) {
    const Move* known = find(slot);
    if (known != nullptr && known->target == target) { return; }
    const RefinedVertex from = known != nullptr ? drawn(refiner, *known) : refiner.vertex_of(refiner.node_at(slot));
    add({slot, target, from, 0.0, drawn_places(refiner.node_at(slot), known)});
}

std::uint32_t Geomorphs::target(std::uint32_t slot) const {
    return slot < places_.size() && places_[slot] != none ? moves_[places_[slot]].target : none;
}

bool Geomorphs::has_arrived(std::uint32_t slot) const {
    return slot >= places_.size() || places_[slot] == none || moves_[places_[slot]].share >= 1.0;
}

std::size_t Geomorphs::move(SelectiveRefiner& refiner, const RefineView& view) {
    std::size_t moved = 0;
    const glm::dvec3 eye_m = view.eye_m - refiner.mesh().parts().origin_m;
    for (std::size_t i = moves_.size(); i-- > 0;) {
        Move& move = moves_[i];
        if (move.share < 1.0) {
            const RefinedVertex to = refiner.vertex_of(move.target);
            const glm::dvec3 at_m(mixed(move.from, to, move.share).position_m);
            const auto way_m = static_cast<double>(glm::distance(move.from.position_m, to.position_m));
            const double max_m = step_m(at_m - eye_m, view, options_.step_px);
            const double step = way_m > 0.0 ? std::min(max_m / way_m, 1.0 / options_.frames) : 1.0 / options_.frames;
            move.share = std::min(1.0, move.share + step);
            ++moved;
        }
        refiner.set_drawn_vertex(move.slot, drawn(refiner, move));
        if (move.share >= 1.0 && move.target == refiner.node_at(move.slot)) { forget(move.slot); }
    }
    return moved;
}

ViewRefiner::ViewRefiner(std::shared_ptr<const ProgressiveMesh> mesh, const ViewRefinerOptions& options,
    std::shared_ptr<const MeshTextures> textures)
    : options_(options), textures_(std::move(textures)),
      refiner_(std::move(mesh), {.records_splits = true, .repair = options.repair}),
      moves_(options.geomorph, textures_.get()) {}

RefinedFrame ViewRefiner::update(const RefineView& view) {
    if (settled_ && has_view_ && view == view_) { return {}; }
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
    collapse_smallest();
    RefinedFrame frame;
    frame.moving = options_.geomorphs ? moves_.move(refiner_, view) : 0;
    frame.splits = refiner_.counts().splits - before.splits;
    frame.collapses = refiner_.counts().collapses - before.collapses;
    settled_ = frame.splits + frame.collapses + frame.moving == 0 && !waiting_;
    frame.settled = settled_;
    return frame;
}

void ViewRefiner::refine_fully(const RefineView& view) {
    // Without a limit repair and collapses could undo each other's work for ever.
    constexpr int max_rounds = 100;
    const ViewRefinerOptions kept = options_;
    options_.geomorphs = false;
    options_.operations = std::numeric_limits<std::size_t>::max();
    options_.rest_frames = 0;
    settled_ = false;
    for (int round = 0; round < max_rounds && !update(view).settled; ++round) {}
    options_ = kept;
}

void ViewRefiner::restart() {
    refiner_.restart();
    moves_.clear();
    has_view_ = false;
    settled_ = false;
    waiting_ = false;
    frame_ = 0;
    split_frames_.clear();
    collapsed_.clear();
}

/// Fills splits_ with the nodes to split, and collapses_ with the nodes whose children may be collapsed.
void ViewRefiner::collect_candidates() {
    splits_.clear();
    collapses_.clear();
    const ProgressiveMesh& mesh = refiner_.mesh();
    for (std::uint32_t slot = 0; slot < refiner_.vertices().size(); ++slot) {
        const std::uint32_t node = refiner_.node_at(slot);
        if (node == none) { continue; }
        consider_split(node);
        const std::uint32_t parent = mesh.parent(node);
        if (parent == none || mesh.split_of(parent).first != node ||
            !refiner_.is_active(mesh.split_of(parent).second)) {
            continue;
        }
        if (!keeps_split(parent)) { collapses_.push_back({collapsed_error_px(parent), parent}); }
    }
}

/// Adds a node to splits_ when its error is too large.
void ViewRefiner::consider_split(std::uint32_t node) {
    if (refiner_.mesh().is_leaf(node)) { return; }
    const double shown_px = error_px(node);
    if (shown_px > options_.error_px) {
        splits_.push_back({shown_px, node});
        std::ranges::push_heap(splits_, has_smaller_error);
    }
}

/// Splits the nodes of splits_, largest error first, and considers their children in turn.
void ViewRefiner::split_worst() {
    std::size_t left = options_.operations;
    while (!splits_.empty() && left > 0) {
        std::ranges::pop_heap(splits_, has_smaller_error);
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
            if (refiner_.is_active(child)) { consider_split(child); }
        }
    }
    waiting_ = waiting_ || !splits_.empty();
}

/// Starts geomorphs for all nodes that were split in this frame.
void ViewRefiner::start_moves() {
    split_frames_.resize(refiner_.vertices().size(), 0);
    for (const std::uint32_t node : refiner_.recent_splits()) {
        const VertexSplit split = refiner_.mesh().split_of(node);
        split_frames_[refiner_.slot(split.first)] = frame_;
        split_frames_[refiner_.slot(split.second)] = frame_;
        if (options_.geomorphs) { moves_.start(refiner_, node); }
    }
    refiner_.clear_recent_splits();
}

/// Sends vertices back to their own nodes where their collapse is no longer wanted or no longer possible.
void ViewRefiner::reverse_moves() {
    turning_.clear();
    moves_.each([&](std::uint32_t slot, std::uint32_t target) {
        const std::uint32_t node = refiner_.node_at(slot);
        if (target == node) { return; }
        const VertexSplit split = refiner_.mesh().split_of(target);
        if (!refiner_.is_active(split.first) || !refiner_.is_active(split.second) ||
            error_px(target) > options_.error_px || !refiner_.can_collapse(target)) {
            turning_.push_back(slot);
        }
    });
    for (const std::uint32_t slot : turning_) { moves_.retarget(refiner_, slot, refiner_.node_at(slot)); }
}

/// Collapses the candidates of collapses_, the smallest error first.
void ViewRefiner::collapse_smallest() {
    std::ranges::sort(collapses_, [](const Candidate& a, const Candidate& b) {
        return a.error_px != b.error_px ? a.error_px < b.error_px : a.node > b.node;
    });
    std::size_t left = options_.operations;
    for (const Candidate& candidate : collapses_) {
        const VertexSplit split = refiner_.mesh().split_of(candidate.node);
        if (!refiner_.is_active(split.first) || !refiner_.is_active(split.second)) {
            continue; // A child has been split in the meantime.
        }
        if (left == 0 || rests_after_split(candidate.node)) {
            waiting_ = true;
        } else if (move_and_collapse(candidate.node)) {
            --left;
        }
    }
}

/// Whether one of a node's children came by a split within the last rest_frames: the node must not collapse yet.
bool ViewRefiner::rests_after_split(std::uint32_t node) const {
    const VertexSplit split = refiner_.mesh().split_of(node);
    const std::uint32_t came =
        std::max(split_frames_[refiner_.slot(split.first)], split_frames_[refiner_.slot(split.second)]);
    return came != 0 && frame_ - came <= static_cast<std::uint32_t>(options_.rest_frames);
}

/// Whether an active node came by a collapse within the last rest_frames.
bool ViewRefiner::rests_after_collapse(std::uint32_t node) const {
    const std::uint32_t slot = refiner_.slot(node);
    return slot < collapsed_.size() && collapsed_[slot].node == node &&
           frame_ - collapsed_[slot].frame <= static_cast<std::uint32_t>(options_.rest_frames);
}

/// Whether splitting an active node would split one that rests after its collapse: itself or a forced one.
bool ViewRefiner::needs_resting(std::uint32_t node) {
    if (rests_after_collapse(node)) { return true; }
    refiner_.find_forced_splits(node, forced_);
    return std::ranges::any_of(
        forced_, [this](std::uint32_t forced) { return refiner_.is_active(forced) && rests_after_collapse(forced); });
}

/// Collapses a node's children; with geomorphs moves them to the node's position first, in several frames. Returns
/// false when the collapse is not possible now.
bool ViewRefiner::move_and_collapse(std::uint32_t node) {
    const VertexSplit split = refiner_.mesh().split_of(node);
    const std::uint32_t first = refiner_.slot(split.first);
    const std::uint32_t second = refiner_.slot(split.second);
    const bool there = moves_.target(first) == node && moves_.target(second) == node && moves_.has_arrived(first) &&
                       moves_.has_arrived(second);
    if (!options_.geomorphs || there) {
        if (!refiner_.collapse(node)) { return false; }
        moves_.forget(first);
        moves_.forget(second);
        split_frames_[first] = 0;
        collapsed_.resize(split_frames_.size());
        collapsed_[first] = {node, frame_};
        return true;
    }
    if (!refiner_.can_collapse(node)) { return false; }
    moves_.retarget(refiner_, first, node);
    moves_.retarget(refiner_, second, node);
    return true;
}

} // namespace octant::visuals::refine
