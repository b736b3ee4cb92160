// Painting orders in words: the 1989 paper's table 4 for any model, for `octant draw-order --table` and the panels of
// the window.
#include "visuals/orderfile/order_table.h"

#include "sim/base/plane.h"
#include "visuals/draworder/octant_path.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace octant::visuals::orderfile {

namespace {

constexpr double same_normal = 1e-9;
constexpr double shown_component = 5e-4; ///< Below this a component would be shown as 0.000.

bool same(const Plane& a, const Plane& b, double tolerance_m) {
    return glm::distance(a.normal, b.normal) < same_normal && std::abs(a.offset_m - b.offset_m) < tolerance_m;
}

std::string number(double value) { return fmt::format("{:.4g}", value + 0.0); }

/// A linear form in words, such as "0.6 x - 0.8 y".
std::string sum_in_words(const glm::dvec3& normal) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
        const double factor = normal[axis];
        if (std::abs(factor) < shown_component) { continue; }
        text += text.empty() ? (factor < 0.0 ? "-" : "") : (factor < 0.0 ? " - " : " + ");
        text += fmt::format("{:.3f} {}", std::abs(factor), "xyz"[axis]);
    }
    return text;
}

/// A half-space in words.
std::string in_words(
    const Plane& plane, const models::polygons::PolygonModel& model, const models::polygons::FileAxes& axes) {
    const glm::dvec3 normal = axes.file_from_body(plane.normal);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(normal[axis]) > 1.0 - 1e-12) {
            const bool up = normal[axis] > 0.0;
            return fmt::format("{} {} {}", "xyz"[axis], up ? '>' : '<', number(up ? -plane.offset_m : plane.offset_m));
        }
    }
    const double tolerance_m = same_normal * (1.0 + models::polygons::radius_m(model));
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const Plane of_polygon = models::polygons::plane_of(model, i);
        if (same(plane, of_polygon, tolerance_m)) { return fmt::format("in front of P{}", i + 1); }
        if (same(turned_over(plane), of_polygon, tolerance_m)) { return fmt::format("behind P{}", i + 1); }
    }
    return fmt::format("{} > {}", sum_in_words(normal), number(-plane.offset_m));
}

std::string distances_in_words(const ListedCell& cell, Metric metric) {
    std::string text;
    const char* away = metric == Metric::L1 ? "|x| + |y| + |z|" : "distance";
    if (cell.min_m > 0.0) { text += fmt::format(", {} >= {}", away, number(cell.min_m)); }
    if (std::isfinite(cell.max_m)) { text += fmt::format(", {} <= {}", away, number(cell.max_m)); }
    return text;
}

} // namespace

std::string list_description(std::span<const std::uint32_t> list) {
    std::string text;
    for (const std::uint32_t polygon : list) { text += fmt::format("{}P{}", text.empty() ? "" : ", ", polygon + 1); }
    return text;
}

std::string region_description(std::span<const Plane> planes, const models::polygons::PolygonModel& model,
    const models::polygons::FileAxes& axes) {
    std::string text;
    for (const Plane& plane : planes) { text += (text.empty() ? "" : ", ") + in_words(plane, model, axes); }
    return text.empty() ? "everywhere" : text;
}

std::vector<OrderRow> order_table(
    const models::polygons::PolygonModel& model, const CellOrders& orders, const models::polygons::FileAxes& axes) {
    std::vector<OrderRow> rows;
    for (int part = 0; orders.parts && part < orders.parts->cell_count(); ++part) {
        rows.push_back({fmt::format("list {}", part), "", list_description(orders.parts->polygons_of(part))});
    }
    bool only_octants = orders.cells.size() > 0;
    for (std::size_t i = 0; i < orders.cells.size(); ++i) {
        const ListedCell& cell = orders.cells[i];
        OrderRow row;
        if (cell.path.empty()) {
            only_octants = false;
            row.cell = fmt::format("{}", i + 1);
            row.region = region_description(cell.planes, model, axes) + distances_in_words(cell, orders.metric);
        } else {
            row.cell = draworder::path_in_file(cell.path, axes);
        }
        row.list = list_description(cell.list);
        rows.push_back(std::move(row));
    }
    if (only_octants) { // The character '+' sorts before '-', which is the paper's order.
        std::ranges::stable_sort(rows, {}, &OrderRow::cell);
    }
    return rows;
}

} // namespace octant::visuals::orderfile
