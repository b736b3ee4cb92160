#include "models/meshfile/level_chain.h"

#include "models/meshfile/binary_file.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace octant::models::meshfile {

namespace {

/// How chains hold meshes and models: each list behind its 64-bit count, numbers little endian as they are in memory,
/// so that nothing is rounded.
void append_mesh(std::string& bytes, const TriangleMesh& mesh);
void append_model(std::string& bytes, const polygons::PolygonModel& model);
void append_text(std::string& bytes, const std::string& text);

/// Throw Error "file: at byte N: ..." for what the file cannot hold, indices out of range, numbers that are not finite,
/// and what is not as TriangleMesh and PolygonModel say.
TriangleMesh take_mesh(ByteReader& reader);
polygons::PolygonModel take_model(ByteReader& reader);
std::string take_text(ByteReader& reader);

void append(std::string& bytes, std::uint32_t value) { append_number(bytes, value); }

void append(std::string& bytes, double value) { append_number(bytes, value); }

template <int size, typename Part>
void append(std::string& bytes, const glm::vec<size, Part>& vector) {
    for (int part = 0; part < size; ++part) { append_number(bytes, vector[part]); }
}

void append(std::string& bytes, const Triangle& triangle) {
    for (const std::uint32_t index : triangle) { append(bytes, index); }
}

void append(std::string& bytes, const std::string& text) { append_text(bytes, text); }

void append(std::string& bytes, const Material& material) {
    append_text(bytes, material.name);
    append(bytes, material.colour);
}

void append(std::string& bytes, const polygons::Polygon& polygon) {
    append(bytes, polygon.first_corner);
    append(bytes, polygon.corner_count);
    append(bytes, polygon.material);
    append(bytes, polygon.part);
}

void append(std::string& bytes, const polygons::Pivot& pivot) {
    append(bytes, pivot.part);
    append(bytes, pivot.point_m);
    append(bytes, pivot.axis);
    append(bytes, pivot.turns_per_s);
}

template <typename Entry>
void append(std::string& bytes, const std::vector<Entry>& entries) {
    append_number(bytes, static_cast<std::uint64_t>(entries.size()));
    for (const Entry& entry : entries) { append(bytes, entry); }
}

/// What one entry of a list takes at least.
template <typename Entry>
constexpr std::size_t min_bytes = sizeof(Entry);
template <>
constexpr std::size_t min_bytes<std::string> = 8;
template <>
constexpr std::size_t min_bytes<Material> = 20;
template <>
constexpr std::size_t min_bytes<polygons::Pivot> = 60;

/// Takes what append made, in the same order.
class Taking {
public:
    explicit Taking(ByteReader& reader) : reader_(reader) {}

    void take(std::uint32_t& value) { value = reader_.number<std::uint32_t>("a whole number"); }

    template <typename Part>
    requires std::is_floating_point_v<Part>

    void take(Part& value) {
        value = reader_.number<Part>("a number");
        if (!std::isfinite(value)) {
            reader_.refuse_at(reader_.at() - sizeof(Part), "a finite number", fmt::format("{}", value));
        }
    }

    template <int size, typename Part>
    void take(glm::vec<size, Part>& vector) {
        for (int part = 0; part < size; ++part) { take(vector[part]); }
    }

    void take(Triangle& triangle) {
        for (std::uint32_t& index : triangle) { take(index); }
    }

    void take(std::string& text) { text = take_text(reader_); }

    void take(Material& material) {
        take(material.name);
        take(material.colour);
    }

    void take(polygons::Polygon& polygon) {
        take(polygon.first_corner);
        take(polygon.corner_count);
        take(polygon.material);
        take(polygon.part);
    }

    void take(polygons::Pivot& pivot) {
        take(pivot.part);
        take(pivot.point_m);
        take(pivot.axis);
        take(pivot.turns_per_s);
    }

    template <typename Entry>
    void take(std::vector<Entry>& entries) {
        const std::size_t at = reader_.at();
        const std::size_t most = reader_.bytes_left() / min_bytes<Entry>;
        const auto count = reader_.number<std::uint64_t>("a count");
        if (count > most) { reader_.refuse_at(at, fmt::format("a count of at most {}", most), std::to_string(count)); }
        entries.resize(count);
        for (Entry& entry : entries) { take(entry); }
    }

