#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/ordercache/order_cache.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace octant;
using namespace octant::visuals::ordercache;
using Catch::Contains;
using models::polygons::PolygonModel;
using visuals::draworder::DrawOrder;
using visuals::draworder::ordered;
using visuals::draworder::OrderedModel;
using visuals::draworder::OrderOptions;

namespace {

/// f15, 500md or concave.
PolygonModel shipped_model(const std::string& name) {
    return models::polygons::read_obj(OCTANT_SOURCE_DIR "/models/" + name + ".obj");
}

/// Two rectangles that pass through one another: one of them must be split.
PolygonModel crossing_plates() {
    PolygonModel model;
    model.name = "plates";
    model.vertices_m = {
        {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-0.5, 0, -1}, {0.5, 0, -1}, {0.5, 0.1, 1}, {-0.5, 0.1, 1}};
    model.corner_vertices = {0, 1, 2, 3, 4, 5, 6, 7};
    model.polygons = {{0, 4, 0, 0}, {4, 4, 1, 1}};
    model.materials = {{"red", {1, 0, 0}}, {"blue", {0, 0, 1}}};
    model.parts = {"flat", "upright"};
    return model;
}

/// Checks that two ordered models are the same, bit for bit, and that all that a drawing takes from them is.
void check_same(const OrderedModel& one, const OrderedModel& other) {
    CHECK(encode_order(one) == encode_order(other));
    CHECK(std::ranges::equal(one.order.polygons(), other.order.polygons()));
    CHECK(one.order.list_count() == other.order.list_count());
    CHECK(one.order.has_one_cell_per_eye() == other.order.has_one_cell_per_eye());
    CHECK(one.notes == other.notes);
    CHECK(one.model.name == other.model.name);
    CHECK(one.model.parts == other.model.parts);
    CHECK(one.model.notes == other.model.notes);
    const auto same_material = [](const models::Material& a, const models::Material& b) {
        return a.name == b.name && a.colour == b.colour;
    };
    CHECK(std::ranges::equal(one.model.materials, other.model.materials, same_material));
    const auto same_pivot = [](const models::polygons::Pivot& a, const models::polygons::Pivot& b) {
        return a.part == b.part && a.point_m == b.point_m && a.axis == b.axis && a.turns_per_s == b.turns_per_s;
    };
    CHECK(std::ranges::equal(one.model.pivots, other.model.pivots, same_pivot));
}

const OrderOptions by_paper{.method = visuals::draworder::OrderMethod::Paper};
const OrderOptions by_splitting{.seconds = 0.0};
const std::vector<OrderOptions> every_way{by_paper, {}, by_splitting};

/// Reads bytes that may be anything. Where they are taken for an order, eyes all around must be able to ask it for what
/// is painted, and that must be polygons of the model.
void read_anything(const std::string& bytes, const PolygonModel& given) {
    try {
        const OrderedModel read = decode_order(bytes, given);
        DrawOrder::Walk walk;
        for (const double x : {-10.0, 10.0}) {
            for (const double z : {-10.0, 10.0}) {
                std::vector<std::uint32_t> painted;
                read.order.append_painted({x, 3.0, z}, walk, painted);
                for (const std::uint32_t polygon : painted) {
                    REQUIRE(polygon < read.model.polygons.size());
                    for (const std::uint32_t vertex : read.model.corners(polygon)) {
                        REQUIRE(vertex < read.model.vertices_m.size());
                    }
                }
            }
        }
    } catch (const Error& fault) {
        REQUIRE_THAT(fault.what(), Catch::StartsWith("at byte ") && Contains(": expected "));
    }
}

/// An order of two whole plates from these nodes and lists, as bytes.
std::string order_of(const std::vector<DrawOrder::Node>& nodes, const std::vector<std::vector<std::uint32_t>>& lists) {
    const PolygonModel model = crossing_plates();
    BinaryWriter out;
    out.put_list(model.vertices_m);
    out.put_list(model.corner_vertices);
    out.put_list(model.polygons);
    out.put_list(model.parents);
    out.put(std::uint64_t{nodes.size()});
    for (const DrawOrder::Node& node : nodes) {
        out.put(node.plane);
        out.put(static_cast<std::uint32_t>(node.kind));
        for (const int child : {node.front, node.back, node.coplanar_front, node.coplanar_back}) { out.put(child); }
    }
    out.put(std::uint64_t{lists.size()});
    for (const auto& list : lists) { out.put_list(list); }
    // No regions, the centre, the least distance, splits, cycles, no notes, a tree, the trial.
    const OrderedModel rest{.model = {}, .order = DrawOrder(std::vector<std::uint32_t>{}), .cells = {}, .notes = {}};
    constexpr std::size_t before_rest = 4 * 8 + 8 + 8 + 8;
    out.put_bytes(encode_order(rest).substr(before_rest));
    return out.bytes();
}

std::string fault_of(const std::vector<DrawOrder::Node>& nodes, const std::vector<std::vector<std::uint32_t>>& lists) {
    try {
        decode_order(order_of(nodes, lists), crossing_plates());
    } catch (const Error& fault) {
        const std::string what = fault.what();
        return what.substr(what.find(": ") + 2); // behind "at byte N"
    }
    return "";
}

} // namespace

