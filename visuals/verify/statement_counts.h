#pragma once

#include <cstdint>

namespace octant::visuals::verify {

/// How many claims about pairs were checked, by kinds.
struct StatementCounts {
    std::uint64_t by_polygons = 0; ///< The plane of one polygon of the pair decides.
    std::uint64_t by_sums = 0;     ///< A sum of planes decides.
    std::uint64_t never_both_visible = 0;  ///< No eye sees both.
};

} // namespace octant::visuals::verify
