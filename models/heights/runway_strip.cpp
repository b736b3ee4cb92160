#include "models/heights/runway_strip.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace octant::models::heights {

glm::dvec2 RunwayStrip::along() const { return {std::sin(heading_rad), std::cos(heading_rad)}; }

glm::dvec2 RunwayStrip::left() const { return {-std::cos(heading_rad), std::sin(heading_rad)}; }

glm::dvec2 RunwayStrip::strip_from_world(const glm::dvec2& place_m) const {
    const glm::dvec2 from_begin_m = place_m - begin_m;
    return {glm::dot(from_begin_m, along()), glm::dot(from_begin_m, left())};
}

glm::dvec2 RunwayStrip::place(const glm::dvec2& along_left_m) const {
    return begin_m + along() * along_left_m.x + left() * along_left_m.y;
}

double RunwayStrip::distance_m(const glm::dvec2& place_m) const {
    const glm::dvec2 at_m = strip_from_world(place_m);
    const double beyond_m = std::max({-at_m.x, at_m.x - length_m, 0.0});
    const double beside_m = std::max(std::abs(at_m.y) - 0.5 * width_m, 0.0);
    return std::hypot(beyond_m, beside_m);
}

double RunwayStrip::plane_m(const glm::dvec2& place_m) const {
    return height_m + rise * glm::dot(place_m - begin_m, along());
}

SampleBox samples_around(const RunwayStrip& strip, const HeightField& field, double reach_m) {
    glm::dvec2 least = strip.begin_m;
    glm::dvec2 most = strip.begin_m;
    for (const double along_m : {0.0, strip.length_m}) {
        for (const double left_m : {-0.5 * strip.width_m, 0.5 * strip.width_m}) {
            const glm::dvec2 corner = strip.place({along_m, left_m});
            least = glm::min(least, corner);
            most = glm::max(most, corner);
        }
    }
    const glm::dvec2 last(field.columns() - 1, field.rows() - 1);
    const auto sample_at = [&](const glm::dvec2& at_m) {
        return glm::clamp((at_m + field.half_extent_m()) / field.spacing_m(), glm::dvec2(0.0), last);
    };
    return {glm::ivec2(glm::floor(sample_at(least - reach_m))), glm::ivec2(glm::ceil(sample_at(most + reach_m)))};
}

namespace {

/// Up to here from the runway all samples lie in its plane. Of a cell whose nearest point is levelled the farthest
/// corner is a diagonal away.
double level_m(double spacing_m) { return level_margin_m + std::sqrt(2.0) * spacing_m; }

} // namespace

double reach_m(const HeightField& field) { return level_m(field.spacing_m()) + side_slope_end_m; }

double levelled_m(const RunwayStrip& strip, double spacing_m, const glm::dvec2& place_m, double own_m) {
    const double beyond_m = std::max(strip.distance_m(place_m) - level_m(spacing_m), 0.0);
    if (beyond_m >= side_slope_end_m) { return own_m; }
    const double plane_m = strip.plane_m(place_m);
    const double side_m = side_slope * beyond_m;
    const double graded_m = std::clamp(own_m, plane_m - side_m, plane_m + side_m);
    return glm::mix(graded_m, own_m, glm::smoothstep(0.5 * side_slope_end_m, side_slope_end_m, beyond_m));
}

HeightField levelled(const HeightField& field, const RunwayStrip& strip) {
    const auto columns = static_cast<std::size_t>(field.columns());
    std::vector<float> heights_m;
    heights_m.reserve(columns * static_cast<std::size_t>(field.rows()));
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) { heights_m.push_back(field.height_m(column, row)); }
    }
    const SampleBox box = samples_around(strip, field, reach_m(field));
    for (int row = box.first.y; row <= box.last.y; ++row) {
        for (int column = box.first.x; column <= box.last.x; ++column) {
            float& height_m = heights_m[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
            height_m = static_cast<float>(levelled_m(
                strip, field.spacing_m(), glm::dvec2(field.sample_m(column, row)), static_cast<double>(height_m)));
        }
    }
    HeightField level(field.columns(), field.rows(), field.spacing_m(), std::move(heights_m));
    level.name = field.name;
    level.place = field.place;
    level.system = field.system;
    level.filled_voids = field.filled_voids;
    return level;
}

} // namespace octant::models::heights
