#include "models/polygons/obj_reader.h"

#include "models/polygons/polygon_model.h"
#include "models/polygons/polygon_outlines.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
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

bool is_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    return first != std::string_view::npos && line[first] == '#';
}

/// Takes the backslash off the end; false when there is none.
bool goes_on(std::string_view& line) {
    if (!line.ends_with('\\')) { return false; }
    line.remove_suffix(1);
    return true;
}

} // namespace

std::string_view without_byte_order_mark(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) { text.remove_prefix(3); }
    return text;
}

ObjLineReader::ObjLineReader(std::string_view text) : rest_(without_byte_order_mark(text)) {}

/// Takes the next line off the rest, which must not be empty.
std::string_view ObjLineReader::next_line() {
    ++lines_;
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    if (line.ends_with('\r')) { line.remove_suffix(1); }
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    return line;
}

bool ObjLineReader::next() {
    if (rest_.empty()) { return false; }
    text_ = next_line();
    number_ = lines_;
    if (is_comment(text_) || !goes_on(text_)) { return true; }
    joined_ = text_;
    bool more = true;
    while (more && !rest_.empty()) {
        std::string_view part = next_line();
        more = goes_on(part);
        joined_ += ' ';
        joined_ += part;
    }
    text_ = joined_;
    return true;
}

std::string_view after_first_word(std::string_view line) {
    constexpr std::string_view blanks = " \t\r";
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    line.remove_prefix(std::min(line.find_first_of(blanks), line.size()));
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    return line.substr(0, line.find_last_not_of(blanks) + 1);
}

namespace {

/// Reads a finite number within max_obj_coordinate_m. Throws Error "file:line: ...".
double obj_number(std::string_view word, const std::filesystem::path& path, int line) {
    const auto value = finite_number(word);
    if (!value) {
        throw_error_at(path, line, fmt::format("expected a number, got '{}'", printable(std::string(word))));
    }
    if (std::abs(*value) > max_obj_coordinate_m) {
        throw_error_at(path, line,
            fmt::format("expected a number within {:g}, got '{}'", max_obj_coordinate_m, printable(std::string(word))));
    }
    return *value;
}

constexpr std::size_t largest_mtl_bytes = std::size_t{16} << 20U;

class MtlReading {
public:
    explicit MtlReading(const std::filesystem::path& path) : path_(path) {}

    std::vector<Material> read() {
        const std::string text = read_text_file(path_, largest_mtl_bytes);
        for (const std::string_view line : split_lines(without_byte_order_mark(text))) {
            ++line_;
            const auto words = split_words(line);
            if (!words.empty() && words[0] == "newmtl") {
                add_material(std::string(after_first_word(line)));
            } else if (!words.empty() && words[0] == "Kd") {
                set_colour(words, line);
            }
        }
        return std::move(materials_);
    }

private:
    void add_material(const std::string& name) {
        if (name.empty()) { throw_error_at(path_, line_, "expected a material name after newmtl, got none"); }
        if (!names_.insert(name).second) {
            throw_error_at(path_, line_, fmt::format("expected a new material name, got '{}' again", printable(name)));
        }
        materials_.push_back({.name = name});
    }

    void set_colour(const std::vector<std::string_view>& words, std::string_view line) {
        if (materials_.empty()) { throw_error_at(path_, line_, "expected newmtl before Kd, got Kd"); }
        glm::vec3 colour(0.0F);
        bool good = words.size() == 4;
        for (int part = 0; good && part < 3; ++part) {
            const auto value = finite_number(words[static_cast<std::size_t>(part) + 1]);
            good = value && *value >= 0.0 && *value <= 1.0;
            colour[part] = good ? static_cast<float>(*value) : 0.0F;
        }
        if (!good) {
            throw_error_at(path_, line_,
                fmt::format("expected Kd and three numbers 0..1, got '{}'", printable(std::string(line))));
        }
        materials_.back().colour = colour;
    }

    std::filesystem::path path_;
    std::vector<Material> materials_;
    std::set<std::string> names_;
    int line_ = 0;
};

} // namespace

