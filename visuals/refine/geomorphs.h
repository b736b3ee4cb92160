#pragma once

#include "visuals/refine/refine_criterion.h"
#include "visuals/refine/selective_refiner.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::refine {

/// How fast vertices travel.
struct GeomorphOptions {
    /// No vertex moves farther than this on the screen in one frame.
    double step_px = 0.6; ///< no vertex moves farther on the screen in a frame, seen from one eye
    /// A move takes at least this many frames.
    double frames = 8.0; ///< a move takes at least so many
};

/// The vertices that are in motion (H. Hoppe's geomorphs), so that splits and collapses do not pop.
/// After a split, both children start where their parent was drawn and travel to their own
/// positions. Before a collapse, both travel to the parent's position, and only then is the edge
/// collapsed.
class Geomorphs {
public:
    explicit Geomorphs(GeomorphOptions options)
        : options_(options) {}

    /// Starts the two vertices of a node that was just split from where that node's vertex was
    /// drawn. To be called once for each split, in the order of the splits.
    void start(const SelectiveRefiner& refiner, std::uint32_t split_node);

    /// Sends the vertex of an active node to the position of node `target`, which is the node
    /// itself or its parent.
    void retarget(const SelectiveRefiner& refiner, std::uint32_t slot, std::uint32_t target);

    /// The node to whose position a slot's vertex travels; `none` when it rests at its own node.
    std::uint32_t target(std::uint32_t slot) const;

    /// Whether a slot's vertex is at the position it was sent to.
    bool has_arrived(std::uint32_t slot) const;

    /// Ends the motion of a slot's vertex: it is drawn at its node from now on.
    void forget(std::uint32_t slot);

    /// Advances all vertices in motion by one frame and puts them into the refiner's vertex array.
    /// Returns how many have moved.
    std::size_t move(SelectiveRefiner& refiner, const RefineView& view);

    /// Calls use(slot, target) for each vertex in motion.
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
        double share = 0.0; ///< The share of the way that is done, 0 to 1.
    };

    Move* find(std::uint32_t slot);
    void add(const Move& move);
    RefinedVertex drawn(const SelectiveRefiner& refiner, const Move& move) const;

    GeomorphOptions options_;
    std::vector<Move> moves_;
    std::vector<std::uint32_t> places_; ///< For each slot its index in moves_, or `none`.
};

} // namespace octant::visuals::refine
