#include "models/meshfile/material_names.h"
#include "models/meshfile/mesh_formats.h"
#include "sim/base/format_once.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <utility>

namespace octant::models::meshfile {

namespace {

/// Words that no DEF may take: those of VRML itself, and those of the lists below.
constexpr std::array<std::string_view, 10> taken_words{
    "DEF", "USE", "TRUE", "FALSE", "NULL", "PROTO", "ROUTE", "points", "colours", "normals"};

template <typename Vector>
void append_list(std::string& text, std::string_view head, const std::vector<Vector>& vectors) {
    text += fmt::format("      {} [\n", head);
    for (const Vector& vector : vectors) {
        fmt::format_to(std::back_inserter(text), "{} {} {},\n", vector.x, vector.y, vector.z);
    }
    text += "      ] }\n";
}

/// A shape of the triangles of one material; of all triangles where there are no materials. The first one names the
/// lists that the others use.
class ShapeWriting {
public:
    explicit ShapeWriting(const TriangleMesh& mesh) : mesh_(mesh), names_(unique_material_names(mesh.materials)) {}

    std::string text() {
        text_ = "#VRML V2.0 utf8\nGroup { children [\n";
        if (names_.empty()) { append_shape(0); }
        for (std::uint32_t material = 0; material < names_.size(); ++material) { append_shape(material); }
        text_ += "] }\n";
        return std::move(text_);
    }

private:
    void append_shape(std::uint32_t material) {
        text_ += "  Shape {\n";
        if (!names_.empty()) {
            const glm::vec3& colour = mesh_.materials[material].colour;
            text_ += fmt::format("    appearance Appearance {{ material DEF {} Material {{ diffuseColor {} {} {} "
                                 "}} }}\n",
                identifier(names_[material]), colour.x, colour.y, colour.z);
        }
        text_ += "    geometry IndexedFaceSet {\n";
        append_lists();
        append_indices("coordIndex", mesh_.triangles, material);
        if (!mesh_.corner_normals.empty()) { append_indices("normalIndex", mesh_.corner_normals, material); }
        text_ += "    }\n  }\n";
    }

    void append_lists() {
        if (!first_) {
            text_ += "      coord USE points\n";
            text_ += mesh_.colours.empty() ? "" : "      color USE colours\n";
            text_ += mesh_.normals.empty() ? "" : "      normal USE normals\n";
            return;
        }
        first_ = false;
        append_list(text_, "coord DEF points Coordinate { point", mesh_.vertices_m);
        if (!mesh_.colours.empty()) { append_list(text_, "color DEF colours Color { color", mesh_.colours); }
        if (!mesh_.normals.empty()) { append_list(text_, "normal DEF normals Normal { vector", mesh_.normals); }
    }

    void append_indices(std::string_view name, const std::vector<Triangle>& corners, std::uint32_t material) {
        text_ += fmt::format("      {} [\n", name);
        for (std::size_t t = 0; t < corners.size(); ++t) {
            if (mesh_.triangle_materials.empty() || mesh_.triangle_materials[t] == material) {
                const auto [a, b, c] = corners[t];
                fmt::format_to(std::back_inserter(text_), "{} {} {} -1\n", a, b, c);
            }
        }
        text_ += "      ]\n";
    }

    /// A material's name as a DEF can hold it.
    static std::string identifier(std::string_view name) {
        std::string out;
        for (const char c : name) {
            const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
            out += is_letter || (c >= '0' && c <= '9') ? c : '_';
        }
        const bool is_taken = std::ranges::find(taken_words, out) != taken_words.end();
        return is_taken || out.find_first_of("0123456789") == 0 ? "m_" + out : out;
    }

    const TriangleMesh& mesh_;
    std::vector<std::string> names_;
    std::string text_;
    bool first_ = true;
};

} // namespace

std::string vrml_text(const TriangleMesh& mesh) { return ShapeWriting(mesh).text(); }

} // namespace octant::models::meshfile
