#include "models/meshfile/level_chain.h"

#include "models/meshfile/mesh_formats.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "sim/base/binary_file.h"
#include "sim/base/text_file.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

namespace octant::models::meshfile {

namespace {

// Lists are behind their 64-bit count. Numbers are as they are in memory, so that nothing is rounded.

static_assert(sizeof(Triangle) == 12 && sizeof(polygons::Polygon) == 16);

/// From this version on materials have an opacity; before, all were opaque.
constexpr std::uint32_t version_with_opacities = 2;

/// Puts each part of a mesh or model.
class ChainWriter {
public:
    void put(const std::string& text) { out.put_text(text); }

    void put(const Material& material) {
        put(material.name);
        out.put(material.colour);
        out.put(material.opacity);
    }

    void put(const polygons::Pivot& pivot) {
        out.put(pivot.part);
        out.put(pivot.point_m);
        out.put(pivot.axis);
        out.put(pivot.turns_per_s);
    }

    template <typename Entry>
    void put(const std::vector<Entry>& entries) {
        if constexpr (requires { put(entries.front()); }) {
            out.put(std::uint64_t{entries.size()});
            for (const Entry& entry : entries) { put(entry); }
        } else {
            out.put_list(entries);
        }
    }

    BinaryWriter out;
};

bool is_finite(double number) { return std::isfinite(number); }

template <int size, typename Part>
bool is_finite(const glm::vec<size, Part>& vector) {
    return vector - vector == glm::vec<size, Part>(0); // Infinity and NaN give NaN.
}

/// Takes what ChainWriter put, in the same order. Throws Error "file: at byte N: ..." for what the file cannot hold and
/// for numbers that are not finite.
class ChainReader {
public:
    explicit ChainReader(BinaryReader& reader) : in(reader) {}

    void take(std::string& text) { text = in.take_text(); }

    void take(Material& material) {
        take(material.name);
        take_finite(material.colour);
        if (in.archive_version() >= version_with_opacities) { take_finite(material.opacity); }
    }

    void take(polygons::Pivot& pivot) {
        pivot.part = in.take<std::uint32_t>();
        take_finite(pivot.point_m);
        take_finite(pivot.axis);
        take_finite(pivot.turns_per_s);
    }

    template <typename Entry>
    void take(std::vector<Entry>& entries) {
        if constexpr (requires { take(entries.front()); }) {
            const std::size_t count = in.take_count(sizeof(std::uint64_t), "a count");
            for (std::size_t i = 0; i < count; ++i) { take(entries.emplace_back()); }
        } else {
            entries = in.take_list<Entry>();
            if constexpr (requires { is_finite(entries.front()); }) {
                in.check(std::ranges::all_of(entries, [](const Entry& entry) { return is_finite(entry); }), finite);
            }
        }
    }

    BinaryReader& in;

private:
    static constexpr const char* finite = "finite numbers";

