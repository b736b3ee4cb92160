// A file is: signature, version, the key, the order, and a checksum of all bytes before it. The key is a copy of all
// that decides the order, not a hash of it, so that a file is either of this very model or not used.
#include "visuals/ordercache/order_cache.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/ordercache/binary_file.h"

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
void add_enum(BinaryWriter& out, Enum value) {
    out.number(static_cast<std::uint32_t>(value));
}

void add_vector(BinaryWriter& out, const glm::dvec3& vector) { out.array(std::span(&vector, 1)); }

void add_geometry(BinaryWriter& out, const PolygonModel& model) {
    out.array(model.vertices_m);
    out.array(model.corner_vertices);
    out.array(model.polygons);
    out.array(model.parents);
}

void add_node(BinaryWriter& out, const DrawOrder::Node& node) {
    out.array(std::span(&node.plane, 1));
    add_enum(out, node.kind);
    for (const int child : {node.front, node.back, node.coplanar_front, node.coplanar_back}) { out.number(child); }
}

/// Reads an order and holds it against the model that it is for.
class OrderReader {
public:
    OrderReader(std::string_view bytes, const PolygonModel& given) : in_(bytes), given_(given) {}

    OrderedModel read() {
        PolygonModel model = geometry();
        DrawOrder draw_order = order(model.polygons.size());
        OrderedModel out{.model = std::move(model), .order = std::move(draw_order), .cells = {}, .notes = {}};
        out.cells = cells(out.order);
        out.centre_m = vector();
        out.min_distance_m = in_.number<double>();
        check(std::isfinite(out.min_distance_m), "a finite distance");
        out.splits = in_.number<int>();
        out.cyclic_cells = in_.number<int>();
        const std::size_t notes = in_.count(sizeof(std::uint64_t));
        for (std::size_t i = 0; i < notes; ++i) { out.notes.push_back(note()); }
        out.found_by = static_cast<draworder::OrderSource>(at_most(last_way, "a way to an order"));
        out.ray_test.rays = in_.number<long>();
        out.ray_test.wrong = in_.number<long>();
        out.ray_test.unproved = in_.number<std::uint64_t>();
        out.ray_test.is_proof_complete = at_most(1, "a yes or no") == 1;
        check(in_.bytes_left() == 0, "the end");
        return out;
    }

private:
    static void check(bool good, const char* expected) {
        if (!good) { throw Error(fmt::format("expected {}, got something else", expected)); }
    }

    std::uint32_t at_most(std::uint32_t most, const char* what) {
        const auto value = in_.number<std::uint32_t>();
        if (value > most) { throw Error(fmt::format("expected {} of 0 to {}, got {}", what, most, value)); }
        return value;
    }

    static bool is_finite(const glm::dvec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    }

    static bool is_finite(const Plane& plane) { return is_finite(plane.normal) && std::isfinite(plane.offset_m); }

    /// An array whose elements must all pass a test.
    template <class Value, class Test>
    std::vector<Value> all_that(const Test& is_good, const char* expected) {
        auto values = in_.array<Value>();
        check(std::ranges::all_of(values, is_good), expected);
        return values;
    }

    template <class Value>
    Value one_that_is_finite(const char* expected) {
        const auto is_good = [](const Value& value) { return is_finite(value); };
        const auto values = all_that<Value>(is_good, expected);
        check(values.size() == 1, expected);
        return values.front();
    }

    glm::dvec3 vector() { return one_that_is_finite<glm::dvec3>("a finite vector"); }

