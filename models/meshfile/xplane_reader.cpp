// X-Plane's OBJ8 objects, by their published specification: vertices with normals and places on one picture, triangles
// by ranges of indices, and animations, which are read as at rest: all datarefs 0, seen from outside.
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "sim/base/units.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

constexpr std::size_t max_xplane_corners = std::size_t{1} << 26U; ///< of all triangles, repeats counted
constexpr std::size_t max_animation_depth = 100;

double dataref_at_rest(std::string_view dataref) { return dataref.ends_with("view_is_external") ? 1.0 : 0.0; }

class XplaneReading {
public:
    XplaneReading(const std::filesystem::path& path, std::string_view text, const ReadOptions& options)
        : path_(path), text_(path, text, mesh_text), mesh_(path, options) {}

    MeshBuilder read() {
        for (int line = 0; line < 3; ++line) { text_.next_line(); } // is_xplane_object has read them
        while (text_.next_line()) { take(text_.word_or_end()); }
        if (hidden_ > 0) {
            mesh_.add_note(fmt::format("{}: {} triangles that animations hide at rest, or that are for far away, are "
                                       "not read",
                path_.string(), hidden_));
        }
        return std::move(mesh_);
    }

private:
    /// What an animation has done to the triangles inside it.
    struct Animation {
        AffineTransform placement;
        bool is_shown = true;
    };

    void take(std::string_view keyword) {
        if (keyword == "VT") {
            take_vertex();
        } else if (keyword == "IDX" || keyword == "IDX10") {
            for (std::size_t left = keyword == "IDX" ? 1 : 10; left > 0; --left) { take_index(); }
        } else if (keyword == "TRIS") {
            take_triangles();
        } else if (keyword == "TEXTURE") {
            take_picture();
        } else if (keyword.starts_with("ANIM_")) {
            take_animation(keyword.substr(5));
        } else {
            take_attribute(keyword);
        }
    }

    void take_attribute(std::string_view keyword) {
        if (keyword == "ATTR_LOD") {
            is_near_ = text_.number("a distance") <= 0.0;
        } else if (keyword == "ATTR_draw_disable" || keyword == "ATTR_draw_enable") {
            is_drawn_ = keyword == "ATTR_draw_enable";
        } else if (keyword == "ATTR_no_cull" || keyword == "ATTR_cull") {
            mesh_.set_two_sided(keyword == "ATTR_no_cull");
        } else if (keyword == "ATTR_shade_flat" || keyword == "ATTR_shade_smooth") {
            is_flat_ = keyword == "ATTR_shade_flat";
        } else if (keyword == "ATTR_diffuse_rgb") {
            const glm::dvec3 colour = glm::clamp(triple("a part of a colour"), 0.0, 1.0);
            material_ = mesh_.add_material(material_of(glm::vec3(colour)));
        } else if (keyword == "ELSE" || keyword == "ENDIF") {
            is_other_branch_ = keyword == "ELSE";
        }
    }

    glm::dvec3 triple(std::string_view what) {
        const double x = text_.number(what);
        const double y = text_.number(what);
        return {x, y, text_.number(what)};
    }

    struct Vertex {
        glm::dvec3 place_m{0.0};
        glm::dvec3 normal{0.0};
        glm::vec2 on_picture{0.0F};
    };

    void take_vertex() {
        Vertex vertex;
        vertex.place_m = triple("a coordinate");
        vertex.normal = triple("a part of a normal");
        const auto u = text_.take_number();
        const auto v = text_.take_number();
        vertex.on_picture = {static_cast<float>(u.value_or(0.0)), static_cast<float>(v.value_or(0.0))};
        vertices_.push_back(vertex);
    }

    void take_index() {
        const long last = static_cast<long>(vertices_.size()) - 1;
        if (last < 0) { text_.refuse("VT lines before IDX", "none"); }
        indices_.push_back(static_cast<std::uint32_t>(text_.integer("the number of a vertex", 0, last)));
    }

    void take_picture() {
        const std::string name(text_.rest_of_line());
        if (name.empty() || name == "none") { return; }
        picture_name_ = name;
        material_ = mesh_.add_material(material_of(glm::vec3(1.0F)));
        if (mesh_.uses_pictures()) { picture_ = mesh_.pictures().picture(name); }
    }

    Material material_of(const glm::vec3& colour) const {
        Material made{.name = picture_name_.empty() ? "surface" : picture_name_, .colour = colour};
        if (!picture_name_.empty() && !mesh_.uses_pictures()) {
            made.picture = picture_file(path_, picture_name_).string();
        }
        return made;
    }

    /// `kind`: what follows ANIM_.
    void take_animation(std::string_view kind) {
        if (kind == "begin") {
            if (stack_.size() >= max_animation_depth) {
                text_.refuse(fmt::format("animations at most {} deep", max_animation_depth), "a deeper one");
            }
            stack_.push_back(now_);
        } else if (kind == "end") {
            if (stack_.empty()) { text_.refuse("ANIM_begin before ANIM_end", "none"); }
            now_ = stack_.back();
            stack_.pop_back();
        } else if (kind == "hide" || kind == "show") {
            const double first = text_.number("a value");
            const double last = text_.number("a value");
            const double value = dataref_at_rest(text_.rest_of_line());
            if (value >= std::min(first, last) && value <= std::max(first, last)) { now_.is_shown = kind == "show"; }
        } else if (kind == "trans") {
            const glm::dvec3 from_m = triple("a coordinate");
            const auto [to_m, share] = take_end(from_m);
            move(from_m + (to_m - from_m) * share);
        } else if (kind == "rotate") {
            take_rotation();
        } else if (kind.ends_with("_begin")) {
            axis_ = kind == "rotate_begin" ? triple("a part of an axis") : glm::dvec3(0.0);
            dataref_ = std::string(text_.rest_of_line());
            keys_.clear();
        } else if (kind.ends_with("_key")) {
            const double value = text_.number("a value");
            const bool turns = kind == "rotate_key";
            keys_.push_back({value, turns ? glm::dvec3(text_.number("an angle"), 0.0, 0.0) : triple("a coordinate")});
        } else if (kind.ends_with("_end")) {
            const glm::dvec3 result = at_key(dataref_at_rest(dataref_));
            kind == "rotate_end" ? turn(axis_, result.x) : move(result);
        }
    }