    void check(bool good, const char* expected) const {
        if (!good) { reader_.refuse(fmt::format("{} before", expected), "other ones"); }
    }

private:
    ByteReader& reader_;
};

/// Calls `visit` for all that chains hold of a mesh, in the order of the file.
template <typename Mesh, typename Visit>
void each_part_of_mesh(Mesh& mesh, const Visit& visit) {
    visit(mesh.name);
    visit(mesh.vertices_m);
    visit(mesh.colours);
    visit(mesh.triangles);
    visit(mesh.normals);
    visit(mesh.corner_normals);
    visit(mesh.materials);
    visit(mesh.triangle_materials);
    visit(mesh.notes);
}

template <typename Model, typename Visit>
void each_part_of_model(Model& model, const Visit& visit) {
    visit(model.name);
    visit(model.vertices_m);
    visit(model.corner_vertices);
    visit(model.polygons);
    visit(model.materials);
    visit(model.parts);
    visit(model.pivots);
    visit(model.parents);
    visit(model.notes);
}

bool all_below(const std::vector<Triangle>& triangles, std::size_t count) {
    for (const auto& [a, b, c] : triangles) {
        if (a >= count || b >= count || c >= count) { return false; }
    }
    return true;
}

bool all_below(const std::vector<std::uint32_t>& indices, std::size_t count) {
    for (const std::uint32_t index : indices) {
        if (index >= count) { return false; }
    }
    return true;
}

bool is_colour(const glm::vec3& colour) {
    return glm::min(colour, glm::vec3(0.0F)) == glm::vec3(0.0F) && glm::max(colour, glm::vec3(1.0F)) == glm::vec3(1.0F);
}

bool sound(const std::vector<Material>& materials) {
    return std::ranges::all_of(materials, [](const Material& material) { return is_colour(material.colour); });
}

template <typename Part>
bool is_unit(const glm::vec<3, Part>& vector) {
    return std::abs(glm::length(vector) - Part(1)) < Part(1e-3);
}

/// Whether polygons have all corners among them, one polygon's behind the other's, each a few.
bool corners_in_order(const polygons::PolygonModel& model) {
    constexpr std::uint32_t most = 1000; // what follows looks at all pairs
    std::size_t next = 0;
    for (const polygons::Polygon& polygon : model.polygons) {
        if (polygon.first_corner != next || polygon.corner_count < 3 || polygon.corner_count > most) { return false; }
        next += polygon.corner_count;
    }
    return next == model.corner_vertices.size();
}

bool sound(const polygons::PolygonModel& model, const polygons::Polygon& polygon) {
    return polygon.material < model.materials.size() && polygon.part < model.parts.size();
}

/// Whether all polygons are convex; their corners must be valid indices.
bool all_convex(const polygons::PolygonModel& model) {
    const double tolerance_m = polygons::flatness_tolerance_m(model);
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        if (model.polygons[i].corner_count > 3 && polygons::polygon_fault(model, i, tolerance_m)) { return false; }
    }
    return true;
}

bool one_pivot_a_part(const polygons::PolygonModel& model) {
    std::vector<char> turns(model.parts.size(), 0);
    return std::ranges::all_of(model.pivots, [&](const polygons::Pivot& pivot) { return ++turns[pivot.part] == 1; });
}

void append_text(std::string& bytes, const std::string& text) {
    append_number(bytes, static_cast<std::uint64_t>(text.size()));
    bytes += text;
}

std::string take_text(ByteReader& reader) {
    const auto size = reader.number<std::uint64_t>("a length");
    return std::string(reader.take(size, "a text"));
}

void append_mesh(std::string& bytes, const TriangleMesh& mesh) {
    each_part_of_mesh(mesh, [&](const auto& part) { append(bytes, part); });
}

TriangleMesh take_mesh(ByteReader& reader) {
    Taking taking(reader);
    TriangleMesh mesh;
    each_part_of_mesh(mesh, [&](auto& part) { taking.take(part); });
    const std::size_t count = mesh.triangles.size();
    taking.check(count > 0, "triangles");
    taking.check(mesh.colours.empty() || mesh.colours.size() == mesh.vertices_m.size(), "a colour for each vertex");
    taking.check(mesh.corner_normals.size() == (mesh.normals.empty() ? 0 : count), "normals for each triangle");
    taking.check(
        mesh.triangle_materials.size() == (mesh.materials.empty() ? 0 : count), "a material for each triangle");
    taking.check(all_below(mesh.triangles, mesh.vertices_m.size()) &&
                     all_below(mesh.corner_normals, mesh.normals.size()) &&
                     all_below(mesh.triangle_materials, mesh.materials.size()),
        "indices in range");
    taking.check(std::ranges::all_of(mesh.colours, is_colour) && sound(mesh.materials), "colours of 0 to 1");
    taking.check(std::ranges::all_of(mesh.normals, is_unit<float>), "normals of length 1");
    return mesh;
}

void append_model(std::string& bytes, const polygons::PolygonModel& model) {
    each_part_of_model(model, [&](const auto& part) { append(bytes, part); });
}

