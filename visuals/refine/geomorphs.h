#pragma once

#include "visuals/refine/refine_criterion.h"
#include "visuals/refine/selective_refiner.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::refine {

struct GeomorphOptions {
    double step_px = 0.6; ///< no vertex moves farther on the screen in a frame, seen from one eye
    double frames = 8.0;  ///< a move takes at least so many
};

/// Vertices on their way: from the place of a node that was split to their own, or to the place of
/// the node that they are about to be merged into. They are drawn between both.
class Geomorphs {
public:
    explicit Geomorphs(GeomorphOptions options)
        : options_(options) {}

    /// Lets the vertices of a node that was split start where its own was drawn. Once a split, in
    /// the order of the splits.
    void start(const SelectiveRefiner& refiner, std::uint32_t split_node);

    /// Sends an active node's vertex to where `target` lies: its own node or its parent.
    void send(const SelectiveRefiner& refiner, std::uint32_t slot, std::uint32_t target);

    /// Where a slot's vertex is sent; none when it lies at its own node.
    std::uint32_t target(std::uint32_t slot) const;

    /// Whether a slot's vertex is where it was sent.
    bool has_arrived(std::uint32_t slot) const;

    /// Forgets the vertex of a slot: it is at its node from now on.
    void forget(std::uint32_t slot);

    /// One frame on; draws the vertices on their way. Returns how many have moved.
    std::size_t move(SelectiveRefiner& refiner, const RefineView& view);

    /// Calls use(slot, target) for each vertex on its way.
    template <class Use>
    void each(const Use& use) const {
        for (const Move& move : moves_) {
            use(move.slot, move.target);
        }
    }

private:
    struct Move {
        std::uint32_t slot = none;
        std::uint32_t target = none;
        RefinedVertex from;
        double share = 0.0; ///< of the way that is done
    };

    Move* find(std::uint32_t slot);
    void add(const Move& move);
    RefinedVertex drawn(const SelectiveRefiner& refiner, const Move& move) const;

    GeomorphOptions options_;
    std::vector<Move> moves_;
    std::vector<std::uint32_t> places_; ///< in moves_, one a slot
};

} // namespace octant::visuals::refine
