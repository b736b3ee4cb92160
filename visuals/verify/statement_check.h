#pragma once

#include "visuals/verify/statement_counts.h"
#include "visuals/verify/proved_pairs.h"
#include "visuals/verify/pair_check.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace octant::visuals::verify {

/// The earlier polygons of which a row of pairs speaks, by the later one; nothing where there
/// should be no such row.
using EarlierOf = std::function<std::optional<std::span<const std::uint32_t>>(std::uint32_t later)>;

/// Checks all that is claimed about pairs for the eyes before some walls, and adds it to what is
/// known. Throws Refusal.
void check_statements(
    const PairCheck& check,
    const Statements& claims,
    const RegionPlanes& region_planes,
    const EarlierOf& earlier_of,
    ProvedPairs& proved_pairs,
    StatementCounts& counts);

} // namespace octant::visuals::verify
