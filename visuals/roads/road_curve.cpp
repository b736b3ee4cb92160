#include "visuals/roads/road_curve.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::visuals::roads {

namespace {

constexpr std::size_t steps_a_cell = 8;
constexpr int passes = 3;
constexpr std::size_t piece_points = 32;
constexpr double longest_mitre = 1.5; ///< half widths

/// Points at even distances between neighbouring places.
std::vector<glm::dvec2> divided(std::span<const glm::dvec2> places_m, double step_m) {
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
glm::dvec2 to_left_m(const glm::dvec2& before, const glm::dvec2& after) {
    const glm::dvec2 along = direction(direction(before) + direction(after));
    const glm::dvec2 left(-along.y, along.x);
    const double seen = std::max(glm::dot(along, direction(after)), 1.0 / longest_mitre);
    return left * (half_width_m / seen);
}

/// The points of a level; at the ends edges go on as on the whole line.
std::vector<RoadPoint> level_of(
    std::span<const glm::dvec2> piece_m,
    std::size_t number,
    const glm::dvec2& first_left_m,
    const glm::dvec2& last_left_m) {
    const std::vector<std::size_t> kept =
        enough_points(piece_m, level_error_m[number], longest_stretch_m[number]);
    std::vector<RoadPoint> level;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const glm::dvec2& at_m = piece_m[kept[i]];
        if (i == 0 || i + 1 == kept.size()) {
            level.push_back({at_m, i == 0 ? first_left_m : last_left_m});
        } else {
            level.push_back(
                {at_m, to_left_m(at_m - piece_m[kept[i - 1]], piece_m[kept[i + 1]] - at_m)});
        }
    }
    return level;
}

void measure(RoadPiece& piece) {
    piece.min_m = glm::dvec2(std::numeric_limits<double>::infinity());
    piece.max_m = -piece.min_m;
    for (const std::vector<RoadPoint>& level : piece.levels) {
        for (const RoadPoint& point : level) {
            const glm::dvec2 aside_m = glm::abs(point.left_m);
            piece.min_m = glm::min(piece.min_m, point.at_m - aside_m);
            piece.max_m = glm::max(piece.max_m, point.at_m + aside_m);
        }
    }
}

} // namespace

double
distance_from_stretch_m(const glm::dvec2& at_m, const glm::dvec2& from_m, const glm::dvec2& to_m) {
    const glm::dvec2 way_m = to_m - from_m;
    const double squared_m2 = std::max(glm::dot(way_m, way_m), 1e-12);
    const double share = std::clamp(glm::dot(at_m - from_m, way_m) / squared_m2, 0.0, 1.0);
    return glm::distance(at_m, from_m + share * way_m);
}

std::vector<glm::dvec2> rounded(
    std::span<const glm::dvec2> places_m,
    double cell_m,
    const std::function<bool(const glm::dvec2&)>& is_free) {
    const std::vector<glm::dvec2> straight_m =
        divided(places_m, cell_m / static_cast<double>(steps_a_cell));
    for (const std::size_t reach : {steps_a_cell, steps_a_cell / 2}) {
        std::vector<glm::dvec2> line_m = straight_m;
        for (int pass = 0; pass < passes; ++pass) {
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
enough_points(std::span<const glm::dvec2> line_m, double error_m, double apart_m) {
    std::vector<std::size_t> kept{0};
    std::vector<std::size_t> open{line_m.size() - 1}; // ends of stretches, the nearest last
    while (!open.empty()) {
        const std::size_t first = kept.back();
        const std::size_t last = open.back();
        std::size_t farthest = last;
        double max_m = error_m;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double off_m = distance_from_stretch_m(line_m[i], line_m[first], line_m[last]);
            if (off_m > max_m) {
                max_m = off_m;
                farthest = i;
            }
        }
        if (farthest == last && glm::distance(line_m[first], line_m[last]) > apart_m) {
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

void append_pieces(std::vector<glm::dvec2> line_m, std::vector<RoadPiece>& pieces) {
    const std::size_t last = line_m.size() - 1;
    const glm::dvec2 first_way = direction(line_m[1] - line_m[0]);
    const glm::dvec2 last_way = direction(line_m[last] - line_m[last - 1]);
    line_m[0] -= first_way * half_width_m;
    line_m[last] += last_way * half_width_m;
    const auto left_m = [&](std::size_t i) {
        return to_left_m(
            i > 0 ? line_m[i] - line_m[i - 1] : first_way,
            i < last ? line_m[i + 1] - line_m[i] : last_way);
    };
    for (std::size_t first = 0; first < last;) {
        // No short piece is left over.
        const std::size_t end = first + 2 * piece_points > last ? last : first + piece_points;
        const std::span piece_m(&line_m[first], end - first + 1);
        RoadPiece& piece = pieces.emplace_back();
        for (std::size_t level = 0; level < piece.levels.size(); ++level) {
            piece.levels[level] = level_of(piece_m, level, left_m(first), left_m(end));
        }
        measure(piece);
        first = end;
    }
}

} // namespace octant::visuals::roads
