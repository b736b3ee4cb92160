#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/mesh_formats.h"
#include "models/repair/repair.h"
#include "sim/base/binary_file.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace octant::models::meshfile {

namespace {

constexpr std::size_t largest_stl_bytes = std::size_t{1} << 30U;
constexpr std::size_t count_at = 80; ///< byte of the number of triangles in a binary file
constexpr std::size_t header_bytes = 84;
constexpr std::size_t triangle_bytes = 50;

/// Corners as they stand in the file, three a triangle; equal ones become one vertex.
class Corners {
public:
    void add(const glm::dvec3& place_m) { places_m_.push_back(place_m); }

    MeshBuilder welded(MeshBuilder& mesh) const {
        const std::vector<std::uint32_t> firsts =
            repair::first_duplicates(places_m_, {}, std::vector<bool>(places_m_.size(), true));
        std::vector<std::uint32_t> vertices(places_m_.size(), invalid_index);
        for (std::uint32_t corner = 0; corner < firsts.size(); ++corner) {
            vertices[corner] = firsts[corner] == corner ? mesh.add_vertex(places_m_[corner]) : vertices[firsts[corner]];
        }
        for (std::size_t corner = 0; corner + 2 < vertices.size(); corner += 3) {
            mesh.add_polygon(std::array<CornerIndices, 3>{CornerIndices{vertices[corner]},
                CornerIndices{vertices[corner + 1]}, CornerIndices{vertices[corner + 2]}});
        }
        return std::move(mesh);
    }

private:
    std::vector<glm::dvec3> places_m_;
};

bool is_word(std::string_view word, std::string_view lower) {
    return std::ranges::equal(
        word, lower, [](char a, char b) { return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b; });
}

class AsciiReading {
public:
    AsciiReading(const std::filesystem::path& path, std::string_view text)
        : words_(path, text, mesh_text), mesh_(path) {}

    MeshBuilder read() {
        take("solid");
        words_.rest_of_line();
        while (true) {
            const std::string_view word = words_.word_or_end();
            if (is_word(word, "facet")) {
                take_facet();
            } else if (is_word(word, "endsolid")) {
                words_.rest_of_line();
                if (words_.word_or_end().empty()) { return corners_.welded(mesh_); }
                words_.rest_of_line(); // another solid's name
            } else {
                words_.refuse("facet or endsolid", word.empty() ? "the end of the file" : in_quotes(word));
            }
        }
    }

private:
    void take(std::string_view expected) {
        const std::string_view word = words_.word(expected);
        if (!is_word(word, expected)) { words_.refuse(expected, in_quotes(word)); }
    }

    /// The normal says nothing that the corners do not, and is often wrong.
    void take_facet() {
        take("normal");
        for (int part = 0; part < 3; ++part) { words_.word("a part of a normal"); }
        take("outer");
        take("loop");
        for (int corner = 0; corner < 3; ++corner) {
            take("vertex");
            const double x = words_.number("a coordinate");
            const double y = words_.number("a coordinate");
            const double z = words_.number("a coordinate");
            corners_.add({x, y, z});
        }
        take("endloop");
        take("endfacet");
    }

    TextScanner words_;
    MeshBuilder mesh_;
    Corners corners_;
};

MeshBuilder read_binary(const std::filesystem::path& path, std::string_view bytes) {
    BinaryReader reader(bytes, path);
    MeshBuilder mesh(path);
    Corners corners;
    reader.take_bytes(count_at, "a header");
    const std::size_t count = reader.take<std::uint32_t>("a number of triangles");
    const std::size_t room = reader.bytes_left() / triangle_bytes;
    if (count > room) {
        reader.refuse_at(
            count_at, fmt::format("at most {} triangles in a file of this size", room), std::to_string(count));
    }
    for (std::size_t t = 0; t < count; ++t) {
        reader.take_bytes(12, "a normal");
        for (int corner = 0; corner < 3; ++corner) {
            glm::dvec3 place_m;
            for (int part = 0; part < 3; ++part) {
                place_m[part] = static_cast<double>(reader.take<float>("a coordinate"));
                if (!(std::abs(place_m[part]) <= max_coordinate)) { // also NaN
                    reader.refuse_at(reader.at() - 4, "a coordinate", fmt::format("{}", place_m[part]));
                }
            }
            corners.add(place_m);
        }
        reader.take_bytes(2, "attributes");
    }
    if (reader.bytes_left() > 0) {
        mesh.add_note(
            fmt::format("{}: {} bytes behind the last triangle are not read", path.string(), reader.bytes_left()));
    }
    return corners.welded(mesh);
}

/// Many binary files begin with "solid" too: the size decides.
bool is_binary(std::string_view bytes) {
    if (bytes.size() >= header_bytes) {
        const std::size_t count = value_at<std::uint32_t>(&bytes[count_at]);
        if (bytes.size() == header_bytes + count * triangle_bytes) { return true; }
    }
    const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    return !is_word(bytes.substr(first, 5), "solid");
}

} // namespace

MeshBuilder read_stl(const std::filesystem::path& path, const ReadOptions& /*options*/) {
    const std::string bytes = read_file(path, largest_stl_bytes);
    return is_binary(bytes) ? read_binary(path, bytes) : AsciiReading(path, bytes).read();
}

std::string stl_bytes(const TriangleMesh& mesh) {
    BinaryWriter out;
    out.put_bytes(fmt::format("{:80}", "binary STL"));
    out.put(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const Triangle& triangle : mesh.triangles) {
        out.put(glm::vec3(normal_of(mesh, triangle)));
        for (const std::uint32_t vertex : triangle) { out.put(glm::vec3(mesh.vertices_m[vertex])); }
        out.put(std::uint16_t{0});
    }
    return out.take();
}

} // namespace octant::models::meshfile
