#pragma once

#include "models/material.h"
#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::models::polygons {

/// A convex planar polygon seen from its front side only: its corners run counter-clockwise seen from there. `corners`
/// is a range of PolygonModel::corner_vertices.
struct Polygon {
    std::uint32_t first_corner = 0;
    std::uint32_t corner_count = 0; ///< at least 3
    std::uint32_t material = 0;     ///< index into PolygonModel::materials
    std::uint32_t part = 0;         ///< index into PolygonModel::parts
};

/// A part that turns about an axis of its own: a rotor, a propeller.
struct Pivot {
    std::uint32_t part = 0;  ///< index into PolygonModel::parts
    glm::dvec3 point_m{0.0}; ///< a point of the axis, body axes
    /// Unit vector along the axis, body axes; positive turns follow the right-hand rule.
    glm::dvec3 axis{0.0, 0.0, 1.0};
    double turns_per_s = 0.0; ///< how fast it turns in flight; the file shows it at angle 0
};

/// A polygon model with its n-gons kept, in body axes: x forward, y right, z down, metres.
struct PolygonModel {
    std::string name;
    std::vector<glm::dvec3> vertices_m;
    std::vector<std::uint32_t> corner_vertices; ///< indices into vertices_m, polygon after polygon
    std::vector<Polygon> polygons;              ///< in file order
    std::vector<Material> materials;            ///< at least one
    std::vector<std::string> parts;             ///< OBJ groups in file order, at least one
    std::vector<Pivot> pivots;                  ///< at most one for each part
    /// Polygon of the file of which each polygon is a piece; empty: each is whole.
    std::vector<std::uint32_t> parents;
    std::vector<std::string> notes; ///< what its file lacks, each "file:line: ..."; often none

    std::uint32_t parent_of(std::size_t polygon) const {
        return parents.empty() ? static_cast<std::uint32_t>(polygon) : parents[polygon];
    }

    /// Vertex indices of one polygon.
    std::span<const std::uint32_t> corners(std::size_t polygon) const {
        const Polygon& p = polygons[polygon];
        return std::span(corner_vertices).subspan(p.first_corner, p.corner_count);
    }
};

/// Unit normal of a polygon, pointing to the side from which it is seen (Newell's sum, so that no single corner
/// decides).
glm::dvec3 normal_of(const PolygonModel& model, std::size_t polygon);

/// The plane of a polygon through the middle of its corners; its front is where it is seen from.
Plane plane_of(const PolygonModel& model, std::size_t polygon);

/// Index into PolygonModel::pivots of the pivot that turns a polygon; nothing for a fixed one.
std::optional<std::uint32_t> pivot_of(const PolygonModel& model, std::size_t polygon);

/// Where a point (body axes, file position) of a part lies once the part has turned.
glm::dvec3 turned(const Pivot& pivot, const glm::dvec3& point_m, double angle_rad);

/// Radius of the smallest sphere around the origin that holds all vertices, metres.
double radius_m(const PolygonModel& model);

} // namespace octant::models::polygons
