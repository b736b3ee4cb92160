// Geomorphs after H. Hoppe, "Progressive Meshes", 1996, section 3.1: positions, normals and colours
// are mixed linearly between two places.
//
// Deviation: the share of the way follows from the screen, not from the clock. In each frame a
// vertex covers at most step_px pixels, as seen from the present eye, so that near vertices take
// longer than far ones and no motion catches the eye.
#include "visuals/refine/geomorphs.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::refine {

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
    return {
        glm::mix(from.position_m, to.position_m, part),
        glm::length(normal) > 0.01F ? packed(normal) : to.normal,
        mixed_colour(from.colour, to.colour, share)};
}

/// How far a vertex may move in one frame, metres, so that it moves by `step_px` pixels at most in
/// any direction. Outside the picture the scale of its corners is used, about 60 degrees off the
/// middle.
double step_m(const glm::dvec3& from_eye_m, const RefineView& view, double step_px) {
    const double distance_m = std::max(glm::length(from_eye_m), view.near_m);
    const double depth_m = std::max(glm::dot(from_eye_m, view.forward), 0.5 * distance_m);
    return step_px * depth_m * depth_m / (view.focal_px * distance_m);
}

} // namespace

Geomorphs::Move* Geomorphs::find(std::uint32_t slot) {
    return slot < places_.size() && places_[slot] != none ? &moves_[places_[slot]] : nullptr;
}

void Geomorphs::add(const Move& move) {
    if (Move* known = find(move.slot)) {
        *known = move;
        return;
    }
    if (move.slot >= places_.size()) {
        places_.resize(move.slot + 1, none);
    }
    places_[move.slot] = static_cast<std::uint32_t>(moves_.size());
    moves_.push_back(move);
}

void Geomorphs::forget(std::uint32_t slot) {
    if (find(slot) == nullptr) {
        return;
    }
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
    const std::uint32_t first = refiner.slot_below(split.first);
    const Move* known = find(first);
    const RefinedVertex from =
        known != nullptr ? drawn(refiner, *known) : refiner.vertex_of(split_node);
    add({first, split.first, from, 0.0});
    add({refiner.slot_below(split.second), split.second, from, 0.0});
}

void Geomorphs::retarget(const SelectiveRefiner& refiner, std::uint32_t slot, std::uint32_t target) {
    const Move* known = find(slot);
    if (known != nullptr && known->target == target) {
        return;
    }
    const RefinedVertex from =
        known != nullptr ? drawn(refiner, *known) : refiner.vertex_of(refiner.node_at(slot));
    add({slot, target, from, 0.0});
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
            const auto way_m =
                static_cast<double>(glm::distance(move.from.position_m, to.position_m));
            const double max_m = step_m(at_m - eye_m, view, options_.step_px);
            const double step = way_m > 0.0 ? std::min(max_m / way_m, 1.0 / options_.frames)
                                            : 1.0 / options_.frames;
            move.share = std::min(1.0, move.share + step);
            ++moved;
        }
        refiner.set_drawn_vertex(move.slot, drawn(refiner, move));
        if (move.share >= 1.0 && move.target == refiner.node_at(move.slot)) {
            forget(move.slot);
        }
    }
    return moved;
}

} // namespace octant::visuals::refine
