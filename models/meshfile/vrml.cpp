#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "models/meshfile/mesh_join.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

constexpr TextRules vrml_rules{
    .separators = ",", .marks = "{}[]", .comment = '#', .has_strings = true, .max_number = max_coordinate};

bool is_mark(std::string_view word) {
    return !word.empty() && vrml_rules.marks.find(word.front()) != std::string_view::npos;
}

/// A field of a VRML node: nodes, or the text of its other values as it stands in the file.
struct VrmlField {
    std::vector<std::uint32_t> nodes; ///< places in VrmlFile::nodes
    std::string_view text;            ///< without the brackets of a list
    int line = 1;                     ///< where the text begins
};

struct VrmlNode {
    std::string_view type;
    std::string_view name; ///< of its DEF; often empty
    int line = 1;
    std::map<std::string_view, VrmlField> fields; ///< the last one of each name

    /// The field of a name; null where the node has none.
    const VrmlField* field(std::string_view field_name) const {
        const auto found = fields.find(field_name);
        return found == fields.end() ? nullptr : &found->second;
    }
};

struct VrmlFile {
    std::vector<VrmlNode> nodes;      ///< a node stands behind those in its fields
    std::vector<std::uint32_t> roots; ///< in file order
    bool has_prototypes = false;      ///< passed over, and so are the nodes made of them
};

constexpr int max_vrml_use_depth = 100;

class Nodes {
public:
    Nodes(const std::filesystem::path& path, std::string_view text) : text_(text), words_(path, text, vrml_rules) {}

    VrmlFile read() {
        if (!text_.starts_with("#VRML V2.0")) {
            words_.refuse("'#VRML V2.0'", in_quotes(text_.substr(0, text_.find('\n'))));
        }
        while (!words_.peek().empty()) {
            if (!passed_over()) { file_.roots.push_back(take_node(0)); }
        }
        return std::move(file_);
    }

private:
    static bool is_name(std::string_view word) {
        const auto first = static_cast<unsigned char>(word.empty() ? '0' : word.front());
        return (std::isalpha(first) != 0 || first == '_' || first >= 0x80) && word != "TRUE" && word != "FALSE" &&
               word != "NULL";
    }

    std::string_view take_name(std::string_view what) {
        const std::string_view word = words_.word(what);
        if (!is_name(word)) { words_.refuse(what, in_quotes(word)); }
        return word;
    }

    /// Whether the next words are a node: DEF, USE or a type with its brace.
    bool node_follows() {
        const std::string_view word = words_.peek();
        if (word == "DEF" || word == "USE") { return true; }
        return is_name(word) && words_.peek_second() == "{";
    }

    /// Passes over what stands between a mark and its partner.
    void skip_balanced(char open, char close) {
        if (words_.word("a bracket") != std::string_view(&open, 1)) {
            words_.refuse(fmt::format("'{}'", open), in_quotes(words_.peek()));
        }
        for (std::size_t depth = 1; depth > 0;) {
            const std::string_view word = words_.word(fmt::format("'{}'", close));
            depth += static_cast<std::size_t>(word.front() == open);
            depth -= static_cast<std::size_t>(word.front() == close);
        }
    }

    /// Passes over ROUTE A.a TO B.b and prototypes; false where neither begins.
    bool passed_over() {
        const std::string_view word = words_.peek();
        if (word == "ROUTE") {
            for (int i = 0; i < 4; ++i) { words_.word("a route"); }
            return true;
        }
        if (word != "PROTO" && word != "EXTERNPROTO") { return false; }
        file_.has_prototypes = true;
        words_.word("PROTO");
        take_name("a name of a prototype");
        skip_balanced('[', ']');
        if (word == "PROTO") {
            skip_balanced('{', '}');
        } else if (words_.peek() == "[") {
            skip_balanced('[', ']');
        } else {
            words_.word("an address");
        }
        return true;
    }

