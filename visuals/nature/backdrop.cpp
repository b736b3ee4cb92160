#include "visuals/nature/backdrop.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace octant::visuals::nature {

namespace {

/// Distances of the rings from the map's edge over its mean half extent, from outside in. The last
/// lies under the map's own border.
constexpr std::array ring_shares = {
    2.5, 1.8, 1.3, 1.0, 0.78, 0.62, 0.50, 0.40, 0.32, 0.25, 0.19, 0.135, 0.09, 0.05, 0.02, -0.01};
constexpr int side_corners = 48;
constexpr int ring_corners = 4 * side_corners;
constexpr double sunk_under_map = 0.02; ///< of the last ring, over the map's mean half extent

/// A place on the outline of a square from -1 to 1, counter-clockwise seen from above.
glm::dvec2 on_square(int corner) {
    const double along = 2.0 * (corner % side_corners) / side_corners - 1.0;
    switch (corner / side_corners) {
    case 0:
        return {along, -1.0};
    case 1:
        return {1.0, along};
    case 2:
        return {-along, 1.0};
    default:
        return {-1.0, -along};
    }
}

/// A coordinate mirrored at the edges -half and half as often as it takes.
double mirrored(double at_m, double half_m) {
    const double period_m = 4.0 * half_m;
    const double turn = std::abs(std::remainder(at_m + half_m, period_m));
    return turn - half_m;
}

Backdrop::Corner corner_at(const MapFacts& map, double share, int number) {
    const double size_m = 0.5 * (map.half_extent_m.x + map.half_extent_m.y);
    const glm::dvec2 at_m = on_square(number) * (map.half_extent_m + share * size_m);
    constexpr double inside = 0.999;
    const glm::dvec2 twin_m(
        inside * mirrored(at_m.x, map.half_extent_m.x),
        inside * mirrored(at_m.y, map.half_extent_m.y));
    const double left = 1.0 - glm::smoothstep(0.0, 1.0, std::max(share, 0.0) / ring_shares.front());
    const double height_m = glm::mix(map.mean_height_m, map.height_m(twin_m), left) -
                            (share < 0.0 ? sunk_under_map * size_m : 0.0);
    const double footprint_m = std::max(1.2 * size_m / side_corners, 0.12 * share * size_m);
    return {
        {at_m, height_m},
        glm::mix(map.mean_colour, map.colour(twin_m, footprint_m), static_cast<float>(left)),
        map.covers ? map.covers(twin_m, footprint_m) : 0.0F};
}

} // namespace

Backdrop backdrop_of(const MapFacts& map) {
    Backdrop backdrop;
    for (const double share : ring_shares) {
        for (int number = 0; number < ring_corners; ++number) {
            backdrop.corners.push_back(corner_at(map, share, number));
        }
    }
    const auto rings = static_cast<std::uint32_t>(ring_shares.size());
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
        for (std::uint32_t number = 0; number < ring_corners; ++number) {
            const std::uint32_t outer = ring * ring_corners + number;
            const std::uint32_t outer_next = ring * ring_corners + (number + 1) % ring_corners;
            const std::uint32_t inner = outer + ring_corners;
            const std::uint32_t inner_next = outer_next + ring_corners;
            backdrop.indices.insert(
                backdrop.indices.end(), {outer, outer_next, inner_next, outer, inner_next, inner});
        }
    }
    return backdrop;
}

} // namespace octant::visuals::nature
