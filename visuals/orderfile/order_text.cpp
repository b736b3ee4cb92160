// Writes painting orders in the text format that order_text.h describes.
#include "visuals/orderfile/order_text.h"

#include "sim/base/format_once.h"
#include "visuals/draworder/octant_path.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace octant::visuals::orderfile {

namespace {

using draworder::DrawOrder;

std::string numbers(const glm::dvec3& v) { return fmt::format("{:.17g} {:.17g} {:.17g}", v.x, v.y, v.z); }

std::string indices(const std::vector<std::uint32_t>& list) {
    std::string text;
    for (const std::uint32_t index : list) { fmt::format_to(std::back_inserter(text), " {}", index); }
    return text;
}

std::string region_text(const ListedCell& cell, const models::polygons::FileAxes& axes) {
    if (!cell.path.empty()) { return draworder::path_in_file(cell.path, axes); }
    if (!cell.directions.empty()) {
        std::string text = fmt::format("cone {}", cell.directions.size());
        for (const glm::dvec3& direction : cell.directions) { text += " " + numbers(axes.file_from_body(direction)); }
        return text;
    }
    std::string text = fmt::format("half {}", cell.planes.size());
    for (const Plane& plane : cell.planes) {
        text += fmt::format(" {} {:.17g}", numbers(axes.file_from_body(plane.normal)), plane.offset_m + 0.0);
    }
    return text;
}

std::string child_text(int child) {
    if (child == DrawOrder::nothing) { return " nothing"; }
    return child < 0 ? fmt::format(" list {}", ~child) : fmt::format(" node {}", child);
}

std::string parts_text(const DrawOrder& order, const models::polygons::FileAxes& axes) {
    std::string text;
    for (int cell = 0; cell < order.cell_count(); ++cell) {
        const auto list = order.polygons_of(cell);
        text += fmt::format("list{}\n", indices({list.begin(), list.end()}));
    }
    for (const DrawOrder::Node& node : order.nodes()) {
        const std::string children = child_text(node.front) + child_text(node.back);
        if (node.kind == DrawOrder::Kind::Sequence) {
            text += fmt::format("node sequence{}\n", children);
            continue;
        }
        const std::string plane =
            fmt::format("{} {:.17g}", numbers(axes.file_from_body(node.plane.normal)), node.plane.offset_m + 0.0);
        const bool parts = node.kind == DrawOrder::Kind::PolygonSplit;
        text += fmt::format("node {} {}{}{}\n", parts ? "parting" : "choice", plane, children,
            parts ? child_text(node.coplanar_front) + child_text(node.coplanar_back) : "");
    }
    return text;
}

} // namespace

std::string order_text(const CellOrders& orders, const models::polygons::FileAxes& axes) {
    std::string text = "draworder 1\n";
    if (orders.centre_m != glm::dvec3(0.0)) {
        text += fmt::format("center {}\n", numbers(axes.file_from_body(orders.centre_m)));
    }
    text += fmt::format("metric {}\n", orders.metric == Metric::L1 ? "l1" : "l2");
    text += fmt::format("faces {}\n", orders.faces);
    if (!orders.two_sided.empty()) { text += fmt::format("twosided{}\n", indices(orders.two_sided)); }
    if (!orders.parents.empty()) { text += fmt::format("parents{}\n", indices(orders.parents)); }
    for (const ListedCell& cell : orders.cells) {
        text += "cell " + region_text(cell, axes);
        if (cell.min_m > 0.0) { text += fmt::format(" min {:.17g}", cell.min_m); }
        if (std::isfinite(cell.max_m)) { text += fmt::format(" max {:.17g}", cell.max_m); }
        text += fmt::format(" order{}\n", indices(cell.list));
    }
    if (orders.parts) { text += parts_text(*orders.parts, axes); }
    return text;
}

} // namespace octant::visuals::orderfile
