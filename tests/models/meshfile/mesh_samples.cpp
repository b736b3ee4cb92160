#include "tests/models/meshfile/mesh_samples.h"

#include "models/meshfile/mesh_file.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"

#include <catch2/catch.hpp>

namespace octant::models::meshfile::test {

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

std::string ac3d_square(const std::string& flags, const std::string& name) {
    return "AC3Db\nMATERIAL \"white\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
           "OBJECT world\nkids 1\nOBJECT poly\nname \"" +
           name + "\"\ntexture \"two.bmp\"\nnumvert 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nnumsurf 1\nSURF " + flags +
           "\nmat 0\nrefs 4\n0 0.01 0\n1 0.99 0\n2 0.99 1\n3 0.01 1\nkids 0\n";
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

} // namespace octant::models::meshfile::test