    std::uint32_t take_node(int depth) {
        if (depth > max_vrml_use_depth) {
            words_.refuse(fmt::format("nodes at most {} deep", max_vrml_use_depth), "a deeper one");
        }
        std::string_view word = take_name("a node");
        if (word == "USE") {
            const std::string_view name = take_name("a name");
            const auto known = named_.find(name);
            if (known == named_.end()) { words_.refuse("a name that DEF gave to a node before", in_quotes(name)); }
            return known->second;
        }
        VrmlNode node;
        if (word == "DEF") {
            node.name = take_name("a name");
            word = take_name("a node");
        }
        node.type = word;
        node.line = words_.line_number();
        if (words_.word("'{'") != "{") {
            words_.refuse(fmt::format("'{{' after {}", printable(std::string(word))), "something else");
        }
        while (words_.peek() != "}") {
            if (!passed_over()) {
                const std::string_view field = take_name("a field or '}'");
                node.fields.insert_or_assign(field, take_field(depth));
            }
        }
        words_.word("'}'");
        const auto made = static_cast<std::uint32_t>(file_.nodes.size());
        if (!node.name.empty()) { named_.insert_or_assign(node.name, made); }
        file_.nodes.push_back(std::move(node));
        return made;
    }

    VrmlField take_field(int depth) {
        VrmlField field;
        const bool is_list = words_.peek() == "[";
        if (is_list) { words_.word("'['"); }
        words_.peek();
        field.line = words_.line_number();
        const std::size_t first = words_.offset();
        std::size_t last = first;
        while (true) {
            if (node_follows()) {
                field.nodes.push_back(take_node(depth + 1));
                if (!is_list) { return field; }
                continue;
            }
            const std::string_view word = words_.peek();
            if (word.empty()) { words_.refuse(is_list ? "']'" : "'}'", "the end of the file"); }
            if (is_list ? word == "]" : word == "}" || is_name(word)) { break; }
            if (is_mark(word)) { words_.refuse("a value of a field", in_quotes(word)); }
            words_.word("a value");
            last = words_.offset();
        }
        if (field.nodes.empty()) { field.text = text_.substr(first, last - first); }
        if (is_list) { words_.word("']'"); }
        return field;
    }

    std::string_view text_;
    TextScanner words_;
    VrmlFile file_;
    std::map<std::string_view, std::uint32_t> named_;
};

/// The nodes of a VRML 2.0 (97) file, views into `text`. USE gives the node of the DEF before it, so that no node lies
/// in itself. Throws Error "file:line: ...".
VrmlFile read_vrml_nodes(const std::filesystem::path& path, std::string_view text) { return Nodes(path, text).read(); }

constexpr double max_rad = 1e6;

/// The matrix that turns by an angle around an axis, the right hand's way.
glm::dmat3 turned_about(const glm::dvec3& axis, double angle_rad) {
    const double length = glm::length(axis);
    if (!(length > 0.0)) { return glm::dmat3(1.0); }
    const glm::dvec3 a = axis / length;
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const auto image = [&](const glm::dvec3& v) {
        return v * c + glm::cross(a, v) * s + a * (glm::dot(a, v) * (1.0 - c));
    };
    return {image({1.0, 0.0, 0.0}), image({0.0, 1.0, 0.0}), image({0.0, 0.0, 1.0})};
}

/// Values of the fields of VRML nodes; a field that a node has not gives what VRML says or what the caller does. Faults
/// throw Error "file:line: ...".
class VrmlFields {
public:
    /// Keeps references to both.
    VrmlFields(const std::filesystem::path& path, const VrmlFile& file) : path_(path), file_(file) {}

    glm::dvec3 vector(const VrmlNode& node, std::string_view name, const glm::dvec3& otherwise) const {
        const auto v = numbers(node, name, {otherwise.x, otherwise.y, otherwise.z});
        return {v[0], v[1], v[2]};
    }

