#include "models/meshfile/mesh_file.h"

#include "models/meshfile/mesh_formats.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <memory>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

namespace octant::models::meshfile {

namespace {

/// The first bytes of a file; empty where it cannot be read.
std::string start_of(const std::filesystem::path& path) {
    std::array<char, 512> bytes{};
    std::ifstream in(path, std::ios::binary);
    in.read(bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(in.gcount())};
}

} // namespace

bool is_xplane_object(const std::filesystem::path& path) { return is_xplane_text(start_of(path)); }

std::optional<polygons::FileAxes> axes_of_format(const std::filesystem::path& file) {
    const std::string ending = extension_of(file);
    if (ending == ".ac") { return polygons::FileAxes::from_text("back,up,left"); }
    if (ending == ".dnm" || ending == ".srf") { return polygons::FileAxes::from_text("left,up,forward"); }
    if (ending == ".acf" || (ending == ".obj" && is_xplane_object(file))) { return polygons::FileAxes(); }
    if (ending == ".xml") { return polygons::FileAxes::from_text("back,right,up"); }
    return std::nullopt;
}

std::vector<polygons::AxesHint> axes_hints_of_format(const std::filesystem::path& file) {
    using enum polygons::AxesHint::Subject;
    constexpr double declared = 4.5;
    constexpr double usual = 3.0; // hardly any file has its top downwards
    constexpr glm::dvec3 y(0.0, 1.0, 0.0);
    constexpr glm::dvec3 z(0.0, 0.0, 1.0);
    const std::string ending = extension_of(file);
    const auto is_one_of = [&](std::string_view endings) {
        const auto words = split_words(endings);
        return std::ranges::find(words, ending) != words.end();
    };
    if (is_one_of(".gltf .glb")) { return {{Top, y, declared}, {Top, z, 1.5}, {Nose, z, 1.0}}; }
    if (is_one_of(".flt .ive .osg .osgb .osgt")) { return {{Top, z, declared}, {Top, y, 1.5}, {Nose, y, 1.0}}; }
    if (is_one_of(".3ds .ase .b3d .blend .dae .dxf .fbx .lwo .lws .md2 .ms3d .wrl .x")) {
        return {{Top, y, declared}, {Top, z, 2.0}, {Nose, -z, 0.3}, {Nose, z, 0.2}};
    }
    if (ending == ".stl") { return {{Top, z, usual + 0.2}, {Top, y, usual}, {Nose, y, 0.2}}; }
    return {{Top, y, usual + 0.2}, {Top, z, usual}, {Nose, -z, 0.3}, {Nose, z, 0.2}};
}

namespace {

/// Makes picture names relative to the folder of the file to be written, and writes embedded pictures into that folder.
TriangleMesh with_named_pictures(const std::filesystem::path& path, const TriangleMesh& mesh) {
    TriangleMesh named = mesh;
    const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
    const auto from_folder = [&](const std::string& file) {
        return std::filesystem::absolute(file)
            .lexically_normal()
            .lexically_proximate(folder.lexically_normal())
            .string();
    };
    for (Material& material : named.materials) {
        if (material.picture_bytes) {
            std::string own = material.picture;
            std::ranges::replace_if(
                own, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_'; }, '-');
            material.picture = fmt::format(
                "{}-{}.{}", path.stem().string(), own, material.picture_bytes->starts_with("\x89PNG") ? "png" : "jpg");
            write_file(folder / material.picture, *material.picture_bytes);
        } else if (!material.picture.empty()) {
            material.picture = from_folder(material.picture);
        }
        if (std::error_code ignored; std::filesystem::is_regular_file(material.emissive_picture, ignored)) {
            material.emissive_picture = from_folder(material.emissive_picture);
        } else {
            material.emissive_picture.clear(); // inside the file that was read
        }
    }
    return named;
}

bool has_pictures(const TriangleMesh& mesh) {
    return std::ranges::any_of(mesh.materials, [](const Material& material) { return !material.picture.empty(); });
}

void write_obj_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
    std::filesystem::path mtl = path;
    mtl.replace_extension(".mtl");
    const ObjMeshText text =
        obj_mesh_text(has_pictures(mesh) ? with_named_pictures(path, mesh) : mesh, mtl.filename().string());
    if (!text.mtl.empty()) { write_file(mtl, text.mtl); }
    write_file(path, text.obj);
}

template <std::string (*bytes_of)(const TriangleMesh&)>
void write_one_file(const std::filesystem::path& path, const TriangleMesh& mesh) {
    write_file(path, bytes_of(mesh));
}

void write_ac3d_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
    write_file(path, ac3d_text(has_pictures(mesh) ? with_named_pictures(path, mesh) : mesh));
}

template <std::string (*bytes_of)(const TriangleMesh&)>
void write_gltf_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
    if (!has_pictures(mesh)) {
        write_file(path, bytes_of(mesh));
        return;
    }
    TriangleMesh loaded = mesh;
    for (Material& material : loaded.materials) { material.picture_bytes = picture_bytes_of(material); }
    write_file(path, bytes_of(loaded));
}

