#pragma once

#include "visuals/verify/polygon_set.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/exact_sides.h"

#include <cstdint>
#include <span>
#include <unordered_map>

namespace octant::visuals::verify {

/// Pairs of which the earlier polygon is proved to hide nothing of the later one from some eyes.
class ProvedPairs {
public:
    explicit ProvedPairs(std::size_t polygons)
        : polygons_(polygons) {}

    void add(const PolygonPair& pair);

    /// Adds what a plane proves that all eyes are before: whatever is behind it hides nothing of
    /// whatever is before it.
    void add_region_plane(const WrittenPlane& wall, const Certificate& certificate, const ExactSides& sides);

    /// Whether all of `painted` hide nothing of a polygon.
    bool decide(const PolygonSet& painted, std::uint32_t later) const;

    /// The first polygon of which that is not known; there is one (asserted).
    std::uint32_t first_open(std::span<const std::uint32_t> painted, std::uint32_t later) const;

private:
    PolygonSet& row(std::uint32_t later);

    std::size_t polygons_;
    std::unordered_map<std::uint32_t, PolygonSet> rows_; ///< By the later polygon.
};

} // namespace octant::visuals::verify
