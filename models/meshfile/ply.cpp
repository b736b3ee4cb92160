#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

std::size_t bytes_of(PlyType type) {
    constexpr std::array<std::size_t, 8> bytes{1, 1, 2, 2, 4, 4, 4, 8};
    return bytes.at(static_cast<std::size_t>(type));
}

/// What stands for a colour part of 1: the largest of a whole-number type; 1 for float and double.
double normalization_divisor(PlyType type) {
    constexpr std::array<double, 8> divisors{127.0, 255.0, 32767.0, 65535.0, 2147483647.0, 4294967295.0, 1.0, 1.0};
    return divisors.at(static_cast<std::size_t>(type));
}

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::f32;
    bool is_list = false;
    PlyType count_type = PlyType::u8; ///< of a list
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

struct PlyHeader {
    PlyEncoding form = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::size_t body_at = 0; ///< byte behind the header
    int body_line = 1;
};

using Words = std::vector<std::string_view>;

constexpr std::size_t max_properties = 1000; ///< of all elements

struct TypeName {
    std::string_view name;
    PlyType type;
};

constexpr std::array<TypeName, 16> type_names{
    {{"char", PlyType::i8}, {"int8", PlyType::i8}, {"uchar", PlyType::u8}, {"uint8", PlyType::u8},
        {"short", PlyType::i16}, {"int16", PlyType::i16}, {"ushort", PlyType::u16}, {"uint16", PlyType::u16},
        {"int", PlyType::i32}, {"int32", PlyType::i32}, {"uint", PlyType::u32}, {"uint32", PlyType::u32},
        {"float", PlyType::f32}, {"float32", PlyType::f32}, {"double", PlyType::f64}, {"float64", PlyType::f64}}};

/// The least that one element takes in the body: what a count is held against.
std::size_t min_element_bytes(const PlyElement& element, PlyEncoding form) {
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
        bytes += form == PlyEncoding::ascii ? 2
                 : property.is_list         ? bytes_of(property.count_type)
                                            : bytes_of(property.type);
    }
    return bytes;
}

class HeaderReading {
public:
    HeaderReading(const std::filesystem::path& path, std::string_view bytes)
        : path_(path), text_(path, bytes), bytes_(bytes) {}

    PlyHeader read() {
        if (next_line() != "ply") { text_.refuse("'ply'", in_quotes(line_)); }
        bool has_form = false;
        while (next_line() != "end_header") {
            const Words& words = text_.words();
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") { continue; }
            if (words[0] == "format") {
                take_form(words);
                has_form = true;
            } else if (words[0] == "element") {
                take_element(words);
            } else if (words[0] == "property") {
                take_property(words);
            } else {
                refuse_line("format, element, property, comment or end_header");
            }
        }
        if (!has_form) { text_.refuse("a format line in the header", "none"); }
        header_.body_at = text_.offset();
        header_.body_line = text_.line_number() + 1;
        check_counts();
        return std::move(header_);
    }

private:
    [[noreturn]] void refuse_line(std::string_view expected) const { text_.refuse(expected, in_quotes(line_)); }

    std::string_view next_line() {
        if (!text_.next_line() || text_.is_truncated()) { text_.refuse("end_header", "the end of the file"); }
        line_ = text_.line();
        while (!line_.empty() && (line_.back() == '\r' || line_.back() == ' ')) { line_.remove_suffix(1); }
        return line_;
    }

    void take_form(const Words& words) {
        const std::string_view form = words.size() > 1 ? words[1] : std::string_view();
        if (words.size() != 3 || words[2] != "1.0") { refuse_line("'format FORM 1.0'"); }
        if (form == "ascii") {
            header_.form = PlyEncoding::ascii;
        } else if (form == "binary_little_endian") {
            header_.form = PlyEncoding::little_endian;
        } else if (form == "binary_big_endian") {
            header_.form = PlyEncoding::big_endian;
        } else {
            text_.refuse("ascii, binary_little_endian or binary_big_endian", in_quotes(form));
        }
    }

    void take_element(const Words& words) {
        const auto count = words.size() == 3 ? whole_number(words[2]) : std::nullopt;
        if (!count || *count < 0) { refuse_line("'element NAME COUNT'"); }
        element_lines_.push_back(text_.line_number());
        header_.elements.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
    }

    PlyType type_of(std::string_view name) const {
        for (const TypeName& known : type_names) {
            if (known.name == name) { return known.type; }
        }
        text_.refuse("a type such as uchar, int or float", in_quotes(name));
    }

