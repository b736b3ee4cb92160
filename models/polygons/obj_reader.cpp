#include "models/polygons/obj_reader.h"

#include "models/polygons/polygon_model.h"
#include "models/polygons/polygon_outlines.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::polygons {

namespace {

constexpr std::size_t largest_mtl_bytes = std::size_t{16} << 20U;

class MtlReading {
public:
    MtlReading(const std::filesystem::path& path, std::string_view text) : path_(path), text_(path, text) {}

    MtlFile read() {
        while (text_.next_line()) {
            const std::string_view keyword = text_.word_or_end();
            if (keyword == "newmtl") {
                add_material(std::string(text_.rest_of_line()));
            } else if (keyword == "Kd") {
                set_colour();
            } else if (keyword == "map_Kd" && !text_.words().empty()) {
                require_material(keyword);
                made_.pictures.emplace_back(material_, picture());
            } else if (keyword == "map_Ke" && !text_.words().empty()) {
                require_material(keyword);
                made_.emissive_pictures.emplace_back(material_, picture().file);
                ++made_.undrawn_pictures["glow"];
            } else if (keyword == "map_Bump" || keyword == "map_bump" || keyword == "bump" || keyword == "norm") {
                ++made_.undrawn_pictures["normals"];
            } else if (keyword == "map_Ks" || keyword == "map_Ns") {
                ++made_.undrawn_pictures["highlights"];
            } else if (keyword == "map_d") {
                ++made_.undrawn_pictures["opacity"];
            } else if (keyword == "d" || keyword == "Tr") {
                take_opacity(keyword);
            } else if (keyword == "illum") {
                take_illumination();
            }
        }
        finish_material();
        finish_notes();
        return std::move(made_);
    }

private:
    void require_material(std::string_view keyword) const {
        if (made_.materials.empty()) { text_.refuse(fmt::format("newmtl before {}", keyword), std::string(keyword)); }
    }

