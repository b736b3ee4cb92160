#include "tests/fuzz/formats/samples.h"

#include "models/meshfile/mesh_file.h"
#include "models/repair/repair.h"
#include "tests/fuzz/formats/target.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::tests::formats {

namespace {

void expect_below(const std::vector<models::Triangle>& triples, std::size_t count) {
    for (const models::Triangle& triple : triples) {
        for (const std::uint32_t index : triple) { expect(index < count, "indices below " + std::to_string(count)); }
    }
}

void check_lists(const models::TriangleMesh& mesh) {
    const auto is_finite = [](const glm::dvec3& place_m) {
        return std::isfinite(place_m.x) && std::isfinite(place_m.y) && std::isfinite(place_m.z);
    };
    expect(!mesh.triangles.empty(), "triangles");
    expect(std::ranges::all_of(mesh.vertices_m, is_finite), "finite places");
    expect(mesh.colours.empty() || mesh.colours.size() == mesh.vertices_m.size(), "a colour a vertex");
    expect_below(mesh.triangles, mesh.vertices_m.size());
    expect_below(mesh.corner_normals, mesh.normals.size());
    const std::size_t triangles = mesh.triangles.size();
    expect(mesh.corner_normals.size() == (mesh.normals.empty() ? 0 : triangles), "normals");
    expect(mesh.triangle_materials.size() == (mesh.materials.empty() ? 0 : triangles), "materials");
    for (const std::uint32_t material : mesh.triangle_materials) {
        expect(material < mesh.materials.size(), "materials that are there");
    }
}

} // namespace

void use_mesh(const models::TriangleMesh& mesh) {
    check_lists(mesh);
    const models::TriangleMesh mended = models::repair::repaired(mesh).mesh;
    if (!mended.triangles.empty()) { check_lists(mended); }
}

models::TriangleMesh sample_cube() {
    models::TriangleMesh mesh;
    mesh.name = "cube";
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place_m(corner & 1, corner >> 1 & 1, corner >> 2);
        mesh.vertices_m.push_back(place_m);
        mesh.colours.push_back(glm::vec3(place_m));
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2},
        {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    mesh.normals = {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
    mesh.materials = {{"grey", {0.5F, 0.5F, 0.5F}}, {"red", {1.0F, 0.0F, 0.0F}}};
    for (std::uint32_t triangle = 0; triangle < 12; ++triangle) {
        mesh.corner_normals.push_back({triangle / 2, triangle / 2, triangle / 2});
        mesh.triangle_materials.push_back(triangle < 6 ? 0 : 1);
    }
    return mesh;
}

models::TriangleMesh sample_tetrahedron() {
    models::TriangleMesh mesh;
    mesh.name = "tetrahedron";
    mesh.vertices_m = {{0, 0, 0}, {1.1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

std::vector<std::string> mesh_seeds(const std::string& ending) {
    std::vector<std::string> seeds;
    for (const models::TriangleMesh& mesh : {sample_cube(), sample_tetrahedron()}) {
        seeds.push_back(bytes_written(
            "seed" + ending, [&](const std::filesystem::path& file) { models::meshfile::write_mesh(file, mesh); }));
    }
    return seeds;
}

models::polygons::PolygonModel small_model() {
    models::polygons::PolygonModel model;
    model.name = "box and wall";
    for (int corner = 0; corner < 8; ++corner) {
        model.vertices_m.emplace_back(corner & 1, corner >> 1 & 1, corner >> 2);
    }
    for (const auto& [y, z] : {std::pair(-1, -1), std::pair(2, -1), std::pair(2, 2), std::pair(-1, 2)}) {
        model.vertices_m.emplace_back(3, y, z);
    }
    model.corner_vertices = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5, 8, 9, 10, 11};
    for (std::uint32_t polygon = 0; polygon < 7; ++polygon) {
        model.polygons.push_back({4 * polygon, 4, 0, polygon == 6 ? 1U : 0U});
    }
    model.materials = {{"grey", {0.5F, 0.5F, 0.5F}}};
    model.parts = {"box", "wall"};
    return model;
}

std::vector<glm::dvec3> some_eyes() {
    std::vector<glm::dvec3> eyes_m{{0.5, 0.5, 0.5}, {0.0, 0.0, 0.0}, {1e9, -1e9, 3.0}};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(
            (corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0);
        eyes_m.push_back(sign * glm::dvec3(5.0, 6.0, 7.0));
        eyes_m.push_back(sign * glm::dvec3(0.9, 1.1, 0.3));
    }
    return eyes_m;
}

} // namespace octant::tests::formats