    /// The whole numbers of a field; none where the node has no such field.
    std::vector<long> indices(const VrmlNode& node, std::string_view name) const {
        std::vector<long> found;
        if (const VrmlField* field = node.field(name)) {
            TextScanner words(path_, field->text, vrml_rules, field->line);
            while (!words.peek().empty()) { found.push_back(words.integer("a whole number")); }
        }
        return found;
    }

    /// Points of the list `name` of the node in a field of another node; none without either.
    template <class Point>
    std::vector<Point> points(const VrmlNode& set, std::string_view field_name, std::string_view name) const {
        std::vector<Point> found;
        const VrmlNode* node = only_node(set, field_name);
        const VrmlField* field = node == nullptr ? nullptr : node->field(name);
        if (field == nullptr) { return found; }
        TextScanner words(path_, field->text, vrml_rules, field->line);
        while (!words.peek().empty()) {
            Point& point = found.emplace_back();
            for (int k = 0; k < Point::length(); ++k) { point[k] = words.number("a number"); }
        }
        return found;
    }

    /// The first text in quotes of a field; empty without.
    static std::string first_text(const VrmlNode& node, std::string_view name) {
        const VrmlField* field = node.field(name);
        const std::size_t open = field == nullptr ? std::string_view::npos : field->text.find('"');
        const std::size_t close = open == std::string_view::npos ? open : field->text.find('"', open + 1);
        return close == std::string_view::npos ? std::string()
                                               : std::string(field->text.substr(open + 1, close - open - 1));
    }

    /// The value of a field; true where the node has no such field.
    bool flag(const VrmlNode& node, std::string_view name) const {
        const VrmlField* field = node.field(name);
        if (field == nullptr || field->text == "TRUE") { return true; }
        if (field->text != "FALSE") {
            throw_error_at(path_, field->line, "expected TRUE or FALSE, got " + in_quotes(field->text));
        }
        return false;
    }

    double number(const VrmlNode& node, std::string_view name, double otherwise) const {
        return numbers(node, name, {otherwise}).front();
    }

    /// The node, or the first one, in a field; null without.
    const VrmlNode* only_node(const VrmlNode& node, std::string_view name) const {
        const VrmlField* field = node.field(name);
        return field == nullptr || field->nodes.empty() ? nullptr : &file_.nodes[field->nodes.front()];
    }

    /// How a Transform places the nodes that it holds.
    AffineTransform placement(const VrmlNode& node) const {
        const glm::dvec3 centre_m = vector(node, "center", glm::dvec3(0.0));
        const glm::dvec3 scale = vector(node, "scale", glm::dvec3(1.0));
        const glm::dmat3 slant = turn(node, "scaleOrientation");
        glm::dmat3 scaled(1.0);
        for (int part = 0; part < 3; ++part) { scaled[part][part] = scale[part]; }
        AffineTransform made;
        made.turn = turn(node, "rotation");
        if (scale != glm::dvec3(1.0)) { made.turn = made.turn * slant * scaled * glm::transpose(slant); }
        made.shift_m = vector(node, "translation", glm::dvec3(0.0)) + centre_m - made.turn * centre_m;
        return made;
    }

    /// Place of a node in VrmlFile::nodes.
    std::uint32_t place_of(const VrmlNode& node) const {
        return static_cast<std::uint32_t>(&node - file_.nodes.data());
    }

private:
    std::vector<double> numbers(const VrmlNode& node, std::string_view name, std::vector<double> otherwise) const {
        const VrmlField* field = node.field(name);
        if (field == nullptr) { return otherwise; }
        TextScanner words(path_, field->text, vrml_rules, field->line);
        for (double& value : otherwise) { value = words.number(name); }
        return otherwise;
    }

    glm::dmat3 turn(const VrmlNode& node, std::string_view name) const {
        const auto v = numbers(node, name, {0.0, 0.0, 1.0, 0.0});
        if (std::abs(v[3]) > max_rad) {
            throw_error_at(path_, node.line, fmt::format("expected an angle in radians, got {}", v[3]));
        }
        return turned_about({v[0], v[1], v[2]}, v[3]);
    }