    void take_property(const Words& words) {
        const bool is_list = words.size() == 5 && words[1] == "list";
        if (!is_list && words.size() != 3) { refuse_line("'property TYPE NAME' or 'property list TYPE TYPE NAME'"); }
        if (header_.elements.empty()) { refuse_line("an element before its property"); }
        if (++properties_ > max_properties) {
            text_.refuse(fmt::format("at most {} properties", max_properties), "more");
        }
        PlyProperty property;
        property.name = std::string(words.back());
        property.is_list = is_list;
        property.type = type_of(words[words.size() - 2]);
        if (is_list) {
            property.count_type = type_of(words[2]);
            if (normalization_divisor(property.count_type) == 1.0) {
                refuse_line("a whole number as the count of a list");
            }
        }
        header_.elements.back().properties.push_back(std::move(property));
    }

    void check_counts() {
        const std::size_t room = bytes_.size() - header_.body_at;
        // The last number of an ascii body may stand without a blank behind it.
        const std::size_t spare = header_.form == PlyEncoding::ascii ? 1 : 0;
        for (std::size_t i = 0; i < header_.elements.size(); ++i) {
            const PlyElement& element = header_.elements[i];
            const std::size_t least = min_element_bytes(element, header_.form);
            if (least > 0 && element.count > (room + spare) / least) {
                throw_error_at(path_, element_lines_[i],
                    fmt::format("expected at most {} of {} in a file of this size, got {}", (room + spare) / least,
                        in_quotes(element.name), element.count));
            }
        }
    }

    std::filesystem::path path_;
    TextScanner text_;
    std::string_view bytes_;
    std::string_view line_; ///< without blanks at its end
    std::size_t properties_ = 0;
    std::vector<int> element_lines_;
    PlyHeader header_;
};

/// The header of a PLY file, checked for what its body can hold at most. Throws Error "file:line".
PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view bytes) {
    return HeaderReading(path, bytes).read();
}

constexpr std::size_t largest_ply_bytes = std::size_t{1} << 30U;

/// Gives the numbers of an ascii body one after the other.
class WordSource {
public:
    WordSource(const std::filesystem::path& path, std::string_view bytes, const PlyHeader& header)
        : words_(path, bytes.substr(header.body_at), mesh_text, header.body_line) {}

    double number(PlyType /*type*/, const char* what) { return words_.number(what); }

    double count(PlyType /*type*/, const char* what) {
        return static_cast<double>(words_.integer(what, 0, 0xffffffffL));
    }

    /// Other properties may be anything, such as nan for a confidence.
    void skip(PlyType /*type*/) { words_.word("a value of a property"); }

    void skip(PlyType type, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) { skip(type); }
    }

    [[noreturn]] void refuse(const std::string& expected, const std::string& got) const {
        words_.refuse(expected, got);
    }

private:
    TextScanner words_;
};

/// Gives the numbers of a binary body one after the other.
class ByteSource {
public:
    ByteSource(const std::filesystem::path& path, std::string_view bytes, const PlyHeader& header)
        : bytes_(bytes, path, header.body_at,
              header.form == PlyEncoding::big_endian ? std::endian::big : std::endian::little) {}

    double number(PlyType type, const char* what) {
        const double value = raw(type, what);
        if (!(std::abs(value) <= max_coordinate)) { // also NaN
            bytes_.refuse_at(bytes_.at() - bytes_of(type), what, fmt::format("{}", value));
        }
        return value;
    }

    double count(PlyType type, const char* what) { return number(type, what); }

    void skip(PlyType type) { bytes_.take_bytes(bytes_of(type), "a value of a property"); }

    void skip(PlyType type, std::size_t count) { bytes_.take_bytes(count * bytes_of(type), "a list of a property"); }

    [[noreturn]] void refuse(const std::string& expected, const std::string& got) const {
        bytes_.refuse(expected, got);
    }

private:
    double raw(PlyType type, const char* what) {
        switch (type) {
        case PlyType::i8:
            return bytes_.take<std::int8_t>(what);
        case PlyType::u8:
            return bytes_.take<std::uint8_t>(what);
        case PlyType::i16:
            return bytes_.take<std::int16_t>(what);
        case PlyType::u16:
            return bytes_.take<std::uint16_t>(what);
        case PlyType::i32:
            return bytes_.take<std::int32_t>(what);
        case PlyType::u32:
            return bytes_.take<std::uint32_t>(what);
        case PlyType::f32:
            return static_cast<double>(bytes_.take<float>(what));
        case PlyType::f64:
            break;
        }
        return bytes_.take<double>(what);
    }

    BinaryReader bytes_;
};

