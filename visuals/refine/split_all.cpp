// SelectiveRefiner::split_all: splits whose memory is fetched ahead. A split reads what lies far
// apart, each address out of what was read before: node, place, list of corners, original faces.
// Here each step is done some splits before the next one needs what it fetches.
#include "visuals/refine/selective_refiner.h"

#include <algorithm>
#include <array>

namespace octant::visuals::refine {

namespace {

void fetch(const void* address) {
    __builtin_prefetch(address);
}

} // namespace

/// What split_all knows of a split to come. All of it are guesses: splits before it may change what
/// was read, and then something is fetched in vain.
struct SelectiveRefiner::Ahead {
    std::uint32_t slot = 0;
    std::uint32_t corner = none; ///< at the slot, whose links are on their way
};

void SelectiveRefiner::fetch_node(std::uint32_t node) const {
    const char* split = reinterpret_cast<const char*>(&mesh_->split_of(node));
    fetch(split);
    fetch(split + sizeof(Split) - 1);
}

void SelectiveRefiner::fetch_children(std::uint32_t node) const {
    const Split& split = mesh_->split_of(node);
    fetch(slots_.address(split.first_leaf));
    fetch(slots_.address(split.middle));
    fetch(&mesh_->child_shapes(node)[0]);
    fetch(&mesh_->child_shapes(node)[1].cone);
    for (const std::uint32_t face : {split.left_face, split.right_face}) {
        if (face != none) {
            fetch(&mesh_->faces()[face]);
        }
    }
    for (const std::uint32_t cut : {split.left_cut, split.right_cut}) {
        if (cut != none) {
            fetch(slots_.address(starts_.at_or_before(cut)));
        }
    }
}

void SelectiveRefiner::fetch_vertices(std::uint32_t node, Ahead& ahead) const {
    const Split& split = mesh_->split_of(node);
    ahead = {slots_[split.first_leaf], none};
    if (ahead.slot < vertices_.size()) {
        fetch(faces_.vertex_address(ahead.slot));
        fetch(&vertices_[ahead.slot]);
    }
    for (const std::uint32_t cut : {split.left_cut, split.right_cut}) {
        if (cut != none) {
            fetch(faces_.vertex_address(slot_above(cut)));
        }
    }
}

/// One face further around the vertex.
void SelectiveRefiner::fetch_around(Ahead& ahead) const {
    if (ahead.corner != none) {
        const std::uint32_t face = faces_.label(ahead.corner / 3);
        if (face != none) {
            fetch(&mesh_->faces()[face]);
        }
        ahead.corner = faces_.fetch_next(ahead.corner);
    }
}

std::size_t SelectiveRefiner::split_all(std::span<const std::uint32_t> nodes) {
    constexpr std::size_t for_node = 24; // so many splits ahead
    constexpr std::size_t for_children = 18;
    constexpr std::size_t for_slot = 13;
    constexpr std::size_t for_corners = 9; // and one face further each split from then on
    std::array<Ahead, 16> ring;
    std::size_t done = 0;
    const auto has = [&](std::size_t at) { return at < nodes.size(); };
    for (std::size_t now = 0; now < nodes.size() + for_node; ++now) {
        if (has(now)) {
            fetch_node(nodes[now]);
        }
        if (const std::size_t at = now - (for_node - for_children); has(at)) {
            fetch_children(nodes[at]);
        }
        if (const std::size_t at = now - (for_node - for_slot); has(at)) {
            fetch_vertices(nodes[at], ring[at % ring.size()]);
        }
        if (const std::size_t at = now - (for_node - for_corners); has(at)) {
            Ahead& ahead = ring[at % ring.size()];
            ahead.corner = faces_.fetch_first(ahead.slot);
        }
        for (std::size_t later = 1; later < for_corners; ++later) {
            if (const std::size_t at = now - (for_node - later); has(at)) {
                fetch_around(ring[at % ring.size()]);
            }
        }
        if (const std::size_t at = now - for_node; has(at)) {
            done += split(nodes[at]);
        }
    }
    return done;
}

} // namespace octant::visuals::refine
