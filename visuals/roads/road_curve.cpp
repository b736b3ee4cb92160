#include "visuals/roads/road_curve.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::visuals::roads {

namespace {

constexpr std::size_t steps_per_cell = 8;
constexpr int smoothing_passes = 3;
constexpr std::size_t section_points = 32;
constexpr double max_mitre_ratio = 1.5; ///< half widths

/// Points at even distances between neighbouring places.
std::vector<glm::dvec2> resampled(std::span<const glm::dvec2> places_m, double step_m) {
    std::vector<glm::dvec2> line_m;
    for (std::size_t i = 1; i < places_m.size(); ++i) {
        const double length_m = glm::distance(places_m[i - 1], places_m[i]);
        const int steps = std::max(static_cast<int>(std::lround(length_m / step_m)), 1);
        for (int step = 0; step < steps; ++step) {
            line_m.push_back(
                glm::mix(places_m[i - 1], places_m[i], static_cast<double>(step) / steps));
        }
    }
    line_m.push_back(places_m.back());
    return line_m;
}

/// Each point as the mean of as many before it as after it, at most `reach`.
std::vector<glm::dvec2> smoothed(const std::vector<glm::dvec2>& line_m, std::size_t reach) {
    std::vector<glm::dvec2> smooth_m;
    smooth_m.reserve(line_m.size());
    for (std::size_t i = 0; i < line_m.size(); ++i) {
        const std::size_t around = std::min({reach, i, line_m.size() - 1 - i});
        glm::dvec2 sum_m(0.0);
        for (std::size_t j = i - around; j <= i + around; ++j) {
            sum_m += line_m[j];
        }
        smooth_m.push_back(sum_m / static_cast<double>(2 * around + 1));
    }
    return smooth_m;
}

/// A unit vector; along x where there is none.
glm::dvec2 direction(const glm::dvec2& way_m) {
    const double length_m = glm::length(way_m);
    return length_m > 1e-9 ? way_m / length_m : glm::dvec2(1.0, 0.0);
}

/// From a point where one way ends and the next begins to the left edge of both.
glm::dvec2 left_edge_offset_m(const glm::dvec2& before, const glm::dvec2& after) {
    const glm::dvec2 along = direction(direction(before) + direction(after));
    const glm::dvec2 left(-along.y, along.x);
    const double seen = std::max(glm::dot(along, direction(after)), 1.0 / max_mitre_ratio);
    return left * (half_width_m / seen);
}

/// The points of a level; at the ends edges go on as on the whole line.
std::vector<RoadPoint> level_points(
    std::span<const glm::dvec2> piece_m,
    std::size_t number,
    const glm::dvec2& first_left_m,
    const glm::dvec2& last_left_m) {
    const std::vector<std::size_t> kept =
        simplify_line(piece_m, level_error_m[number], max_segment_length_m[number]);
    std::vector<RoadPoint> level;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const glm::dvec2& at_m = piece_m[kept[i]];
        if (i == 0 || i + 1 == kept.size()) {
            level.push_back({at_m, i == 0 ? first_left_m : last_left_m});
        } else {
            level.push_back(
                {at_m, left_edge_offset_m(at_m - piece_m[kept[i - 1]], piece_m[kept[i + 1]] - at_m)});
        }
    }
    return level;
}

void update_bounds(RoadSection& section) {
    section.min_m = glm::dvec2(std::numeric_limits<double>::infinity());
    section.max_m = -section.min_m;
    for (const std::vector<RoadPoint>& level : section.levels) {
        for (const RoadPoint& point : level) {
            const glm::dvec2 aside_m = glm::abs(point.to_left_edge_m);
            section.min_m = glm::min(section.min_m, point.at_m - aside_m);
            section.max_m = glm::max(section.max_m, point.at_m + aside_m);
        }
    }
}

} // namespace

double
distance_to_segment_m(const glm::dvec2& at_m, const glm::dvec2& from_m, const glm::dvec2& to_m) {
    const glm::dvec2 way_m = to_m - from_m;
    const double squared_m2 = std::max(glm::dot(way_m, way_m), 1e-12);
    const double share = std::clamp(glm::dot(at_m - from_m, way_m) / squared_m2, 0.0, 1.0);
    return glm::distance(at_m, from_m + share * way_m);
}

std::vector<glm::dvec2> smooth_centre_line(
    std::span<const glm::dvec2> places_m,
    double cell_m,
    const std::function<bool(const glm::dvec2&)>& is_free) {
    const std::vector<glm::dvec2> straight_m =
        resampled(places_m, cell_m / static_cast<double>(steps_per_cell));
    for (const std::size_t reach : {steps_per_cell, steps_per_cell / 2}) {
        std::vector<glm::dvec2> line_m = straight_m;
        for (int pass = 0; pass < smoothing_passes; ++pass) {
            line_m = smoothed(line_m, reach);
        }
        if (std::ranges::all_of(line_m, is_free)) {
            return line_m;
        }
    }
    std::vector<glm::dvec2> nearly_straight_m = smoothed(straight_m, 1);
    if (!std::ranges::all_of(nearly_straight_m, is_free)) {
        nearly_straight_m.clear();
    }
    return nearly_straight_m;
}

std::vector<std::size_t>
simplify_line(std::span<const glm::dvec2> line_m, double error_m, double max_gap_m) {
    std::vector<std::size_t> kept{0};
    std::vector<std::size_t> open{line_m.size() - 1}; // ends of stretches, the nearest last
    while (!open.empty()) {
        const std::size_t first = kept.back();
        const std::size_t last = open.back();
        std::size_t farthest = last;
        double max_m = error_m;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double off_m = distance_to_segment_m(line_m[i], line_m[first], line_m[last]);
            if (off_m > max_m) {
                max_m = off_m;
                farthest = i;
            }
        }
        if (farthest == last && glm::distance(line_m[first], line_m[last]) > max_gap_m) {
            farthest = (first + last + 1) / 2; // the last one where there is none between
        }
        if (farthest == last) {
            kept.push_back(last);
            open.pop_back();
        } else {
            open.push_back(farthest);
        }
    }
    return kept;
}

void append_sections(std::vector<glm::dvec2> line_m, std::vector<RoadSection>& sections) {
    const std::size_t last = line_m.size() - 1;
    const glm::dvec2 first_way = direction(line_m[1] - line_m[0]);
    const glm::dvec2 last_way = direction(line_m[last] - line_m[last - 1]);
    line_m[0] -= first_way * half_width_m;
    line_m[last] += last_way * half_width_m;
    const auto to_left_edge_m = [&](std::size_t i) {
        return left_edge_offset_m(
            i > 0 ? line_m[i] - line_m[i - 1] : first_way,
            i < last ? line_m[i + 1] - line_m[i] : last_way);
    };
    for (std::size_t first = 0; first < last;) {
        // No short piece is left over.
        const std::size_t end = first + 2 * section_points > last ? last : first + section_points;
        const std::span piece_m(&line_m[first], end - first + 1);
        RoadSection& section = sections.emplace_back();
        for (std::size_t level = 0; level < section.levels.size(); ++level) {
            section.levels[level] = level_points(piece_m, level, to_left_edge_m(first), to_left_edge_m(end));
        }
        update_bounds(section);
        first = end;
    }
}

} // namespace octant::visuals::roads