    /// The second end of a move and where between both ends it rests, 0 to 1. Static moves have one end.
    std::pair<glm::dvec3, double> take_end(const glm::dvec3& from) {
        if (text_.words().size() < 3) { return {from, 0.0}; }
        const glm::dvec3 to = triple("a coordinate");
        return {to, take_share()};
    }

    double take_share() {
        const auto first = text_.take_number();
        const auto last = text_.take_number();
        if (!first || !last || *first == *last) { return 0.0; }
        return std::clamp((dataref_at_rest(text_.rest_of_line()) - *first) / (*last - *first), 0.0, 1.0);
    }

    void take_rotation() {
        const glm::dvec3 axis = triple("a part of an axis");
        const double from_deg = text_.number("an angle");
        const double to_deg = text_.take_number().value_or(from_deg);
        turn(axis, from_deg + (to_deg - from_deg) * take_share());
    }

    struct Key {
        double value = 0.0;
        glm::dvec3 result{0.0};
    };

    glm::dvec3 at_key(double value) {
        if (keys_.empty()) { return glm::dvec3(0.0); }
        std::ranges::stable_sort(keys_, {}, &Key::value);
        const auto next = std::ranges::upper_bound(keys_, value, {}, &Key::value);
        if (next == keys_.begin()) { return keys_.front().result; }
        const Key& before = *std::prev(next);
        if (next == keys_.end() || next->value == before.value) { return before.result; }
        return before.result + (next->result - before.result) * ((value - before.value) / (next->value - before.value));
    }

    void move(const glm::dvec3& by_m) { now_.placement = now_.placement.of({glm::dmat3(1.0), by_m}); }

    void turn(const glm::dvec3& axis, double angle_deg) {
        const double length = glm::length(axis);
        if (!(length > 0.0) || angle_deg == 0.0) { return; }
        const double angle_rad = rad_from_deg(std::fmod(angle_deg, 360.0));
        now_.placement = now_.placement.of({glm::dmat3(glm::rotate(glm::dmat4(1.0), angle_rad, axis / length))});
    }

    void take_triangles() {
        const long first = text_.integer("the first index", 0, static_cast<long>(indices_.size()));
        const long count = text_.integer("a number of indices", 0, static_cast<long>(indices_.size()) - first);
        corners_ += static_cast<std::size_t>(count);
        if (count % 3 != 0) { text_.refuse("indices of whole triangles", std::to_string(count)); }
        if (corners_ > max_xplane_corners) {
            text_.refuse(fmt::format("at most {} corners", max_xplane_corners), "more");
        }
        if (!is_near_ || !is_drawn_ || is_other_branch_ || !now_.is_shown) {
            hidden_ += static_cast<std::size_t>(count) / 3;
            return;
        }
        mesh_.set_smoothing({is_flat_ ? Smoothing::flat : Smoothing::unknown});
        for (long i = first; i < first + count; i += 3) {
            const auto at = static_cast<std::size_t>(i);
            // Clockwise seen from the front.
            const std::array triangle{corner(indices_[at]), corner(indices_[at + 2]), corner(indices_[at + 1])};
            mesh_.add_polygon(triangle, material_, {.picture = picture_});
        }
    }

    CornerIndices corner(std::uint32_t index) {
        const Vertex& vertex = vertices_[index];
        const auto place_m = now_.placement.point_m(vertex.place_m);
        if (!place_m) { text_.refuse("vertices within bounds", "one that animations move out of them"); }
        CornerIndices made{.vertex = mesh_.add_vertex(*place_m)};
        if (!is_flat_) { made.normal = mesh_.add_normal(now_.placement.turn * vertex.normal); }
        if (!picture_name_.empty()) { made.texture = mesh_.add_texture_coordinates(vertex.on_picture); }
        return made;
    }

    std::filesystem::path path_;
    TextScanner text_;
    MeshBuilder mesh_;
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> indices_;
    std::vector<Animation> stack_;
    Animation now_;
    glm::dvec3 axis_{0.0};
    std::string dataref_;
    std::vector<Key> keys_;
    std::string picture_name_;
    std::uint32_t picture_ = BakedPictures::none;
    std::uint32_t material_ = invalid_index;
    std::size_t corners_ = 0;
    std::size_t hidden_ = 0; ///< triangles
    bool is_near_ = true;
    bool is_drawn_ = true;
    bool is_flat_ = false;
    bool is_other_branch_ = false;
};

} // namespace

bool is_xplane_text(std::string_view text) {
    std::array<std::string_view, 3> lines;
    for (std::string_view& line : lines) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const auto words = split_words(text.substr(0, end));
        line = words.empty() ? std::string_view() : words[0];
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    const auto version = whole_number(lines[1]);
    return (lines[0] == "I" || lines[0] == "A") && version && *version >= 700 && lines[2] == "OBJ";
}

MeshBuilder read_xplane(const std::filesystem::path& path, std::string_view text, const ReadOptions& options) {
    return XplaneReading(path, text, options).read();
}

} // namespace octant::models::meshfile
