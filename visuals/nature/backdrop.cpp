#include "visuals/nature/backdrop.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace octant::visuals::nature {

namespace {

/// Distances of the rings from the map's edge over its half extents, from outside in. The last lies under the map's own
/// border.
constexpr std::array ring_distance_ratios = {
    5.0, 3.3, 2.2, 1.5, 1.0, 0.78, 0.62, 0.50, 0.40, 0.32, 0.25, 0.18, 0.11, 0.05, 0.02, -0.01};
constexpr double flat_ratio = 1.0; ///< from this ring on the land lies at the mean height
/// Small maps' flat rings are farther off, so that the outermost one is at least so far.
constexpr double min_reach_m = 20000.0;
constexpr double full_colour_share = 0.2; ///< of the reach: from here on colours fade to the mean one
constexpr int vertices_per_side = 48;
constexpr int vertices_per_ring = 4 * vertices_per_side;
constexpr double overlap_depth_ratio = 0.02; ///< of the last ring, over the map's mean half extent

/// A place on the outline of a square from -1 to 1, counter-clockwise seen from above.
glm::dvec2 square_outline_point(int corner) {
    const double along = 2.0 * (corner % vertices_per_side) / vertices_per_side - 1.0;
    switch (corner / vertices_per_side) {
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

double size_of(const BackdropSource& map) { return 0.5 * (map.half_extent_m.x + map.half_extent_m.y); }

/// Of the outermost ring, over the map's half extents.
double reach_of(const BackdropSource& map) {
    return std::max(ring_distance_ratios.front(), min_reach_m / std::min(map.half_extent_m.x, map.half_extent_m.y));
}

/// A vertex of the ring at `share`; `gap` is how far the next ring outwards is, both over the map's half extents.
Backdrop::BackdropVertex vertex_at(const BackdropSource& map, double share, double gap, int number) {
    const double size_m = size_of(map);
    const glm::dvec2 at_m = (1.0 + share) * square_outline_point(number) * map.half_extent_m;
    constexpr double inside = 0.999;
    const glm::dvec2 mirrored_m(
        inside * mirrored(at_m.x, map.half_extent_m.x), inside * mirrored(at_m.y, map.half_extent_m.y));
    const auto is_water = [&](const glm::dvec2& of_map_m) {
        return map.water_level_m && map.height_m(of_map_m) <= *map.water_level_m;
    };
    const glm::dvec2 edge_m = glm::clamp(at_m, -inside * map.half_extent_m, inside * map.half_extent_m);
    if (is_water(edge_m)) { return {{at_m, *map.water_level_m}, map.colour(edge_m, 0.0), 0.0F, true}; }
    const double relief = 1.0 - glm::smoothstep(0.0, flat_ratio, share);
    const double reach = reach_of(map);
    const double contrast = 1.0 - glm::smoothstep(full_colour_share * reach, reach, share);
    const double height_m = glm::mix(map.mean_height_m, map.height_m(mirrored_m), relief) -
                            (share < 0.0 ? overlap_depth_ratio * size_m : 0.0);
    const double footprint_m = std::max(1.2 / vertices_per_side, 0.5 * gap) * size_m;
    return {{at_m, height_m},
        glm::mix(map.mean_colour, map.colour(mirrored_m, footprint_m), static_cast<float>(contrast)),
        map.cover_code ? map.cover_code(mirrored_m, footprint_m) : 0.0F, is_water(mirrored_m)};
}

} // namespace

Backdrop make_backdrop(const BackdropSource& map) {
    Backdrop backdrop;
    backdrop.outer_vertices = vertices_per_ring;
    const double stretch = (reach_of(map) - flat_ratio) / (ring_distance_ratios.front() - flat_ratio);
    double farther = reach_of(map);
    for (const double ratio : ring_distance_ratios) {
        const double share = ratio + (stretch - 1.0) * std::max(ratio - flat_ratio, 0.0);
        for (int number = 0; number < vertices_per_ring; ++number) {
            backdrop.vertices.push_back(vertex_at(map, share, farther - share, number));
        }
        farther = share;
    }
    const auto rings = static_cast<std::uint32_t>(ring_distance_ratios.size());
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
        for (std::uint32_t number = 0; number < vertices_per_ring; ++number) {
            const std::uint32_t outer = ring * vertices_per_ring + number;
            const std::uint32_t outer_next = ring * vertices_per_ring + (number + 1) % vertices_per_ring;
            const std::uint32_t inner = outer + vertices_per_ring;
            const std::uint32_t inner_next = outer_next + vertices_per_ring;
            backdrop.indices.insert(backdrop.indices.end(), {outer, outer_next, inner_next, outer, inner_next, inner});
        }
    }
    return backdrop;
}

} // namespace octant::visuals::nature
