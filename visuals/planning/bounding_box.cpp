#include "visuals/planning/bounding_box.h"

#include "sim/base/plane.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace octant::visuals::planning {

void clip_to_front(ViewPolygon& polygon, const Plane& plane, double tolerance_m, ViewPolygon& scratch) {
    bool any_behind = false;
    bool any_in_front = false;
    for (const ViewVertex& corner : polygon) {
        const double height_m = distance_m(plane, corner.at_m);
        any_behind = any_behind || height_m < -tolerance_m;
        any_in_front = any_in_front || height_m > tolerance_m;
    }
    if (!any_in_front) { polygon.clear(); }
    if (!any_in_front || !any_behind) { return; }
    scratch.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const ViewVertex& from = polygon[i];
        const ViewVertex& to = polygon[i + 1 < polygon.size() ? i + 1 : 0];
        const double from_height_m = distance_m(plane, from.at_m);
        const double to_height_m = distance_m(plane, to.at_m);
        if (from_height_m >= 0.0) { scratch.push_back(from); }
        if ((from_height_m >= 0.0) != (to_height_m >= 0.0)) {
            const double share = from_height_m / (from_height_m - to_height_m);
            const bool leaves = from_height_m >= 0.0;
            scratch.push_back({from.at_m + (to.at_m - from.at_m) * share, leaves || from.cut});
        }
    }
    polygon.swap(scratch);
}

void clip_to_cone(ViewPolygon& polygon, std::span<const glm::dvec3> normals, ViewPolygon& scratch) {
    for (const glm::dvec3& normal : normals) {
        clip_to_front(polygon, {normal, 0.0}, 0.0, scratch);
        if (polygon.empty()) { return; }
    }
}

void cone_of(const ViewPolygon& polygon, double widening_rad, std::vector<glm::dvec3>& inward_normals) {
    inward_normals.clear();
    const glm::dvec3 middle_m = middle_of(polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& from_m = polygon[i].at_m;
        const glm::dvec3& to_m = polygon[i + 1 < polygon.size() ? i + 1 : 0].at_m;
        const glm::dvec3 across = glm::cross(from_m, to_m);
        const double size = glm::length(across);
        if (size <= 1e-12 * glm::length(from_m) * glm::length(to_m)) {
            continue; // the corners lie behind each other: no edge on the screen
        }
        const glm::dvec3 inward = across * ((glm::dot(across, middle_m) < 0.0 ? -1.0 : 1.0) / size);
        const glm::dvec3 along = glm::normalize(from_m) + glm::normalize(to_m);
        inward_normals.push_back(glm::normalize(inward + along * (0.5 * widening_rad)));
    }
}

Plane plane_of(const ViewPolygon& polygon) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        sum += glm::cross(polygon[i].at_m - polygon[0].at_m, polygon[i + 1].at_m - polygon[0].at_m);
    }
    const double size = glm::length(sum);
    if (size == 0.0) { return {glm::dvec3(0.0), 0.0}; }
    const glm::dvec3 normal = sum / size;
    return {normal, -glm::dot(normal, middle_of(polygon))};
}

glm::dvec3 middle_of(const ViewPolygon& polygon) {
    glm::dvec3 sum(0.0);
    for (const ViewVertex& corner : polygon) { sum += corner.at_m; }
    return sum / static_cast<double>(std::max<std::size_t>(polygon.size(), 1));
}

double solid_angle_sr(const ViewPolygon& polygon) {
    double sum_sr = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[0].at_m;
        const glm::dvec3& b = polygon[i].at_m;
        const glm::dvec3& c = polygon[i + 1].at_m;
        const double sizes = glm::length(a) * glm::length(b) * glm::length(c);
        sum_sr += sizes > 0.0 ? std::abs(glm::dot(a, glm::cross(b, c))) / (2.0 * sizes) : 0.0;
    }
    return sum_sr;
}

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void widen(AxisAlignedBox& extent, const glm::dvec3& min_m, const glm::dvec3& max_m) {
    extent.min_m = glm::min(extent.min_m, min_m);
    extent.max_m = glm::max(extent.max_m, max_m);
}