struct Format {
    std::string_view ending;
    MeshBuilder (*read)(const std::filesystem::path&, const ReadOptions&);      ///< null: read_rotating_model
    bool has_parts = false;                                                     ///< else all is body
    void (*write)(const std::filesystem::path&, const TriangleMesh&) = nullptr; ///< null: it is only read
    /// What a written file leaves out, of "normals", "colours of vertices", "materials" and "texture coordinates".
    std::string_view excluded = {};
    bool places_in_float = false; ///< As written.
    bool has_origin = false;      ///< Written places count from gltf_origin_m.
};

constexpr std::array formats{Format{".obj", read_obj, true, write_obj_mesh},
    Format{".ply", read_ply, false, write_one_file<ply_bytes>, "materials"},
    Format{".stl", read_stl, false, write_one_file<stl_bytes>,
        "normals, colours of vertices, materials, texture coordinates", true},
    Format{".off", read_off}, Format{".gltf", read_gltf, true, write_gltf_mesh<gltf_text>, "", true, true},
    Format{".glb", read_gltf, true, write_gltf_mesh<glb_bytes>, "", true, true},
    Format{".ac", read_ac3d, true, write_ac3d_mesh, "normals, colours of vertices"},
    Format{".wrl", read_vrml, true, write_one_file<vrml_text>, "texture coordinates"}, Format{".dnm", read_dnm, true},
    Format{".srf", read_srf, true}, Format{".xml", nullptr}, Format{".acf", nullptr}};

const Format* find_format(const std::filesystem::path& path) {
    const std::string ending = extension_of(path);
    const auto* const found = std::ranges::find(formats, ending, &Format::ending);
    return found == formats.end() ? nullptr : found;
}

/// What files of other kinds begin with.
struct FileStart {
    std::string_view bytes;
    std::string_view kind;
};

constexpr std::array file_starts{FileStart{"PSSD", "a scenery file of X-Plane"}, FileStart{"\x89PNG", "a PNG picture"},
    FileStart{"\xff\xd8\xff", "a JPEG picture"}, FileStart{"PK\x03\x04", "a zip archive: unpack it first"},
    FileStart{"\x1f\x8b", "a gzip file: unpack it first"}, FileStart{"7z\xbc\xaf", "a 7-Zip archive: unpack it first"},
    FileStart{"Rar!", "a RAR archive: unpack it first"}, FileStart{"SQLite", "a database"},
    FileStart{"%PDF", "a PDF document"}, FileStart{"PXR-USDC", "a USD scene: Blender writes it as glTF"},
    FileStart{"#usda", "a USD scene: Blender writes it as glTF"},
    FileStart{"MDLX", "a model of Microsoft Flight Simulator: ModelConverterX writes it as glTF"},
    FileStart{"ISO-10303-21", "a STEP file: FreeCAD writes it as OBJ"}};