std::vector<Material> read_mtl(const std::filesystem::path& path) { return MtlReading(path).read(); }

std::map<std::string, std::string> pictures_of_mtl(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, largest_mtl_bytes);
    std::map<std::string, std::string> pictures;
    std::string material;
    for (const std::string_view line : split_lines(without_byte_order_mark(text))) {
        const auto words = split_words(line);
        if (!words.empty() && words[0] == "newmtl") {
            material = std::string(after_first_word(line));
        } else if (words.size() >= 2 && words[0] == "map_Kd") {
            const bool has_options = words[1].starts_with('-'); // else the name may have blanks
            pictures.insert_or_assign(material, std::string(has_options ? words.back() : after_first_word(line)));
        }
    }
    return pictures;
}

std::map<std::string, float> opacities_of_mtl(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, largest_mtl_bytes);
    std::map<std::string, float> by_d;
    std::map<std::string, float> all; // by Tr at first
    std::string material;
    for (const std::string_view line : split_lines(without_byte_order_mark(text))) {
        const auto words = split_words(line);
        if (!words.empty() && words[0] == "newmtl") { material = std::string(after_first_word(line)); }
        const auto value = words.size() == 2 ? finite_number(words[1]) : std::nullopt;
        if (!value || *value < 0.0 || *value > 1.0) { continue; }
        if (words[0] == "d") {
            by_d.insert_or_assign(material, static_cast<float>(*value));
        } else if (words[0] == "Tr" && *value < 1.0) {
            all.insert_or_assign(material, 1.0F - static_cast<float>(*value));
        }
    }
    for (const auto& [name, opacity] : by_d) { all.insert_or_assign(name, opacity); }
    std::erase_if(all, [](const auto& one) { return one.second >= 1.0F; });
    return all;
}

