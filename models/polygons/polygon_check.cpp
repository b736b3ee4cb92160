#include "models/polygons/polygon_check.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace octant::models::polygons {

namespace {

constexpr double flatness = 1e-4;

/// Area over squared extent below which a polygon is a line.
constexpr double min_area_share = 1e-9;

using Corners = std::span<const glm::dvec3>;

std::vector<glm::dvec3> corners_of(const PolygonModel& model, std::size_t polygon) {
    std::vector<glm::dvec3> corners;
    for (const std::uint32_t vertex : model.corners(polygon)) { corners.push_back(model.vertices_m[vertex]); }
    return corners;
}

std::optional<std::string> repeated_corner(Corners corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            if (corners[i] == corners[j]) {
                return fmt::format("expected corners in different places, got corners {} and {} in one", i + 1, j + 1);
            }
        }
    }
    return std::nullopt;
}

glm::dvec3 double_area_vector(Corners corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return sum;
}

/// The mean of some points.
glm::dvec3 middle_of(Corners corners) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : corners) {
        sum += corner - corners[0]; // far from the origin, no digits are lost
    }
    return corners[0] + sum / static_cast<double>(corners.size());
}

/// The diameter of the sphere about the mean of some points that holds all of them: the same whichever way they are
/// turned, as the box around them is not.
double extent_of(Corners corners) {
    const glm::dvec3 middle = middle_of(corners);
    double farthest_m = 0.0;
    for (const glm::dvec3& corner : corners) { farthest_m = std::max(farthest_m, glm::distance(corner, middle)); }
    return 2.0 * farthest_m;
}

std::optional<std::string> bent(Corners corners, const glm::dvec3& normal, double tolerance_m) {
    const glm::dvec3 middle = middle_of(corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double off_m = std::abs(glm::dot(corners[i] - middle, normal));
        if (off_m > tolerance_m) {
            return fmt::format("expected a planar polygon (within {:.3g} m), got corner {} {:.3g} m off the plane",
                tolerance_m, i + 1, off_m);
        }
    }
    return std::nullopt;
}

/// With every corner on the inner side of every edge's line the outline turns one way, once.
std::optional<std::string> dented(Corners corners, const glm::dvec3& normal, double tolerance_m) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t next = (i + 1) % corners.size();
        const glm::dvec3 inward = glm::cross(normal, glm::normalize(corners[next] - corners[i]));
        for (std::size_t j = 0; j < corners.size(); ++j) {
            const double outside_m = -glm::dot(corners[j] - corners[i], inward);
            if (outside_m > tolerance_m) {
                return fmt::format("expected a convex polygon, got corner {} {:.3g} m outside the edge from "
                                   "corner {} to {}",
                    j + 1, outside_m, i + 1, next + 1);
            }
        }
    }
    return std::nullopt;
}

} // namespace

double flatness_tolerance_m(const PolygonModel& model) {
    return model.vertices_m.empty() ? 0.0 : flatness * extent_of(model.vertices_m);
}

std::optional<std::string> outline_fault(std::span<const glm::dvec3> corners_m) {
    assert(corners_m.size() >= 3);
    if (auto fault = repeated_corner(corners_m)) { return fault; }
    if (is_line(corners_m)) { return "expected a polygon with an area, got corners on one line"; }
    return std::nullopt;
}

bool is_line(std::span<const glm::dvec3> corners_m) {
    const double extent_m = extent_of(corners_m);
    return glm::length(double_area_vector(corners_m)) * 0.5 <= min_area_share * extent_m * extent_m;
}

bool is_planar(std::span<const glm::dvec3> corners_m, double tolerance_m) {
    return !bent(corners_m, glm::normalize(double_area_vector(corners_m)), tolerance_m);
}

std::optional<std::string> corners_fault(std::span<const glm::dvec3> corners_m, double tolerance_m) {
    if (auto fault = outline_fault(corners_m)) { return fault; }
    const glm::dvec3 normal = glm::normalize(double_area_vector(corners_m));
    if (auto fault = bent(corners_m, normal, tolerance_m)) { return fault; }
    return dented(corners_m, normal, tolerance_m);
}

std::optional<std::string> polygon_fault(const PolygonModel& model, std::size_t polygon, double tolerance_m) {
    return corners_fault(corners_of(model, polygon), tolerance_m);
}

} // namespace octant::models::polygons