glm::dvec3 signs_of(int corner) {
    return {(corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0};
}

/// Calls edge(corner, other corner) for each edge of the outline between the sides of which `seen` says yes and those
/// of which it says no.
template <class Seen, class Edge>
void for_each_outline_edge(const Seen& seen, const Edge& edge) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (int which = 0; which < 4; ++which) {
            const int u_max = which & 1;
            const int v_max = which >> 1;
            if (seen(2 * u + u_max) != seen(2 * v + v_max)) {
                const int corner = (u_max << u) | (v_max << v);
                edge(static_cast<std::size_t>(corner), static_cast<std::size_t>(corner | 1 << axis));
            }
        }
    }
}

/// Half the length of a box's shadow on a unit axis.
double reach_m(const OrientedBox& box, const glm::dvec3& axis) {
    return glm::dot(box.half_m, glm::abs(axis * box.axes));
}

/// Takes out of `pair` what a plane across `axis` between the boxes forbids.
void forbid_across(OcclusionPair& pair, const OrientedBox& a, const OrientedBox& b, const glm::dvec3& axis) {
    const double size = glm::length(axis);
    if (size < 1e-6) {
        return; // of two edges that run alike; other axes serve
    }
    const glm::dvec3 unit = axis / size;
    const double a_m = glm::dot(unit, a.centre_m);
    const double b_m = glm::dot(unit, b.centre_m);
    const double a_reach_m = reach_m(a, unit);
    const double b_reach_m = reach_m(b, unit);
    if (std::abs(b_m - a_m) <= a_reach_m + b_reach_m) { return; }
    pair.intersect = false;
    const double up = b_m > a_m ? 1.0 : -1.0;
    // Along up * unit: a, then b, the eye at zero. An eye below the beginning of b cannot have a hidden by b.
    pair.b_occludes_a = pair.b_occludes_a && up * b_m - b_reach_m < 0.0;
    pair.a_occludes_b = pair.a_occludes_b && up * a_m + a_reach_m > 0.0;
}

bool are_disjoint_on_screen(const ViewCone& cone, const std::array<glm::dvec3, 8>& corners_m) {
    return std::ranges::any_of(cone.planes(), [&](const glm::dvec3& normal) {
        return std::ranges::all_of(
            corners_m, [&](const glm::dvec3& corner_m) { return glm::dot(normal, corner_m) <= 0.0; });
    });
}

} // namespace

AxisAlignedBox rotation_bounds(const models::polygons::Pivot& pivot, const glm::dvec3& point_m) {
    const glm::dvec3 arm_m = point_m - pivot.point_m;
    const glm::dvec3 along_m = pivot.axis * glm::dot(arm_m, pivot.axis);
    const double radius_m = glm::length(arm_m - along_m);
    const glm::dvec3 reach_m = radius_m * glm::sqrt(glm::max(1.0 - pivot.axis * pivot.axis, glm::dvec3(0.0)));
    const glm::dvec3 centre_m = pivot.point_m + along_m;
    return {centre_m - reach_m, centre_m + reach_m};
}

AxisAlignedBox model_bounds(const models::polygons::PolygonModel& model) {
    AxisAlignedBox extent{glm::dvec3(infinite), glm::dvec3(-infinite)};
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const std::optional<std::uint32_t> pivot = models::polygons::pivot_of(model, i);
        for (const std::uint32_t vertex : model.corners(i)) {
            const glm::dvec3& point_m = model.vertices_m[vertex];
            widen(extent, point_m, point_m);
            if (pivot) {
                const AxisAlignedBox circle = rotation_bounds(model.pivots[*pivot], point_m);
                widen(extent, circle.min_m, circle.max_m);
            }
        }
    }
    return model.polygons.empty() ? AxisAlignedBox{} : extent;
}

OrientedBox placed_box(
    const AxisAlignedBox& extent, const glm::dvec3& position_m, const glm::dquat& body_to_world, double margin_m) {
    return {position_m + body_to_world * (0.5 * (extent.min_m + extent.max_m)), glm::mat3_cast(body_to_world),
        0.5 * (extent.max_m - extent.min_m) + margin_m};
}

std::array<glm::dvec3, 8> corners_of(const OrientedBox& box) {
    std::array<glm::dvec3, 8> corners_m;
    for (int corner = 0; corner < 8; ++corner) {
        corners_m[static_cast<std::size_t>(corner)] = box.centre_m + box.axes * (box.half_m * signs_of(corner));
    }
    return corners_m;
}

