#include "ui/world/mesh_textures.h"

#include "models/colour_vertex.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace octant::ui::world {

namespace refine = visuals::refine;
using models::invalid_index;
using models::simplify::AttributeSeams;
using models::simplify::MeshPoint;

bool has_textures(const models::TriangleMesh& mesh) {
    return !mesh.corner_texture_coordinates.empty() &&
           std::ranges::any_of(mesh.materials, [](const auto& one) { return one.texture.picture != nullptr; });
}

bool has_plain_colours(const models::TriangleMesh& mesh) {
    constexpr std::size_t most_colours = 256; // more of them are a colour a face, as scanners write it
    if ((!mesh.colours.empty() && !mesh.colours_are_means) || mesh.materials.empty()) { return false; }
    std::set<std::uint32_t> colours;
    for (const std::uint32_t material : mesh.triangle_materials) {
        if (material == invalid_index) { return false; }
        colours.insert(models::packed_colour(mesh.materials[material].colour));
    }
    return colours.size() > 1 && colours.size() <= most_colours;
}

std::optional<AttributeSeams> texture_charts(
    const models::TriangleMesh& mesh, bool is_plain, std::vector<std::string>& notes) {
    const bool is_textured = has_textures(mesh);
    if (!is_textured && !is_plain) { return std::nullopt; }
    models::TriangleMesh shown = mesh;
    shown.normals.clear();
    shown.corner_normals.clear();
    if (!is_textured) {
        shown.texture_coordinates.clear();
        shown.corner_texture_coordinates.clear();
    }
    for (std::size_t t = 0; t < shown.corner_texture_coordinates.size(); ++t) {
        if (shown.materials[shown.triangle_materials[t]].texture.picture == nullptr) {
            shown.corner_texture_coordinates[t] = {invalid_index, invalid_index, invalid_index};
        }
    }
    AttributeSeams charts(std::move(shown), {});
    constexpr std::size_t max_charts = std::numeric_limits<std::uint16_t>::max();
    if (charts.materials_of_charts().size() > max_charts) {
        notes.push_back(fmt::format(
            "{}: its pictures and colours lie in {} pieces, more than {}: it is drawn in the colours of its vertices",
            mesh.name, charts.materials_of_charts().size(), max_charts));
        return std::nullopt;
    }
    return charts;
}

namespace {

/// A chart that a node touches, and the point of the mesh from which it takes its place there.
struct NodeChart {
    std::uint32_t chart = 0;
    MeshPoint point;
};

/// The charts at each leaf, ascending, each with the corner of one of its triangles.
std::vector<std::vector<NodeChart>> charts_of_leaves(
    const refine::ProgressiveMesh& hierarchy, const models::TriangleMesh& marked) {
    constexpr std::array<glm::dvec3, 3> corners{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    std::vector<std::vector<NodeChart>> found(hierarchy.leaf_count());
    for (std::uint32_t face = 0; face < hierarchy.face_count(); ++face) {
        const std::uint32_t triangle = hierarchy.original_face(face);
        const std::uint32_t chart = marked.triangle_materials[triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            std::vector<NodeChart>& at = found[hierarchy.faces()[face][k]];
            const auto next = std::ranges::lower_bound(at, chart, {}, &NodeChart::chart);
            if (next == at.end() || next->chart != chart) { at.insert(next, {chart, {triangle, corners.at(k)}}); }
        }
    }
    return found;
}

/// The charts of both children of a node.
std::vector<NodeChart> joined(const std::vector<NodeChart>& first, const std::vector<NodeChart>& second,
    const AttributeSeams& charts, const glm::dvec3& at_m) {
    std::vector<NodeChart> all;
    auto a = first.begin();
    auto b = second.begin();
    while (a != first.end() || b != second.end()) {
        const bool takes_a = b == second.end() || (a != first.end() && a->chart <= b->chart);
        const bool takes_b = a == first.end() || (b != second.end() && b->chart <= a->chart);
        const std::uint32_t chart = takes_a ? a->chart : b->chart;
        const std::array<std::uint32_t, 2> from{
            takes_a ? a->point.triangle : b->point.triangle, takes_b ? b->point.triangle : a->point.triangle};
        all.push_back({chart,
            charts.has_texture_coordinates() ? charts.near_point(at_m, from) : (takes_a ? a->point : b->point)});
        a += takes_a ? 1 : 0;
        b += takes_b ? 1 : 0;
    }
    return all;
}

} // namespace

NodePlaces node_places(const refine::ProgressiveMesh& hierarchy, const AttributeSeams& charts) {
    const models::TriangleMesh& marked = charts.marked();
    std::vector<std::vector<NodeChart>> found = charts_of_leaves(hierarchy, marked);
    found.resize(hierarchy.node_count());
    for (std::size_t node = hierarchy.leaf_count(); node < hierarchy.node_count(); ++node) {
        const auto number = static_cast<std::uint32_t>(node);
        const refine::VertexSplit split = hierarchy.split_of(number);
        const glm::dvec3 at_m = hierarchy.parts().origin_m + glm::dvec3(hierarchy.position_m(number));
        found[node] = joined(found[split.first], found[split.second], charts, at_m);
    }
    NodePlaces made;
    made.chart_materials = charts.materials_of_charts();
    for (const std::vector<NodeChart>& of_node : found) {
        made.first.push_back(static_cast<std::uint32_t>(made.places.size()));
        for (const NodeChart& one : of_node) {
            const glm::vec2 up =
                charts.has_coordinates(one.point) ? charts.texture_coordinates(one.point) : glm::vec2(0.0F, 1.0F);
            made.places.push_back({one.chart, {up.x, 1.0F - up.y}});
        }
    }
    made.first.push_back(static_cast<std::uint32_t>(made.places.size()));
    return made;
}

std::shared_ptr<const refine::MeshTextures> mesh_textures(
    NodePlaces places, std::span<const models::Material> materials, bool is_plain, std::size_t node_count) {
    const bool fits = places.first.size() == node_count + 1 && places.first.front() == 0 &&
                      std::ranges::is_sorted(places.first) && places.first.back() == places.places.size() &&
                      std::ranges::all_of(places.places,
                          [&](const refine::ChartPlace& one) { return one.chart < places.chart_materials.size(); });
    if (!fits) { return nullptr; }
    auto made = std::make_shared<refine::MeshTextures>();
    made->first = std::move(places.first);
    made->places = std::move(places.places);
    for (const std::uint32_t material : places.chart_materials) {
        refine::ChartSurface& chart = made->charts.emplace_back();
        if (material >= materials.size()) { continue; }
        chart.is_plain = is_plain && materials[material].texture.picture == nullptr;
        if (chart.is_plain) { chart.colour = models::packed_colour(materials[material].colour); }
        if (materials[material].texture.picture == nullptr) { continue; }
        const models::SurfaceTexture& texture = materials[material].texture;
        const auto known = std::ranges::find(made->textures, texture);
        chart.texture = static_cast<std::uint32_t>(known - made->textures.begin()) + 1;
        if (known == made->textures.end()) { made->textures.push_back(texture); }
        chart.colour = models::packed_colour(materials[material].colour);
    }
    return made;
}

} // namespace octant::ui::world
