#include "models/meshfile/chain_bytes.h"

#include "models/meshfile/byte_writer.h"

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

void append(std::string& bytes, const Polygon& polygon) {
    append(bytes, polygon.first_corner);
    append(bytes, polygon.corner_count);
    append(bytes, polygon.material);
    append(bytes, polygon.part);
}

void append(std::string& bytes, const Pivot& pivot) {
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

    void take(Polygon& polygon) {
        take(polygon.first_corner);
        take(polygon.corner_count);
        take(polygon.material);
        take(polygon.part);
    }

    void take(Pivot& pivot) {
        take(pivot.part);
        take(pivot.point_m);
        take(pivot.axis);
        take(pivot.turns_per_s);
    }

    /// `least_bytes` are what one entry takes at least.
    template <typename Entry>
    void take(std::vector<Entry>& entries, std::size_t least_bytes) {
        const std::size_t at = reader_.at();
        const auto count = reader_.number<std::uint64_t>("a count");
        if (count > reader_.bytes_left() / least_bytes) {
            reader_.refuse_at(
                at,
                fmt::format("a count of at most {}", reader_.bytes_left() / least_bytes),
                std::to_string(count));
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

constexpr std::size_t material_bytes = 20;

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

bool is_unit(const glm::vec3& vector) {
    return std::abs(glm::length(vector) - 1.0F) < 1e-3F;
}

bool sound(const PolygonModel& model, const Polygon& polygon) {
    return polygon.corner_count >= 3 &&
           std::size_t{polygon.first_corner} + polygon.corner_count <=
               model.corner_vertices.size() &&
           polygon.material < model.materials.size() && polygon.part < model.parts.size();
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
    append(bytes, mesh.name);
    append(bytes, mesh.vertices_m);
    append(bytes, mesh.colours);
    append(bytes, mesh.triangles);
    append(bytes, mesh.normals);
    append(bytes, mesh.corner_normals);
    append(bytes, mesh.materials);
    append(bytes, mesh.triangle_materials);
    append(bytes, mesh.notes);
}

TriangleMesh take_mesh(ByteReader& reader) {
    Taking taking(reader);
    TriangleMesh mesh;
    taking.take(mesh.name);
    taking.take(mesh.vertices_m, 24);
    taking.take(mesh.colours, 12);
    taking.take(mesh.triangles, 12);
    taking.take(mesh.normals, 12);
    taking.take(mesh.corner_normals, 12);
    taking.take(mesh.materials, material_bytes);
    taking.take(mesh.triangle_materials, 4);
    taking.take(mesh.notes, 8);
    const std::size_t count = mesh.triangles.size();
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
    taking.check(std::ranges::all_of(mesh.normals, is_unit), "normals of length 1");
    return mesh;
}

void append_model(std::string& bytes, const PolygonModel& model) {
    append(bytes, model.name);
    append(bytes, model.vertices_m);
    append(bytes, model.corner_vertices);
    append(bytes, model.polygons);
    append(bytes, model.materials);
    append(bytes, model.parts);
    append(bytes, model.pivots);
    append(bytes, model.parents);
    append(bytes, model.notes);
}

PolygonModel take_model(ByteReader& reader) {
    Taking taking(reader);
    PolygonModel model;
    taking.take(model.name);
    taking.take(model.vertices_m, 24);
    taking.take(model.corner_vertices, 4);
    taking.take(model.polygons, 16);
    taking.take(model.materials, material_bytes);
    taking.take(model.parts, 8);
    taking.take(model.pivots, 60);
    taking.take(model.parents, 4);
    taking.take(model.notes, 8);
    bool good = all_below(model.corner_vertices, model.vertices_m.size());
    for (const Polygon& polygon : model.polygons) {
        good = good && sound(model, polygon);
    }
    for (const Pivot& pivot : model.pivots) {
        good = good && pivot.part < model.parts.size();
    }
    taking.check(good, "indices in range");
    taking.check(sound(model.materials), "colours of 0 to 1");
    taking.check(!model.materials.empty() && !model.parts.empty(), "a material and a part");
    taking.check(
        model.parents.empty() || model.parents.size() == model.polygons.size(),
        "a parent for each polygon");
    return model;
}

} // namespace octant::models::meshfile
