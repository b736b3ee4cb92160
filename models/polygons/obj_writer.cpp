#include "models/polygons/obj_writer.h"

#include "sim/base/output_file.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <optional>

namespace octant::models::polygons {

namespace {

constexpr double seconds_per_minute = 60.0;

/// Returns the turns per minute that the reader converts back to exactly this rate, if that number exists.
double rpm_of(double turns_per_s) {
    const double rpm = turns_per_s * seconds_per_minute;
    for (const double towards : {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}) {
        const double neighbour = std::nextafter(rpm, towards);
        if (rpm / seconds_per_minute != turns_per_s && neighbour / seconds_per_minute == turns_per_s) {
            return neighbour;
        }
    }
    return rpm;
}

/// Returns the pivot comment of a part, with a line end. The reader gets back the same pivot bit for bit if the pivot
/// came from a file; other rates up to rounding.
std::string pivot_text(const Pivot& pivot, std::string_view part, const FileAxes& axes) {
    const glm::dvec3 point = axes.file_from_body(pivot.point_m);
    const glm::dvec3 axis = axes.file_from_body(pivot.axis);
    std::string text =
        fmt::format("# pivot {} {} {} {} axis {} {} {}", part, point.x, point.y, point.z, axis.x, axis.y, axis.z);
    if (pivot.turns_per_s != 0.0) { text += fmt::format(" rpm {}", rpm_of(pivot.turns_per_s)); }
    return text + '\n';
}

std::string mtl_text(const PolygonModel& model) {
    std::string text;
    for (const Material& material : model.materials) {
        text += fmt::format(
            "newmtl {}\nKd {} {} {}\n", material.name, material.colour.x, material.colour.y, material.colour.z);
        if (material.is_mirror) { text += "illum 5\n"; }
    }
    return text;
}

void append_polygons(std::string& text, const PolygonModel& model) {
    std::optional<std::uint32_t> part;
    std::optional<std::uint32_t> material;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const Polygon& polygon = model.polygons[i];
        if (part != polygon.part) {
            part = polygon.part;
            text += fmt::format("g {}\n", model.parts[polygon.part]);
        }
        if (material != polygon.material) {
            material = polygon.material;
            text += fmt::format("usemtl {}\n", model.materials[polygon.material].name);
        }
        text += 'f';
        for (const std::uint32_t vertex : model.corners(i)) { text += fmt::format(" {}", vertex + 1); }
        text += '\n';
    }
}

} // namespace

ObjText obj_text(const PolygonModel& model, const FileAxes& axes, std::string_view mtl_name) {
    ObjText out;
    out.mtl = mtl_text(model);
    std::string& text = out.obj;
    text = fmt::format("# {} vertices, {} polygons; metres, x y z = {}\nmtllib {}\n", model.vertices_m.size(),
        model.polygons.size(), axes.text(), mtl_name);
    for (const Pivot& pivot : model.pivots) { text += pivot_text(pivot, model.parts[pivot.part], axes); }
    for (const glm::dvec3& vertex_m : model.vertices_m) {
        const glm::dvec3 in_file = axes.file_from_body(vertex_m);
        text += fmt::format("v {} {} {}\n", in_file.x, in_file.y, in_file.z);
    }
    append_polygons(text, model);
    return out;
}

void write_obj(const std::filesystem::path& path, const PolygonModel& model, const FileAxes& axes) {
    std::filesystem::path mtl = path;
    mtl.replace_extension(".mtl");
    const ObjText text = obj_text(model, axes, mtl.filename().string());
    write_file(mtl, text.mtl);
    write_file(path, text.obj);
}

} // namespace octant::models::polygons
