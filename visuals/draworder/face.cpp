// Outlines for the hiding test. Polygons of a model share edges, and rounding would let them overlap a little and seem
// to hide one another; shrinking each outline by an inset that is larger than the rounding prevents that.
#include "visuals/draworder/face.h"

#include "models/polygons/polygon_outlines.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::visuals::draworder {

namespace {

/// At sharper corners the offset is limited, because they would move out of the polygon.
constexpr double sharpest = 0.01;

/// The unit normal of an edge that points into a counter-clockwise outline.
glm::dvec2 inward_of(const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 along = to - from;
    const double length = glm::length(along);
    return length > 0.0 ? glm::dvec2(-along.y, along.x) / length : glm::dvec2(0.0);
}

/// The outline with every edge moved inwards.
std::vector<glm::dvec2> drawn_in(const std::vector<glm::dvec2>& outline, double inset) {
    glm::dvec2 middle(0.0);
    for (const glm::dvec2& corner : outline) { middle += corner / static_cast<double>(outline.size()); }
    double nearest = std::numeric_limits<double>::max();
    for (const glm::dvec2& corner : outline) { nearest = std::min(nearest, glm::distance(corner, middle)); }
    const double step = std::min(inset, nearest / 5.0);
    std::vector<glm::dvec2> inner;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t count = outline.size();
        const glm::dvec2 before = inward_of(outline[(i + count - 1) % count], outline[i]);
        const glm::dvec2 after = inward_of(outline[i], outline[(i + 1) % count]);
        const double share = std::max(1.0 + glm::dot(before, after), sharpest);
        inner.push_back(outline[i] + (before + after) * (step / share));
    }
    return inner;
}

} // namespace

Face outline_face(std::span<const glm::dvec3> corners, const Plane& plane, double inset) {
    Face face;
    face.plane = plane;
    face.outline.assign(corners.begin(), corners.end());
    const bool along_x = std::abs(plane.normal.x) > 0.7;
    const glm::dvec3 aside = along_x ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    face.right = glm::normalize(glm::cross(aside, plane.normal));
    face.up = glm::cross(plane.normal, face.right);
    std::vector<glm::dvec2> outline;
    for (const glm::dvec3& corner : corners) {
        outline.emplace_back(glm::dot(corner, face.right), glm::dot(corner, face.up));
    }
    face.flat = drawn_in(outline, inset);
    for (const glm::dvec2& corner : face.flat) {
        face.corners.push_back(face.right * corner.x + face.up * corner.y - plane.normal * plane.offset_m);
    }
    for (std::size_t i = 0; i < face.flat.size(); ++i) {
        face.edge_directions.push_back(glm::normalize(face.flat[(i + 1) % face.flat.size()] - face.flat[i]));
    }
    return face;
}

bool behind_or_on(const Face& face, const Plane& plane, double on_plane) {
    return std::ranges::all_of(
        face.corners, [&](const glm::dvec3& corner) { return distance_m(plane, corner) <= on_plane; });
}

std::vector<glm::dvec3> front_part(const std::vector<glm::dvec3>& outline, const Plane& plane, double on_plane) {
    const auto height_of = [&](const glm::dvec3& corner) {
        const double height = distance_m(plane, corner);
        return std::abs(height) <= on_plane ? 0.0 : height;
    };
    std::vector<glm::dvec3> part;
    glm::dvec3 last = outline.back();
    double last_height = height_of(last);
    for (const glm::dvec3& corner : outline) {
        const double height = height_of(corner);
        if (height * last_height < 0.0) {
            part.push_back(last + (corner - last) * (last_height / (last_height - height)));
        }
        if (height >= 0.0) { part.push_back(corner); }
        last = corner;
        last_height = height;
    }
    return part;
}

bool overlap_in_plane(const Face& a, const Face& b, double on_plane) {
    const bool one_plane = a.plane && b.plane && !a.pivot && !b.pivot &&
                           glm::dot(a.plane->normal, b.plane->normal) > 0.0 && behind_or_on(a, *b.plane, on_plane) &&
                           behind_or_on(b, *a.plane, on_plane) &&
                           behind_or_on(a, {-b.plane->normal, -b.plane->offset_m}, on_plane);
    const auto parts = [](const Face& of, const Face& other) {
        return models::polygons::has_separating_edge(of.corners, of.plane->normal, other.corners, 0.0);
    };
    return one_plane && !parts(a, b) && !parts(b, a);
}

} // namespace octant::visuals::draworder