    const std::filesystem::path& path_;
    const VrmlFile& file_;
};

constexpr std::size_t largest_vrml_bytes = std::size_t{1} << 28U;
constexpr int max_vrml_depth = 200;
constexpr std::size_t max_visits = 1'000'000;                   ///< of nodes that USE brings back again and again
constexpr std::size_t max_vrml_numbers = std::size_t{1} << 27U; ///< of corners and points, likewise

/// Grouping nodes, with the field that holds their children.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> groups{
    {{"Transform", "children"}, {"Group", "children"}, {"Anchor", "children"}, {"Billboard", "children"},
        {"Collision", "children"}, {"LOD", "level"}}};

/// The lists of an IndexedFaceSet; indices are empty where the file gives none.
struct FaceSet {
    std::vector<long> corners;
    std::vector<long> colour_indices;
    std::vector<long> normal_indices;
    std::vector<long> texture_indices;
    std::vector<glm::dvec3> colours;
    std::size_t textures = 0;        ///< texture coordinates
    std::uint32_t first_texture = 0; ///< of the mesh's
    PolygonPicture picture;
    std::size_t normals = 0;
    std::uint32_t first_normal = 0; ///< of the mesh's
    bool colour_per_vertex = true;
    bool normal_per_vertex = true;
    bool counter_clockwise = true;
    int line = 1;
};

class VrmlReading {
public:
    VrmlReading(const std::filesystem::path& path, std::string_view text, const ReadOptions& options)
        : path_(path), file_(read_vrml_nodes(path_, text)), fields_(path_, file_), mesh_(path, options),
          used_materials_(file_.nodes.size(), invalid_index) {}

    MeshBuilder read() {
        for (const std::uint32_t root : file_.roots) { visit(root, {}, 0, 0); }
        if (file_.has_prototypes) { mesh_.add_note(fmt::format("{}: prototypes are not read", path_.string())); }
        if (has_moved_textures_) {
            mesh_.add_note(fmt::format("{}: transforms of texture coordinates are not read", path_.string()));
        }
        return std::move(mesh_);
    }

private:
    [[noreturn]] void refuse(int line, std::string_view expected, std::string_view got) const {
        throw_error_at(path_, line, fmt::format("expected {}, got {}", expected, got));
    }

    /// `group` tells apart the places at which a node is met.
    void visit(std::uint32_t at, const AffineTransform& placement, std::size_t group, int depth) {
        const VrmlNode& node = file_.nodes[at];
        if (depth > max_vrml_depth || ++visits_ > max_visits) {
            refuse(node.line, fmt::format("at most {} nodes, {} deep", max_visits, max_vrml_depth), "more");
        }
        if (node.type == "Shape") {
            take_shape(node, placement, group);
            return;
        }
        if (node.type == "Switch") {
            take_switch(node, placement, depth);
            return;
        }
        const auto* const kind = std::ranges::find(groups, node.type, [](const auto& g) { return g.first; });
        const VrmlField* children = kind == groups.end() ? nullptr : node.field(kind->second);
        if (children == nullptr) { return; }
        const bool first_only = node.type == "LOD";
        const AffineTransform inner = node.type == "Transform" ? placement.of(fields_.placement(node)) : placement;
        const std::size_t inner_group = visits_;
        for (const std::uint32_t child : children->nodes) {
            visit(child, inner, inner_group, depth + 1);
            if (first_only) { return; }
        }
    }

    void take_switch(const VrmlNode& node, const AffineTransform& placement, int depth) {
        const VrmlField* which = node.field("whichChoice");
        const VrmlField* choices = node.field("choice");
        if (which == nullptr || choices == nullptr) { return; }
        TextScanner words(path_, which->text, vrml_rules, which->line);
        const long chosen = words.integer("a choice");
        if (chosen >= 0 && std::cmp_less(chosen, choices->nodes.size())) {
            visit(choices->nodes[static_cast<std::size_t>(chosen)], placement, visits_, depth + 1);
        }
    }

