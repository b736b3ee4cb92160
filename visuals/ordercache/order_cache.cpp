// Keeps painting orders as archives (sim/base/binary_file.h). The key is a copy of all that decides the order, not a
// hash of it, so that a file is either of this very model or not used.
#include "visuals/ordercache/order_cache.h"

#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "visuals/draworder/octant_order.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <unistd.h>
#include <unordered_set>
#include <utility>
#include <vector>

namespace octant::visuals::ordercache {

namespace fs = std::filesystem;

// The key and the order as bytes. The reader checks everything: a child is a later node that no other node has, or a
// cell, so that every walk ends after as many steps as there are nodes.

using draworder::DrawOrder;
using draworder::OrderCell;
using draworder::OrderedModel;
using models::polygons::Polygon;
using models::polygons::PolygonModel;

namespace {

static_assert(std::has_unique_object_representations_v<Polygon>);
static_assert(sizeof(glm::dvec3) == 3 * sizeof(double) && sizeof(Plane) == 4 * sizeof(double));

constexpr auto last_kind = static_cast<std::uint32_t>(DrawOrder::Kind::Sequence);
constexpr auto last_way = static_cast<std::uint32_t>(draworder::OrderSource::TreeAndSplitPolygons);

template <class Enum>
void put_enum(BinaryWriter& out, Enum value) {
    out.put(static_cast<std::uint32_t>(value));
}

void put_geometry(BinaryWriter& out, const PolygonModel& model) {
    out.put_list(model.vertices_m);
    out.put_list(model.corner_vertices);
    out.put_list(model.polygons);
    out.put_list(model.parents);
}

void put_node(BinaryWriter& out, const DrawOrder::Node& node) {
    out.put(node.plane);
    put_enum(out, node.kind);
    for (const int child : {node.front, node.back, node.coplanar_front, node.coplanar_back}) { out.put(child); }
}

/// Reads an order and holds it against the model that it is for.
class OrderReader {
public:
    OrderReader(BinaryReader& in, const PolygonModel& given) : in_(in), given_(given) {}

    OrderedModel read() {
        PolygonModel model = geometry();
        DrawOrder draw_order = order(model.polygons.size());
        OrderedModel out{.model = std::move(model), .order = std::move(draw_order), .cells = {}, .notes = {}};
        out.cells = cells(out.order);
        out.centre_m = finite<glm::dvec3>("a finite vector");
        out.min_distance_m = in_.take<double>();
        check(std::isfinite(out.min_distance_m), "a finite distance");
        out.splits = in_.take<int>();
        out.cyclic_cells = in_.take<int>();
        const std::size_t notes = in_.take_count(sizeof(std::uint64_t), "a number of notes");
        for (std::size_t i = 0; i < notes; ++i) { out.notes.push_back(note()); }
        out.found_by = static_cast<draworder::OrderSource>(at_most(last_way, "a way to an order"));
        out.ray_test.rays = in_.take<long>();
        out.ray_test.wrong = in_.take<long>();
        out.ray_test.unproved = in_.take<std::uint64_t>();
        out.ray_test.is_proof_complete = at_most(1, "a yes or no") == 1;
        return out;
    }

private:
    void check(bool good, const char* expected) const { in_.check(good, expected); }

    std::uint32_t at_most(std::uint32_t most, const char* what) {
        const auto value = in_.take<std::uint32_t>();
        if (value > most) { in_.refuse(fmt::format("{} of 0 to {} before", what, most), std::to_string(value)); }
        return value;
    }

    static bool is_finite(const glm::dvec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    }

    static bool is_finite(const Plane& plane) { return is_finite(plane.normal) && std::isfinite(plane.offset_m); }

    /// An array whose elements must all pass a test.
    template <class Value, class Test>
    std::vector<Value> all_that(const Test& is_good, const char* expected) {
        auto values = in_.take_list<Value>();
        check(std::ranges::all_of(values, is_good), expected);
        return values;
    }

    template <class Value>
    Value finite(const char* expected) {
        const auto value = in_.take<Value>();
        check(is_finite(value), expected);
        return value;
    }

