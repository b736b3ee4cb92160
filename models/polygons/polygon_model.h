#pragma once

#include "models/material.h"
#include "models/triangle_mesh.h"
#include "sim/base/plane.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::models::polygons {

/// A convex planar polygon, visible from its front side only, where its corners run counter-clockwise. Its corners are
/// a range of PolygonModel::corner_vertices.
struct Polygon {
    std::uint32_t first_corner = 0;
    std::uint32_t corner_count = 0; ///< at least 3
    std::uint32_t material = 0;     ///< index into PolygonModel::materials
    std::uint32_t part = 0;         ///< index into PolygonModel::parts
};

/// The axis of a part that rotates: a rotor or a propeller.
struct Pivot {
    std::uint32_t part = 0;  ///< index into PolygonModel::parts
    glm::dvec3 point_m{0.0}; ///< a point of the axis, body axes
    /// Unit vector along the axis, body axes; positive turns follow the right-hand rule.
    glm::dvec3 axis{0.0, 0.0, 1.0};
    double turns_per_s = 0.0; ///< in flight; the vertices are at angle 0
};

/// A model of convex polygons in body axes: x forward, y right, z down, metres.
struct PolygonModel {
    std::string name;
    std::vector<glm::dvec3> vertices_m;
    std::vector<std::uint32_t> corner_vertices; ///< indices into vertices_m, polygon after polygon
    /// One for each of corner_vertices, or none: u to the right and v up from a picture's lower left corner. Not
    /// numbers (NaN) at all corners of a polygon that has none. Pieces that painting orders cut have none either: they
    /// take them from the whole polygons (visuals/shading).
    std::vector<glm::vec2> corner_texture_coordinates;
    /// One for each of corner_vertices, or none: unit normals that the file gives; zero where it gives none. Pieces
    /// that painting orders cut have none: they take them from the whole polygons (visuals/shading).
    std::vector<glm::vec3> corner_normals;
    std::vector<Polygon> polygons;   ///< in file order
    std::vector<Material> materials; ///< at least one
    std::vector<std::string> parts;  ///< OBJ groups in file order, at least one
    std::vector<Pivot> pivots;       ///< at most one for each part
    /// For each polygon the index of the file's polygon of which it is a piece; empty where none was cut.
    std::vector<std::uint32_t> parents;
    std::vector<std::string> notes; ///< what the reader guessed or left out, each "file:line: ..."

    std::uint32_t parent_of(std::size_t polygon) const {
        return parents.empty() ? static_cast<std::uint32_t>(polygon) : parents[polygon];
    }

    /// Vertex indices of one polygon.
    std::span<const std::uint32_t> corners(std::size_t polygon) const {
        const Polygon& p = polygons[polygon];
        return std::span(corner_vertices).subspan(p.first_corner, p.corner_count);
    }
};

/// Unit normal of a polygon towards its front side, by Newell's method.
glm::dvec3 normal_of(const PolygonModel& model, std::size_t polygon);

/// The plane of a polygon through the mean of its corners; its front is the polygon's front.
Plane plane_of(const PolygonModel& model, std::size_t polygon);

/// Index into PolygonModel::pivots of the pivot that rotates a polygon; nothing for a fixed polygon.
std::optional<std::uint32_t> pivot_of(const PolygonModel& model, std::size_t polygon);

/// The position of a point of a rotating part (body axes, given at angle 0) after a rotation by `angle_rad`.
glm::dvec3 turned(const Pivot& pivot, const glm::dvec3& point_m, double angle_rad);

/// Radius of the smallest sphere around the origin that contains all vertices, metres.
double radius_m(const PolygonModel& model);

/// Converts each triangle of a mesh to a polygon. The model has one part, and one material for all colours that differ
/// by less than 1/31, for each opacity.
PolygonModel polygons_from_mesh(const TriangleMesh& mesh);

/// Appends the polygons, vertices and materials of a model without pivots to a part of another one.
void append_polygons(PolygonModel& to, const PolygonModel& from, std::uint32_t part);

/// Cuts the polygons into triangle fans without colours, for the measurement of distances.
TriangleMesh mesh_from_polygons(const PolygonModel& polygons);

/// Returns the indices of a model's polygons, ascending, without those that a later polygon repeats: the same corner
/// positions, the same front side and the same pivot. Of two equal polygons the later one in the file must be visible.
/// A depth buffer cannot decide between them, so the earlier one must not be drawn.
std::vector<std::uint32_t> distinct_polygons(const PolygonModel& model);

/// Returns the distance, metres, that a corner may have from its polygon's plane or from an edge's line before the
/// polygon counts as bent or concave: 1e-4 of the diameter of the sphere about the mean of all vertices that contains
/// them. Rotations do not change it. Files with four digits stay within it; a larger error would be visible.
double flatness_tolerance_m(const PolygonModel& model);

/// Returns the first fault of a polygon as "expected ..., got ..."; nothing for a valid polygon. Checks in this order:
/// two corners at one position, no area, corners off the plane of Newell's normal through their mean, corners outside
/// the line of an edge (concave polygons and stars). Corners inside a straight side are allowed. The polygon must have
/// at least 3 corners, all finite. Messages number the corners from 1.
std::optional<std::string> polygon_fault(const PolygonModel& model, std::size_t polygon, double tolerance_m);

/// As polygon_fault, for a polygon given by its corners.
std::optional<std::string> corners_fault(std::span<const glm::dvec3> corners_m, double tolerance_m);

/// Returns the fault of corners that cannot be cut into convex planar pieces: two corners at one position, or no area.
std::optional<std::string> outline_fault(std::span<const glm::dvec3> corners_m);

/// True when all corners lie on one line or at one position.
bool is_line(std::span<const glm::dvec3> corners_m);

/// True when all corners lie on the plane of Newell's normal through their mean.
bool is_planar(std::span<const glm::dvec3> corners_m, double tolerance_m);

} // namespace octant::models::polygons