    void take_shape(const VrmlNode& shape, const AffineTransform& placement, std::size_t group) {
        const VrmlNode* set = fields_.only_node(shape, "geometry");
        const VrmlNode* coord = set == nullptr ? nullptr : fields_.only_node(*set, "coord");
        if (coord == nullptr || set->type != "IndexedFaceSet") { return; }
        FaceSet faces;
        faces.corners = fields_.indices(*set, "coordIndex");
        count_numbers(faces.corners.size(), set->line);
        faces.colour_indices = fields_.indices(*set, "colorIndex");
        faces.normal_indices = fields_.indices(*set, "normalIndex");
        faces.colours = fields_.points<glm::dvec3>(*set, "color", "color");
        faces.colour_per_vertex = fields_.flag(*set, "colorPerVertex");
        faces.normal_per_vertex = fields_.flag(*set, "normalPerVertex");
        faces.counter_clockwise = fields_.flag(*set, "ccw") != placement.mirrors();
        faces.line = set->line;
        std::ranges::for_each(faces.colours, [&](const glm::dvec3& colour) { check_colour(colour, set->line); });
        faces.first_normal = static_cast<std::uint32_t>(mesh_.normal_count());
        for (const glm::dvec3& normal : fields_.points<glm::dvec3>(*set, "normal", "vector")) {
            mesh_.add_normal(placement.normal(normal));
            ++faces.normals;
        }
        faces.texture_indices = fields_.indices(*set, "texCoordIndex");
        faces.first_texture = static_cast<std::uint32_t>(mesh_.texture_coordinates_count());
        for (const glm::dvec2& place : fields_.points<glm::dvec2>(*set, "texCoord", "point")) {
            mesh_.add_texture_coordinates(glm::vec2(place));
            ++faces.textures;
        }
        take_points(*set, *coord, placement, group);
        const std::uint32_t material = faces.textures > 0 ? pictured_material_of(shape, faces.picture) : invalid_index;
        take_faces(faces, material == invalid_index ? material_of(shape) : material);
    }

    /// What a node holds counts each time that it is met.
    void count_numbers(std::size_t count, int line) {
        numbers_ += count;
        if (numbers_ > max_vrml_numbers) {
            refuse(line, fmt::format("at most {} corners and points", max_vrml_numbers), "more");
        }
    }

    /// Shapes of one group that have the same points share their vertices.
    void take_points(const VrmlNode& set, const VrmlNode& coord, const AffineTransform& placement, std::size_t group) {
        const auto key = std::pair(group, fields_.place_of(coord));
        const auto known = points_.find(key);
        if (known != points_.end()) {
            std::tie(first_point_, point_count_) = known->second;
            return;
        }
        first_point_ = mesh_.vertex_count();
        for (const glm::dvec3& own_m : fields_.points<glm::dvec3>(set, "coord", "point")) {
            const auto place_m = placement.point_m(own_m);
            if (!place_m) { refuse(coord.line, "points within bounds", "one that its node moves out of them"); }
            mesh_.add_vertex(*place_m);
        }
        point_count_ = mesh_.vertex_count() - first_point_;
        count_numbers(point_count_, coord.line);
        coloured_.resize(mesh_.vertex_count());
        points_.emplace(key, std::pair(first_point_, point_count_));
    }

    void check_colour(const glm::dvec3& colour, int line) const {
        if (const auto fault = colour_fault(colour)) {
            refuse(line, "colours of numbers 0..1", fmt::format("{}", *fault));
        }
    }