    /// What follows map_Kd: options that begin with a dash, each with its values, then a name that may have blanks.
    MtlPicture picture() {
        MtlPicture made;
        const std::vector<std::string_view>& words = text_.words();
        std::size_t at = 0;
        while (at + 1 < words.size() && words[at].starts_with('-')) {
            std::string option(words[at]); // some programs write -S
            std::ranges::transform(
                option, option.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            constexpr std::array known{"-blendu", "-blendv", "-boost", "-bm", "-cc", "-clamp", "-imfchan", "-mm", "-o",
                "-s", "-t", "-texres", "-type"};
            if (std::ranges::find(known, option) == known.end()) { // the name begins with a dash
                note({text_.line_number(), "an option of MTL pictures", text_of_line(), "read as part of the name"});
                break;
            }
            ++at;
            made.is_clamped = option == "-clamp" ? words[at] == "on" : made.is_clamped;
            const bool is_vector = option == "-o" || option == "-s" || option == "-t";
            made.is_moved = made.is_moved || is_vector;
            const std::size_t most = is_vector ? 3 : option == "-mm" ? 2 : 1;
            for (std::size_t k = 0; k < most && at + 1 < words.size(); ++k) {
                if (most > 1 && !finite_number(words[at])) { break; }
                ++at;
            }
        }
        const std::string_view line = text_.rest_of_line();
        made.file = std::string(at == 0 ? line : line.substr(static_cast<std::size_t>(words[at].data() - line.data())));
        return made;
    }

    void add_material(const std::string& name) {
        if (name.empty()) { text_.refuse("a material name after newmtl", "none"); }
        if (!names_.insert(name).second) { text_.refuse("a new material name", in_quotes(name) + " again"); }
        finish_material();
        made_.materials.push_back({.name = name});
        material_ = name;
    }

    void set_colour() {
        require_material("Kd");
        bool is_good = values().size() == 3;
        for (int part = 0; is_good && part < 3; ++part) {
            const double value = text_.take_number().value_or(-1.0);
            is_good = value >= 0.0 && value <= 1.0;
            made_.materials.back().colour[part] = static_cast<float>(value);
        }
        if (!is_good) { text_.refuse("Kd and three numbers 0..1", in_quotes(text_.line())); }
    }

    /// The words that follow, up to a comment.
    std::vector<std::string_view> values() {
        std::vector<std::string_view> words = text_.words();
        const auto is_comment = [](std::string_view word) { return word.starts_with('#'); };
        words.erase(std::ranges::find_if(words, is_comment), words.end());
        return words;
    }

    /// What of `d` or `Tr` counts is known at the end of the material.
    void take_opacity(std::string_view keyword) {
        require_material(keyword);
        const bool is_d = keyword == "d";
        const bool is_halo = is_d && text_.skip("-halo");
        const std::vector<std::string_view> words = values();
        const auto value = words.empty() ? std::nullopt : finite_number(words.front());
        const std::string_view wrong = is_halo                    ? "without -halo"
                                       : !value                   ? "and a number"
                                       : words.size() > 1         ? "and one number"
                                       : *value < 0 || *value > 1 ? "of 0 to 1"
                                       : !is_d && *value == 1.0   ? "below 1, or d, too"
                                                                  : "";
        if (wrong.empty()) {
            (is_d ? d_ : tr_) = value;
        } else {
            unread_opacities_.push_back({text_.line_number(), fmt::format("{} {}", keyword, wrong), text_of_line()});
        }
    }

    /// `d` takes precedence: beside it nothing is said about a Tr that is not read.
    void finish_material() {
        if (d_ || tr_) { made_.materials.back().opacity = static_cast<float>(d_ ? *d_ : 1.0 - *tr_); }
        for (const UnreadLine& line : unread_opacities_) {
            if (!d_ || line.expected.starts_with("d ")) { note(line); }
        }
        d_ = tr_ = std::nullopt;
        unread_opacities_.clear();
    }

    void take_illumination() {
        require_material("illum");
        constexpr std::string_view expected = "illum and a whole number of 0 to 10";
        const std::vector<std::string_view> words = values();
        const std::string_view first = words.empty() ? std::string_view() : words.front();
        if (first.empty()) { text_.refuse(expected, "none"); }
        if (first.find_first_of("+-.0123456789") != 0) { text_.refuse(expected, in_quotes(first)); }
        const auto model = finite_number(first);
        if (words.size() > 1 || !model || *model < 0.0 || *model > 10.0 || *model != std::floor(*model)) {
            note({text_.line_number(), std::string(expected), text_of_line()});
            return;
        }
        made_.materials.back().is_mirror = *model == 5.0 || *model == 7.0;
    }

    struct UnreadLine {
        int number = 0;
        std::string expected;
        std::string text; ///< printable
        std::string_view outcome = "not read";
        int alike = 0; ///< lines after it of which the same was expected
    };

    std::string text_of_line() const { return in_quotes(text_.line()); }

    /// The first line of each kind is named and the others are counted: exporters write one form for all materials.
    void note(const UnreadLine& line) {
        const auto known = std::ranges::find(unread_, line.expected, &UnreadLine::expected);
        if (known == unread_.end()) {
            unread_.push_back(line);
        } else {
            ++known->alike;
        }
    }

    void finish_notes() {
        std::ranges::sort(unread_, {}, &UnreadLine::number);
        for (const UnreadLine& line : unread_) {
            const std::string others = line.alike == 0 ? "" : fmt::format(", and {} more like it", line.alike);
            made_.notes.push_back(fmt::format("{}:{}: expected {}, got {}{}: {}", path_.string(), line.number,
                line.expected, line.text, others, line.outcome));
        }
    }

    std::filesystem::path path_;
    TextScanner text_;
    MtlFile made_;
    std::set<std::string> names_;
    std::string material_;                     ///< current
    std::optional<double> d_;                  ///< of the current material
    std::optional<double> tr_;                 ///< of the current material
    std::vector<UnreadLine> unread_opacities_; ///< of the current material
    std::vector<UnreadLine> unread_;           ///< of the file
};

} // namespace

MtlFile read_mtl(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, largest_mtl_bytes);
    return MtlReading(path, text).read();
}

