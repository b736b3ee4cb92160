// Painting orders as text: tables in words, and the writer and reader of the file format that order_text.h describes.
#include "visuals/orderfile/order_text.h"

#include "models/polygons/file_axes.h"
#include "sim/base/error.h"
#include "sim/base/plane.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "visuals/draworder/octant_order.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::visuals::orderfile {

// Orders in words: the 1989 paper's table 4 for any model, for `octant draw-order --table` and the panels of the
// window.

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

namespace {

using draworder::DrawOrder;

std::string numbers(const glm::dvec3& v) { return fmt::format("{:.17g} {:.17g} {:.17g}", v.x, v.y, v.z); }

std::string indices(const std::vector<std::uint32_t>& list) {
    std::string text;
    for (const std::uint32_t index : list) { text += fmt::format(" {}", index); }
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
    if (child == DrawOrder::no_child) { return " nothing"; }
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

// Reads painting orders in the text format that order_text.h describes. Every message names the file, the line, what
// was expected and what was found.

namespace {

constexpr double largest_number = 1e12;
constexpr double min_length = 1e-12; ///< A normal or direction must be longer than this.
constexpr long max_planes = 1000;
constexpr long max_directions = 64;
constexpr std::size_t max_cells = 1'000'000;

/// The reading of one file, line by line and word by word.
class OrderReader {
public:
    OrderReader(const std::filesystem::path& path, std::string_view text, std::size_t faces,
        const models::polygons::FileAxes& axes)
        : path_(path), axes_(axes), words_(path, text, {.comment = '#', .max_number = largest_number}), used_(faces) {
        orders_.faces = faces;
    }

    CellOrders read() {
        while (words_.next_line()) {
            if (has_more()) { take(); }
        }
        if (seen_.empty()) { throw_error_in(path_, "expected 'draworder 1' first, got an empty file"); }
        if (orders_.cells.empty() && lists_.empty()) {
            throw_error_in(path_, "expected at least one cell or list, got none");
        }
        if (!lists_.empty()) { finish_parts(); }
        return std::move(orders_);
    }

private:
    bool has_more() { return !words_.peek().empty(); }

    double number(const char* what) {
        const auto value = words_.take_number();
        if (!value) { words_.refuse_next(fmt::format("{} (a number within {:g})", what, largest_number)); }
        return *value;
    }

    double non_negative_number(const char* what) {
        const double value = number(what);
        if (value < 0.0) { words_.refuse_last(fmt::format("{} of 0 or more", what)); }
        return value;
    }

    long count(const char* what, long min, long max) {
        const auto value = words_.take_integer(min, max);
        if (!value) { words_.refuse_next(fmt::format("{} ({} to {})", what, min, max)); }
        return *value;
    }

    /// Three numbers: a vector in body axes.
    glm::dvec3 vector(const char* what) {
        const double x = number(what);
        const double y = number(what);
        return axes_.body_from_file({x, y, number(what)});
    }

    glm::dvec3 nonzero_vector(const char* what) {
        const glm::dvec3 v = vector(what);
        if (glm::length(v) < min_length) { words_.refuse_last(fmt::format("{} with a length", what)); }
        return v;
    }

    /// A plane with a normal of any length.
    Plane plane() {
        const glm::dvec3 normal = nonzero_vector("a normal");
        const double length = glm::length(normal);
        // A unit vector stays as written, bit for bit.
        const double factor = std::abs(length - 1.0) < 1e-14 ? 1.0 : 1.0 / length;
        return {normal * factor, number("an offset") * factor};
    }

    std::uint32_t face() {
        const long last = static_cast<long>(orders_.faces) - 1;
        return static_cast<std::uint32_t>(count("a polygon of the model", 0, last));
    }

    /// The polygons up to the end of the line, none of them twice.
    std::vector<std::uint32_t> different_faces() {
        std::vector<std::uint32_t> list;
        while (has_more()) {
            const std::uint32_t polygon = face();
            if (used_[polygon]) { words_.refuse_last("each polygon once"); }
            used_[polygon] = true;
            list.push_back(polygon);
        }
        for (const std::uint32_t polygon : list) { used_[polygon] = false; }
        return list;
    }

    void take() {
        const std::string keyword(words_.peek());
        if (seen_.empty()) {
            const auto& words = words_.words();
            if (words.size() != 2 || keyword != "draworder" || words[1] != "1") {
                words_.refuse_next("'draworder 1' first");
            }
            seen_.insert(keyword);
            return;
        }
        if (keyword != "center" && keyword != "metric" && keyword != "faces" && keyword != "twosided" &&
            keyword != "parents" && keyword != "cell" && keyword != "list" && keyword != "node") {
            words_.refuse_next("center, metric, faces, twosided, parents, cell, list or node");
        }
        const bool is_part = keyword == "list" || keyword == "node";
        if (is_part ? !orders_.cells.empty() : keyword == "cell" && !lists_.empty()) {
            words_.refuse_next("either cells or parts");
        }
        if (!is_part && keyword != "cell" && (!seen_.insert(keyword).second || !orders_.cells.empty())) {
            words_.refuse_next("each keyword once and before the cells");
        }
        words_.word_or_end();
        take(keyword);
        if (has_more()) { words_.refuse_next("the end of the line"); }
    }

    void take(const std::string& keyword) {
        if (keyword == "center") {
            orders_.centre_m = vector("the centre");
        } else if (keyword == "metric") {
            take_metric();
        } else if (keyword == "faces") {
            const long faces = static_cast<long>(orders_.faces);
            count("as many faces as the model has", faces, faces);
        } else if (keyword == "twosided") {
            orders_.two_sided = different_faces();
        } else if (keyword == "parents") {
            take_parents();
        } else if (keyword == "list") {
            need_faces();
            if (lists_.size() == max_cells) { words_.refuse_next(fmt::format("at most {} lists", max_cells)); }
            lists_.push_back(different_faces());
        } else if (keyword == "node") {
            need_faces();
            take_node();
        } else {
            take_cell();
        }
    }

    void need_faces() {
        if (!seen_.contains("faces")) { words_.refuse_last("faces before the first cell or list"); }
    }

    void take_node() {
        if (nodes_.size() == max_cells) { words_.refuse_next(fmt::format("at most {} nodes", max_cells)); }
        DrawOrder::Node node;
        node.kind = words_.skip("choice")     ? DrawOrder::Kind::ViewSplit
                    : words_.skip("parting")  ? DrawOrder::Kind::PolygonSplit
                    : words_.skip("sequence") ? DrawOrder::Kind::Sequence
                                              : throw_wrong_kind();
        if (node.kind != DrawOrder::Kind::Sequence) { node.plane = plane(); }
        node.front = child();
        node.back = child();
        if (node.kind == DrawOrder::Kind::PolygonSplit) {
            node.coplanar_front = child();
            node.coplanar_back = child();
        }
        nodes_.push_back(node);
    }

    [[noreturn]] DrawOrder::Kind throw_wrong_kind() { words_.refuse_next("choice, parting or sequence"); }

    /// A child as DrawOrder::Node has it. Whether a list is there is known only at the end.
    int child() {
        if (words_.skip("nothing")) { return DrawOrder::no_child; }
        const auto most = static_cast<long>(max_cells);
        if (words_.skip("list")) { return ~static_cast<int>(count("the number of a list", 0, most)); }
        if (words_.skip("node")) {
            const auto later = static_cast<long>(nodes_.size()) + 1;
            const auto number = count("the number of a later node", later, most);
            if (!below_one_.insert(number).second) {
                // Where nodes have several parents, the ways from the root may be too many to walk.
                words_.refuse_last("each node below one other");
            }
            return static_cast<int>(number);
        }
        words_.refuse_next("a child: node K, list K or nothing");
    }

    /// Makes the order of the parts that were read.
    void finish_parts() {
        const auto check = [&](int child) {
            const bool there =
                child == DrawOrder::no_child || (child < 0 ? static_cast<std::size_t>(~child) < lists_.size()
                                                           : static_cast<std::size_t>(child) < nodes_.size());
            if (!there) {
                throw_error_in(
                    path_, fmt::format("expected children among {} nodes and {} lists, got {} {}", nodes_.size(),
                               lists_.size(), child < 0 ? "list" : "node", child < 0 ? ~child : child));
            }
        };
        for (const DrawOrder::Node& node : nodes_) {
            check(node.front);
            check(node.back);
            check(node.coplanar_front);
            check(node.coplanar_back);
        }
        if (nodes_.empty() && lists_.size() > 1) {
            throw_error_in(path_, "expected nodes between several lists, got none");
        }
        orders_.parts = DrawOrder(std::move(nodes_), lists_);
    }

    void take_metric() {
        if (words_.peek() != "l1" && words_.peek() != "l2") { words_.refuse_next("l1 or l2"); }
        orders_.metric = words_.peek() == "l1" ? Metric::L1 : Metric::L2;
        words_.word_or_end();
    }

    void take_parents() {
        for (std::size_t i = 0; i < orders_.faces; ++i) {
            orders_.parents.push_back(
                static_cast<std::uint32_t>(count("a polygon of the whole model", 0, 999'999'999)));
        }
    }

    void take_cell() {
        need_faces();
        if (orders_.cells.size() == max_cells) { words_.refuse_next(fmt::format("at most {} cells", max_cells)); }
        ListedCell cell;
        take_region(cell);
        if (words_.skip("min")) { cell.min_m = non_negative_number("the least distance"); }
        if (words_.skip("max")) {
            cell.max_m = non_negative_number("the greatest distance");
            if (cell.max_m <= cell.min_m) { words_.refuse_last("a greatest distance above the least"); }
        }
        if (!words_.skip("order")) { words_.refuse_next("min R, max R or order"); }
        cell.list = different_faces();
        orders_.cells.push_back(std::move(cell));
    }

    /// Reads a cell's region and makes its planes.
    void take_region(ListedCell& cell) {
        if (words_.skip("cone")) {
            const long directions = count("how many directions", 3, max_directions);
            for (long i = 0; i < directions; ++i) { cell.directions.push_back(nonzero_vector("a direction")); }
        } else if (words_.skip("half")) {
            take_planes(cell);
            return;
        } else if (has_more() && draworder::is_octant_path(words_.peek())) {
            cell.path = draworder::path_in_body(std::string(words_.peek()), axes_);
            const auto corners = draworder::octant_triangle(cell.path);
            cell.directions.assign(corners.begin(), corners.end());
            words_.word_or_end();
        } else {
            words_.refuse_next(fmt::format("a region: an octant path such as +-+/0/3 (at most {} levels), cone or half",
                draworder::max_path_levels));
        }
        const auto planes = planes_of_cone(cell.directions, orders_.centre_m);
        if (!planes) { words_.refuse_last("directions that do not lie in one plane"); }
        cell.planes = *planes;
    }

    void take_planes(ListedCell& cell) {
        const long planes = count("how many planes", 0, max_planes);
        for (long i = 0; i < planes; ++i) { cell.planes.push_back(plane()); }
    }

    std::filesystem::path path_;
    models::polygons::FileAxes axes_;
    TextScanner words_;
    CellOrders orders_;
    std::vector<DrawOrder::Node> nodes_;
    std::vector<std::vector<std::uint32_t>> lists_;
    std::set<long> below_one_; ///< The nodes that are children of another one.
    std::vector<bool> used_;   ///< One flag for each polygon; all are false between lines.
    std::set<std::string> seen_;
};

} // namespace

CellOrders read_order_file(
    const std::filesystem::path& path, std::size_t faces, const models::polygons::FileAxes& axes) {
    const std::string text = read_text_file(path);
    return OrderReader(path, text, faces, axes).read();
}

} // namespace octant::visuals::orderfile