TEST_CASE("an ordered model read back is the same, bit for bit, by every method") {
    for (const OrderOptions& way : every_way) {
        for (const PolygonModel& model :
            {shipped_model("f15"), shipped_model("500md"), shipped_model("concave"), crossing_plates()}) {
            CAPTURE(model.name, static_cast<int>(way.method), way.seconds);
            const OrderedModel ordered = visuals::draworder::ordered(model, way);
            check_same(decode_order(encode_order(ordered), model), ordered);
        }
    }
}

TEST_CASE("an order without any polygon is read back, too") {
    const PolygonModel model;
    const OrderedModel ordered = visuals::draworder::ordered(model);
    check_same(decode_order(encode_order(ordered), model), ordered);
}

TEST_CASE("what decides the order is in the key, names and colours are not") {
    const PolygonModel plates = crossing_plates();
    const OrderOptions options;
    const std::string key = encode_key(plates, options);
    PolygonModel other = plates;
    other.name = "painted plates";
    other.notes = {"plates.obj:1: faded"};
    other.materials[1] = {"green", {0, 1, 0}};
    CHECK(encode_key(other, options) == key);

    std::vector<PolygonModel> changed(7, plates);
    changed[0].vertices_m[7].z += 1e-15;
    changed[1].corner_vertices = {1, 2, 3, 0, 4, 5, 6, 7};
    changed[2].polygons[1].material = 0;
    changed[3].polygons[1].part = 0;
    changed[4].parts[1] = "rotor";
    changed[5].pivots = {{1, {0, 0, 0}, {0, 0, 1}, 6.0}};
    changed[6].parents = {0, 0};
    for (const PolygonModel& model : changed) { CHECK(encode_key(model, options) != key); }
    std::vector<OrderOptions> asked(2);
    asked[0].method = visuals::draworder::OrderMethod::Paper;
    asked[1].seconds = 19.0;
    for (const OrderOptions& one : asked) { CHECK(encode_key(plates, one) != key); }
}

TEST_CASE("an order cut short anywhere is refused") {
    const PolygonModel model = crossing_plates();
    const std::string bytes = encode_order(visuals::draworder::ordered(model));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        CHECK_THROWS_AS(decode_order(bytes.substr(0, length), model), Error);
    }
    CHECK_THROWS_AS(decode_order(bytes + '\0', model), Error);
}