    /// The material of a shape on which a picture lies, whose colours VRML takes in place of the material's, and the
    /// picture where pictures are read; invalid_index where the shape has none.
    std::uint32_t pictured_material_of(const VrmlNode& shape, PolygonPicture& picture) {
        const VrmlNode* appearance = fields_.only_node(shape, "appearance");
        const VrmlNode* texture = appearance == nullptr ? nullptr : fields_.only_node(*appearance, "texture");
        if (texture == nullptr || texture->type != "ImageTexture") { return invalid_index; }
        has_moved_textures_ = has_moved_textures_ || appearance->field("textureTransform") != nullptr;
        const std::string file = VrmlFields::first_text(*texture, "url");
        if (file.empty()) { return invalid_index; }
        if (mesh_.uses_pictures()) {
            picture.picture = mesh_.pictures().picture(file);
            picture.wrap_u = fields_.flag(*texture, "repeatS") ? TextureWrap::Repeat : TextureWrap::Clamp;
            picture.wrap_v = fields_.flag(*texture, "repeatT") ? TextureWrap::Repeat : TextureWrap::Clamp;
            if (picture.picture == PolygonPicture::none) { return invalid_index; }
        }
        const auto [at, is_new] = pictured_materials_.try_emplace(file, invalid_index);
        if (is_new) {
            at->second = mesh_.add_material(
                {.name = "picture", .colour = glm::vec3(1.0F), .picture = picture_file(path_, file).string()});
        }
        return at->second;
    }

    std::uint32_t material_of(const VrmlNode& shape) {
        const VrmlNode* appearance = fields_.only_node(shape, "appearance");
        const VrmlNode* node = appearance == nullptr ? nullptr : fields_.only_node(*appearance, "material");
        if (node == nullptr || node->type != "Material") { return invalid_index; }
        std::uint32_t& used = used_materials_[fields_.place_of(*node)];
        if (used == invalid_index) {
            const glm::dvec3 colour = fields_.vector(*node, "diffuseColor", glm::dvec3(0.8));
            check_colour(colour, node->line);
            const double clear = std::clamp(fields_.number(*node, "transparency", 0.0), 0.0, 1.0);
            const std::string name(node->name.empty() ? "material" : node->name);
            used = mesh_.add_material(
                {.name = name, .colour = glm::vec3(colour), .opacity = static_cast<float>(1.0 - clear)});
        }
        return used;
    }

    void take_faces(const FaceSet& faces, std::uint32_t material) {
        std::size_t first = 0;
        for (std::size_t face = 0; first < faces.corners.size(); ++face) {
            const auto begin = faces.corners.begin() + static_cast<long>(first);
            const auto end = std::find(begin, faces.corners.end(), -1);
            const auto count = static_cast<std::size_t>(end - begin);
            if (count < 3 || count > max_polygon_corners) {
                refuse(faces.line, fmt::format("faces of 3 to {} corners", max_polygon_corners), std::to_string(count));
            }
            take_face(faces, face, first, count, material);
            first += count + 1;
        }
    }

    std::size_t checked(long index, std::size_t count, const FaceSet& faces, const char* what) {
        if (index < 0 || std::cmp_greater_equal(index, count)) {
            refuse(faces.line, fmt::format("{} below {}", what, count), std::to_string(index));
        }
        return static_cast<std::size_t>(index);
    }

    /// Index of a colour or a normal: of its own list, of the corner's point or of the face.
    std::size_t attribute(const FaceSet& faces, const std::vector<long>& own, bool per_vertex, std::size_t face,
        std::size_t corner, std::size_t count, const char* what) {
        const std::size_t at = per_vertex ? corner : face;
        if (!own.empty()) { return checked(at < own.size() ? own[at] : -1, count, faces, what); }
        return checked(per_vertex ? faces.corners[corner] : static_cast<long>(face), count, faces, what);
    }

