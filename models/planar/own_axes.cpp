// Which way a model lies. Whatever looks along axes later on, at boxes or for planes across them,
// then gives the same for a model and the same model turned.
#include "models/planar/own_axes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace octant::models::planar {

namespace {

/// Of more sides only so many are looked at, evenly spread.
constexpr std::size_t max_sides = 4'000;
/// So many are tried as axes: the longest, and as many spread over all.
constexpr std::size_t max_tried = 64;
constexpr double right_angle = 1e-8; ///< A smaller cosine is none; so is a smaller sine.
constexpr double rounding = 1e-9;

struct Side {
    glm::dvec3 along{0.0};
    double length = 0.0;
};

std::vector<Side>
sides_of(const polygons::PolygonModel& model, std::span<const glm::dvec3> points) {
    std::vector<Side> sides;
    const std::size_t step = model.corner_vertices.size() / max_sides + 1;
    std::size_t number = 0;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto corners = model.corners(i);
        const bool turns = polygons::pivot_of(model, i).has_value();
        for (std::size_t k = 0; k < corners.size(); ++k, ++number) {
            const glm::dvec3 side = points[corners[(k + 1) % corners.size()]] - points[corners[k]];
            const double length = glm::length(side);
            if (!turns && number % step == 0 && length > 0.0) {
                sides.push_back({side / length, length});
            }
        }
    }
    return sides;
}

/// The sides that are tried, in their order. Rounding does not decide which of many that are
/// equally long are among them.
std::vector<Side> tried_of(const std::vector<Side>& sides) {
    std::vector<double> lengths;
    for (const Side& side : sides) {
        lengths.push_back(side.length);
    }
    const std::size_t last = std::min(max_tried, lengths.size()) - 1;
    std::ranges::nth_element(
        lengths, lengths.begin() + static_cast<std::ptrdiff_t>(last), std::greater());
    const double least = lengths[last] * (1.0 - rounding);
    const std::size_t step = sides.size() / max_tried + 1;
    std::vector<Side> tried;
    std::size_t long_ones = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const bool is_long = sides[i].length >= least && long_ones < 4 * max_tried;
        long_ones += is_long ? 1 : 0;
        if (is_long || i % step == 0) {
            tried.push_back(sides[i]);
        }
    }
    return tried;
}

/// The length of the sides that lie along a direction or across it.
double support_of(const glm::dvec3& direction, const std::vector<Side>& sides) {
    double support = 0.0;
    for (const Side& side : sides) {
        const double cosine = glm::dot(side.along, direction);
        const glm::dvec3 sine = glm::cross(side.along, direction);
        if (std::abs(cosine) < right_angle || glm::dot(sine, sine) < right_angle * right_angle) {
            support += side.length;
        }
    }
    return support;
}

/// The direction with the most support, the first one among equals; nothing of nothing.
glm::dvec3 best_of(const std::vector<glm::dvec3>& directions, const std::vector<Side>& sides) {
    glm::dvec3 best(0.0);
    double most = 0.0;
    for (const glm::dvec3& direction : directions) {
        const double support = support_of(direction, sides);
        if (support > most * (1.0 + rounding)) {
            best = direction;
            most = support;
        }
    }
    return best;
}

/// The directions of sides with what they have along an axis taken away: those across it or, where
/// there are none, all.
std::vector<glm::dvec3> across(const glm::dvec3& axis, const std::vector<Side>& tried) {
    std::vector<glm::dvec3> exactly;
    std::vector<glm::dvec3> about;
    for (const Side& side : tried) {
        const double cosine = glm::dot(side.along, axis);
        const glm::dvec3 rest = side.along - axis * cosine;
        const double length = glm::length(rest);
        if (std::abs(cosine) < right_angle) {
            exactly.push_back(rest / length);
        } else if (length > right_angle) {
            about.push_back(rest / length);
        }
    }
    return exactly.empty() ? about : exactly;
}

} // namespace

glm::dmat3 own_axes(const polygons::PolygonModel& model, std::span<const glm::dvec3> points) {
    const std::vector<Side> sides = sides_of(model, points);
    if (sides.empty()) {
        return glm::dmat3(1.0);
    }
    const std::vector<Side> tried = tried_of(sides);
    std::vector<glm::dvec3> directions;
    for (const Side& side : tried) {
        directions.push_back(side.along);
    }
    const glm::dvec3 first = best_of(directions, sides);
    const glm::dvec3 second = best_of(across(first, tried), sides);
    if (second == glm::dvec3(0.0)) {
        return glm::dmat3(1.0); // all on one line
    }
    return {first, second, glm::cross(first, second)};
}

} // namespace octant::models::planar