namespace {

/// The number of polygons of a file that PolygonModel::notes names; one more note counts the others.
constexpr std::size_t max_notes_of_cuts = 10;

/// A finite number within max_obj_coordinate_m. Throws Error.
double obj_number(std::string_view word, const TextScanner& text) {
    const auto value = finite_number(word);
    if (!value) { text.refuse("a number", in_quotes(word)); }
    if (std::abs(*value) > max_obj_coordinate_m) {
        text.refuse(fmt::format("a number within {:g}", max_obj_coordinate_m), in_quotes(word));
    }
    return *value;
}

/// A comment of an OBJ file that makes a part rotate: # pivot NAME X Y Z axis AX AY AZ [rpm N]
struct PivotLine {
    std::string part;
    Pivot pivot; ///< in body axes; Pivot::part is not set
    int line = 0;
};

/// Reads the current line, a comment; nothing if it does not begin with "# pivot" or lacks the word axis. Throws Error
/// "file:line: ...".
std::optional<PivotLine> pivot_line(TextScanner& text, const FileAxes& axes) {
    const std::vector<std::string_view> words = text.words();
    const bool pivot =
        words.size() > 2 && words[0] == "#" && words[1] == "pivot" && std::ranges::find(words, "axis") != words.end();
    if (!pivot) { return std::nullopt; }
    const auto refuse = [&](std::string_view expected) { text.refuse(expected, in_quotes(text.line())); };
    const bool has_rate = words.size() == 12 && words[10] == "rpm";
    if ((words.size() != 10 && !has_rate) || words[6] != "axis") { refuse("# pivot NAME X Y Z axis AX AY AZ [rpm N]"); }
    const auto number = [&](std::size_t word) { return obj_number(words[word], text); };
    PivotLine read{.part = std::string(words[2]), .pivot = {}, .line = text.line_number()};
    read.pivot.point_m = axes.body_from_file({number(3), number(4), number(5)});
    const glm::dvec3 axis = axes.body_from_file({number(7), number(8), number(9)});
    const double length = glm::length(axis);
    if (length < 1e-6) { refuse("an axis with a length"); }
    // A unit vector stays as written, bit for bit.
    read.pivot.axis = std::abs(length - 1.0) < 1e-14 ? axis : axis / length;
    read.pivot.turns_per_s = has_rate ? number(11) / 60.0 : 0.0;
    return read;
}

using CornerVertices = std::vector<std::uint32_t>;

class PolygonCutting {
public:
    PolygonCutting(PolygonModel& model, const std::filesystem::path& path, std::span<const int> lines)
        : model_(model), path_(path), lines_(lines), tolerance_m_(flatness_tolerance_m(model)) {}

    void cut() {
        const std::vector<Polygon> polygons = std::exchange(model_.polygons, {});
        const CornerVertices corner_vertices = std::exchange(model_.corner_vertices, {});
        all_places_ = std::exchange(model_.corner_texture_coordinates, {});
        const std::vector<glm::vec3> corner_normals = std::exchange(model_.corner_normals, {});
        std::vector<std::uint32_t> parents;
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            const auto corners = std::span(corner_vertices).subspan(polygons[i].first_corner, polygons[i].corner_count);
            corners_ = corners;
            first_corner_ = polygons[i].first_corner;
            for (const CornerVertices& piece : pieces_of(corners, lines_[i])) {
                add(polygons[i], piece);
                for (std::size_t k = 0; k < piece.size() && !corner_normals.empty(); ++k) {
                    const auto at = std::ranges::find(corners, piece[k]) - corners.begin();
                    model_.corner_normals.push_back(
                        corner_normals[polygons[i].first_corner + static_cast<std::size_t>(at)]);
                }
                parents.push_back(static_cast<std::uint32_t>(i));
            }
        }
        if (changed_polygons_ > 0) { model_.parents = std::move(parents); }
        if (changed_polygons_ > max_notes_of_cuts) {
            model_.notes.push_back(fmt::format("{}: {} more polygons are dented, bent or without an area",
                path_.string(), changed_polygons_ - max_notes_of_cuts));
        }
        if (model_.polygons.empty()) { throw_error_in(path_, "expected at least one polygon with an area, got none"); }
    }

private:
    std::vector<CornerVertices> pieces_of(std::span<const std::uint32_t> corners, int line) {
        const CornerVertices outline = different_corners(corners);
        if (outline.size() < 3 || !has_area(outline)) {
            note(line, corners.size(), "has no area: left out");
            return {};
        }
        if (!corners_fault(places_m_, tolerance_m_)) { return {outline}; }
        const bool planar = is_planar(places_m_, tolerance_m_);
        const std::size_t count = outline.size();
        std::vector<CornerVertices> pieces;
        const ConvexPieces convex = convex_pieces(places_m_, tolerance_m_);
        for (const std::vector<std::size_t>& places : convex.pieces) {
            CornerVertices& piece = pieces.emplace_back();
            for (const std::size_t place : places) { piece.push_back(outline[place]); }
        }
        const std::string_view fault = planar ? "dented" : "bent";
        if (convex.fault.empty()) {
            note(line, count, fmt::format("is {}: cut into {}", fault, pieces.size()));
        } else {
            pieces = triangles_of(outline);
            note(line, count, fmt::format("meets itself: drawn as {} triangles", pieces.size()));
        }
        return pieces;
    }