    void take_face(
        const FaceSet& faces, std::size_t face, std::size_t first, std::size_t count, std::uint32_t material) {
        polygon_.clear();
        for (std::size_t corner = first; corner < first + count; ++corner) {
            const std::size_t point = checked(faces.corners[corner], point_count_, faces, "a point");
            CornerIndices made{static_cast<std::uint32_t>(first_point_ + point)};
            if (!faces.colours.empty() && faces.colour_per_vertex) {
                made.vertex = coloured(made.vertex, glm::vec3(faces.colours[attribute(faces, faces.colour_indices, true,
                                                        face, corner, faces.colours.size(), "a colour")]));
            }
            if (faces.normals > 0) {
                made.normal =
                    faces.first_normal + static_cast<std::uint32_t>(attribute(faces, faces.normal_indices,
                                             faces.normal_per_vertex, face, corner, faces.normals, "a normal"));
            }
            if (faces.textures > 0) {
                made.texture = faces.first_texture + static_cast<std::uint32_t>(attribute(faces, faces.texture_indices,
                                                         true, face, corner, faces.textures, "a texture coordinate"));
            }
            polygon_.push_back(made);
        }
        if (!faces.counter_clockwise) { std::ranges::reverse(polygon_); }
        if (!faces.colours.empty() && !faces.colour_per_vertex) {
            material = mesh_.face_colour_material(glm::vec3(faces.colours[attribute(
                faces, faces.colour_indices, false, face, first, faces.colours.size(), "a colour")]));
        }
        mesh_.add_polygon(polygon_, material, faces.picture);
    }

    /// The vertex itself, or for each further colour a copy of it.
    std::uint32_t coloured(std::uint32_t vertex, const glm::vec3& colour) {
        if (!coloured_[vertex]) {
            coloured_[vertex] = true;
            mesh_.set_colour(vertex, colour);
            copies_[{vertex, colour.x, colour.y, colour.z}] = vertex;
            return vertex;
        }
        const auto [at, is_new] = copies_.try_emplace({vertex, colour.x, colour.y, colour.z}, invalid_index);
        if (is_new) {
            at->second = mesh_.add_vertex(mesh_.vertex_m(vertex));
            mesh_.set_colour(at->second, colour);
            coloured_.resize(mesh_.vertex_count(), true);
        }
        return at->second;
    }

    std::filesystem::path path_;
    VrmlFile file_;
    VrmlFields fields_;
    MeshBuilder mesh_;
    std::vector<std::uint32_t> used_materials_; ///< of each node
    std::map<std::pair<std::size_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> points_;
    std::size_t first_point_ = 0; ///< of the face set at hand
    std::size_t point_count_ = 0;
    std::vector<bool> coloured_; ///< vertices that have a colour
    std::map<std::tuple<std::uint32_t, float, float, float>, std::uint32_t> copies_;
    std::vector<CornerIndices> polygon_;
    std::size_t visits_ = 0;
    std::size_t numbers_ = 0;                                 ///< met so far
    std::map<std::string, std::uint32_t> pictured_materials_; ///< by the files of their pictures
    bool has_moved_textures_ = false;
};

} // namespace

MeshBuilder read_vrml(const std::filesystem::path& path, const ReadOptions& options) {
    const std::string text = read_text_file(path, largest_vrml_bytes);
    return VrmlReading(path, text, options).read();
}

namespace {

/// Words that no DEF may take: those of VRML itself, and those of the lists below.
constexpr std::array<std::string_view, 10> taken_words{
    "DEF", "USE", "TRUE", "FALSE", "NULL", "PROTO", "ROUTE", "points", "colours", "normals"};

template <typename Vector>
void append_list(std::string& text, std::string_view head, const std::vector<Vector>& vectors) {
    text += fmt::format("      {} [\n", head);
    for (const Vector& vector : vectors) { text += fmt::format("{} {} {},\n", vector.x, vector.y, vector.z); }
    text += "      ] }\n";
}

/// Writes one shape for each material, or one for all triangles without materials. The first shape defines the lists
/// that the others use.
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
            const float clear = 1.0F - mesh_.materials[material].opacity;
            text_ += fmt::format("    appearance Appearance {{ material DEF {} Material {{ diffuseColor {} {} {}{} "
                                 "}} }}\n",
                identifier(names_[material]), colour.x, colour.y, colour.z,
                clear > 0.0F ? fmt::format(" transparency {}", clear) : "");
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
                text_ += fmt::format("{} {} {} -1\n", a, b, c);
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