/// What a vertex's property means, in the order of a vertex's eleven values.
constexpr std::array<std::string_view, 11> vertex_names{
    "x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "s", "t"};
constexpr std::size_t first_colour = 6;
constexpr std::size_t first_texture = 9;

/// Other names of the last five values.
constexpr std::array<std::string_view, 5> short_names{"r", "g", "b", "u", "v"};
constexpr std::array<std::string_view, 5> long_names{
    "diffuse_red", "diffuse_green", "diffuse_blue", "texture_u", "texture_v"};

template <typename Source>
class BodyReading {
public:
    BodyReading(const std::filesystem::path& path, std::string_view bytes, const PlyHeader& header)
        : header_(header), path_(path), source_(path, bytes, header), mesh_(path) {}

    MeshBuilder read() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex" && !has_vertices_) {
                take_vertices(element);
            } else if (is_surface(element) && has_vertices_) {
                take_surface(element);
            } else if (is_surface(element)) {
                source_.refuse(
                    fmt::format("the element vertex before the element {}", element.name), element.name + " first");
            } else {
                skip(element);
            }
        }
        if (!not_read_.empty()) {
            mesh_.add_note(
                fmt::format("{}: properties that are not read: {}", path_.string(), fmt::join(not_read_, ", ")));
        }
        return std::move(mesh_);
    }

