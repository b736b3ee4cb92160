#include "tests/fuzz/formats/samples.h"

#include "models/meshfile/mesh_file.h"
#include "models/repair/repair.h"
#include "tests/fuzz/formats/target.h"
#include "tests/sample_meshes.h"

#include <utility>

namespace octant::tests::formats {

void use_mesh(const models::TriangleMesh& mesh) {
    expect(!mesh.triangles.empty(), "triangles");
    expect(index_fault(mesh).empty(), "a sound mesh, got: " + index_fault(mesh));
    const models::TriangleMesh mended = models::repair::repaired(mesh).mesh;
    expect(index_fault(mended).empty(), "a sound repaired mesh, got: " + index_fault(mended));
    const std::string fault = manifold_fault(mended);
    expect(fault.empty(), "a repaired manifold, got: " + fault);
}

void use_mesh_file(const std::filesystem::path& file) {
    use_mesh(models::meshfile::read_mesh(file, {.pictures = true, .backs = true}));
}

std::vector<std::string> mesh_seeds(const std::string& ending) {
    std::vector<std::string> seeds;
    models::TriangleMesh smooth = tetrahedron();
    smooth.vertices_m[1].x = 1.1; // no float
    smooth.normals = {{0.0F, 0.0F, 1.0F}};
    smooth.corner_normals.assign(4, {0, 0, 0});
    for (const models::TriangleMesh& mesh : {coloured_cube(), smooth}) {
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