    /// The corners without those in the place of the one before; their places in places_m_.
    CornerVertices different_corners(std::span<const std::uint32_t> corners) {
        CornerVertices outline;
        places_m_.clear();
        for (const std::uint32_t vertex : corners) {
            const glm::dvec3& place_m = model_.vertices_m[vertex];
            if (places_m_.empty() || places_m_.back() != place_m) {
                outline.push_back(vertex);
                places_m_.push_back(place_m);
            }
        }
        while (places_m_.size() > 1 && places_m_.back() == places_m_.front()) {
            outline.pop_back();
            places_m_.pop_back();
        }
        return outline;
    }

    bool has_area(const CornerVertices& outline) {
        places_m_.clear();
        for (const std::uint32_t vertex : outline) { places_m_.push_back(model_.vertices_m[vertex]); }
        return !is_line(places_m_);
    }

    /// An outline whose sides meet, such as one that a doubled side leads around a hole: its triangles that have an
    /// area.
    std::vector<CornerVertices> triangles_of(const CornerVertices& outline) {
        std::vector<CornerVertices> triangles;
        for (const auto& [a, b, c] : triangulate_polygon(places_m_)) {
            if (!is_line(std::array{places_m_[a], places_m_[b], places_m_[c]})) {
                triangles.push_back({outline[a], outline[b], outline[c]});
            }
        }
        return triangles;
    }

    void note(int line, std::size_t corners, std::string_view what) {
        if (++changed_polygons_ <= max_notes_of_cuts) {
            model_.notes.push_back(fmt::format("{}:{}: polygon of {} corners {}", path_.string(), line, corners, what));
        }
    }

    void add(Polygon polygon, const CornerVertices& outline) {
        polygon.first_corner = static_cast<std::uint32_t>(model_.corner_vertices.size());
        polygon.corner_count = static_cast<std::uint32_t>(outline.size());
        model_.polygons.push_back(polygon);
        model_.corner_vertices.insert(model_.corner_vertices.end(), outline.begin(), outline.end());
        for (std::size_t k = 0, from = 0; k < outline.size() && !all_places_.empty(); ++k) {
            from = corner_of(outline[k], k == 0 ? 0 : from + 1);
            model_.corner_texture_coordinates.push_back(all_places_[first_corner_ + from]);
        }
    }

    /// Which corner of the file's polygon has a vertex: the first one from `from` on, else the first of all. Corners of
    /// pieces come in the order of the polygon, begun anywhere.
    std::size_t corner_of(std::uint32_t vertex, std::size_t from) const {
        const auto next = std::ranges::find(
            corners_.begin() + static_cast<std::ptrdiff_t>(std::min(from, corners_.size())), corners_.end(), vertex);
        const auto found = next != corners_.end() ? next : std::ranges::find(corners_, vertex);
        return static_cast<std::size_t>(found - corners_.begin());
    }

    PolygonModel& model_;
    const std::filesystem::path& path_;
    std::span<const int> lines_;
    double tolerance_m_;
    std::vector<glm::dvec3> places_m_; ///< corners of the polygon at hand
    std::span<const std::uint32_t> corners_;
    std::size_t first_corner_ = 0;      ///< of the polygon at hand, as the file has it
    std::vector<glm::vec2> all_places_; ///< texture coordinates of all corners of the file, or none
    std::size_t changed_polygons_ = 0;
};

/// Makes all polygons of a model from a file convex and planar within flatness_tolerance_m. Replaces a concave or bent
/// polygon by its convex_pieces, fills model.parents and adds the note "file:line: polygon of N corners is dented|bent:
/// cut into K". A self-intersecting polygon, for example around a hole, becomes triangles (triangulate_polygon), a
/// polygon without an area is left out, and repeated corners are removed, each with a note. `lines` are the polygons'
/// lines in the file. Throws Error "file: expected ..., got ..." if no polygon is left.
void triangulate_faulty_polygons(PolygonModel& model, const std::filesystem::path& path, std::span<const int> lines) {
    assert(lines.size() == model.polygons.size());
    PolygonCutting(model, path, lines).cut();
}

