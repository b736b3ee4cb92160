#pragma once

#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::shading {

/// Where light is worked out: corners of smooth polygons that would look the same share one.
struct LitPoint {
    glm::vec3 place_m{0.0F};
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    float colour_sum = 2.1F; ///< red + green + blue of the surface there
};

/// What selection asks of a polygon.
struct ShadedPolygon {
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    glm::vec3 centre_m{0.0F}; ///< of its area
    float perimeter_m = 0.0F;
    float area_m2 = 0.0F;
    float colour_sum = 2.1F;        ///< red + green + blue, mean of its corners
    std::uint32_t first_corner = 0; ///< in ShadedPolygons::corner_points and fan_m2
    std::uint32_t corner_count = 3;
};

/// A model as selection sees it, in the model's own axes (body axes of an aircraft, turning parts
/// where the file shows them). Made once when a model is loaded; both rules share it.
struct ShadedPolygons {
    std::vector<ShadedPolygon> polygons;      ///< as many as the model's, in their order
    std::vector<std::uint32_t> corner_points; ///< indices into `points`, polygon after polygon
    /// A corner: area of the triangle that the polygon's first corner makes with it and the next
    /// one, 0 for its first and its last corner.
    std::vector<float> fan_m2;
    std::vector<LitPoint> points;
    glm::vec3 centre_m{0.0F}; ///< middle of the box around `points`
    float radius_m = 0.0F;    ///< of the sphere around centre_m that holds them
    double mean_perimeter_m = 0.0;

    std::size_t size() const { return polygons.size(); }
};

/// `corner_normals`: one a corner, as vertex_normals.h makes them. Colours are those of materials;
/// of a mesh those of vertices where it has any, grey 0.7 where it has neither.
ShadedPolygons shaded_polygons(
    const models::polygons::PolygonModel& model, std::span<const glm::vec3> corner_normals);
ShadedPolygons
shaded_polygons(const models::TriangleMesh& mesh, std::span<const glm::vec3> corner_normals);

} // namespace octant::visuals::shading
