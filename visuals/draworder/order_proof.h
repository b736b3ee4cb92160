#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

/// How far an order is proved.
struct OrderProof {
    /// Pairs and polygons for which no proof was found.
    std::uint64_t unproved = 0;
    /// The first of these pairs: which is painted earlier, which later.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> unproved_pairs;
    static constexpr std::size_t max_open = 100;
    /// Whether the whole order was looked at; else the work was spent before.
    bool is_complete = false;
};

/// Proves an order pair by pair (proof_walk.h), as far as about so many seconds of work on one core
/// go. They are counted, not timed: the same model and order give the same proof.
OrderProof
prove_order(const models::polygons::PolygonModel& model, const DrawOrder& order, double seconds);

} // namespace octant::visuals::draworder