/// Leaves out polygons of materials that are not seen, with a note; where all are of such, their materials are opaque.
void leave_out_unseen(PolygonModel& model, const std::filesystem::path& path) {
    const auto is_seen = [&](const Polygon& polygon) {
        return model.materials[polygon.material].opacity >= seen_from_opacity;
    };
    const auto unseen =
        model.polygons.size() - static_cast<std::size_t>(std::ranges::count_if(model.polygons, is_seen));
    if (unseen == 0) { return; }
    if (unseen == model.polygons.size()) {
        for (Material& material : model.materials) { material.opacity = 1.0F; }
        model.notes.push_back(path.string() + ": all of it is transparent by its materials: taken for opaque");
        return;
    }
    PolygonModel kept = model;
    kept.polygons.clear();
    kept.parents.clear();
    kept.corner_vertices.clear();
    kept.corner_texture_coordinates.clear();
    kept.corner_normals.clear();
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        Polygon polygon = model.polygons[i];
        if (!is_seen(polygon)) { continue; }
        const auto take = [&](const auto& from, auto& to) {
            if (from.empty()) { return; }
            const auto first = from.begin() + polygon.first_corner;
            to.insert(to.end(), first, first + polygon.corner_count);
        };
        const auto first_corner = static_cast<std::uint32_t>(kept.corner_vertices.size());
        take(model.corner_vertices, kept.corner_vertices);
        take(model.corner_texture_coordinates, kept.corner_texture_coordinates);
        take(model.corner_normals, kept.corner_normals);
        polygon.first_corner = first_corner;
        kept.polygons.push_back(polygon);
        kept.parents.push_back(model.parent_of(i));
    }
    kept.notes.push_back(
        fmt::format("{}: {} polygons are left out: their materials are transparent", path.string(), unseen));
    model = std::move(kept);
}

constexpr std::size_t largest_file_bytes = std::size_t{256} << 20U;
/// All other keywords of the OBJ specification: lines and points, free-form curves and surfaces, display and rendering
/// attributes, calls.
constexpr std::array<std::string_view, 31> ignored_keywords{"l", "p", "vt", "vp", "mg", "bevel", "c_interp", "d_interp",
    "lod", "maplib", "usemap", "shadow_obj", "trace_obj", "ctech", "stech", "cstype", "deg", "bmat", "step", "curv",
    "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con", "call", "csh"};

/// What version 3.0 of the specification lists as superseded: patches and curves.
constexpr std::array<std::string_view, 5> old_keywords{"bsp", "bzp", "cdc", "cdp", "res"};

/// Names in the order of their first use, each with the line of that use.
class Names {
public:
    std::uint32_t index_of(const std::string& name, int line) {
        const auto [at, added] = index_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
        if (added) {
            names_.push_back(name);
            lines_.push_back(line);
        }
        return at->second;
    }

    std::optional<std::uint32_t> find(const std::string& name) const {
        const auto at = index_.find(name);
        return at == index_.end() ? std::nullopt : std::optional(at->second);
    }

    const std::vector<std::string>& names() const { return names_; }

    int line_of(std::size_t index) const { return lines_[index]; }

private:
    std::map<std::string, std::uint32_t> index_;
    std::vector<std::string> names_;
    std::vector<int> lines_;
};

class ObjReading {
public:
    ObjReading(const std::filesystem::path& path, std::string_view text, const FileAxes& axes, bool textures)
        : path_(path), text_(path, text, {.joins_lines = true}), axes_(axes), reads_textures_(textures) {
        model_.name = path.stem().string();
    }

