#pragma once

#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::shading {

/// A point at which light is computed. Corners of smooth polygons with the same position, normal and colour share one,
/// so that each is lit once.
struct ShadingPoint {
    glm::vec3 place_m{0.0F};
    glm::vec3 normal{0.0F, 0.0F, 1.0F}; ///< A unit vector.
    float colour_sum = 2.1F;            ///< red + green + blue of the surface there
};

/// What the selection of smooth polygons must know of one polygon. Lengths are in metres.
struct ShadedPolygon {
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    glm::vec3 centre_m{0.0F}; ///< The centroid of its area.
    float perimeter_m = 0.0F;
    float area_m2 = 0.0F;
    float colour_sum = 2.1F; ///< Red + green + blue, the mean over its corners.
    /// The index of its first corner in ShadedPolygons::corner_points and fan_m2.
    std::uint32_t first_corner = 0;
    std::uint32_t corner_count = 3;
};

/// A model as the selection sees it, in the model's own axes (body axes of an aircraft; turning parts such as rotors at
/// the angle that the file shows). It is made once when a model is loaded and shared by both rules and all aircraft of
/// that model.
struct ShadedPolygons {
    std::vector<ShadedPolygon> polygons; ///< As many as the model has, in the same order.
    /// For each corner its index into `points`, polygon after polygon.
    std::vector<std::uint32_t> corner_points;
    /// For each corner the area of the triangle that it forms with the next corner and the polygon's first corner; 0
    /// for the first and the last corner of a polygon. These triangles are the polygon's triangle fan.
    std::vector<float> fan_m2;
    std::vector<ShadingPoint> points;
    glm::vec3 centre_m{0.0F}; ///< The centre of the bounding box of `points`.
    float radius_m = 0.0F;    ///< The radius of the sphere about centre_m that holds all points.
    /// The mean over all polygons: the paper's threshold between small and large.
    double mean_perimeter_m = 0.0;

    std::size_t size() const { return polygons.size(); }
};

/// Prepares a model or a mesh for selection. `corner_normals` has one unit normal for each corner (asserted), as
/// vertex_normals.h makes them. Colours are those of the materials; a mesh with vertex colours takes these, and one
/// without either is grey (0.7 of each part).
ShadedPolygons shaded_polygons(const models::polygons::PolygonModel& model, std::span<const glm::vec3> corner_normals);
ShadedPolygons shaded_polygons(const models::TriangleMesh& mesh, std::span<const glm::vec3> corner_normals);

} // namespace octant::visuals::shading