TEST_CASE("bytes changed at will are refused or lead to nothing that is not there") {
    for (const OrderOptions& way : every_way) {
        const PolygonModel model = crossing_plates();
        const std::string bytes = encode_order(visuals::draworder::ordered(model, way));
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            for (const int value : {0x00, 0x01, 0x7f, 0x80, 0xff}) {
                std::string changed = bytes;
                changed[at] = static_cast<char>(value);
                read_anything(changed, model);
            }
        }
    }
}

TEST_CASE("nodes and lists that are no tree over the polygons are refused") {
    const DrawOrder::Node leaf{.plane = {}, .front = ~0, .back = ~1};
    CHECK(fault_of({}, {{0, 1}}).empty());
    CHECK(fault_of({leaf}, {{0, 1}, {1, 0}}).empty());
    const std::string children = "expected children that are later nodes or cells";
    CHECK(fault_of({{.plane = {}, .front = 0, .back = ~0}}, {{0}}).starts_with(children));
    CHECK(fault_of({{.plane = {}, .front = 1, .back = ~0}}, {{0}}).starts_with(children));
    CHECK(fault_of({leaf}, {{0, 1}}).starts_with(children));
    CHECK(fault_of({{.plane = {}, .front = 1, .back = 1}, leaf}, {{0}, {1}}).starts_with(children));
    CHECK(fault_of({{.plane = {}, .front = ~0, .back = DrawOrder::no_child}},
        {{0}}).starts_with("expected a choice between nodes or cells"));
    CHECK(fault_of({}, {{0, 2}}).starts_with("expected lists of different polygons"));
    CHECK(fault_of({}, {{1, 0, 1}}).starts_with("expected lists of different polygons"));
    CHECK(fault_of({}, {{0}, {1}}).starts_with("expected one list or nodes"));
    CHECK(fault_of({}, {}).starts_with("expected one list or nodes"));
}

TEST_CASE("a builder that gives other orders has another version") {
    // Where this fails, draworder::ordered() gives other results than before, and files that were kept would go on
    // giving the old ones: raise order_version, and write the new number here.
    Hash hash;
    const auto add = [&](const OrderedModel& ordered) {
        hash.add(std::as_bytes(ordered.order.polygons()));
        for (const DrawOrder::Node& node : ordered.order.nodes()) {
            hash.add(std::as_bytes(std::span(&node.front, 1)));
            hash.add(std::as_bytes(std::span(&node.back, 1)));
        }
    };
    for (const char* name : {"f15", "500md", "concave"}) {
        for (const OrderOptions& way : every_way) { add(visuals::draworder::ordered(shipped_model(name), way)); }
    }
    add(visuals::draworder::ordered(crossing_plates()));
    add(visuals::draworder::ordered(models::procedural::torus(), by_splitting));
    CHECK(order_version == 12);
    CHECK(hash.value() == 0xe2e2fdf1cf1160b1ULL);
}

namespace {

namespace fs = std::filesystem;

using octant::tests::empty_folder;

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// A folder that keeps the order of a model, its file, and that file's bytes.
struct Kept {
    fs::path folder;
    PolygonModel model;
    fs::path file;
    std::string bytes;
};

Kept kept_order(const std::string& name, const PolygonModel& model) {
    Kept kept{empty_folder(name), model, {}, {}};
    kept.file = cached_order(kept.folder, model, by_splitting).file;
    kept.bytes = read_file(kept.file);
    return kept;
}

Kept kept_plates(const std::string& name) { return kept_order(name, crossing_plates()); }

/// A model without polygons, whose order takes no time.
PolygonModel no_polygons() {
    PolygonModel model;
    model.parts = {"flat"};
    return model;
}

/// Bytes of an archive with the checksum that belongs to their body.
std::string with_checksum(std::string bytes) {
    const std::uint64_t sum = checksum_of(std::string_view(bytes).substr(32));
    std::memcpy(&bytes[24], &sum, sizeof sum);
    return bytes;
}

/// Puts bytes in place of the kept file. The model must then be ordered anew, with one note that names the file, and
/// the file must be as it was.
std::string note_about(const Kept& kept, const std::string& bytes) {
    write_file(kept.file, bytes);
    const CachedOrder found = cached_order(kept.folder, kept.model, by_splitting);
    REQUIRE_FALSE(found.was_cached);
    REQUIRE(found.notes.size() == 1);
    REQUIRE(read_file(kept.file) == kept.bytes);
    const std::string& note = found.notes.front();
    REQUIRE_THAT(
        note, Catch::StartsWith("order cache " + kept.file.string() + ": at byte ") && Contains(": expected "));
    REQUIRE(note.find(", got ") != std::string::npos);
    REQUIRE(note.ends_with(": computed anew"));
    return note;
}

} // namespace