    PolygonModel read() {
        while (text_.next_line()) { take(); }
        if (model_.polygons.empty()) { throw_error_in(path_, "expected at least one polygon (f), got none"); }
        resolve_materials();
        drop_unused_places();
        finish_normals();
        triangulate_faulty_polygons(model_, path_, polygon_lines_);
        leave_out_unseen(model_, path_);
        model_.parts = parts_.names();
        resolve_pivots();
        return std::move(model_);
    }

private:
    void take() {
        if (text_.peek().starts_with('#')) {
            if (auto pivot = pivot_line(text_, axes_)) { pivots_.push_back(std::move(*pivot)); }
            return;
        }
        const std::string_view keyword = text_.word_or_end();
        if (keyword == "v") {
            take_vertex();
        } else if (keyword == "f") {
            take_polygon();
        } else if (keyword == "vt" && reads_textures_) {
            const double u = finite_number(text_.word_or_end()).value_or(0.0);
            const double v = finite_number(text_.word_or_end()).value_or(0.0);
            places_.emplace_back(static_cast<float>(u), static_cast<float>(v));
        } else if (keyword == "vn") {
            take_normal();
        } else if (keyword == "s") {
            const std::string_view word = text_.word_or_end();
            const auto number = whole_number(word);
            smoothing_group_ = word == "off" || number == 0L ? flat_group : std::max(number.value_or(1), 1L);
        } else if (keyword == "g" || keyword == "o") {
            const std::string_view name = text_.rest_of_line();
            part_ = name.empty() ? "default" : std::string(name);
        } else if (keyword == "usemtl") {
            material_ = name("material");
            material_line_ = text_.line_number();
        } else if (keyword == "mtllib") {
            take_material_files();
        } else if (std::ranges::find(old_keywords, keyword) != old_keywords.end()) {
            take_old_statement(keyword);
        } else if (!keyword.empty() && std::ranges::find(ignored_keywords, keyword) == ignored_keywords.end()) {
            text_.refuse_last("an OBJ line (v, f, g, o, usemtl, mtllib)");
        }
    }

    std::string name(std::string_view what) {
        const std::string_view name = text_.rest_of_line();
        if (name.empty()) { text_.refuse(fmt::format("a {} name", what), "none"); }
        return std::string(name);
    }

    void take_vertex() {
        const std::vector<std::string_view>& words = text_.words();
        if (words.size() < 3) { text_.refuse("three coordinates", std::to_string(words.size())); }
        if (model_.vertices_m.size() == max_obj_vertices) {
            text_.refuse(fmt::format("at most {} vertices", max_obj_vertices), "more");
        }
        const auto number = [&](std::size_t word) { return obj_number(words[word], text_); };
        const glm::dvec3 vertex_m(number(0), number(1), number(2));
        model_.vertices_m.push_back(axes_.body_from_file(vertex_m));
    }