namespace {

/// The number of polygons of a file that PolygonModel::notes names; one more note counts the others.
constexpr std::size_t max_notes_of_cuts = 10;

/// A comment of an OBJ file that makes a part rotate: # pivot NAME X Y Z axis AX AY AZ [rpm N]
struct PivotLine {
    std::string part;
    Pivot pivot; ///< in body axes; Pivot::part is not set
    int line = 0;
};

/// Reads a comment; nothing if it does not begin with "# pivot" or lacks the word axis. Throws Error "file:line: ...".
std::optional<PivotLine> pivot_line(
    std::string_view comment, const FileAxes& axes, const std::filesystem::path& path, int line) {
    const auto words = split_words(comment);
    const bool pivot =
        words.size() > 2 && words[0] == "#" && words[1] == "pivot" && std::ranges::find(words, "axis") != words.end();
    if (!pivot) { return std::nullopt; }
    const auto refuse = [&](std::string_view expected) {
        throw_error_at(path, line, fmt::format("expected {}, got '{}'", expected, printable(std::string(comment))));
    };
    const bool has_rate = words.size() == 12 && words[10] == "rpm";
    if ((words.size() != 10 && !has_rate) || words[6] != "axis") { refuse("# pivot NAME X Y Z axis AX AY AZ [rpm N]"); }
    const auto number = [&](std::size_t word) { return obj_number(words[word], path, line); };
    PivotLine read{.part = std::string(words[2]), .pivot = {}, .line = line};
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
        std::vector<std::uint32_t> parents;
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            const auto corners = std::span(corner_vertices).subspan(polygons[i].first_corner, polygons[i].corner_count);
            for (const CornerVertices& piece : pieces_of(corners, lines_[i])) {
                add(polygons[i], piece);
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
    }

    PolygonModel& model_;
    const std::filesystem::path& path_;
    std::span<const int> lines_;
    double tolerance_m_;
    std::vector<glm::dvec3> places_m_; ///< corners of the polygon at hand
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

constexpr std::size_t largest_file_bytes = std::size_t{256} << 20U;
/// All other keywords of the OBJ specification: lines and points, free-form curves and surfaces, display and rendering
/// attributes, calls.
constexpr std::array<std::string_view, 33> ignored_keywords{"s", "l", "p", "vt", "vn", "vp", "mg", "bevel", "c_interp",
    "d_interp", "lod", "maplib", "usemap", "shadow_obj", "trace_obj", "ctech", "stech", "cstype", "deg", "bmat", "step",
    "curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con", "call", "csh"};

/// What version 3.0 of the specification lists as superseded: patches and curves.
constexpr std::array<std::string_view, 5> old_keywords{"bsp", "bzp", "cdc", "cdp", "res"};

using Words = std::vector<std::string_view>;

std::string in_quotes(std::string_view text) { return fmt::format("'{}'", printable(std::string(text))); }

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
    ObjReading(const std::filesystem::path& path, const FileAxes& axes) : path_(path), axes_(axes) {
        model_.name = path.stem().string();
    }

    PolygonModel read() {
        const std::string text = read_text_file(path_, largest_file_bytes);
        ObjLineReader lines(text);
        while (lines.next()) {
            line_ = lines.number();
            take(lines.text());
        }
        if (model_.polygons.empty()) { throw_error_in(path_, "expected at least one polygon (f), got none"); }
        triangulate_faulty_polygons(model_, path_, polygon_lines_);
        model_.parts = parts_.names();
        resolve_materials();
        resolve_pivots();
        return std::move(model_);
    }

private:
    [[noreturn]] void refuse(const std::string& what) const { throw_error_at(path_, line_, what); }

    void take(std::string_view line) {
        const Words words = split_words(line);
        if (words.empty()) { return; }
        const std::string_view keyword = words[0];
        if (keyword.front() == '#') {
            if (auto pivot = pivot_line(line, axes_, path_, line_)) { pivots_.push_back(std::move(*pivot)); }
        } else if (keyword == "v") {
            take_vertex(words);
        } else if (keyword == "f") {
            take_polygon(words);
        } else if (keyword == "g" || keyword == "o") {
            const std::string_view name = after_first_word(line);
            part_ = name.empty() ? "default" : std::string(name);
        } else if (keyword == "usemtl") {
            material_ = name_after(line, "material");
            material_line_ = line_;
        } else if (keyword == "mtllib") {
            take_material_files(name_after(line, "file"), words);
        } else if (std::ranges::find(old_keywords, keyword) != old_keywords.end()) {
            take_old_statement(keyword);
        } else if (std::ranges::find(ignored_keywords, keyword) == ignored_keywords.end()) {
            refuse(fmt::format("expected an OBJ line (v, f, g, o, usemtl, mtllib), got {}", in_quotes(keyword)));
        }
    }

    std::string name_after(std::string_view line, std::string_view what) const {
        const std::string_view name = after_first_word(line);
        if (name.empty()) { refuse(fmt::format("expected a {} name, got none", what)); }
        return std::string(name);
    }

    glm::dvec3 numbers(const Words& words, std::size_t first) const {
        const auto number = [&](std::size_t word) { return obj_number(words[word], path_, line_); };
        return {number(first), number(first + 1), number(first + 2)};
    }

    void take_vertex(const Words& words) {
        if (words.size() < 4) { refuse(fmt::format("expected three coordinates, got {}", words.size() - 1)); }
        if (model_.vertices_m.size() == max_obj_vertices) {
            refuse(fmt::format("expected at most {} vertices, got more", max_obj_vertices));
        }
        model_.vertices_m.push_back(axes_.body_from_file(numbers(words, 1)));
    }

    /// Vertex of a corner written as 7, 7/1, 7//3 or 7/1/3.
    std::uint32_t vertex_of(std::string_view corner) const {
        const auto fields = split_fields(corner, '/');
        const auto index = whole_number(fields[0]);
        bool good = index && fields.size() <= 3 && (fields.size() == 1 || !fields.back().empty());
        for (std::size_t i = 1; i < fields.size(); ++i) {
            good = good && (fields[i].empty() || whole_number(fields[i]));
        }
        if (!good) {
            refuse(fmt::format("expected a corner such as 7, 7/1, 7//3 or 7/1/3, got {}", in_quotes(corner)));
        }
        const long count = static_cast<long>(model_.vertices_m.size());
        if (*index == 0 || *index > count || *index < -count) {
            refuse(count == 0 ? fmt::format("expected vertices before a polygon, got {}", *index)
                              : fmt::format("expected a vertex 1 to {} (or -{} to -1), got {}", count, count, *index));
        }
        return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : count + *index);
    }

