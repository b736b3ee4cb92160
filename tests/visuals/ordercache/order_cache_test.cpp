#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/visuals/ordercache/small_models.h"
#include "visuals/ordercache/order_cache.h"

#include <catch2/catch.hpp>

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
using octant::tests::check_same;
using octant::tests::crossing_plates;
using octant::tests::shipped_model;
using visuals::draworder::ordered;
using visuals::draworder::OrderMethod;
using visuals::draworder::OrderOptions;

namespace {

namespace fs = std::filesystem;

const OrderOptions by_bsp{.method = OrderMethod::Bsp, .paper = {}};

using octant::tests::empty_folder;

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// A folder that keeps the order of the plates, its file, and that file's bytes.
struct Kept {
    fs::path folder;
    fs::path file;
    std::string bytes;
};

Kept kept_plates(const std::string& name) {
    Kept kept{empty_folder(name), {}, {}};
    kept.file = cached_order(kept.folder, crossing_plates(), by_bsp).file;
    kept.bytes = read_file(kept.file);
    return kept;
}

/// Bytes with the checksum that belongs to them at their end, in place of the one there.
std::string with_checksum(std::string bytes) {
    bytes.resize(bytes.size() - sizeof(std::uint64_t));
    Hash hash;
    hash.add(std::as_bytes(std::span(bytes)));
    const std::uint64_t value = hash.value();
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    return bytes;
}

/// Puts bytes in place of the kept file. The plates must then be ordered anew, with one note that names the file, and
/// the file must be as it was.
std::string note_about(const Kept& kept, const std::string& bytes) {
    write_file(kept.file, bytes);
    const CachedOrder found = cached_order(kept.folder, crossing_plates(), by_bsp);
    REQUIRE_FALSE(found.was_cached);
    REQUIRE(found.notes.size() == 1);
    REQUIRE(read_file(kept.file) == kept.bytes);
    const std::string& note = found.notes.front();
    REQUIRE(note.starts_with("order cache " + kept.file.string() + ": expected "));
    REQUIRE(note.find(", got ") != std::string::npos);
    REQUIRE(note.ends_with(": computed anew"));
    return note;
}

} // namespace

TEST_CASE("a model is ordered once and read from then on, with the same result") {
    const fs::path folder = empty_folder("once");
    for (const char* name : {"f15", "500md"}) {
        const PolygonModel model = shipped_model(name);
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
    cached_order(folder, crossing_plates(), by_bsp);
    PolygonModel moved = crossing_plates();
    moved.vertices_m[4].x -= 0.25;
    CHECK_FALSE(cached_order(folder, moved, by_bsp).was_cached);
    CHECK_FALSE(cached_order(folder, crossing_plates(), {}).was_cached);
    CHECK(cached_order(folder, moved, by_bsp).was_cached);
    CHECK(cached_order(folder, crossing_plates(), by_bsp).was_cached);
    CHECK(files_in(folder) == 3);
}

TEST_CASE("a model in other colours shares the order and keeps its colours") {
    const fs::path folder = empty_folder("colours");
    cached_order(folder, crossing_plates(), by_bsp);
    PolygonModel green = crossing_plates();
    green.materials[0] = {"green", {0, 1, 0}};
    const CachedOrder found = cached_order(folder, green, by_bsp);
    CHECK(found.was_cached);
    CHECK(found.ordered.model.materials[0].name == "green");
    check_same(found.ordered, ordered(green, by_bsp));
}

TEST_CASE("a file cut short anywhere is computed anew and replaced") {
    const Kept kept = kept_plates("short");
    for (std::size_t length = 0; length < kept.bytes.size(); ++length) {
        note_about(kept, kept.bytes.substr(0, length));
    }
    CHECK_THAT(note_about(kept, kept.bytes + "x"), Contains("expected bytes of checksum "));
}

TEST_CASE("a file with any byte changed is computed anew and replaced") {
    const Kept kept = kept_plates("flipped");
    for (std::size_t at = 0; at < kept.bytes.size(); ++at) {
        std::string bytes = kept.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
        note_about(kept, bytes);
    }
}

TEST_CASE("a file of another version, kind or model is computed anew, whatever its checksum") {
    const Kept kept = kept_plates("version");
    std::string older = kept.bytes;
    older[8] = static_cast<char>(order_version + 1);
    CHECK_THAT(note_about(kept, with_checksum(older)),
        Contains(fmt::format("expected version {}, got {}", order_version, order_version + 1)));
    CHECK_THAT(note_about(kept, "v 0 0 0\nv 1 0 0\n"), Contains("got another kind of file"));

    PolygonModel moved = crossing_plates();
    moved.vertices_m[4].x -= 0.25;
    CHECK_THAT(note_about(kept, read_file(cached_order(kept.folder, moved, by_bsp).file)),
        Contains("got that of another one"));
}

TEST_CASE("a forged file whose numbers lead nowhere is computed anew") {
    const Kept kept = kept_plates("forged");
    std::string bytes = kept.bytes;
    // Behind signature, version and key stand the number of vertices and, 24 bytes each, they.
    std::uint64_t key_size = 0;
    std::memcpy(&key_size, bytes.data() + 12, sizeof key_size);
    const auto vertices_at = static_cast<std::size_t>(20 + key_size);
    std::memset(bytes.data() + vertices_at, 0xff, 8);
    CHECK_THAT(note_about(kept, with_checksum(bytes)), Contains(" times 24 bytes, got "));
}

TEST_CASE("a folder in the place of a file is told, and the order is computed all the same") {
    const Kept kept = kept_plates("folder");
    fs::remove(kept.file);
    fs::create_directories(kept.file / "inside");
    const CachedOrder found = cached_order(kept.folder, crossing_plates(), by_bsp);
    check_same(found.ordered, ordered(crossing_plates(), by_bsp));
    CHECK(found.notes.size() == 2);
    CHECK(files_in(kept.folder) == 1);
}

TEST_CASE("a folder that is gone by the time of writing costs a note, not the order") {
    const fs::path folder = empty_folder("gone");
    fs::remove_all(folder);
    const CachedOrder found = cached_order(folder, crossing_plates(), by_bsp);
    check_same(found.ordered, ordered(crossing_plates(), by_bsp));
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
                team.emplace_back([&] { one = cached_order(folder, crossing_plates(), by_bsp); });
            }
        }
        for (const auto& one : found) {
            CHECK(one->notes.empty());
            check_same(one->ordered, found.front()->ordered);
        }
        CHECK(files_in(folder) == 1);
        CHECK(cached_order(folder, crossing_plates(), by_bsp).was_cached);
    }
}
