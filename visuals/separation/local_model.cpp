#include "visuals/separation/local_model.h"

#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace octant::visuals::separation {

namespace {

using models::polygons::PolygonModel;

/// What is left of the tolerance for the rounding of this code.
constexpr double safe = 0.999;
/// How far a corner may be from a plane that is not quite the polygon's own, in tolerances.
constexpr double share_of_borrowed = 0.25;
constexpr int circle_sides = 24;
/// A model farther from the origin than this is far from it, in sizes.
constexpr double far_sizes = 100.0;

/// Twice the area, along the normal (Newell's sum about the first corner).
glm::dvec3 area_of(const std::vector<glm::dvec3>& corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return sum;
}

Plane through_middle(const glm::dvec3& normal, const std::vector<glm::dvec3>& corners) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners) { middle += corner / static_cast<double>(corners.size()); }
    return {normal, -glm::dot(normal, middle)};
}

bool fits(const LocalPolygon& polygon, const Plane& plane, double tolerance) {
    return glm::dot(area_of(polygon.corners), plane.normal) > 0.0 &&
           std::ranges::all_of(polygon.corners, [&](const glm::dvec3& corner) {
               return std::abs(distance_m(plane, corner)) < share_of_borrowed * tolerance;
           });
}

/// Gives pieces of one polygon the plane of the largest.
void share_planes(const PolygonModel& model, LocalModel& out) {
    std::map<std::uint32_t, std::pair<double, std::size_t>> largest;
    for (std::size_t i = 0; i < out.polygons.size(); ++i) {
        const double area = glm::length(area_of(out.polygons[i].corners));
        auto& known = largest[model.parent_of(i)];
        known = std::max(known, std::pair(area, i));
    }
    for (std::size_t i = 0; i < out.polygons.size(); ++i) {
        const Plane& plane = out.polygons[largest[model.parent_of(i)].second].plane;
        if (fits(out.polygons[i], plane, out.tolerance)) { out.polygons[i].plane = plane; }
    }
}

/// Prepares a polygon that turns about an axis.
void set_turning(const LocalAxis& axis, double tolerance, LocalPolygon& polygon) {
    const double facing = glm::dot(polygon.plane.normal, axis.along);
    const Plane across = through_middle(facing > 0.0 ? axis.along : -axis.along, polygon.corners);
    polygon.keeps_plane = fits(polygon, across, tolerance);
    if (polygon.keeps_plane) { polygon.plane = across; }
    const glm::dvec3 aside = std::abs(axis.along.x) > 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, axis.along));
    const glm::dvec3 up = glm::cross(axis.along, right);
    polygon.swept.clear();
    for (const glm::dvec3& corner : polygon.corners) {
        const double height = glm::dot(corner - axis.point, axis.along);
        const glm::dvec3 foot = axis.point + axis.along * height;
        const double reach = glm::distance(corner, foot) / std::cos(pi / circle_sides);
        for (int side = 0; side < circle_sides; ++side) {
            const double angle_rad = 2.0 * pi * side / circle_sides;
            polygon.swept.push_back(foot + (right * std::cos(angle_rad) + up * std::sin(angle_rad)) * reach);
        }
    }
}

/// The height over a plane of the highest point on the circle of a corner.
double highest(const Plane& plane, const LocalAxis& axis, const glm::dvec3& corner) {
    const glm::dvec3 foot = axis.point + axis.along * glm::dot(corner - axis.point, axis.along);
    const glm::dvec3 across = plane.normal - axis.along * glm::dot(plane.normal, axis.along);
    return distance_m(plane, foot) + glm::distance(corner, foot) * glm::length(across);
}

} // namespace

// In long double, so that a model far from its origin loses no digits.
Plane LocalModel::from_file(const Plane& plane_m) const {
    long double offset = plane_m.offset_m;
    for (int i = 0; i < 3; ++i) { offset += static_cast<long double>(plane_m.normal[i]) * middle_m[i]; }
    return {plane_m.normal, static_cast<double>(offset / size_m)};
}

Plane LocalModel::about(const Plane& plane_m) const {
    long double offset = plane_m.offset_m;
    for (int i = 0; i < 3; ++i) { offset += static_cast<long double>(plane_m.normal[i]) * reference_m[i]; }
    return {plane_m.normal, static_cast<double>(offset)};
}

Plane LocalModel::in_metres(const Plane& plane) const {
    long double offset = static_cast<long double>(plane.offset_m) * size_m;
    const glm::dvec3 to_middle_m = middle_m - reference_m;
    for (int i = 0; i < 3; ++i) { offset -= static_cast<long double>(plane.normal[i]) * to_middle_m[i]; }
    return {plane.normal, static_cast<double>(offset)};
}

LocalModel local_model(const PolygonModel& model, const models::polygons::FileAxes& axes, double tolerance) {
    LocalModel out;
    out.tolerance = tolerance;
    const auto corner = [&](std::uint32_t vertex) { return axes.file_from_body(model.vertices_m[vertex]); };
    glm::dvec3 least = corner(model.corner_vertices.front());
    glm::dvec3 most = least;
    for (const std::uint32_t vertex : model.corner_vertices) {
        least = glm::min(least, corner(vertex));
        most = glm::max(most, corner(vertex));
    }
    const glm::dvec3 box = most - least;
    out.middle_m = least + box * 0.5;
    out.size_m = std::max({box.x, box.y, box.z});
    if (glm::length(out.middle_m) > far_sizes * out.size_m) { out.reference_m = out.middle_m; }
    const auto local = [&](const glm::dvec3& point_m) {
        return (axes.file_from_body(point_m) - out.middle_m) / out.size_m;
    };
    for (const models::polygons::Pivot& pivot : model.pivots) {
        out.axes.push_back({local(pivot.point_m), axes.file_from_body(pivot.axis)});
    }
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        LocalPolygon& polygon = out.polygons.emplace_back();
        for (const std::uint32_t vertex : model.corners(i)) {
            polygon.corners.push_back(local(model.vertices_m[vertex]));
        }
        polygon.plane = through_middle(glm::normalize(area_of(polygon.corners)), polygon.corners);
        polygon.swept = polygon.corners;
        polygon.axis = models::polygons::pivot_of(model, i);
    }
    share_planes(model, out);
    for (LocalPolygon& polygon : out.polygons) {
        if (polygon.axis) { set_turning(out.axes[*polygon.axis], tolerance, polygon); }
    }
    return out;
}

bool is_behind(const LocalModel& model, std::uint32_t number, const Plane& plane, bool turns) {
    const LocalPolygon& polygon = model.polygons[number];
    const glm::dvec3 size = glm::abs(plane.normal);
    const double limit = safe * model.tolerance * std::max({size.x, size.y, size.z});
    return std::ranges::all_of(polygon.corners, [&](const glm::dvec3& corner) {
        const double height =
            turns && polygon.axis ? highest(plane, model.axes[*polygon.axis], corner) : distance_m(plane, corner);
        return height <= limit;
    });
}

} // namespace octant::visuals::separation