    Plane plane() { return one_that_is_finite<Plane>("a finite plane"); }

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
        model.parents = in_.array<std::uint32_t>();
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
        constexpr std::size_t node_bytes = sizeof(std::uint64_t) + sizeof(Plane) + 20;
        std::vector<DrawOrder::Node> nodes(in_.count(node_bytes));
        for (DrawOrder::Node& node : nodes) {
            node.plane = plane();
            node.kind = static_cast<DrawOrder::Kind>(at_most(last_kind, "a kind of node"));
            for (int* child : {&node.front, &node.back, &node.coplanar_front, &node.coplanar_back}) {
                *child = in_.number<int>();
            }
        }
        std::vector<std::vector<std::uint32_t>> lists(in_.count(sizeof(std::uint64_t)));
        std::vector<std::size_t> last_list(polygons, 0); // in which each was seen, from 1
        for (std::size_t i = 0; i < lists.size(); ++i) {
            lists[i] = in_.array<std::uint32_t>();
            for (const std::uint32_t polygon : lists[i]) {
                check(
                    polygon < polygons && std::exchange(last_list[polygon], i + 1) <= i, "lists of different polygons");
            }
        }
        check(!nodes.empty() || lists.size() == 1, "one list or nodes");
        check_children(nodes, lists.size());
        return {std::move(nodes), lists};
    }

    static void check_children(std::span<const DrawOrder::Node> nodes, std::size_t lists) {
        std::vector<char> has_parent(nodes.size(), 0);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const auto is_cell_or_nothing = [&](int child) {
                return child == DrawOrder::nothing || (child < 0 && static_cast<std::size_t>(~child) < lists);
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
                      (node.front != DrawOrder::nothing && node.back != DrawOrder::nothing),
                "a choice between nodes or cells");
        }
    }

    std::vector<OrderCell> cells(const DrawOrder& order) {
        std::vector<OrderCell> cells(in_.count(2 * sizeof(std::uint64_t)));
        for (OrderCell& cell : cells) {
            cell.path = in_.text();
            check(cell.path.empty() || draworder::is_octant_path(cell.path), "an octant path");
            cell.planes = all_that<Plane>([](const Plane& plane) { return is_finite(plane); }, "finite planes");
        }
        const bool fits = order.has_one_cell_per_eye() && cells.size() == static_cast<std::size_t>(order.cell_count());
        check(cells.empty() || fits, "a region for each cell");
        return cells;
    }

    /// A line of text.
    std::string note() {
        const std::string_view text = in_.text();
        const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
        check(std::ranges::none_of(text, is_control), "a note of one line");
        return std::string(text);
    }

    BinaryReader in_;
    const PolygonModel& given_;
};

} // namespace

std::string encode_key(const PolygonModel& model, const draworder::OrderOptions& options) {
    BinaryWriter out;
    add_enum(out, options.method);
    out.number(options.seconds);
    out.number(options.min_distance_radii);
    add_vector(out, options.paper.viewpoint_radii);
    add_enum(out, options.paper.screen);
    add_enum(out, options.paper.listed);
    add_geometry(out, model);
    out.number(std::uint64_t{model.materials.size()});
    out.number(std::uint64_t{model.parts.size()});
    for (const std::string& part : model.parts) { out.text(part); }
    out.number(std::uint64_t{model.pivots.size()});
    for (const models::polygons::Pivot& pivot : model.pivots) {
        out.number(pivot.part);
        add_vector(out, pivot.point_m);
        add_vector(out, pivot.axis);
    }
    return out.bytes();
}

std::string encode_order(const OrderedModel& ordered) {
    BinaryWriter out;
    add_geometry(out, ordered.model);
    const DrawOrder& order = ordered.order;
    out.number(std::uint64_t{order.nodes().size()});
    for (const DrawOrder::Node& node : order.nodes()) { add_node(out, node); }
    out.number(static_cast<std::uint64_t>(order.cell_count()));
    for (int cell = 0; cell < order.cell_count(); ++cell) { out.array(order.polygons_of(cell)); }
    out.number(std::uint64_t{ordered.cells.size()});
    for (const OrderCell& cell : ordered.cells) {
        out.text(cell.path);
        out.array(cell.planes);
    }
    add_vector(out, ordered.centre_m);
    out.number(ordered.min_distance_m);
    out.number(ordered.splits);
    out.number(ordered.cyclic_cells);
    out.number(std::uint64_t{ordered.notes.size()});
    for (const std::string& note : ordered.notes) { out.text(note); }
    add_enum(out, ordered.found_by);
    out.number(ordered.ray_test.rays);
    out.number(ordered.ray_test.wrong);
    out.number(ordered.ray_test.unproved);
    out.number(std::uint32_t{ordered.ray_test.is_proof_complete});
    return out.bytes();
}

OrderedModel decode_order(std::string_view bytes, const PolygonModel& given) {
    return OrderReader(bytes, given).read();
}

namespace fs = std::filesystem;
using draworder::OrderedModel;
using draworder::OrderOptions;
using models::polygons::PolygonModel;

