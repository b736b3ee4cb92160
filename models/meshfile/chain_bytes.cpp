#include "models/meshfile/chain_bytes.h"

#include "models/meshfile/byte_writer.h"
#include "models/polygons/polygon_check.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <type_traits>

namespace octant::models::meshfile {

namespace {

void append(std::string& bytes, std::uint32_t value) {
    append_number(bytes, value);
}

void append(std::string& bytes, double value) {
    append_number(bytes, value);
}

template <int size, typename Part>
void append(std::string& bytes, const glm::vec<size, Part>& vector) {
    for (int part = 0; part < size; ++part) {
        append_number(bytes, vector[part]);
    }
}

void append(std::string& bytes, const Triangle& triangle) {
    for (const std::uint32_t index : triangle) {
        append(bytes, index);
    }
}

void append(std::string& bytes, const std::string& text) {
    append_text(bytes, text);
}

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
    for (const Entry& entry : entries) {
        append(bytes, entry);
    }
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
    explicit Taking(ByteReader& reader)
        : reader_(reader) {}

    void take(std::uint32_t& value) { value = reader_.number<std::uint32_t>("a whole number"); }

    template <typename Part>
    requires std::is_floating_point_v<Part>

    void take(Part& value) {
        value = reader_.number<Part>("a number");
        if (!std::isfinite(value)) {
            reader_.refuse_at(
                reader_.at() - sizeof(Part), "a finite number", fmt::format("{}", value));
        }
    }

    template <int size, typename Part>
    void take(glm::vec<size, Part>& vector) {
        for (int part = 0; part < size; ++part) {
            take(vector[part]);
        }
    }

    void take(Triangle& triangle) {
        for (std::uint32_t& index : triangle) {
            take(index);
        }
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
        if (count > most) {
            reader_.refuse_at(
                at, fmt::format("a count of at most {}", most), std::to_string(count));
        }
        entries.resize(count);
        for (Entry& entry : entries) {
            take(entry);
        }
    }

    void check(bool good, const char* expected) const {
        if (!good) {
            reader_.refuse(fmt::format("{} before", expected), "other ones");
        }
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
        if (a >= count || b >= count || c >= count) {
            return false;
        }
    }
    return true;
}

bool all_below(const std::vector<std::uint32_t>& indices, std::size_t count) {
    for (const std::uint32_t index : indices) {
        if (index >= count) {
            return false;
        }
    }
    return true;
}

bool is_colour(const glm::vec3& colour) {
    return glm::min(colour, glm::vec3(0.0F)) == glm::vec3(0.0F) &&
           glm::max(colour, glm::vec3(1.0F)) == glm::vec3(1.0F);
}

bool sound(const std::vector<Material>& materials) {
    return std::ranges::all_of(
        materials, [](const Material& material) { return is_colour(material.colour); });
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
        if (polygon.first_corner != next || polygon.corner_count < 3 ||
            polygon.corner_count > most) {
            return false;
        }
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
        if (model.polygons[i].corner_count > 3 && polygons::polygon_fault(model, i, tolerance_m)) {
            return false;
        }
    }
    return true;
}

bool one_pivot_a_part(const polygons::PolygonModel& model) {
    std::vector<char> turns(model.parts.size(), 0);
    return std::ranges::all_of(
        model.pivots, [&](const polygons::Pivot& pivot) { return ++turns[pivot.part] == 1; });
}

} // namespace

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
    taking.check(
        mesh.colours.empty() || mesh.colours.size() == mesh.vertices_m.size(),
        "a colour for each vertex");
    taking.check(
        mesh.corner_normals.size() == (mesh.normals.empty() ? 0 : count),
        "normals for each triangle");
    taking.check(
        mesh.triangle_materials.size() == (mesh.materials.empty() ? 0 : count),
        "a material for each triangle");
    taking.check(
        all_below(mesh.triangles, mesh.vertices_m.size()) &&
            all_below(mesh.corner_normals, mesh.normals.size()) &&
            all_below(mesh.triangle_materials, mesh.materials.size()),
        "indices in range");
    taking.check(
        std::ranges::all_of(mesh.colours, is_colour) && sound(mesh.materials), "colours of 0 to 1");
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
    bool good = all_below(model.corner_vertices, model.vertices_m.size()) &&
                all_below(model.parents, model.polygons.size());
    for (const polygons::Polygon& polygon : model.polygons) {
        good = good && sound(model, polygon);
    }
    for (const polygons::Pivot& pivot : model.pivots) {
        good = good && pivot.part < model.parts.size();
    }
    taking.check(good, "indices in range");
    taking.check(corners_in_order(model), "polygons of 3 to 1000 corners, one behind the other");
    taking.check(sound(model.materials), "colours of 0 to 1");
    taking.check(!model.materials.empty() && !model.parts.empty(), "a material and a part");
    taking.check(
        model.parents.empty() || model.parents.size() == model.polygons.size(),
        "a parent for each polygon");
    taking.check(model.pivots.size() <= 1000, "at most 1000 pivots");
    taking.check(one_pivot_a_part(model), "one pivot a part at most");
    taking.check(
        std::ranges::all_of(
            model.pivots, [](const polygons::Pivot& pivot) { return is_unit(pivot.axis); }),
        "axes of length 1");
    taking.check(all_convex(model), "convex planar polygons");
    return model;
}

} // namespace octant::models::meshfile