private:
    static bool is_surface(const PlyElement& element) { return element.name == "face" || element.name == "tristrips"; }

    void skip(const PlyElement& element) {
        if (element.properties.empty()) { return; }
        for (std::size_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) { skip_one(property); }
        }
    }

    void skip_one(const PlyProperty& property) {
        if (property.is_list) {
            source_.skip(property.type, count_of(property));
        } else {
            source_.skip(property.type);
        }
    }

    std::size_t count_of(const PlyProperty& property) {
        const double count = source_.count(property.count_type, "a number of list entries");
        if (count < 0.0) { source_.refuse("a number of list entries", fmt::format("{}", count)); }
        return static_cast<std::size_t>(count);
    }

    /// Slot of a property among a vertex's values.
    static std::optional<std::size_t> slot_of(const PlyProperty& property) {
        for (std::size_t slot = 0; slot < vertex_names.size(); ++slot) {
            if (!property.is_list &&
                (property.name == vertex_names[slot] ||
                    (slot >= first_colour && (property.name == short_names[slot - first_colour] ||
                                                 property.name == long_names[slot - first_colour])))) {
                return slot;
            }
        }
        return std::nullopt;
    }

    void take_vertices(const PlyElement& element) {
        has_vertices_ = true;
        std::vector<std::optional<std::size_t>> slots;
        std::array<bool, vertex_names.size()> has{};
        for (const PlyProperty& property : element.properties) {
            slots.push_back(slot_of(property));
            if (slots.back()) {
                has[*slots.back()] = true;
            } else {
                note_not_read(element, property);
            }
        }
        if (!has[0] || !has[1] || !has[2]) { source_.refuse("the properties x, y and z of a vertex", "fewer"); }
        has_normals_ = has[3] && has[4] && has[5];
        has_colours_ = has[6] && has[7] && has[8];
        has_textures_ = has[9] && has[10];
        for (std::size_t i = 0; i < element.count; ++i) { take_vertex(element, slots); }
    }

    void take_vertex(const PlyElement& element, const std::vector<std::optional<std::size_t>>& slots) {
        std::array<double, vertex_names.size()> values{};
        for (std::size_t p = 0; p < slots.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (!slots[p]) {
                skip_one(property);
            } else if (*slots[p] < first_colour || *slots[p] >= first_texture) {
                values[*slots[p]] = source_.number(property.type, "a coordinate");
            } else {
                values[*slots[p]] = colour_part(property);
            }
        }
        const std::uint32_t vertex = mesh_.add_vertex({values[0], values[1], values[2]});
        if (has_normals_) { mesh_.add_normal({values[3], values[4], values[5]}); }
        if (has_colours_) { mesh_.set_colour(vertex, glm::vec3(glm::dvec3{values[6], values[7], values[8]})); }
        if (has_textures_) { mesh_.add_texture_coordinates(glm::vec2(glm::dvec2{values[9], values[10]})); }
    }

    double colour_part(const PlyProperty& property) {
        const double largest = normalization_divisor(property.type);
        const double value = source_.number(property.type, "a part of a colour");
        if (value < 0.0 || value > largest) {
            source_.refuse(fmt::format("a part of a colour of 0 to {}", largest), fmt::format("{}", value));
        }
        return value / largest;
    }

    void take_surface(const PlyElement& element) {
        bool has_corners = false;
        for (const PlyProperty& property : element.properties) {
            has_corners = has_corners || is_corners(property);
            if (!is_corners(property) && !has_places(element, property)) { note_not_read(element, property); }
        }
        if (!has_corners) { source_.refuse("the list vertex_indices of a " + element.name, "none"); }
        for (std::size_t i = 0; i < element.count; ++i) {
            places_.clear();
            for (const PlyProperty& property : element.properties) {
                if (has_places(element, property)) {
                    take_places(property);
                } else if (!is_corners(property)) {
                    skip_one(property);
                } else if (element.name == "face") {
                    take_face(property);
                } else {
                    take_strips(property);
                }
            }
            if (element.name == "face") { add_face(); }
        }
    }

    /// Texture coordinates of a face's corners, u and v of each.
    void take_places(const PlyProperty& property) {
        for (std::size_t left = count_of(property); left > 0; --left) {
            places_.push_back(source_.number(property.type, "a texture coordinate"));
        }
    }

    void add_face() {
        if (places_.size() == 2 * corners_.size()) {
            for (std::size_t k = 0; k < corners_.size(); ++k) {
                corners_[k].texture =
                    mesh_.add_texture_coordinates(glm::vec2(glm::dvec2{places_[2 * k], places_[2 * k + 1]}));
            }
        }
        mesh_.add_polygon(corners_);
    }

    static bool has_places(const PlyElement& element, const PlyProperty& property) {
        return property.is_list && property.name == "texcoord" && element.name == "face";
    }

    static bool is_corners(const PlyProperty& property) {
        return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
    }

    void take_face(const PlyProperty& property) {
        const std::size_t count = count_of(property);
        if (count < 3 || count > max_polygon_corners) {
            source_.refuse(fmt::format("a face of 3 to {} corners", max_polygon_corners), fmt::format("{}", count));
        }
        corners_.clear();
        for (std::size_t i = 0; i < count; ++i) {
            corners_.push_back(corner(source_.number(property.type, "the number of a vertex")));
        }
    }

    CornerIndices corner(double number) const {
        if (!(number >= 0.0 && number < static_cast<double>(mesh_.vertex_count())) || number != std::floor(number)) {
            source_.refuse(fmt::format("a vertex below {}", mesh_.vertex_count()), fmt::format("{}", number));
        }
        const auto vertex = static_cast<std::uint32_t>(number);
        return {vertex, has_normals_ ? vertex : invalid_index, has_textures_ ? vertex : invalid_index};
    }

    /// Strips of triangles, one behind the other, -1 between them. Every second triangle of a strip has its corners the
    /// other way round; those with a corner twice only lead on.
    void take_strips(const PlyProperty& property) {
        constexpr double next_strip = -1.0;
        corners_.clear();
        for (std::size_t left = count_of(property); left > 0; --left) {
            const double number = source_.number(property.type, "the number of a vertex");
            if (number == next_strip) {
                corners_.clear();
                continue;
            }
            corners_.push_back(corner(number));
            if (const std::size_t count = corners_.size(); count >= 3) {
                const std::size_t other_way = 1 - count % 2;
                add_triangle(corners_[count - 3 + other_way], corners_[count - 2 - other_way]);
            }
        }
    }

    /// Of two corners and the last one of the strip at hand.
    void add_triangle(const CornerIndices& a, const CornerIndices& b) {
        const CornerIndices& c = corners_.back();
        if (a.vertex != b.vertex && b.vertex != c.vertex && c.vertex != a.vertex) {
            mesh_.add_polygon(std::array{a, b, c});
        }
    }

    void note_not_read(const PlyElement& element, const PlyProperty& property) {
        not_read_.push_back(printable(fmt::format("{} of {}", property.name, element.name)));
    }

    const PlyHeader& header_;
    std::filesystem::path path_;
    std::vector<std::string> not_read_; ///< properties
    Source source_;
    MeshBuilder mesh_;
    bool has_vertices_ = false;
    bool has_normals_ = false;
    bool has_colours_ = false;
    bool has_textures_ = false;
    std::vector<CornerIndices> corners_;
    std::vector<double> places_; ///< of the face at hand on its picture
};

} // namespace

MeshBuilder read_ply(const std::filesystem::path& path, const ReadOptions& /*options*/) {
    const std::string bytes = read_file(path, largest_ply_bytes);
    const PlyHeader header = read_ply_header(path, bytes);
    return header.form == PlyEncoding::ascii ? BodyReading<WordSource>(path, bytes, header).read()
                                             : BodyReading<ByteSource>(path, bytes, header).read();
}

