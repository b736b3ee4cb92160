#pragma once

#include "visuals/verify/certificate.h"

#include <cstddef>
#include <vector>

namespace octant::visuals::verify {

/// How many walls bound the eyes that come to each node and list of a certificate: one for each
/// choice above it.
struct RegionPlaneCounts {
    std::vector<std::size_t> by_node;
    std::vector<std::size_t> by_list;
};

/// Counts the walls down from the first node, or for the only list where there is no node. Throws
/// Error unless nodes and lists are one tree and the certificate has a tolerance and polygons.
RegionPlaneCounts count_region_planes(const Certificate& certificate);

} // namespace octant::visuals::verify