TEST_CASE("a model is ordered once and read from then on, with the same result") {
    const fs::path folder = empty_folder("once");
    for (const PolygonModel& model : {shipped_model("f15"), crossing_plates()}) {
        const CachedOrder cold = cached_order(folder, model, {});
        CHECK_FALSE(cold.was_cached);
        const CachedOrder warm = cached_order(folder, model, {});
        CHECK(warm.was_cached);
        CHECK(warm.notes.empty());
        check_same(cold.ordered, ordered(model));
        check_same(warm.ordered, cold.ordered);
    }
    CHECK(files_in(folder) == 2);
}

TEST_CASE("another model or another option is another order") {
    const fs::path folder = empty_folder("other");
    cached_order(folder, crossing_plates(), by_splitting);
    PolygonModel moved = crossing_plates();
    moved.vertices_m[4].x -= 0.25;
    CHECK_FALSE(cached_order(folder, moved, by_splitting).was_cached);
    CHECK_FALSE(cached_order(folder, crossing_plates(), {}).was_cached);
    CHECK(cached_order(folder, moved, by_splitting).was_cached);
    CHECK(cached_order(folder, crossing_plates(), by_splitting).was_cached);
    CHECK(files_in(folder) == 3);
}

TEST_CASE("a model in other colours shares the order and keeps its colours") {
    const fs::path folder = empty_folder("colours");
    cached_order(folder, crossing_plates(), by_splitting);
    PolygonModel green = crossing_plates();
    green.materials[0] = {"green", {0, 1, 0}};
    const CachedOrder found = cached_order(folder, green, by_splitting);
    CHECK(found.was_cached);
    CHECK(found.ordered.model.materials[0].name == "green");
    check_same(found.ordered, ordered(green, by_splitting));
}

TEST_CASE("a file cut short anywhere is computed anew and replaced") {
    const Kept kept = kept_order("short", no_polygons());
    for (std::size_t length = 0; length < kept.bytes.size(); ++length) {
        note_about(kept, kept.bytes.substr(0, length));
    }
    CHECK_THAT(note_about(kept, kept.bytes + "x"), Contains("bytes behind the head, got "));
}

TEST_CASE("a file with any byte changed is computed anew and replaced") {
    const Kept kept = kept_order("flipped", no_polygons());
    for (std::size_t at = 0; at < kept.bytes.size(); ++at) {
        std::string bytes = kept.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
        note_about(kept, bytes);
    }
}

TEST_CASE("an order's file cut short anywhere or with any byte changed is refused before it is decoded") {
    const Kept kept = kept_plates("refused-early");
    const ArchiveKind kind{.content = "a painting order", .signature = "octorder", .version = order_version};
    archive_body(kept.bytes, kept.file, kind);
    for (std::size_t at = 0; at < kept.bytes.size(); ++at) {
        std::string bytes = kept.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
        CHECK_THROWS_AS(archive_body(bytes, kept.file, kind), Error);
        CHECK_THROWS_AS(archive_body(kept.bytes.substr(0, at), kept.file, kind), Error);
    }
}

