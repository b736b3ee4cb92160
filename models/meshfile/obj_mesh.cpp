#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "models/polygons/obj_reader.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

namespace octant::models::meshfile {

namespace {

constexpr std::size_t largest_obj_bytes = std::size_t{1} << 30U;

using Words = std::vector<std::string_view>;

class ObjMeshReading {
public:
    ObjMeshReading(const std::filesystem::path& path, std::string_view text, const ReadOptions& options)
        : path_(path), text_(path, text, {.joins_lines = true}), mesh_(path, options) {}

    /// What the file holds, to be finished.
    MeshBuilder read() {
        while (text_.next_line()) { take(); }
        finish_notes();
        return std::move(mesh_);
    }

private:
    /// Lines of other keywords say nothing about triangles.
    void take() {
        const std::string_view keyword = text_.word_or_end();
        if (keyword == "v") {
            take_vertex(text_.words());
        } else if (keyword == "vn") {
            mesh_.add_normal(vector(text_.words(), 0));
        } else if (keyword == "vt") {
            take_texture_coordinates();
        } else if (keyword == "f") {
            take_polygon(text_.words());
        } else if (keyword == "s") {
            take_smoothing_group();
        } else if (keyword == "usemtl") {
            material_name_ = std::string(text_.rest_of_line());
            material_ = invalid_index;
            picture_ = {};
        } else if (keyword == "mtllib") {
            take_material_files(text_.words());
        }
    }

    /// s N, s off or s 0; `s on`, which some programs write, is one group.
    void take_smoothing_group() {
        const std::string_view word = text_.word_or_end();
        const auto number = whole_number(word);
        const bool is_flat = word == "off" || number == 0L;
        const auto group = static_cast<std::uint32_t>(number.value_or(1) & 0x7fffffffL);
        mesh_.set_smoothing({is_flat ? Smoothing::flat : Smoothing::flat + 1 + group});
    }

    double number(std::string_view word) const {
        const auto value = finite_number(word);
        if (!value) { text_.refuse("a number", in_quotes(word)); }
        if (std::abs(*value) > max_coordinate) {
            text_.refuse(fmt::format("a number within {:g}", max_coordinate), in_quotes(word));
        }
        return *value;
    }

    glm::dvec3 vector(const Words& words, std::size_t first) const {
        if (words.size() < first + 3) { text_.refuse("three numbers", std::to_string(words.size() - first)); }
        return {number(words[first]), number(words[first + 1]), number(words[first + 2])};
    }

    /// v x y z, v x y z w or v x y z r g b.
    void take_vertex(const Words& words) {
        const std::uint32_t vertex = mesh_.add_vertex(vector(words, 0));
        if (words.size() < 6) { return; }
        const glm::dvec3 colour = vector(words, 3);
        for (int part = 0; part < 3; ++part) {
            if (colour[part] < 0.0 || colour[part] > 1.0) {
                text_.refuse(
                    "a vertex colour of three numbers 0..1", in_quotes(words[static_cast<std::size_t>(part) + 3]));
            }
        }
        mesh_.set_colour(vertex, glm::vec3(colour));
    }

    /// vt u v, from the lower left corner of a picture. What is no number counts as 0.
    void take_texture_coordinates() {
        const double u = finite_number(text_.word_or_end()).value_or(0.0);
        const double v = finite_number(text_.word_or_end()).value_or(0.0);
        mesh_.add_texture_coordinates({static_cast<float>(u), static_cast<float>(v)});
    }

    std::uint32_t index(std::string_view word, std::size_t count, std::string_view what) const {
        const auto value = whole_number(word);
        const long most = static_cast<long>(count);
        if (!value || *value == 0 || *value > most || *value < -most) {
            text_.refuse(fmt::format("a {} 1 to {} (or -{} to -1)", what, most, most), in_quotes(word));
        }
        return static_cast<std::uint32_t>(*value > 0 ? *value - 1 : most + *value);
    }

    /// A corner written as 7, 7/1, 7//3 or 7/1/3.
    CornerIndices corner(std::string_view word) const {
        const std::size_t slash = word.find('/');
        const std::size_t second = word.find('/', std::min(slash, word.size() - 1) + 1);
        CornerIndices found;
        found.vertex = index(word.substr(0, slash), mesh_.vertex_count(), "vertex");
        if (second != std::string_view::npos && second + 1 < word.size()) {
            found.normal = index(word.substr(second + 1), mesh_.normal_count(), "normal");
        }
        const std::size_t places = mesh_.texture_coordinates_count();
        if (places > 0 && slash < word.size() && slash + 1 < std::min(second, word.size())) {
            const std::string_view place = word.substr(slash + 1, second - slash - 1);
            found.texture = index(place, places, "place on a picture");
        }
        return found;
    }