namespace {

/// "octorder" as a little-endian machine writes it; another machine's files read as something else.
constexpr std::uint64_t signature = 0x726564726f74636fULL;
constexpr std::size_t checksum_bytes = sizeof(std::uint64_t);
/// Larger orders are not kept, and larger files not read.
constexpr std::size_t max_bytes = std::size_t{1} << 30;

fs::path file_of_key(const fs::path& folder, std::string_view key) {
    return folder / fmt::format("{:016x}.order", checksum_of(key));
}

std::string file_bytes(std::string_view key, const OrderedModel& ordered) {
    BinaryWriter out;
    out.number(signature);
    out.number(order_version);
    out.text(key);
    out.raw(encode_order(ordered));
    out.number(checksum_of(out.bytes()));
    return out.bytes();
}

/// Throws Error "expected ..., got ...".
OrderedModel from_file_bytes(std::string_view bytes, std::string_view key, const PolygonModel& given) {
    BinaryReader head(bytes);
    if (head.number<std::uint64_t>() != signature) {
        throw Error("expected a kept painting order, got another kind of file");
    }
    if (const auto version = head.number<std::uint32_t>(); version != order_version) {
        throw Error(fmt::format("expected version {}, got {}", order_version, version));
    }
    if (head.bytes_left() < checksum_bytes) { throw Error("expected a checksum, got the end of the file"); }
    const std::string_view summed = bytes.substr(0, bytes.size() - checksum_bytes);
    const auto checksum = BinaryReader(bytes.substr(summed.size())).number<std::uint64_t>();
    if (checksum_of(summed) != checksum) {
        throw Error(fmt::format("expected bytes of checksum {:016x}, got {:016x}", checksum, checksum_of(summed)));
    }
    BinaryReader rest(summed.substr(bytes.size() - head.bytes_left()));
    if (rest.text() != key) { throw Error("expected the order of this model, got that of another one"); }
    return decode_order(summed.substr(summed.size() - rest.bytes_left()), given);
}

/// Throws Error "file: expected ..., got ...".
OrderedModel read_order(const fs::path& file, std::string_view key, const PolygonModel& given) {
    const std::string bytes = read_file(file, max_bytes);
    try {
        return from_file_bytes(bytes, key, given);
    } catch (const Error& fault) { throw_error_in(file, fault.what()); }
}

/// The order that a file holds; nothing, and a note where there is a file, when it cannot be used.
std::optional<OrderedModel> kept_order(
    const fs::path& file, std::string_view key, const PolygonModel& given, std::vector<std::string>& notes) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) { return std::nullopt; }
    try {
        return read_order(file, key, given);
    } catch (const Error& fault) {
        notes.push_back(fmt::format("order cache {}: computed anew", fault.what()));
        return std::nullopt;
    }
}

/// Writes the file of an order; a note where that is not possible.
void keep(const fs::path& file, std::string_view key, const OrderedModel& ordered, std::vector<std::string>& notes) {
    const std::string bytes = file_bytes(key, ordered);
    try {
        if (bytes.size() > max_bytes) {
            throw_error_in(file, fmt::format("expected at most {} bytes, got {}", max_bytes, bytes.size()));
        }
        write_file(file, bytes);
    } catch (const Error& fault) { notes.push_back(fmt::format("order cache {}: not kept", fault.what())); }
}

} // namespace

void make_cache_folder(const fs::path& folder) {
    try {
        make_folder(folder);
    } catch (const Error& fault) { throw Error(fmt::format("order cache {}", fault.what())); }
    if (::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) {
        throw Error(fmt::format(
            "order cache {}: expected a folder to read and write in, got: {}", folder.string(), std::strerror(errno)));
    }
}

CachedOrder cached_order(const fs::path& folder, PolygonModel model, const OrderOptions& options) {
    const std::string key = encode_key(model, options);
    const fs::path file = file_of_key(folder, key);
    std::vector<std::string> notes;
    if (auto kept = kept_order(file, key, model, notes)) { return {std::move(*kept), true, file, {}}; }
    OrderedModel ordered = draworder::ordered(std::move(model), options);
    keep(file, key, ordered, notes);
    return {std::move(ordered), false, file, std::move(notes)};
}

} // namespace octant::visuals::ordercache