    PolygonModel geometry() {
        PolygonModel model;
        model.name = given_.name;
        model.materials = given_.materials;
        model.parts = given_.parts;
        model.pivots = given_.pivots;
        model.notes = given_.notes;
        model.vertices_m = all_that<glm::dvec3>([](const glm::dvec3& v) { return is_finite(v); }, "finite vertices");
        model.corner_vertices = all_that<std::uint32_t>(
            [&](std::uint32_t vertex) { return vertex < model.vertices_m.size(); }, "corners among the vertices");
        model.polygons = all_that<Polygon>(
            [&](const Polygon& polygon) {
                const std::size_t corners = model.corner_vertices.size();
                return polygon.corner_count >= 3 && polygon.corner_count <= corners &&
                       polygon.first_corner <= corners - polygon.corner_count &&
                       polygon.material < given_.materials.size() && polygon.part < given_.parts.size();
            },
            "polygons of corners, materials and parts that are there");
        model.parents = in_.take_list<std::uint32_t>();
        check_parents(model);
        return model;
    }

    /// Each polygon must be a piece of one that is given; those may be pieces of the file's, too.
    void check_parents(const PolygonModel& model) const {
        check(model.parents.empty() || model.parents.size() == model.polygons.size(), "a parent for each polygon");
        std::unordered_set<std::uint32_t> parents;
        for (std::size_t i = 0; i < given_.polygons.size(); ++i) { parents.insert(given_.parent_of(i)); }
        for (std::size_t i = 0; i < model.polygons.size(); ++i) {
            check(parents.contains(model.parent_of(i)), "parents among the polygons of the file");
        }
    }

    DrawOrder order(std::size_t polygons) {
        constexpr std::size_t node_bytes = sizeof(Plane) + 20;
        std::vector<DrawOrder::Node> nodes(in_.take_count(node_bytes, "a number of nodes"));
        for (DrawOrder::Node& node : nodes) {
            node.plane = finite<Plane>("a finite plane");
            node.kind = static_cast<DrawOrder::Kind>(at_most(last_kind, "a kind of node"));
            for (int* child : {&node.front, &node.back, &node.coplanar_front, &node.coplanar_back}) {
                *child = in_.take<int>();
            }
        }
        std::vector<std::vector<std::uint32_t>> lists(in_.take_count(sizeof(std::uint64_t), "a number of lists"));
        std::vector<std::size_t> last_list(polygons, 0); // in which each was seen, from 1
        for (std::size_t i = 0; i < lists.size(); ++i) {
            lists[i] = in_.take_list<std::uint32_t>();
            for (const std::uint32_t polygon : lists[i]) {
                check(
                    polygon < polygons && std::exchange(last_list[polygon], i + 1) <= i, "lists of different polygons");
            }
        }
        check(!nodes.empty() || lists.size() == 1, "one list or nodes");
        check_children(nodes, lists.size());
        return {std::move(nodes), lists};
    }

    void check_children(std::span<const DrawOrder::Node> nodes, std::size_t lists) const {
        std::vector<char> has_parent(nodes.size(), 0);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const auto is_cell_or_nothing = [&](int child) {
                return child == DrawOrder::no_child || (child < 0 && static_cast<std::size_t>(~child) < lists);
            };
            const auto is_child = [&](int child) {
                if (child < 0) { return is_cell_or_nothing(child); }
                const auto node = static_cast<std::size_t>(child);
                const bool is_later = node > i && node < nodes.size();
                return is_later && std::exchange(has_parent[node], 1) == 0;
            };
            const DrawOrder::Node& node = nodes[i];
            check(is_child(node.front) && is_child(node.back) && is_cell_or_nothing(node.coplanar_front) &&
                      is_cell_or_nothing(node.coplanar_back),
                "children that are later nodes or cells");
            check(node.kind != DrawOrder::Kind::ViewSplit ||
                      (node.front != DrawOrder::no_child && node.back != DrawOrder::no_child),
                "a choice between nodes or cells");
        }
    }

