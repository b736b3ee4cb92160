#pragma once

#include "visuals/verify/bits.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/sides.h"

#include <cstdint>
#include <span>
#include <unordered_map>

namespace octant::visuals::verify {

/// Pairs of which the earlier polygon is proved to hide nothing of the later one from some eyes.
class Facts {
public:
    explicit Facts(std::size_t polygons)
        : polygons_(polygons) {}

    void add(const Pair& pair);

    /// Adds what a plane proves that all eyes are before: whatever is behind it hides nothing of
    /// whatever is before it.
    void add_wall(const WrittenPlane& wall, const Certificate& certificate, const Sides& sides);

    /// Whether all of `painted` hide nothing of a polygon.
    bool decide(const Bits& painted, std::uint32_t later) const;

    /// The first polygon of which that is not known; there is one (asserted).
    std::uint32_t first_open(std::span<const std::uint32_t> painted, std::uint32_t later) const;

private:
    Bits& row(std::uint32_t later);

    std::size_t polygons_;
    std::unordered_map<std::uint32_t, Bits> rows_; ///< By the later polygon.
};

} // namespace octant::visuals::verify
