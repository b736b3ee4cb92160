#include "visuals/draworder/opaque_first.h"

#include "visuals/draworder/draw_order.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

using models::polygons::PolygonModel;

bool is_clear(const PolygonModel& model, std::size_t polygon) {
    return models::is_transparent(model.materials[model.polygons[polygon].material]);
}

/// Appends a polygon of `from` to a model that has the same vertices from `first_vertex` on.
void append_polygon(const PolygonModel& from, std::size_t polygon, std::uint32_t first_vertex, PolygonModel& to) {
    to.polygons.push_back(from.polygons[polygon]);
    to.polygons.back().first_corner = static_cast<std::uint32_t>(to.corner_vertices.size());
    for (const std::uint32_t vertex : from.corners(polygon)) { to.corner_vertices.push_back(first_vertex + vertex); }
}

/// A model with all but its polygons.
PolygonModel without_polygons(const PolygonModel& model) {
    PolygonModel empty;
    empty.name = model.name;
    empty.vertices_m = model.vertices_m;
    empty.materials = model.materials;
    empty.parts = model.parts;
    empty.pivots = model.pivots;
    return empty;
}

} // namespace

bool has_transparent_polygons(const PolygonModel& model) {
    return std::ranges::any_of(
        model.polygons, [&](const auto& polygon) { return models::is_transparent(model.materials[polygon.material]); });
}

OrderedModel opaque_first(const PolygonModel& model, const std::function<OrderedModel(PolygonModel)>& order_of) {
    PolygonModel clear = without_polygons(model);
    std::vector<std::uint32_t> whole_of_clear; // polygons of `model`
    PolygonModel joined = without_polygons(model);
    std::vector<std::vector<std::uint32_t>> lists(1);
    for (const std::uint32_t polygon : models::polygons::distinct_polygons(model)) {
        if (is_clear(model, polygon)) {
            append_polygon(model, polygon, 0, clear);
            whole_of_clear.push_back(polygon);
            continue;
        }
        lists.front().push_back(static_cast<std::uint32_t>(joined.polygons.size()));
        append_polygon(model, polygon, 0, joined);
        joined.parents.push_back(model.parent_of(polygon));
    }
    OrderedModel sorted = order_of(std::move(clear));
    const auto first_polygon = static_cast<std::uint32_t>(joined.polygons.size());
    const auto first_vertex = static_cast<std::uint32_t>(joined.vertices_m.size());
    joined.vertices_m.insert(joined.vertices_m.end(), sorted.model.vertices_m.begin(), sorted.model.vertices_m.end());
    for (std::size_t i = 0; i < sorted.model.polygons.size(); ++i) {
        append_polygon(sorted.model, i, first_vertex, joined);
        joined.parents.push_back(model.parent_of(whole_of_clear[sorted.model.parent_of(i)]));
    }
    for (int cell = 0; cell < sorted.order.cell_count(); ++cell) {
        std::vector<std::uint32_t>& list = lists.emplace_back();
        for (const std::uint32_t polygon : sorted.order.polygons_of(cell)) { list.push_back(first_polygon + polygon); }
    }
    const auto moved = [](int child) {
        return child == DrawOrder::no_child ? child : child < 0 ? child - 1 : child + 1;
    };
    const auto nodes = sorted.order.nodes();
    std::vector<DrawOrder::Node> all{
        {.plane = {}, .front = ~0, .back = nodes.empty() ? ~1 : 1, .kind = DrawOrder::Kind::Sequence}};
    for (DrawOrder::Node node : nodes) {
        for (int* child : {&node.front, &node.back, &node.coplanar_front, &node.coplanar_back}) {
            *child = moved(*child);
        }
        all.push_back(node);
    }
    return {.model = std::move(joined),
        .order = DrawOrder(std::move(all), lists),
        .cells = {},
        .splits = sorted.splits,
        .notes = std::move(sorted.notes)};
}

} // namespace octant::visuals::draworder