    void take_polygon(const Words& words) {
        if (words.size() < 3 || words.size() > max_polygon_corners) {
            text_.refuse(
                fmt::format("a polygon of 3 to {} corners", max_polygon_corners), std::to_string(words.size()));
        }
        corners_.clear();
        for (const std::string_view word : words) { corners_.push_back(corner(word)); }
        const std::uint32_t used = material();
        mesh_.add_polygon(corners_, used, picture_);
    }

    /// Of the materials that have one.
    PolygonPicture picture_of(const std::string& material) {
        const auto named = pictures_.find(material);
        if (named == pictures_.end() || !mesh_.uses_pictures()) { return {}; }
        const TextureWrap wrap = named->second.is_clamped ? TextureWrap::Clamp : TextureWrap::Repeat;
        return {.picture = mesh_.pictures().picture(named->second.file), .wrap_u = wrap, .wrap_v = wrap};
    }

    /// Of the polygons from here on; materials come in the order of their first polygon.
    std::uint32_t material() {
        if (!material_name_ || material_ != invalid_index) { return material_; }
        picture_ = picture_of(*material_name_);
        const auto used = materials_.find(*material_name_);
        if (used != materials_.end()) { return material_ = used->second; }
        const auto known = read_materials_.find(*material_name_);
        Material made = known == read_materials_.end() ? Material{.name = *material_name_} : known->second;
        if (std::exchange(made.is_mirror, false) && !is_transparent(made)) { // of meshes only that counts as glass
            opaque_mirrors_.push_back(made.name);
        }
        if (picture_.picture != BakedPictures::none && made.colour == glm::vec3(0.0F)) {
            made.colour = glm::vec3(1.0F); // written by programs that mean the picture alone
        }
        if (const auto named = pictures_.find(*material_name_); named != pictures_.end()) {
            made.picture = picture_file(path_, named->second.file);
        }
        if (const auto named = emissive_pictures_.find(*material_name_); named != emissive_pictures_.end()) {
            made.emissive_picture = picture_file(path_, named->second);
        }
        material_ = mesh_.add_material(made);
        materials_.emplace(*material_name_, material_);
        return material_;
    }

    /// The rest of the line is one name with blanks or, where there is no such file, a name a word.
    void take_material_files(const Words& words) {
        if (take_material_file(std::string(text_.rest_of_line()))) { return; }
        for (const std::string_view word : words) {
            if (!take_material_file(std::string(word))) { missing_.emplace(std::string(word), text_.line_number()); }
        }
    }

    bool take_material_file(const std::string& name) {
        const std::filesystem::path file = path_.parent_path() / name;
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(file, ignored)) { return false; }
        const polygons::MtlFile read = polygons::read_mtl(file);
        for (const Material& material : read.materials) { read_materials_.insert_or_assign(material.name, material); }
        for (const auto& [material, picture] : read.pictures) {
            pictures_.insert_or_assign(material, picture);
            if (picture.is_moved) { moved_.emplace(material, file); }
        }
        for (const auto& [material, picture] : read.emissive_pictures) {
            emissive_pictures_.insert_or_assign(material, picture);
        }
        for (const std::string& note : read.notes) { mesh_.add_note(note); }
        for (const auto& [kind, count] : read.undrawn_pictures) {
            for (int i = 0; i < count; ++i) { mesh_.add_undrawn_picture(kind); }
        }
        return true;
    }

    void finish_notes() {
        for (const auto& [name, line] : missing_) {
            mesh_.add_note(fmt::format("{}:{}: material file {} is missing, its materials are drawn grey",
                path_.string(), line, printable(name)));
        }
        for (const auto& [material, file] : moved_) {
            mesh_.add_note(fmt::format("{}: the options -o, -s and -t of the picture of material {} are not read",
                file.string(), printable(material)));
        }
        if (!opaque_mirrors_.empty()) {
            mesh_.add_note(
                fmt::format("{}: opaque materials do not mirror on a mesh (illum 5 or 7): {}, the first is {}",
                    path_.string(), opaque_mirrors_.size(), printable(opaque_mirrors_.front())));
        }
    }