namespace {

bool fits_float(const TriangleMesh& mesh) {
    return std::ranges::all_of(
        mesh.vertices_m, [](const glm::dvec3& vertex_m) { return glm::dvec3(glm::vec3(vertex_m)) == vertex_m; });
}

std::uint8_t byte_of(float part) { return static_cast<std::uint8_t>(std::lround(part * 255.0F)); }

bool fits_byte(float part) { return static_cast<float>(byte_of(part) / 255.0) == part; }

bool colours_fit_bytes(const TriangleMesh& mesh) {
    return std::ranges::all_of(mesh.colours,
        [](const glm::vec3& colour) { return fits_byte(colour.x) && fits_byte(colour.y) && fits_byte(colour.z); });
}

/// The only entry of `values` that the corners of each vertex have; empty when one has several. Vertices of no triangle
/// get `without`.
template <typename Value>
std::vector<Value> of_vertices(const TriangleMesh& mesh, const std::vector<Value>& values,
    const std::vector<Triangle>& corners, const Value& without) {
    if (corners.empty()) { return {}; }
    std::vector<std::uint32_t> of_vertex(mesh.vertices_m.size(), invalid_index);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& known = of_vertex[mesh.triangles[t][k]];
            const std::uint32_t value = corners[t][k];
            if (known != invalid_index && (value == invalid_index || values[known] != values[value])) { return {}; }
            known = value;
        }
    }
    std::vector<Value> found;
    found.reserve(of_vertex.size());
    for (const std::uint32_t value : of_vertex) { found.push_back(value == invalid_index ? without : values[value]); }
    return found;
}

std::vector<glm::vec3> vertex_normals(const TriangleMesh& mesh) {
    return of_vertices(mesh, mesh.normals, mesh.corner_normals, glm::vec3(0.0F, 0.0F, 1.0F));
}

std::vector<glm::vec2> vertex_textures(const TriangleMesh& mesh) {
    return of_vertices(mesh, mesh.texture_coordinates, mesh.corner_texture_coordinates, glm::vec2(0.0F));
}

/// A face's list of corners and, where `textures`, of their texture coordinates as MeshLab has them.
void put_face(BinaryWriter& out, const TriangleMesh& mesh, std::size_t t, bool textures) {
    out.put(std::uint8_t{3});
    out.put(mesh.triangles[t]);
    if (!textures) { return; }
    const Triangle& corners = mesh.corner_texture_coordinates[t];
    out.put(std::uint8_t{static_cast<std::uint8_t>(corners[0] == invalid_index ? 0 : 6)});
    for (const std::uint32_t corner : corners) {
        if (corner != invalid_index) { out.put(mesh.texture_coordinates[corner]); }
    }
}

} // namespace

bool has_vertex_normals(const TriangleMesh& mesh) { return !vertex_normals(mesh).empty(); }

std::string ply_bytes(const TriangleMesh& mesh) {
    const bool is_float = fits_float(mesh);
    const bool has_colours = !mesh.colours.empty();
    const bool byte_colours = colours_fit_bytes(mesh);
    const std::vector<glm::vec3> normals = vertex_normals(mesh);
    const std::vector<glm::vec2> textures = vertex_textures(mesh);
    const bool face_textures = textures.empty() && !mesh.corner_texture_coordinates.empty();
    std::string head = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.vertices_m.size());
    const auto add_properties = [&](std::string_view type, std::string_view names) {
        for (const char name : names) { head += fmt::format("property {} {}\n", type, name); }
    };
    add_properties(is_float ? "float" : "double", "xyz");
    if (!normals.empty()) { head += "property float nx\nproperty float ny\nproperty float nz\n"; }
    if (has_colours) {
        for (const std::string_view part : {"red", "green", "blue"}) {
            head += fmt::format("property {} {}\n", byte_colours ? "uchar" : "float", part);
        }
    }
    if (!textures.empty()) { add_properties("float", "st"); }
    head += fmt::format("element face {}\nproperty list uchar uint vertex_indices\n{}end_header\n",
        mesh.triangles.size(), face_textures ? "property list uchar float texcoord\n" : "");
    BinaryWriter out;
    out.put_bytes(head);
    for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v) {
        if (is_float) {
            out.put(glm::vec3(mesh.vertices_m[v]));
        } else {
            out.put(mesh.vertices_m[v]);
        }
        if (!normals.empty()) { out.put(normals[v]); }
        for (int part = 0; has_colours && part < 3; ++part) {
            if (byte_colours) {
                out.put(byte_of(mesh.colours[v][part]));
            } else {
                out.put(mesh.colours[v][part]);
            }
        }
        if (!textures.empty()) { out.put(textures[v]); }
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) { put_face(out, mesh, t, face_textures); }
    return out.take();
}

} // namespace octant::models::meshfile
