#include "models/polygons/mesh_polygons.h"

#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <map>

namespace octant::models::polygons {

namespace {

std::array<int, 3> step_of(const glm::vec3& colour) {
    constexpr float steps = 31.0F;
    return {static_cast<int>(colour.x * steps + 0.5F), static_cast<int>(colour.y * steps + 0.5F),
        static_cast<int>(colour.z * steps + 0.5F)};
}

} // namespace

PolygonModel polygons_from_mesh(const TriangleMesh& mesh) {
    PolygonModel model;
    model.name = mesh.name;
    model.vertices_m = mesh.vertices_m;
    model.parts = {"default"};
    std::map<std::array<int, 3>, std::uint32_t> materials;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::vec3 colour = mean_colour(mesh, t);
        const auto [place, is_new] =
            materials.try_emplace(step_of(colour), static_cast<std::uint32_t>(model.materials.size()));
        if (is_new) { model.materials.push_back({fmt::format("colour-{}", place->second + 1), colour}); }
        const auto first = static_cast<std::uint32_t>(model.corner_vertices.size());
        model.corner_vertices.insert(model.corner_vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
        model.polygons.push_back({first, 3, place->second, 0});
    }
    return model;
}

TriangleMesh mesh_from_polygons(const PolygonModel& polygons) {
    TriangleMesh mesh;
    mesh.name = polygons.name;
    mesh.vertices_m = polygons.vertices_m;
    for (std::size_t p = 0; p < polygons.polygons.size(); ++p) {
        const auto corners = polygons.corners(p);
        for (std::size_t k = 2; k < corners.size(); ++k) {
            mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
        }
    }
    return mesh;
}

} // namespace octant::models::polygons