/// The end of X-Plane's and others' names, whose files have no start of their own.
constexpr std::array file_endings{
    FileStart{".mdl", "a model of Microsoft Flight Simulator: ModelConverterX writes it as glTF"},
    FileStart{".max", "a scene of 3ds Max, which writes it as FBX"},
    FileStart{".skp", "a model of SketchUp, which writes it as Collada"},
    FileStart{".vsp3", "a model of OpenVSP, which writes it as STL or OBJ"},
    FileStart{".edm", "a model of DCS, which no other program reads"},
    FileStart{".stp", "a STEP file: FreeCAD writes it as OBJ"},
    FileStart{".step", "a STEP file: FreeCAD writes it as OBJ"},
    FileStart{".iges", "an IGES file: FreeCAD writes it as OBJ"},
    FileStart{".igs", "an IGES file: FreeCAD writes it as OBJ"},
    FileStart{".usdz", "a USD scene: Blender writes it as glTF"},
    FileStart{".usd", "a USD scene: Blender writes it as glTF"}};

/// What a file of another kind is, in words; empty where that is not known.
std::string_view kind_of_file(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) { return {}; }
    const std::string start = start_of(path);
    if (is_xplane_text(start)) { return "an X-Plane object, whose name ends in .obj"; }
    const auto* const by_start = std::ranges::find_if(
        file_starts, [&](const FileStart& one) { return std::string_view(start).starts_with(one.bytes); });
    if (by_start != file_starts.end()) { return by_start->kind; }
    const auto* const by_ending = std::ranges::find(file_endings, extension_of(path), &FileStart::bytes);
    return by_ending == file_endings.end() ? std::string_view() : by_ending->kind;
}

const Format& format_of(const std::filesystem::path& path) {
    const Format* found = find_format(path);
    if (found == nullptr) {
        if (const std::string_view kind = kind_of_file(path); !kind.empty()) {
            throw_error_in(path, fmt::format("expected a mesh file, got {}", kind));
        }
        std::string known;
        for (const Format& format : formats) { known += fmt::format("{}{}", known.empty() ? "" : ", ", format.ending); }
        const std::string ending = printable(path.extension().string());
        throw_error_in(path, fmt::format("expected a mesh file ({}), got {}", known,
                                 ending.empty() ? "a name without an ending" : fmt::format("'{}'", ending)));
    }
    return *found;
}

} // namespace

std::shared_ptr<const std::string> picture_bytes_of(const Material& material) {
    std::error_code ignored;
    constexpr std::size_t largest_bytes = std::size_t{256} << 20U;
    if (material.picture_bytes || material.picture.empty() ||
        !std::filesystem::is_regular_file(material.picture, ignored) ||
        std::filesystem::file_size(material.picture, ignored) > largest_bytes) {
        return material.picture_bytes;
    }
    return std::make_shared<const std::string>(read_file(material.picture, largest_bytes));
}

TriangleMesh mesh_at_rest(RotatingModel model) {
    for (RotatingPart& part : model.parts) {
        if (is_shown_at_rest(part.moves)) { join_mesh(model.body, std::move(part.mesh), {}); }
    }
    join_mesh(model.body, std::move(model.clear), {});
    return std::move(model.body);
}

TriangleMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
    const Format& format = format_of(path);
    return format.read == nullptr ? mesh_at_rest(read_rotating_model(path, options))
                                  : format.read(path, options).finish();
}

RotatingModel read_rotating_model(const std::filesystem::path& path, const ReadOptions& options) {
    const std::string ending = extension_of(path);
    if (ending == ".xml") { return read_flightgear_model(path, options); }
    if (ending == ".dnm") { return read_rotating_dnm(path, options); }
    if (ending == ".acf") { return read_xplane_aircraft(path, options); }
    if (ending == ".obj" && is_xplane_object(path)) { return read_rotating_xplane(path, options); }
    ReadOptions alone = options;
    alone.placeholders = false;
    MeshParts parts = read_parts(path, alone);
    if (parts.body.triangles.empty()) { // then nothing is to be seen through the rest
        return {read_mesh(path, options), {}, {}};
    }
    return {std::move(parts.body), {}, std::move(parts.clear)};
}