    std::vector<OrderCell> cells(const DrawOrder& order) {
        std::vector<OrderCell> cells(in_.take_count(2 * sizeof(std::uint64_t), "a number of regions"));
        for (OrderCell& cell : cells) {
            cell.path = in_.take_text();
            check(cell.path.empty() || draworder::is_octant_path(cell.path), "an octant path");
            cell.planes = all_that<Plane>([](const Plane& plane) { return is_finite(plane); }, "finite planes");
        }
        const bool fits = order.has_one_cell_per_eye() && cells.size() == static_cast<std::size_t>(order.cell_count());
        check(cells.empty() || fits, "a region for each cell");
        return cells;
    }

    /// A line of text.
    std::string note() {
        const std::string_view text = in_.take_text();
        const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
        check(std::ranges::none_of(text, is_control), "a note of one line");
        return std::string(text);
    }

    BinaryReader& in_;
    const PolygonModel& given_;
};

} // namespace

std::string encode_key(const PolygonModel& model, const draworder::OrderOptions& options) {
    BinaryWriter out;
    put_enum(out, options.method);
    out.put(options.seconds);
    put_geometry(out, model);
    out.put(std::uint64_t{model.materials.size()});
    out.put(std::uint64_t{model.parts.size()});
    for (const std::string& part : model.parts) { out.put_text(part); }
    out.put(std::uint64_t{model.pivots.size()});
    for (const models::polygons::Pivot& pivot : model.pivots) {
        out.put(pivot.part);
        out.put(pivot.point_m);
        out.put(pivot.axis);
    }
    return out.bytes();
}

std::string encode_order(const OrderedModel& ordered) {
    BinaryWriter out;
    put_geometry(out, ordered.model);
    const DrawOrder& order = ordered.order;
    out.put(std::uint64_t{order.nodes().size()});
    for (const DrawOrder::Node& node : order.nodes()) { put_node(out, node); }
    out.put(static_cast<std::uint64_t>(order.cell_count()));
    for (int cell = 0; cell < order.cell_count(); ++cell) { out.put_list(order.polygons_of(cell)); }
    out.put(std::uint64_t{ordered.cells.size()});
    for (const OrderCell& cell : ordered.cells) {
        out.put_text(cell.path);
        out.put_list(cell.planes);
    }
    out.put(ordered.centre_m);
    out.put(ordered.min_distance_m);
    out.put(ordered.splits);
    out.put(ordered.cyclic_cells);
    out.put(std::uint64_t{ordered.notes.size()});
    for (const std::string& note : ordered.notes) { out.put_text(note); }
    put_enum(out, ordered.found_by);
    out.put(ordered.ray_test.rays);
    out.put(ordered.ray_test.wrong);
    out.put(ordered.ray_test.unproved);
    out.put(std::uint32_t{ordered.ray_test.is_proof_complete});
    return out.bytes();
}

OrderedModel decode_order(std::string_view bytes, const PolygonModel& given) {
    BinaryReader in(bytes);
    OrderedModel ordered = OrderReader(in, given).read();
    in.expect_end();
    return ordered;
}

void make_cache_folder(const fs::path& folder) {
    try {
        make_folder(folder);
    } catch (const Error& fault) { throw Error(fmt::format("order cache {}", fault.what())); }
    if (::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) {
        throw Error(fmt::format(
            "order cache {}: expected a folder to read and write in, got: {}", folder.string(), std::strerror(errno)));
    }
}

CachedOrder cached_order(const fs::path& folder, PolygonModel model, const draworder::OrderOptions& options) {
    const std::string key = encode_key(model, options);
    const CacheFile cache{.cache = "order cache",
        .file = folder / fmt::format("{:016x}.order", checksum_of(key)),
        .kind = {.content = "a painting order", .signature = "octorder", .version = order_version},
        .key = key};
    std::vector<std::string> notes;
    const auto decode = [&](BinaryReader& in) { return OrderReader(in, model).read(); };
    if (auto kept = read_cache(cache, decode, notes)) { return {std::move(*kept), true, cache.file, {}}; }
    OrderedModel ordered = draworder::ordered(std::move(model), options);
    write_cache(cache, encode_order(ordered), notes);
    return {std::move(ordered), false, cache.file, std::move(notes)};
}

} // namespace octant::visuals::ordercache
