#include "models/meshfile/material_names.h"
#include "models/meshfile/mesh_formats.h"
#include "models/triangle_mesh.h"
#include "sim/base/format_once.h"

#include <fmt/format.h>
#include <iterator>

namespace octant::models::meshfile {

std::string single_picture(const TriangleMesh& mesh) {
    std::string found;
    for (const Material& material : mesh.materials) {
        if (!found.empty() && !material.picture.empty() && material.picture != found) { return {}; }
        found = material.picture.empty() ? found : material.picture;
    }
    return found;
}

std::string ac3d_text(const TriangleMesh& mesh) {
    std::string text = "AC3Db\n";
    auto out = std::back_inserter(text);
    const std::vector<std::string> names = unique_material_names(mesh.materials);
    for (std::size_t m = 0; m < names.size(); ++m) {
        const glm::vec3& colour = mesh.materials[m].colour;
        fmt::format_to(out, "MATERIAL \"{}\" rgb {} {} {} amb 0.2 0.2 0.2 emis 0 0 0 spec 0 0 0 shi 10 trans 0\n",
            names[m], colour.x, colour.y, colour.z);
    }
    text += "OBJECT world\nkids 1\nOBJECT poly\nname \"mesh\"\n";
    if (const std::string picture = single_picture(mesh); !picture.empty()) {
        fmt::format_to(out, "texture \"{}\"\n", picture);
    }
    fmt::format_to(out, "numvert {}\n", mesh.vertices_m.size());
    for (const glm::dvec3& place_m : mesh.vertices_m) {
        fmt::format_to(out, "{} {} {}\n", place_m.x, place_m.y, place_m.z);
    }
    fmt::format_to(out, "numsurf {}\n", mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        text += "SURF 0x10\n";
        if (!mesh.triangle_materials.empty()) { fmt::format_to(out, "mat {}\n", mesh.triangle_materials[t]); }
        text += "refs 3\n";
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t texture =
                mesh.corner_texture_coordinates.empty() ? invalid_index : mesh.corner_texture_coordinates[t][k];
            const glm::vec2 place = texture == invalid_index ? glm::vec2(0.0F) : mesh.texture_coordinates[texture];
            fmt::format_to(out, "{} {} {}\n", mesh.triangles[t][k], place.x, place.y);
        }
    }
    text += "kids 0\n";
    return text;
}

} // namespace octant::models::meshfile