TEST_CASE("a file of another version, kind or model is computed anew, whatever its checksum") {
    const Kept kept = kept_plates("version");
    std::string older = kept.bytes;
    older[8] = static_cast<char>(order_version + 1);
    CHECK_THAT(note_about(kept, with_checksum(older)),
        Contains(fmt::format("expected version {}, got {}", order_version, order_version + 1)));
    CHECK_THAT(note_about(kept, "v 0 0 0\nv 1 0 0\n"), Contains("expected a painting order, got another file"));

    PolygonModel moved = crossing_plates();
    moved.vertices_m[4].x -= 0.25;
    CHECK_THAT(note_about(kept, read_file(cached_order(kept.folder, moved, by_splitting).file)),
        Contains("expected the key of this input, got that of another one"));
}

TEST_CASE("a forged file whose numbers lead nowhere is computed anew") {
    const Kept kept = kept_plates("forged");
    std::string bytes = kept.bytes;
    // Behind the head and the key stand the number of vertices and, 24 bytes each, they.
    const std::size_t vertices_at = 40 + value_at<std::uint64_t>(&bytes[32]);
    std::memset(bytes.data() + vertices_at, 0xff, 8);
    CHECK_THAT(note_about(kept, with_checksum(bytes)), Contains(" times 24 bytes, got 18446744073709551615"));
}

TEST_CASE("a folder in the place of a file is told, and the order is computed all the same") {
    const Kept kept = kept_plates("folder");
    fs::remove(kept.file);
    fs::create_directories(kept.file / "inside");
    const CachedOrder found = cached_order(kept.folder, crossing_plates(), by_splitting);
    check_same(found.ordered, ordered(crossing_plates(), by_splitting));
    CHECK(found.notes.size() == 2);
    CHECK(files_in(kept.folder) == 1);
}

TEST_CASE("a folder that is gone by the time of writing costs a note, not the order") {
    const fs::path folder = empty_folder("gone");
    fs::remove_all(folder);
    const CachedOrder found = cached_order(folder, crossing_plates(), by_splitting);
    check_same(found.ordered, ordered(crossing_plates(), by_splitting));
    REQUIRE(found.notes.size() == 1);
    CHECK_THAT(found.notes.front(), Contains("cannot be written") && Contains(": not kept"));
}

TEST_CASE("a place that cannot be a folder, or not be written in, is refused at once") {
    const fs::path folder = empty_folder("refused");
    write_file(folder / "file", "");
    CHECK_THROWS_WITH(
        make_cache_folder(folder / "file" / "cache"), Contains("order cache " + (folder / "file" / "cache").string()));
    CHECK_THROWS_AS(make_cache_folder(folder / "file"), Error);
    make_cache_folder(folder / "a" / "b");
    CHECK(fs::is_directory(folder / "a" / "b"));
    if (::geteuid() != 0) { // root may write anywhere
        fs::permissions(folder / "a", fs::perms::owner_read | fs::perms::owner_exec);
        CHECK_THROWS_WITH(make_cache_folder(folder / "a"), Contains("a folder to read and write"));
        fs::permissions(folder / "a", fs::perms::owner_all);
    }
}

TEST_CASE("threads that order one model at once all get it, and one whole file stays") {
    const fs::path folder = empty_folder("threads");
    constexpr std::size_t threads = 4;
    constexpr int rounds = 20;
    for (int round = 0; round < rounds; ++round) {
        empty_folder("threads");
        std::vector<std::optional<CachedOrder>> found(threads);
        {
            std::vector<std::jthread> team;
            for (auto& one : found) {
                team.emplace_back([&] { one = cached_order(folder, crossing_plates(), by_splitting); });
            }
        }
        for (const auto& one : found) {
            CHECK(one->notes.empty());
            check_same(one->ordered, found.front()->ordered);
        }
        CHECK(files_in(folder) == 1);
        CHECK(cached_order(folder, crossing_plates(), by_splitting).was_cached);
    }
}