MeshParts read_parts(const std::filesystem::path& path, const ReadOptions& options) {
    const Format& format = format_of(path);
    if (format.has_parts) { return format.read(path, options).finish_parts(); }
    return {read_mesh(path, options), std::vector<TriangleMesh>(options.groups.size()), {}};
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
    const Format& format = format_of(path);
    if (format.write == nullptr) {
        throw_error_in(path, fmt::format("expected a format that is written, got {}", format.ending));
    }
    format.write(path, mesh);
}

std::vector<std::string> write_warnings(const std::filesystem::path& path, const TriangleMesh& mesh) {
    const Format& format = format_of(path);
    std::string excluded;
    const auto look_at = [&](std::string_view what, bool is_there) {
        if (is_there && format.excluded.find(what) != format.excluded.npos) {
            excluded += fmt::format("{}{}", excluded.empty() ? "" : ", ", what);
        }
    };
    look_at("normals", !mesh.corner_normals.empty());
    look_at("colours of vertices", !mesh.colours.empty());
    look_at("materials", !mesh.materials.empty());
    look_at("texture coordinates", !mesh.corner_texture_coordinates.empty());
    std::vector<std::string> notes;
    if (!excluded.empty()) {
        notes.push_back(fmt::format("{}: the format holds no {}; they are left out", path.string(), excluded));
    }
    if (format.ending == ".ply" && !mesh.corner_normals.empty() && !has_vertex_normals(mesh)) {
        notes.push_back(fmt::format(
            "{}: normals are left out, as some vertices have several and the format holds one", path.string()));
    }
    const bool has_textures = !mesh.corner_texture_coordinates.empty();
    if (has_textures && format.ending == ".ac" && single_picture(mesh).empty()) {
        notes.push_back(fmt::format(
            "{}: texture coordinates are written without a picture, as the materials do not have one in common",
            path.string()));
    }
    for (const Material& material : format.has_origin ? mesh.materials : std::vector<Material>()) {
        const auto bytes = picture_bytes_of(material);
        if (!material.picture.empty() && (!bytes || !is_gltf_picture(*bytes))) {
            notes.push_back(fmt::format("{}: expected a PNG or JPEG picture, got '{}'; it is left out", path.string(),
                printable(material.picture)));
        }
    }
    return notes;
}

double rounding_m(const std::filesystem::path& path, const BoundingBox& bounds) {
    const Format& format = format_of(path);
    if (!format.places_in_float) { return 0.0; }
    const glm::dvec3 origin_m = format.has_origin ? gltf_origin_m(bounds) : glm::dvec3(0.0);
    glm::dvec3 moves_m(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double farthest_m =
            std::max(std::abs(bounds.min_m[axis] - origin_m[axis]), std::abs(bounds.max_m[axis] - origin_m[axis]));
        const auto rounded = static_cast<float>(farthest_m);
        moves_m[axis] = 0.5 * static_cast<double>(std::nextafter(rounded, std::numeric_limits<float>::max()) - rounded);
    }
    return glm::length(moves_m);
}

bool is_mesh_file(const std::filesystem::path& path) { return find_format(path) != nullptr; }

bool is_writable_mesh_file(const std::filesystem::path& path) {
    const Format* format = find_format(path);
    return format != nullptr && format->write != nullptr;
}

namespace {

std::string without_marks(std::string_view name) {
    std::string out(name);
    for (char& c : out) {
        const bool is_control = static_cast<unsigned char>(c) < 0x20;
        if (is_control || c == '"' || c == '\\' || c == 0x7f) { c = '_'; }
    }
    out.erase(0, out.find_first_not_of(' '));
    return out.substr(0, out.find_last_not_of(' ') + 1);
}

} // namespace

std::vector<std::string> unique_material_names(std::span<const Material> materials) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const Material& material : materials) {
        const std::string wanted = without_marks(material.name);
        const std::string base = wanted.empty() ? "material" : wanted;
        std::string name = base;
        for (int number = 2; !taken.insert(name).second; ++number) { name = fmt::format("{}_{}", base, number); }
        names.push_back(name);
    }
    return names;
}

} // namespace octant::models::meshfile