    void take_polygon(const Words& words) {
        const std::size_t count = words.size() - 1;
        if (count < 3) { refuse(fmt::format("expected at least three corners, got {}", count)); }
        if (count > max_obj_corners_of_polygon) {
            refuse(fmt::format("expected at most {} corners, got {}", max_obj_corners_of_polygon, count));
        }
        if (model_.polygons.size() == max_obj_polygons) {
            refuse(fmt::format("expected at most {} polygons, got more", max_obj_polygons));
        }
        Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(model_.corner_vertices.size());
        polygon.corner_count = static_cast<std::uint32_t>(count);
        polygon.part = parts_.index_of(part_, line_);
        polygon.material = materials_.index_of(material_, material_line_);
        for (std::size_t i = 1; i < words.size(); ++i) { model_.corner_vertices.push_back(vertex_of(words[i])); }
        model_.polygons.push_back(polygon);
        polygon_lines_.push_back(line_);
    }

    /// `all` is the line after its keyword: one name with blanks if there is such a file or none of the words is one,
    /// else a name a word.
    void take_material_files(const std::string& all, const Words& words) {
        if (take_material_file(all)) { return; }
        std::vector<std::string> missing;
        for (std::size_t i = 1; i < words.size(); ++i) {
            const std::string name(words[i]);
            if (!take_material_file(name)) { missing.push_back(name); }
        }
        if (missing.size() + 1 == words.size()) { missing = {all}; }
        for (const std::string& name : missing) { note_missing(name); }
    }

    /// Reads a material file; false when there is no such file.
    bool take_material_file(const std::string& name) {
        const std::filesystem::path file = path_.parent_path() / name;
        std::error_code ignored;
        if (std::filesystem::is_directory(file, ignored)) {
            refuse(fmt::format("expected a material file, got the folder {}", in_quotes(name)));
        }
        if (!std::filesystem::exists(file, ignored)) { return false; }
        for (const Material& material : read_mtl(file)) { colours_.insert_or_assign(material.name, material.colour); }
        has_material_file_ = true;
        return true;
    }

    void note_missing(const std::string& name) {
        if (missing_files_.insert(name).second) {
            model_.notes.push_back(fmt::format("{}:{}: material file {} is missing, its materials are drawn grey",
                path_.string(), line_, printable(name)));
        }
    }

    void take_old_statement(std::string_view keyword) {
        if (old_statements_.insert(std::string(keyword)).second) {
            model_.notes.push_back(
                fmt::format("{}:{}: {} is an old OBJ statement, ignored", path_.string(), line_, keyword));
        }
    }

    void resolve_materials() {
        for (std::size_t i = 0; i < materials_.names().size(); ++i) {
            Material material{.name = materials_.names()[i]};
            const auto known = colours_.find(material.name);
            if (known != colours_.end()) {
                material.colour = known->second;
            } else if (has_material_file_ && missing_files_.empty() && materials_.line_of(i) > 0) {
                throw_error_at(path_, materials_.line_of(i),
                    fmt::format("expected a material of the material file, got {}", in_quotes(material.name)));
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
    FileAxes axes_;
    PolygonModel model_;
    Names parts_;
    Names materials_; ///< the line is 0 for "default" without usemtl
    std::string part_ = "default";
    std::string material_ = "default";
    int material_line_ = 0;
    std::map<std::string, glm::vec3> colours_;
    bool has_material_file_ = false;
    std::set<std::string> missing_files_;
    std::set<std::string> old_statements_; ///< superseded keywords that the notes name already
    std::vector<int> polygon_lines_;
    std::vector<PivotLine> pivots_;
    int line_ = 0;
};

} // namespace

PolygonModel read_obj(const std::filesystem::path& path, const FileAxes& axes) { return ObjReading(path, axes).read(); }

} // namespace octant::models::polygons