    /// Vertex of a corner written as 7, 7/1, 7//3 or 7/1/3.
    std::uint32_t vertex_of(std::string_view corner) const {
        const auto fields = split_fields(corner, '/');
        const auto index = whole_number(fields[0]);
        bool good = index && fields.size() <= 3 && (fields.size() == 1 || !fields.back().empty());
        for (std::size_t i = 1; i < fields.size(); ++i) {
            good = good && (fields[i].empty() || whole_number(fields[i]));
        }
        if (!good) { text_.refuse("a corner such as 7, 7/1, 7//3 or 7/1/3", in_quotes(corner)); }
        const long count = static_cast<long>(model_.vertices_m.size());
        if (*index == 0 || *index > count || *index < -count) {
            text_.refuse(count == 0 ? std::string("vertices before a polygon")
                                    : fmt::format("a vertex 1 to {} (or -{} to -1)", count, count),
                std::to_string(*index));
        }
        return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : count + *index);
    }

    /// Texture coordinates of a corner written as 7/1 or 7/1/3; not numbers where it has none that are there.
    glm::vec2 place_of(std::string_view corner) const {
        constexpr float no_number = std::numeric_limits<float>::quiet_NaN();
        const auto fields = split_fields(corner, '/');
        const auto index = fields.size() < 2 ? std::nullopt : whole_number(fields[1]);
        const long count = static_cast<long>(places_.size());
        if (!index || *index == 0 || *index > count || *index < -count) { return glm::vec2(no_number); }
        return places_[static_cast<std::size_t>(*index > 0 ? *index - 1 : count + *index)];
    }

    /// Texture coordinates of polygons that show no picture, and of those that have some at a part of their corners.
    void drop_unused_places() {
        bool is_any_left = false;
        for (const Polygon& polygon : model_.polygons) {
            if (!reads_textures_) { break; }
            const auto places =
                std::span(model_.corner_texture_coordinates).subspan(polygon.first_corner, polygon.corner_count);
            const bool is_whole = !model_.materials[polygon.material].picture.empty() &&
                                  std::ranges::none_of(places, [](const glm::vec2& at) { return std::isnan(at.x); });
            is_any_left = is_any_left || is_whole;
            if (!is_whole) { std::ranges::fill(places, glm::vec2(std::numeric_limits<float>::quiet_NaN())); }
        }
        if (!is_any_left) { model_.corner_texture_coordinates.clear(); }
    }

    /// vn x y z; what is no direction counts as none.
    void take_normal() {
        glm::dvec3 normal(0.0);
        for (int k = 0; k < 3; ++k) { normal[k] = finite_number(text_.word_or_end()).value_or(0.0); }
        const double length = glm::length(normal);
        const bool is_good = length > 0.0 && std::isfinite(length);
        normals_.push_back(is_good ? glm::vec3(axes_.body_from_file(normal / length)) : glm::vec3(0.0F));
    }

    /// Of a corner written as 7//3 or 7/1/3; zero where it has none that is there.
    glm::vec3 normal_of_corner(std::string_view corner) const {
        const auto fields = split_fields(corner, '/');
        const auto index = fields.size() < 3 ? std::nullopt : whole_number(fields[2]);
        const long count = static_cast<long>(normals_.size());
        if (!index || *index == 0 || *index > count || *index < -count) { return glm::vec3(0.0F); }
        return normals_[static_cast<std::size_t>(*index > 0 ? *index - 1 : count + *index)];
    }

    /// Along a polygon's normal, twice the area long.
    glm::dvec3 area_vector_of(std::span<const std::uint32_t> corners) const {
        glm::dvec3 sum(0.0);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const glm::dvec3& first_m = model_.vertices_m[corners[0]];
            sum += glm::cross(model_.vertices_m[corners[k]] - first_m,
                model_.vertices_m[corners[(k + 1) % corners.size()]] - first_m);
        }
        return sum;
    }

    /// Gives corners without a normal that of their polygon where it is flat, and the mean of the polygons of their
    /// smoothing group where it has one.
    void finish_normals() {
        std::map<std::pair<long, std::uint32_t>, glm::dvec3> sums; // by group and vertex
        const auto each_corner = [&](const auto& visit) {
            for (std::size_t i = 0; i < model_.polygons.size(); ++i) {
                const Polygon& polygon = model_.polygons[i];
                if (smoothing_groups_[i] == no_group) { continue; }
                const glm::dvec3 own = area_vector_of(model_.corners(i));
                for (std::uint32_t corner = polygon.first_corner; corner < polygon.first_corner + polygon.corner_count;
                     ++corner) {
                    visit(smoothing_groups_[i], model_.corner_vertices[corner], own, model_.corner_normals[corner]);
                }
            }
        };
        each_corner([&](long group, std::uint32_t vertex, const glm::dvec3& own, const glm::vec3&) {
            if (group != flat_group) { sums[{group, vertex}] += own; }
        });
        each_corner([&](long group, std::uint32_t vertex, const glm::dvec3& own, glm::vec3& normal) {
            if (normal != glm::vec3(0.0F)) { return; }
            const glm::dvec3 sum = group == flat_group ? own : sums.at({group, vertex});
            const glm::dvec3 along = glm::length(sum) > 0.0 ? sum : own;
            if (glm::length(along) > 0.0) { normal = glm::vec3(glm::normalize(along)); }
        });
        if (std::ranges::all_of(model_.corner_normals, [](const glm::vec3& one) { return one == glm::vec3(0.0F); })) {
            model_.corner_normals.clear();
        }
    }

    void take_polygon() {
        const std::vector<std::string_view>& words = text_.words();
        if (words.size() < 3) { text_.refuse("at least three corners", std::to_string(words.size())); }
        if (words.size() > max_obj_corners_of_polygon) {
            text_.refuse(fmt::format("at most {} corners", max_obj_corners_of_polygon), std::to_string(words.size()));
        }
        if (model_.polygons.size() == max_obj_polygons) {
            text_.refuse(fmt::format("at most {} polygons", max_obj_polygons), "more");
        }
        Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(model_.corner_vertices.size());
        polygon.corner_count = static_cast<std::uint32_t>(words.size());
        polygon.part = parts_.index_of(part_, text_.line_number());
        polygon.material = materials_.index_of(material_, material_line_);
        for (const std::string_view corner : words) {
            model_.corner_vertices.push_back(vertex_of(corner));
            if (reads_textures_) { model_.corner_texture_coordinates.push_back(place_of(corner)); }
            model_.corner_normals.push_back(normal_of_corner(corner));
        }
        smoothing_groups_.push_back(smoothing_group_);
        model_.polygons.push_back(polygon);
        polygon_lines_.push_back(text_.line_number());
    }

    /// The rest of the line is one name with blanks if there is such a file or none of its words names one, else a name
    /// a word.
    void take_material_files() {
        const std::vector<std::string_view>& words = text_.words();
        const std::string all = name("file");
        if (take_material_file(all)) { return; }
        std::vector<std::string> missing;
        for (const std::string_view word : words) {
            const std::string name(word);
            if (!take_material_file(name)) { missing.push_back(name); }
        }
        if (missing.size() == words.size()) { missing = {all}; }
        for (const std::string& name : missing) { note_missing(name); }
    }

    /// Reads a material file; false when there is no such file.
    bool take_material_file(const std::string& name) {
        const std::filesystem::path file = path_.parent_path() / name;
        std::error_code ignored;
        if (std::filesystem::is_directory(file, ignored)) {
            text_.refuse("a material file", "the folder " + in_quotes(name));
        }
        if (!std::filesystem::exists(file, ignored)) { return false; }
        const MtlFile read = read_mtl(file);
        for (const Material& material : read.materials) { read_materials_.insert_or_assign(material.name, material); }
        for (const auto& [material, picture] : read.pictures) { pictures_.insert_or_assign(material, picture); }
        model_.notes.insert(model_.notes.end(), read.notes.begin(), read.notes.end());
        has_material_file_ = true;
        return true;
    }

    void note_missing(const std::string& name) {
        if (missing_files_.insert(name).second) {
            model_.notes.push_back(fmt::format("{}:{}: material file {} is missing, its materials are drawn grey",
                path_.string(), text_.line_number(), printable(name)));
        }
    }

    void take_old_statement(std::string_view keyword) {
        if (old_statements_.insert(std::string(keyword)).second) {
            model_.notes.push_back(fmt::format(
                "{}:{}: {} is an old OBJ statement, ignored", path_.string(), text_.line_number(), keyword));
        }
    }

    void resolve_materials() {
        for (std::size_t i = 0; i < materials_.names().size(); ++i) {
            Material material{.name = materials_.names()[i]};
            const auto known = read_materials_.find(material.name);
            if (known != read_materials_.end()) {
                material = known->second;
            } else if (has_material_file_ && missing_files_.empty() && materials_.line_of(i) > 0) {
                throw_error_at(path_, materials_.line_of(i),
                    fmt::format("expected a material of the material file, got {}", in_quotes(material.name)));
            }
            if (const auto shown = pictures_.find(material.name); reads_textures_ && shown != pictures_.end()) {
                material.picture = shown->second.file;
                const TextureWrap wrap = shown->second.is_clamped ? TextureWrap::Clamp : TextureWrap::Repeat;
                material.texture.wrap_u = material.texture.wrap_v = wrap;
            }
            model_.materials.push_back(material);
        }
    }

    void resolve_pivots() {
        for (const PivotLine& read : pivots_) {
            const auto part = parts_.find(read.part);
            if (!part) {
                throw_error_at(
                    path_, read.line, fmt::format("expected a group with polygons, got {}", in_quotes(read.part)));
            }
            for (const Pivot& known : model_.pivots) {
                if (known.part == *part) {
                    throw_error_at(path_, read.line,
                        fmt::format("expected one pivot a group, got {} again", in_quotes(read.part)));
                }
            }
            model_.pivots.push_back(read.pivot);
            model_.pivots.back().part = *part;
        }
    }

    std::filesystem::path path_;
    TextScanner text_;
    FileAxes axes_;
    PolygonModel model_;
    Names parts_;
    Names materials_; ///< the line is 0 for "default" without usemtl
    std::string part_ = "default";
    std::string material_ = "default";
    int material_line_ = 0;
    static constexpr long no_group = -1;   ///< the file does not say how a polygon is shaded
    static constexpr long flat_group = -2; ///< s off
    long smoothing_group_ = no_group;
    std::vector<long> smoothing_groups_; ///< one for each polygon
    std::vector<glm::vec3> normals_;     ///< body axes; zero: none
    std::map<std::string, Material> read_materials_;
    std::map<std::string, MtlPicture> pictures_;
    bool reads_textures_ = false;
    std::vector<glm::vec2> places_; ///< texture coordinates
    bool has_material_file_ = false;
    std::set<std::string> missing_files_;
    std::set<std::string> old_statements_; ///< superseded keywords that the notes name already
    std::vector<int> polygon_lines_;
    std::vector<PivotLine> pivots_;
};

} // namespace

PolygonModel read_obj(const std::filesystem::path& path, const FileAxes& axes, bool textures) {
    const std::string text = read_text_file(path, largest_file_bytes);
    return ObjReading(path, text, axes, textures).read();
}

} // namespace octant::models::polygons