    template <typename Value>
    void take_finite(Value& value) {
        value = in.take<Value>();
        in.check(is_finite(value), finite);
    }
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

bool all_below(const std::vector<std::uint32_t>& indices, std::size_t count) {
    return std::ranges::all_of(indices, [&](std::uint32_t index) { return index < count; });
}

bool all_below(const std::vector<Triangle>& triangles, std::size_t count) {
    return std::ranges::all_of(triangles, [&](const Triangle& triangle) { return std::ranges::max(triangle) < count; });
}

bool is_colour(const glm::vec3& colour) {
    return glm::min(colour, glm::vec3(0.0F)) == glm::vec3(0.0F) && glm::max(colour, glm::vec3(1.0F)) == glm::vec3(1.0F);
}

bool sound(const std::vector<Material>& materials) {
    return std::ranges::all_of(materials, [](const Material& material) {
        return is_colour(material.colour) && material.opacity >= 0.0F && material.opacity <= 1.0F;
    });
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

/// Throws Error for what is not as TriangleMesh says.
TriangleMesh take_mesh(BinaryReader& in) {
    ChainReader reader(in);
    TriangleMesh mesh;
    each_part_of_mesh(mesh, [&](auto& part) { reader.take(part); });
    const std::size_t count = mesh.triangles.size();
    in.check(count > 0, "triangles");
    in.check(mesh.colours.empty() || mesh.colours.size() == mesh.vertices_m.size(), "a colour for each vertex");
    in.check(mesh.corner_normals.size() == (mesh.normals.empty() ? 0 : count), "normals for each triangle");
    in.check(mesh.triangle_materials.size() == (mesh.materials.empty() ? 0 : count), "a material for each triangle");
    in.check(all_below(mesh.triangles, mesh.vertices_m.size()) && all_below(mesh.corner_normals, mesh.normals.size()) &&
                 all_below(mesh.triangle_materials, mesh.materials.size()),
        "indices in range");
    in.check(std::ranges::all_of(mesh.colours, is_colour) && sound(mesh.materials), "colours and opacities of 0 to 1");
    in.check(std::ranges::all_of(mesh.normals, is_unit<float>), "normals of length 1");
    return mesh;
}

/// Throws Error for what is not as PolygonModel says.
polygons::PolygonModel take_model(BinaryReader& in) {
    ChainReader reader(in);
    polygons::PolygonModel model;
    each_part_of_model(model, [&](auto& part) { reader.take(part); });
    // Every polygon of the file it came from has a piece at least.
    bool good =
        all_below(model.corner_vertices, model.vertices_m.size()) && all_below(model.parents, model.polygons.size());
    for (const polygons::Polygon& polygon : model.polygons) { good = good && sound(model, polygon); }
    for (const polygons::Pivot& pivot : model.pivots) { good = good && pivot.part < model.parts.size(); }
    in.check(good, "indices in range");
    in.check(corners_in_order(model), "polygons of 3 to 1000 corners, one behind the other");
    in.check(sound(model.materials), "colours and opacities of 0 to 1");
    in.check(!model.materials.empty() && !model.parts.empty(), "a material and a part");
    in.check(model.parents.empty() || model.parents.size() == model.polygons.size(), "a parent for each polygon");
    in.check(model.pivots.size() <= 1000, "at most 1000 pivots");
    in.check(one_pivot_a_part(model), "one pivot a part at most");
    in.check(std::ranges::all_of(model.pivots, [](const polygons::Pivot& pivot) { return is_unit(pivot.axis); }),
        "axes of length 1");
    in.check(all_convex(model), "convex planar polygons");
    return model;
}

// Pictures follow the polygons where a level has texture coordinates: the encoded pictures, then for each level its
// texture coordinates and, for each of its materials, the number of its picture.

constexpr std::uint32_t max_chain_pictures = 10'000;

bool has_textures(const LevelChain& chain) {
    return std::ranges::any_of(
        chain.levels, [](const ChainLevel& level) { return !level.mesh.corner_texture_coordinates.empty(); });
}

void put_textures(const LevelChain& chain, BinaryWriter& out) {
    std::vector<std::pair<std::string, std::shared_ptr<const std::string>>> pictures; // by name
    std::map<std::string, std::uint32_t> numbers;
    for (const ChainLevel& level : chain.levels) {
        for (const Material& material : level.mesh.materials) {
            const auto bytes = numbers.contains(material.picture) ? nullptr : picture_bytes_of(material);
            if (bytes && pictures.size() < max_chain_pictures) {
                numbers.emplace(material.picture, static_cast<std::uint32_t>(pictures.size()));
                pictures.emplace_back(std::filesystem::path(material.picture).filename().string(), bytes);
            }
        }
    }
    out.put(static_cast<std::uint32_t>(pictures.size()));
    for (const auto& [name, bytes] : pictures) {
        out.put_text(name);
        out.put_text(*bytes);
    }
    for (const ChainLevel& level : chain.levels) {
        out.put_list(level.mesh.texture_coordinates);
        out.put_list(level.mesh.corner_texture_coordinates);
        for (const Material& material : level.mesh.materials) {
            const auto known = numbers.find(material.picture);
            out.put(known == numbers.end() ? invalid_index : known->second);
        }
    }
}

/// Whether all corners of each triangle have texture coordinates of the list, or none has.
bool are_texture_corners(const TriangleMesh& mesh) {
    const std::size_t count = mesh.texture_coordinates.size();
    return (mesh.corner_texture_coordinates.empty() ||
               mesh.corner_texture_coordinates.size() == mesh.triangles.size()) &&
           std::ranges::all_of(mesh.corner_texture_coordinates, [&](const Triangle& corners) {
               return corners == Triangle{invalid_index, invalid_index, invalid_index} ||
                      std::ranges::max(corners) < count;
           });
}

void take_textures(BinaryReader& in, LevelChain& chain) {
    ChainReader reader(in);
    const auto count = in.take<std::uint32_t>("a number of pictures");
    in.check(count <= max_chain_pictures, "at most 10,000 pictures");
    std::vector<std::pair<std::string, std::shared_ptr<const std::string>>> pictures;
    for (std::uint32_t i = 0; i < count; ++i) {
        std::string name(in.take_text("a picture's name"));
        pictures.emplace_back(std::move(name), std::make_shared<const std::string>(in.take_text("a picture")));
    }
    for (ChainLevel& level : chain.levels) {
        reader.take(level.mesh.texture_coordinates);
        level.mesh.corner_texture_coordinates = in.take_list<Triangle>();
        in.check(are_texture_corners(level.mesh), "texture coordinates in range");
        for (Material& material : level.mesh.materials) {
            const auto number = in.take<std::uint32_t>("a picture's number");
            in.check(number == invalid_index || number < pictures.size(), "pictures in range");
            if (number != invalid_index) { std::tie(material.picture, material.picture_bytes) = pictures[number]; }
        }
    }
}

constexpr ArchiveKind chain_kind{.content = "a chain of levels",
    .signature = "octchain",
    .version = version_with_opacities,
    .oldest_version = 1,
    .max_bytes = std::size_t{1} << 31U};
constexpr std::uint32_t max_levels = 1000;

double take_error_m(BinaryReader& in, double min_m) {
    const auto error_m = in.take<double>("an error");
    if (!(error_m >= min_m && std::isfinite(error_m))) {
        in.refuse_at(in.at() - 8, fmt::format("an error of at least {}", min_m), fmt::format("{}", error_m));
    }
    return error_m;
}

LevelChain take_chain(BinaryReader& in) {
    LevelChain chain;
    chain.name = in.take_text();
    const auto levels = in.take<std::uint32_t>("a number of levels");
    if (levels == 0 || levels > max_levels) {
        in.refuse_at(in.at() - 4, fmt::format("1 to {} levels", max_levels), std::to_string(levels));
    }
    for (std::uint32_t i = 0; i < levels; ++i) {
        ChainLevel level;
        level.error_m = take_error_m(in, i == 0 ? 0.0 : chain.levels.back().error_m);
        if (i == 0 && level.error_m != 0.0) {
            in.refuse_at(in.at() - 8, "an error of 0 of the finest level", fmt::format("{}", level.error_m));
        }
        level.mesh = take_mesh(in);
        chain.levels.push_back(std::move(level));
    }
    const auto has_polygons = in.take<std::uint32_t>("0 or 1");
    if (has_polygons > 1) { in.refuse_at(in.at() - 4, "0 or 1", std::to_string(has_polygons)); }
    if (has_polygons == 1) {
        chain.polygons_error_m = take_error_m(in, 0.0);
        chain.polygons = take_model(in);
    }
    if (in.bytes_left() > 0) { take_textures(in, chain); }
    return chain;
}

} // namespace

bool is_chain_file(const std::filesystem::path& path) { return extension_of(path) == ".chain"; }

LevelChain read_chain(const std::filesystem::path& path) { return read_archive(path, chain_kind, take_chain); }

void write_chain(const std::filesystem::path& path, const LevelChain& chain) {
    assert(!chain.levels.empty() && chain.levels.size() <= max_levels);
    ChainWriter writer;
    const auto put = [&](const auto& part) { writer.put(part); };
    writer.put(chain.name);
    writer.out.put(static_cast<std::uint32_t>(chain.levels.size()));
    for (const ChainLevel& level : chain.levels) {
        writer.out.put(level.error_m);
        each_part_of_mesh(level.mesh, put);
    }
    writer.out.put(std::uint32_t{chain.polygons.has_value()});
    if (chain.polygons) {
        writer.out.put(chain.polygons_error_m);
        each_part_of_model(*chain.polygons, put);
    }
    if (has_textures(chain)) { put_textures(chain, writer.out); }
    write_archive(path, chain_kind, writer.out.bytes());
}

} // namespace octant::models::meshfile