    std::filesystem::path path_;
    TextScanner text_;
    MeshBuilder mesh_;
    std::optional<std::string> material_name_;
    std::uint32_t material_ = invalid_index; ///< of material_name_, once a polygon has it
    std::map<std::string, std::uint32_t> materials_;
    std::map<std::string, Material> read_materials_;       ///< of the material files
    std::map<std::string, polygons::MtlPicture> pictures_; ///< of materials
    std::map<std::string, std::string> emissive_pictures_; ///< of materials
    std::map<std::string, std::filesystem::path> moved_;   ///< materials whose picture has such options
    std::vector<std::string> opaque_mirrors_;              ///< names
    PolygonPicture picture_;                               ///< of material_name_
    std::map<std::string, int> missing_;                   ///< with the line that names them first
    std::vector<CornerIndices> corners_;
};

} // namespace

MeshBuilder read_obj(const std::filesystem::path& path, const ReadOptions& options) {
    const std::string text = read_text_file(path, largest_obj_bytes);
    return is_xplane_text(text) ? read_xplane(path, text, options) : ObjMeshReading(path, text, options).read();
}

namespace {

std::string mtl_text(const TriangleMesh& mesh, const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t m = 0; m < names.size(); ++m) {
        const glm::vec3& colour = mesh.materials[m].colour;
        text += fmt::format("newmtl {}\nKd {} {} {}\n", names[m], colour.x, colour.y, colour.z);
        const Material& material = mesh.materials[m];
        if (material.opacity < 1.0F) { text += fmt::format("d {}\n", material.opacity); }
        const bool is_clamped =
            material.texture.wrap_u == TextureWrap::Clamp && material.texture.wrap_v == TextureWrap::Clamp;
        if (!material.picture.empty()) {
            text += fmt::format("map_Kd {}{}\n", is_clamped ? "-clamp on " : "", material.picture);
        }
        if (!material.emissive_picture.empty()) { text += fmt::format("map_Ke {}\n", material.emissive_picture); }
    }
    return text;
}

void append_vertices(std::string& text, const TriangleMesh& mesh) {
    for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v) {
        const glm::dvec3& place_m = mesh.vertices_m[v];
        text += fmt::format("v {} {} {}", place_m.x, place_m.y, place_m.z);
        if (!mesh.colours.empty()) {
            const glm::vec3& colour = mesh.colours[v];
            text += fmt::format(" {} {} {}", colour.x, colour.y, colour.z);
        }
        text += '\n';
    }
    for (const glm::vec2& place : mesh.texture_coordinates) { text += fmt::format("vt {} {}\n", place.x, place.y); }
    for (const glm::vec3& normal : mesh.normals) { text += fmt::format("vn {} {} {}\n", normal.x, normal.y, normal.z); }
}

} // namespace

ObjMeshText obj_mesh_text(const TriangleMesh& mesh, std::string_view mtl_name) {
    const std::vector<std::string> names = unique_material_names(mesh.materials);
    ObjMeshText text;
    text.mtl = mtl_text(mesh, names);
    text.obj = fmt::format("# {} vertices, {} triangles\n", mesh.vertices_m.size(), mesh.triangles.size());
    if (!names.empty()) { text.obj += fmt::format("mtllib {}\n", mtl_name); }
    append_vertices(text.obj, mesh);
    std::uint32_t material = invalid_index;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!mesh.triangle_materials.empty() && mesh.triangle_materials[t] != material) {
            material = mesh.triangle_materials[t];
            text.obj += fmt::format("usemtl {}\n", names[material]);
        }
        text.obj += 'f';
        for (std::size_t k = 0; k < 3; ++k) {
            text.obj += fmt::format(" {}", mesh.triangles[t][k] + 1);
            const bool has_texture =
                !mesh.corner_texture_coordinates.empty() && mesh.corner_texture_coordinates[t][k] != invalid_index;
            if (has_texture) { text.obj += fmt::format("/{}", mesh.corner_texture_coordinates[t][k] + 1); }
            if (!mesh.corner_normals.empty()) {
                text.obj += fmt::format("{}{}", has_texture ? "/" : "//", mesh.corner_normals[t][k] + 1);
            }
        }
        text.obj += '\n';
    }
    return text;
}

} // namespace octant::models::meshfile
