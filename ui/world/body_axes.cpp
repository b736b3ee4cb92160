#include "ui/world/body_axes.h"

#include "models/measure/mesh_distance.h"
#include "models/polygons/mesh_polygons.h"
#include "models/repair/repair.h"
#include "models/simplify/simplify.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::world {

namespace {

using models::meshfile::RotatingPart;
using models::polygons::Polygon;
using models::polygons::PolygonModel;

/// Triangles of all parts together, and of one at least.
constexpr std::size_t far_faces_of_parts = 120;
constexpr std::size_t min_far_faces = 12;
constexpr std::size_t far_faces_of_transparent = 60;

void append(PolygonModel& to, const PolygonModel& from, std::uint32_t part) {
    const auto first_vertex = static_cast<std::uint32_t>(to.vertices_m.size());
    const auto first_corner = static_cast<std::uint32_t>(to.corner_vertices.size());
    const auto first_material = static_cast<std::uint32_t>(to.materials.size());
    to.vertices_m.insert(to.vertices_m.end(), from.vertices_m.begin(), from.vertices_m.end());
    to.materials.insert(to.materials.end(), from.materials.begin(), from.materials.end());
    for (const std::uint32_t vertex : from.corner_vertices) {
        to.corner_vertices.push_back(first_vertex + vertex);
    }
    for (Polygon polygon : from.polygons) {
        polygon.first_corner += first_corner;
        polygon.material += first_material;
        polygon.part = part;
        to.polygons.push_back(polygon);
    }
}

/// Adds a mesh to a part, simplified to so many triangles. Returns their certified distance.
double append_far(
    const models::TriangleMesh& mesh, std::size_t faces, std::uint32_t part, PolygonModel& to) {
    const models::TriangleMesh whole = models::repair::repaired(mesh).mesh;
    if (whole.triangles.empty()) {
        return 0.0;
    }
    models::simplify::SimplifyOptions options;
    options.goal.faces = faces;
    const models::TriangleMesh far = models::simplify::simplified(whole, options).mesh;
    append(to, models::polygons::polygons_from_mesh(far), part);
    models::measure::DistanceOptions loosely;
    loosely.tightness = 1.4;
    loosely.samples = 0;
    return models::measure::distance(whole, far, loosely).max_hausdorff_m();
}

} // namespace

void rotate_mesh_to_body(models::TriangleMesh& mesh, const models::polygons::FileAxes& axes) {
    for (glm::dvec3& vertex_m : mesh.vertices_m) {
        vertex_m = axes.body_from_file(vertex_m);
    }
    for (glm::vec3& normal : mesh.normals) {
        normal = glm::vec3(axes.body_from_file(glm::dvec3(normal)));
    }
}

void rotate_part_to_body(RotatingPart& part, const models::polygons::FileAxes& axes) {
    rotate_mesh_to_body(part.mesh, axes);
    part.about.point_m = axes.body_from_file(part.about.point_m);
    part.about.direction = axes.body_from_file(part.about.direction);
}

double add_far_parts(std::span<const RotatingPart> parts, PolygonModel& polygons) {
    double error_m = 0.0;
    for (const RotatingPart& part : parts) {
        const auto number = static_cast<std::uint32_t>(polygons.parts.size());
        polygons.parts.push_back(fmt::format("turning-{}", number));
        polygons.pivots.push_back(
            {number, part.about.point_m, part.about.direction, part.about.turns_per_s});
        const std::size_t faces = std::max(min_far_faces, far_faces_of_parts / parts.size());
        error_m = std::max(error_m, append_far(part.mesh, faces, number, polygons));
    }
    return error_m;
}

double add_far_transparent(const models::TriangleMesh& mesh, PolygonModel& polygons) {
    return append_far(mesh, far_faces_of_transparent, 0, polygons);
}

} // namespace octant::ui::world
