#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace octant::visuals::roads {

inline constexpr double half_width_m = 3.5;

/// A point of a road's middle line, and the way from there to its left edge.
struct RoadPoint {
    glm::dvec2 at_m;
    glm::dvec2 to_left_edge_m;
};

/// How far a level's middle line may lie off the finest one, metres.
inline constexpr std::array<double, 4> level_error_m = {0.1, 0.5, 2.0, 8.0};

/// No stretch of a level is longer, but for one step of the finest line: each has one light.
inline constexpr std::array<double, level_error_m.size()> max_segment_length_m = {
    25.0, 60.0, 150.0, 400.0};

/// A piece of a road some hundred metres long, in levels of detail whose ends are the same. World
/// axes.
struct RoadSection {
    std::array<std::vector<RoadPoint>, level_error_m.size()> levels; ///< at least two points each
    glm::dvec2 min_m{0.0};                                         ///< of its edges
    glm::dvec2 max_m{0.0};
};

/// The middle line through these places, rounded like a road, its ends where they are. Where
/// rounding would lead it over a place that `is_free` denies it goes nearly straight from place to
/// place; empty where that is denied, too.
std::vector<glm::dvec2> smooth_centre_line(
    std::span<const glm::dvec2> places_m,
    double cell_m,
    const std::function<bool(const glm::dvec2&)>& is_free);

/// How far a place lies from the straight way from one place to another.
double
distance_to_segment_m(const glm::dvec2& at_m, const glm::dvec2& from_m, const glm::dvec2& to_m);

/// Which points of a line, the first and the last among them, are enough for it to lie nowhere
/// farther off than so much (Douglas and Peucker 1973), and for no two to lie farther apart than
/// `max_gap_m` where there are others between them.
std::vector<std::size_t>
simplify_line(std::span<const glm::dvec2> line_m, double error_m, double max_gap_m);

/// A line in pieces; a half width longer at both ends, so that roads that meet there leave no gap.
void append_sections(std::vector<glm::dvec2> line_m, std::vector<RoadSection>& sections);

} // namespace octant::visuals::roads