AxisAlignedBox world_bounds(const OrientedBox& box) {
    glm::dvec3 reach(0.0);
    for (int axis = 0; axis < 3; ++axis) { reach += glm::abs(box.axes[axis]) * box.half_m[axis]; }
    return {box.centre_m - reach, box.centre_m + reach};
}

OrientedBox oriented_box(const AxisAlignedBox& extent) {
    return {0.5 * (extent.min_m + extent.max_m), glm::dmat3(1.0), 0.5 * (extent.max_m - extent.min_m)};
}

double radius_m(const OrientedBox& box) { return glm::length(box.half_m); }

Plane side_of(const OrientedBox& box, int side) {
    const int axis = side / 2;
    const glm::dvec3 normal = box.axes[axis] * (side % 2 == 1 ? 1.0 : -1.0);
    return {normal, -glm::dot(normal, box.centre_m) - box.half_m[axis]};
}

void clip_to_box(ViewPolygon& polygon, const OrientedBox& box, ViewPolygon& scratch) {
    for (int side = 0; side < 6 && !polygon.empty(); ++side) {
        const Plane plane = side_of(box, side);
        clip_to_front(polygon, turned_over(plane), 0.0, scratch);
    }
}

bool contains_eye(const OrientedBox& box) {
    return glm::all(glm::lessThanEqual(glm::abs(box.centre_m * box.axes), box.half_m));
}

ViewCone cone_of(const OrientedBox& box) {
    const std::array<glm::dvec3, 8> corners_m = corners_of(box);
    ViewCone cone;
    for_each_outline_edge([&](int side) { return side_of(box, side).offset_m > 0.0; },
        [&](std::size_t from, std::size_t to) {
            const glm::dvec3 across = glm::cross(corners_m[from], corners_m[to]);
            const double size = glm::length(across);
            if (size > 0.0 && cone.count < 6) {
                const double inward = glm::dot(across, box.centre_m) < 0.0 ? -1.0 : 1.0;
                cone.normals[static_cast<std::size_t>(cone.count++)] = across * (inward / size);
            }
        });
    return cone;
}

LightPrism prism_of(const OrientedBox& box, const glm::dvec3& from) {
    const std::array<glm::dvec3, 8> corners_m = corners_of(box);
    LightPrism prism;
    for_each_outline_edge([&](int side) { return glm::dot(side_of(box, side).normal, from) > 0.0; },
        [&](std::size_t first, std::size_t second) {
            const glm::dvec3 across = glm::cross(corners_m[second] - corners_m[first], from);
            const double size = glm::length(across);
            if (size > 0.0 && prism.count < 6) {
                const double inward = glm::dot(across, box.centre_m - corners_m[first]) < 0.0 ? -1.0 : 1.0;
                const glm::dvec3 normal = across * (inward / size);
                prism.planes[static_cast<std::size_t>(prism.count++)] = {normal, -glm::dot(normal, corners_m[first])};
            }
        });
    return prism;
}

double entry_distance(const OrientedBox& box, const glm::dvec3& ray) {
    const glm::dvec3 along = ray * box.axes;
    const glm::dvec3 eye_m = -(box.centre_m * box.axes);
    double entry = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] != 0.0) {
            const double near_side_m = along[axis] > 0.0 ? -box.half_m[axis] : box.half_m[axis];
            entry = std::max(entry, (near_side_m - eye_m[axis]) / along[axis]);
        }
    }
    return entry;
}

OcclusionPair occlusion_pair(const OrientedBox& a, const OrientedBox& b) {
    OcclusionPair pair{true, true, true};
    for (int i = 0; i < 3; ++i) {
        forbid_across(pair, a, b, a.axes[i]);
        forbid_across(pair, a, b, b.axes[i]);
        for (int k = 0; k < 3; ++k) { forbid_across(pair, a, b, glm::cross(a.axes[i], b.axes[k])); }
    }
    if (!pair.intersect && (pair.a_occludes_b || pair.b_occludes_a) && !contains_eye(a) && !contains_eye(b) &&
        (are_disjoint_on_screen(cone_of(a), corners_of(b)) || are_disjoint_on_screen(cone_of(b), corners_of(a)))) {
        pair.a_occludes_b = false;
        pair.b_occludes_a = false;
    }
    return pair;
}

} // namespace octant::visuals::planning