polygons::PolygonModel take_model(ByteReader& reader) {
    Taking taking(reader);
    polygons::PolygonModel model;
    each_part_of_model(model, [&](auto& part) { taking.take(part); });
    // Every polygon of the file it came from has a piece at least.
    bool good =
        all_below(model.corner_vertices, model.vertices_m.size()) && all_below(model.parents, model.polygons.size());
    for (const polygons::Polygon& polygon : model.polygons) { good = good && sound(model, polygon); }
    for (const polygons::Pivot& pivot : model.pivots) { good = good && pivot.part < model.parts.size(); }
    taking.check(good, "indices in range");
    taking.check(corners_in_order(model), "polygons of 3 to 1000 corners, one behind the other");
    taking.check(sound(model.materials), "colours of 0 to 1");
    taking.check(!model.materials.empty() && !model.parts.empty(), "a material and a part");
    taking.check(model.parents.empty() || model.parents.size() == model.polygons.size(), "a parent for each polygon");
    taking.check(model.pivots.size() <= 1000, "at most 1000 pivots");
    taking.check(one_pivot_a_part(model), "one pivot a part at most");
    taking.check(std::ranges::all_of(model.pivots, [](const polygons::Pivot& pivot) { return is_unit(pivot.axis); }),
        "axes of length 1");
    taking.check(all_convex(model), "convex planar polygons");
    return model;
}

/// Magic, version, a word for later, bytes behind the head, their hash.
constexpr std::string_view magic = "octchain";
constexpr std::uint32_t version = 1;
constexpr std::size_t head_bytes = 32;
constexpr std::size_t largest_chain_bytes = std::size_t{1} << 31U;
constexpr std::uint32_t max_levels = 1000;

double take_error_m(ByteReader& reader, double min_m) {
    const auto error_m = reader.number<double>("an error");
    if (!(error_m >= min_m && std::isfinite(error_m))) {
        reader.refuse_at(reader.at() - 8, fmt::format("an error of at least {}", min_m), fmt::format("{}", error_m));
    }
    return error_m;
}

/// Gives the bytes behind the head once they are what was written.
void check_head(ByteReader& reader, std::string_view bytes) {
    if (reader.take(magic.size(), "a chain of levels") != magic) {
        reader.refuse_at(0, "a chain of levels", "another file");
    }
    const auto found = reader.number<std::uint32_t>("a version");
    if (found != version) { reader.refuse_at(8, fmt::format("version {}", version), std::to_string(found)); }
    reader.number<std::uint32_t>("a word");
    const auto size = reader.number<std::uint64_t>("a size");
    if (size != bytes.size() - std::min(bytes.size(), head_bytes)) {
        reader.refuse_at(16, fmt::format("{} bytes behind the head", bytes.size() - std::min(bytes.size(), head_bytes)),
            std::to_string(size));
    }
    const auto hash = reader.number<std::uint64_t>("a checksum");
    const std::uint64_t own = checksum_of(bytes.substr(head_bytes));
    if (hash != own) { reader.refuse_at(24, fmt::format("the checksum {:016x}", own), fmt::format("{:016x}", hash)); }
}

} // namespace

bool is_chain_file(const std::filesystem::path& path) { return extension_of(path) == ".chain"; }

LevelChain read_chain(const std::filesystem::path& path) {
    const std::string bytes = read_file(path, largest_chain_bytes);
    ByteReader reader(path, bytes);
    check_head(reader, bytes);
    LevelChain chain;
    chain.name = take_text(reader);
    const auto levels = reader.number<std::uint32_t>("a number of levels");
    if (levels == 0 || levels > max_levels) {
        reader.refuse_at(reader.at() - 4, fmt::format("1 to {} levels", max_levels), std::to_string(levels));
    }
    for (std::uint32_t i = 0; i < levels; ++i) {
        const double min_m = i == 0 ? 0.0 : chain.levels.back().error_m;
        ChainLevel level;
        level.error_m = take_error_m(reader, min_m);
        if (i == 0 && level.error_m != 0.0) {
            reader.refuse_at(reader.at() - 8, "an error of 0 of the finest level", fmt::format("{}", level.error_m));
        }
        level.mesh = take_mesh(reader);
        chain.levels.push_back(std::move(level));
    }
    const auto has_polygons = reader.number<std::uint32_t>("0 or 1");
    if (has_polygons > 1) { reader.refuse_at(reader.at() - 4, "0 or 1", std::to_string(has_polygons)); }
    if (has_polygons == 1) {
        chain.polygons_error_m = take_error_m(reader, 0.0);
        chain.polygons = take_model(reader);
    }
    if (reader.bytes_left() > 0) {
        reader.refuse("the end of the file", fmt::format("{} more bytes", reader.bytes_left()));
    }
    return chain;
}

void write_chain(const std::filesystem::path& path, const LevelChain& chain) {
    assert(!chain.levels.empty() && chain.levels.size() <= max_levels);
    std::string body;
    append_text(body, chain.name);
    append_number(body, static_cast<std::uint32_t>(chain.levels.size()));
    for (const ChainLevel& level : chain.levels) {
        append_number(body, level.error_m);
        append_mesh(body, level.mesh);
    }
    append_number(body, static_cast<std::uint32_t>(chain.polygons.has_value()));
    if (chain.polygons) {
        append_number(body, chain.polygons_error_m);
        append_model(body, *chain.polygons);
    }
    std::string bytes(magic);
    append_number(bytes, version);
    append_number(bytes, std::uint32_t{0});
    append_number(bytes, static_cast<std::uint64_t>(body.size()));
    append_number(bytes, checksum_of(body));
    write_file(path, bytes + body);
}

} // namespace octant::models::meshfile
