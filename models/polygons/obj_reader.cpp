#include "models/polygons/obj_reader.h"

#include "models/polygons/convex_pieces.h"
#include "models/polygons/mtl_reader.h"
#include "models/polygons/obj_limits.h"
#include "models/polygons/obj_line_reader.h"
#include "models/polygons/obj_pivots.h"
#include "models/polygons/polygon_check.h"
#include "models/polygons/polygon_model.h"
#include "models/polygons/polygon_triangulation.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::polygons {

namespace {

/// How many polygons of a file are named in PolygonModel::notes; one more note counts the others.
constexpr std::size_t max_notes_of_cuts = 10;

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

/// Makes all polygons of a model that was read from a file convex and planar within flatness_tolerance_m. A dented or
/// bent one is replaced, where it stands, by its convex_pieces; then model.parents is filled and model.notes says
/// "file:line: polygon of N corners is dented|bent: cut into K". One that meets itself, as around a hole, becomes
/// triangles by triangulate_polygon, one without an area is left out; corners in the place of the one before do not
/// count. Notes say so. `lines` are the polygons' lines in the file.
///
/// Throws Error "file: expected ..., got ..." when no polygon is left.
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
