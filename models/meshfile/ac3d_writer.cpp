#include "models/meshfile/material_names.h"
#include "models/meshfile/mesh_formats.h"
#include "sim/base/format_once.h"

#include <fmt/format.h>
#include <iterator>

namespace octant::models::meshfile {

std::string ac3d_text(const TriangleMesh& mesh) {
    std::string text = "AC3Db\n";
    auto out = std::back_inserter(text);
    const std::vector<std::string> names = writable_names(mesh.materials);
    for (std::size_t m = 0; m < names.size(); ++m) {
        const glm::vec3& colour = mesh.materials[m].colour;
        fmt::format_to(
            out,
            "MATERIAL \"{}\" rgb {} {} {} amb 0.2 0.2 0.2 emis 0 0 0 spec 0 0 0 shi 10 trans 0\n",
            names[m],
            colour.x,
            colour.y,
            colour.z);
    }
    fmt::format_to(
        out,
        "OBJECT world\nkids 1\nOBJECT poly\nname \"mesh\"\nnumvert {}\n",
        mesh.vertices_m.size());
    for (const glm::dvec3& place_m : mesh.vertices_m) {
        fmt::format_to(out, "{} {} {}\n", place_m.x, place_m.y, place_m.z);
    }
    fmt::format_to(out, "numsurf {}\n", mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        text += "SURF 0x10\n";
        if (!mesh.triangle_materials.empty()) {
            fmt::format_to(out, "mat {}\n", mesh.triangle_materials[t]);
        }
        text += "refs 3\n";
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            fmt::format_to(out, "{} 0 0\n", vertex);
        }
    }
    text += "kids 0\n";
    return text;
}

} // namespace octant::models::meshfile
