#include "models/meshfile/mesh_file.h"

#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/written_places.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

namespace {

void write_obj_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
    std::filesystem::path mtl = path;
    mtl.replace_extension(".mtl");
    const ObjMeshText text = obj_mesh_text(mesh, mtl.filename().string());
    if (!text.mtl.empty()) {
        write_file(mtl, text.mtl);
    }
    write_file(path, text.obj);
}

template <std::string (*bytes_of)(const TriangleMesh&)>
void write_one_file(const std::filesystem::path& path, const TriangleMesh& mesh) {
    write_file(path, bytes_of(mesh));
}

/// A reader of files without pictures.
template <TriangleMesh (*read)(const std::filesystem::path&)>
TriangleMesh read_plainly(const std::filesystem::path& path, const ReadOptions& /*options*/) {
    return read(path);
}

struct Format {
    std::string_view ending;
    TriangleMesh (*read)(const std::filesystem::path&, const ReadOptions&);
    MeshParts (*parts)(const std::filesystem::path&, const ReadOptions&); ///< null: all is body
    void (*write)(const std::filesystem::path&, const TriangleMesh&);
    bool places_in_float = false; ///< As written.
};

void refuse_to_write(const std::filesystem::path& path, const TriangleMesh& /*mesh*/) {
    error_in(path, "expected another format to write than FlightGear's models, got .xml");
}

constexpr std::array formats{
    Format{".obj", read_obj_mesh, read_obj_parts, write_obj_mesh},
    Format{".ply", read_plainly<read_ply_mesh>, nullptr, write_one_file<ply_bytes>},
    Format{".stl", read_plainly<read_stl_mesh>, nullptr, write_one_file<stl_bytes>, true},
    Format{".gltf", read_gltf_mesh, read_gltf_parts, write_one_file<gltf_text>, true},
    Format{".glb", read_gltf_mesh, read_gltf_parts, write_one_file<glb_bytes>, true},
    Format{".ac", read_ac3d_mesh, read_ac3d_parts, write_one_file<ac3d_text>},
    Format{".wrl", read_plainly<read_vrml_mesh>, nullptr, write_one_file<vrml_text>},
    Format{".xml", read_flightgear_model, nullptr, refuse_to_write}};

const Format* find_format(const std::filesystem::path& path) {
    const std::string ending = ending_of(path);
    const auto* const found = std::ranges::find(formats, ending, &Format::ending);
    return found == formats.end() ? nullptr : found;
}

const Format& format_of(const std::filesystem::path& path) {
    const Format* found = find_format(path);
    if (found == nullptr) {
        std::string known;
        for (const Format& format : formats) {
            known += fmt::format("{}{}", known.empty() ? "" : ", ", format.ending);
        }
        const std::string ending = printable(path.extension().string());
        error_in(
            path,
            fmt::format(
                "expected a mesh file ({}), got {}",
                known,
                ending.empty() ? "a name without an ending" : fmt::format("'{}'", ending)));
    }
    return *found;
}

} // namespace

TriangleMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
    return format_of(path).read(path, options);
}

MeshParts read_parts(const std::filesystem::path& path, const ReadOptions& options) {
    const Format& format = format_of(path);
    if (format.parts != nullptr) {
        return format.parts(path, options);
    }
    return {format.read(path, options), std::vector<TriangleMesh>(options.groups.size()), {}};
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
    format_of(path).write(path, mesh);
}

bool writes_places_in_float(const std::filesystem::path& path) {
    return format_of(path).places_in_float;
}

bool is_mesh_file(const std::filesystem::path& path) {
    return find_format(path) != nullptr;
}

} // namespace octant::models::meshfile
