#include "ui/studies/simplification/simplification_meshes.h"

#include "models/procedural/globe.h"
#include "models/procedural/machined_part.h"
#include "models/procedural/background60.h"
#include "models/meshfile/mesh_file.h"
#include "models/repair/repair.h"
#include "sim/base/error.h"
#include "ui/base/data_files.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace octant::ui::studies::simplification {

namespace {

StudyMesh study_mesh(std::string name, models::TriangleMesh original) {
    StudyMesh mesh;
    mesh.name = std::move(name);
    mesh.diagonal_m = models::diagonal_m(original);
    models::TriangleMesh shape;
    shape.vertices_m = original.vertices_m;
    shape.colours = original.colours;
    shape.triangles = original.triangles;
    mesh.original = shape;
    mesh.clean = models::repair::repaired(std::move(shape)).mesh;
    return mesh;
}

models::TriangleMesh torus_mesh() {
    const models::polygons::PolygonModel model = models::procedural::torus(256, 64);
    models::TriangleMesh mesh;
    mesh.vertices_m = model.vertices_m;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto corners = model.corners(i);
        mesh.triangles.push_back({corners[0], corners[1], corners[2]});
        mesh.triangles.push_back({corners[0], corners[2], corners[3]});
    }
    return mesh;
}

/// Every triangle cut in four at the middles of its sides.
models::TriangleMesh cut_in_four(const models::TriangleMesh& coarse) {
    models::TriangleMesh fine;
    fine.vertices_m = coarse.vertices_m;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] = middles.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(fine.vertices_m.size()));
        if (is_new) {
            fine.vertices_m.push_back(0.5 * (coarse.vertices_m[a] + coarse.vertices_m[b]));
        }
        return found->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        fine.triangles.insert(
            fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

models::TriangleMesh fine_aircraft(const char* name) {
    constexpr std::size_t wanted = 40'000;
    models::TriangleMesh mesh =
        models::repair::repaired(models::meshfile::read_mesh(base::aircraft_file(name))).mesh;
    while (mesh.triangles.size() < wanted) {
        mesh = cut_in_four(mesh);
    }
    return mesh;
}

} // namespace

StudyMesh bunny_from(const std::filesystem::path& file) {
    StudyMesh mesh = study_mesh_from(file);
    constexpr std::size_t vertices = 35947;
    constexpr std::size_t faces = 69451;
    if (mesh.original.vertices_m.size() != vertices || mesh.original.triangles.size() != faces) {
        throw_error_in(
            file,
            fmt::format(
                "expected the Stanford bunny of {} vertices and {} faces, got {} and {}",
                vertices,
                faces,
                mesh.original.vertices_m.size(),
                mesh.original.triangles.size()));
    }
    mesh.name = "bunny";
    return mesh;
}

StudyMesh study_mesh_from(const std::filesystem::path& file) {
    StudyMesh mesh = study_mesh(file.stem().string(), models::meshfile::read_mesh(file));
    if (mesh.clean.triangles.empty()) {
        throw_error_in(file, "expected a mesh with triangles, got none");
    }
    return mesh;
}

std::vector<StudyMesh> built_in_mesh_names() {
    std::vector<StudyMesh> meshes;
    meshes.push_back(study_mesh("globe", models::procedural::globe()));
    meshes.push_back(study_mesh("torus", torus_mesh()));
    meshes.push_back(study_mesh("machined part", models::procedural::machined_part()));
    meshes.push_back(study_mesh("F-15, fine", fine_aircraft("f15")));
    return meshes;
}

StudyMesh uncoloured(StudyMesh mesh) {
    mesh.original.colours.clear();
    mesh.clean.colours.clear();
    return mesh;
}

} // namespace octant::ui::studies::simplification
