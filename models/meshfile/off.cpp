// Geomview's Object File Format, as text, in three dimensions.
#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace octant::models::meshfile {

namespace {

constexpr std::size_t largest_off_bytes = std::size_t{1} << 30U;

/// What the header says that each vertex has besides its place.
struct OffHeader {
    bool has_normals = false;
    bool has_colours = false;
    bool has_textures = false;
    std::size_t body_at = 0; ///< byte at which the counts begin
};

/// Takes the word from the beginning of a text, if it stands there.
bool take(std::string_view& text, std::string_view word) {
    const bool is_there = text.starts_with(word);
    text.remove_prefix(is_there ? word.size() : 0);
    return is_there;
}

/// The header is a word such as COFF or STCNOFF, which may be missing; counts may follow without a blank.
OffHeader read_header(const std::filesystem::path& path, std::string_view text) {
    OffHeader header;
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    const auto line = 1 + static_cast<int>(std::ranges::count(text.substr(0, first), '\n'));
    std::string_view rest = text.substr(first);
    if (!rest.empty() && rest.front() >= '0' && rest.front() <= '9' && !rest.starts_with("4OFF")) {
        header.body_at = first;
        return header;
    }
    header.has_textures = take(rest, "ST");
    header.has_colours = take(rest, "C");
    header.has_normals = take(rest, "N");
    if (!take(rest, "OFF") || rest.substr(rest.find_first_not_of(" \t")).starts_with("BINARY")) {
        const std::string_view word = text.substr(first, text.find_first_of("\r\n", first) - first);
        throw_error_at(path, line,
            fmt::format("expected OFF, COFF, NOFF, STOFF or a mixture of them, as text and in three "
                        "dimensions, got {}",
                in_quotes(word)));
    }
    header.body_at = text.size() - rest.size();
    return header;
}

class OffReading {
public:
    /// `text` has no comments.
    OffReading(const std::filesystem::path& path, std::string_view text)
        : header_(read_header(path, text)),
          words_(path, text.substr(header_.body_at), mesh_text,
              1 + static_cast<int>(std::ranges::count(text.substr(0, header_.body_at), '\n'))),
          mesh_(path), path_(path) {}

    MeshBuilder read() {
        const auto most = static_cast<long>(words_.bytes_left());
        const long vertices = words_.integer("the number of vertices", 0, most);
        const long faces = words_.integer("the number of faces", 0, most);
        words_.rest_of_line(); // The number of edges, which nobody needs.
        for (long i = 0; i < vertices; ++i) { take_vertex(); }
        for (long i = 0; i < faces; ++i) { take_face(); }
        if (small_faces_ > 0) {
            mesh_.add_note(
                fmt::format("{}: faces of fewer than 3 corners are not read: {}", path_.string(), small_faces_));
        }
        if (has_map_colours_) {
            mesh_.add_note(
                fmt::format("{}: colours of faces that are numbers of a colour map are not read", path_.string()));
        }
        return std::move(mesh_);
    }

private:
    glm::dvec3 triple(const char* what) {
        const double x = words_.number(what);
        const double y = words_.number(what);
        return {x, y, words_.number(what)};
    }

    /// Place, normal, colour and texture coordinates, in this order. Many files that say OFF have colours behind the
    /// places, too.
    void take_vertex() {
        const std::uint32_t vertex = mesh_.add_vertex(triple("a coordinate"));
        if (header_.has_normals) { mesh_.add_normal(triple("a normal")); }
        const int line = words_.line_number();
        std::vector<std::string_view> rest = split_words(words_.rest_of_line());
        if (header_.has_textures) {
            if (rest.size() < 2) { refuse(line, "texture coordinates behind a vertex", rest); }
            TextScanner numbers(path_, text_of(rest, rest.size() - 2), mesh_text, line);
            const double u = numbers.number("a texture coordinate");
            mesh_.add_texture_coordinates(glm::vec2(glm::dvec2(u, numbers.number("a texture coordinate"))));
            rest.resize(rest.size() - 2);
        }
        if (!rest.empty() || header_.has_colours) { mesh_.set_colour(vertex, colour(rest, line)); }
    }

    void take_face() {
        const long count = words_.integer("a number of corners", 1, static_cast<long>(max_polygon_corners));
        corners_.clear();
        for (long i = 0; i < count; ++i) {
            const auto vertex = static_cast<std::uint32_t>(
                words_.integer("the number of a vertex", 0, static_cast<long>(mesh_.vertex_count()) - 1));
            corners_.push_back(
                {vertex, header_.has_normals ? vertex : invalid_index, header_.has_textures ? vertex : invalid_index});
        }
        const int line = words_.line_number();
        const std::vector<std::string_view> rest = split_words(words_.rest_of_line());
        has_map_colours_ = has_map_colours_ || rest.size() == 1;
        const std::uint32_t material = rest.size() < 2 ? invalid_index : mesh_.face_colour_material(colour(rest, line));
        if (count < 3) {
            ++small_faces_;
        } else {
            mesh_.add_polygon(corners_, material);
        }
    }

    /// Red, green, blue and perhaps opacity, which is not read: whole numbers 0..255 or others 0..1.
    glm::vec3 colour(const std::vector<std::string_view>& words, int line) const {
        if (words.size() < 3 || words.size() > 4) { refuse(line, "a colour of 3 or 4 numbers", words); }
        const bool is_whole =
            std::ranges::all_of(words, [](std::string_view word) { return word.find_first_of(".eE") == word.npos; });
        const double most = is_whole ? 255.0 : 1.0;
        glm::dvec3 parts(0.0);
        for (int part = 0; part < 3; ++part) {
            const auto value = finite_number(words[static_cast<std::size_t>(part)]);
            if (!value || *value < 0.0 || *value > most) {
                refuse(line, fmt::format("parts of a colour of 0 to {}", most), words);
            }
            parts[part] = *value / most;
        }
        return glm::vec3(parts);
    }

    /// The line's words from one on.
    static std::string_view text_of(const std::vector<std::string_view>& words, std::size_t from) {
        return {words[from].data(), words.back().end()};
    }

    [[noreturn]] void refuse(int line, const std::string& expected, const std::vector<std::string_view>& words) const {
        throw_error_at(path_, line,
            fmt::format("expected {}, got {}", expected, words.empty() ? "none" : in_quotes(text_of(words, 0))));
    }

    OffHeader header_;
    TextScanner words_;
    MeshBuilder mesh_;
    std::filesystem::path path_;
    std::vector<CornerIndices> corners_;
    std::size_t small_faces_ = 0;
    bool has_map_colours_ = false;
};

} // namespace

MeshBuilder read_off(const std::filesystem::path& path, const ReadOptions& /*options*/) {
    std::string text = read_text_file(path, largest_off_bytes);
    for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at)) {
        for (; at < text.size() && text[at] != '\n'; ++at) { text[at] = ' '; }
    }
    return OffReading(path, text).read();
}

} // namespace octant::models::meshfile
