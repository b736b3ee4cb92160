#include "tests/models/meshfile/mesh_samples.h"

#include "models/meshfile/mesh_file.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <iostream>

namespace octant::models::meshfile::test {

std::filesystem::path scratch_file(const std::string& name) {
    std::filesystem::create_directories(tests::scratch_folder());
    std::filesystem::remove_all(tests::scratch_folder() / name);
    return tests::scratch_folder() / name;
}

std::filesystem::path file_with(const std::string& name, std::string_view content) {
    const std::filesystem::path path = scratch_file(name);
    write_file(path, content);
    return path;
}

std::string error_of(const std::string& name, std::string_view content) {
    const std::filesystem::path path = file_with(name, content);
    try {
        read_mesh(path);
    } catch (const Error& error) {
        const std::string what = error.what();
        const std::string folder = path.parent_path().string() + "/";
        return what.starts_with(folder) ? what.substr(folder.size()) : what;
    }
    return {};
}

void check_same(const TriangleMesh& a, const TriangleMesh& b) {
    CHECK(a.name == b.name);
    CHECK(a.vertices_m == b.vertices_m);
    CHECK(a.colours == b.colours);
    CHECK(a.triangles == b.triangles);
    CHECK(a.normals == b.normals);
    CHECK(a.corner_normals == b.corner_normals);
    CHECK(a.triangle_materials == b.triangle_materials);
    CHECK(a.notes == b.notes);
    REQUIRE(a.materials.size() == b.materials.size());
    for (std::size_t m = 0; m < a.materials.size(); ++m) {
        CHECK(a.materials[m].name == b.materials[m].name);
        CHECK(a.materials[m].colour == b.materials[m].colour);
    }
}

std::optional<std::filesystem::path> real_mesh_file(const std::string& name) {
    const char* given = std::getenv("OCTANT_SHARED_DATA");
    const std::filesystem::path folder =
        given != nullptr ? std::filesystem::path(given)
                         : std::filesystem::path(OCTANT_SOURCE_DIR) / "../shared/data";
    if (std::filesystem::exists(folder / "meshes" / name)) {
        return folder / "meshes" / name;
    }
    std::cout << "SKIPPED: no meshes/" << name << " in " << folder << '\n';
    return std::nullopt;
}

} // namespace octant::models::meshfile::test
