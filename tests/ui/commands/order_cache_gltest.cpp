#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

using namespace octant;
using Catch::Contains;
using octant::tests::results_of_run;
using octant::tests::run_octant;

namespace {

namespace fs = std::filesystem;

/// A flight of a few frames with an aircraft that turns parts and one that does not.
std::vector<std::string> short_flight(std::vector<std::string> further) {
    std::vector<std::string> words = {"straight", "--aircraft", "500md", "--aircraft", "concave", "--terrain", "none",
        "--size", "160x120", "--frames", "4", "--warm-up", "1"};
    words.insert(words.end(), further.begin(), further.end());
    return words;
}

/// Of states and pictures.
std::string recorded_hashes_in(const tests::PrintedJson& results) {
    return results["state_hash"].text() + " " + results["picture_hash"].text();
}

std::string hashes(const std::vector<std::string>& further) {
    return recorded_hashes_in(results_of_run("fly", short_flight(further)));
}

std::vector<fs::path> cached_files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) { files.push_back(entry.path()); }
    std::ranges::sort(files);
    return files;
}

} // namespace

TEST_CASE("a flight is the same with a cold order cache, a warm one and none") {
    const fs::path folder = tests::empty_folder("order-cache-flight") / "made" / "here";
    const std::string without = hashes({});
    CHECK(hashes({"--order-cache", folder.string()}) == without);
    const std::vector<fs::path> files = cached_files_in(folder);
    REQUIRE(files.size() == 2);
    const std::array written = {fs::last_write_time(files[0]), fs::last_write_time(files[1])};
    CHECK(hashes({"--order-cache", folder.string()}) == without);
    CHECK(cached_files_in(folder) == files);
    CHECK(fs::last_write_time(files[0]) == written[0]);
    CHECK(fs::last_write_time(files[1]) == written[1]);
}

TEST_CASE("a damaged order cache costs a line, is mended, and changes no picture") {
    const fs::path folder = tests::empty_folder("order-cache-damage");
    const std::string before = hashes({"--order-cache", folder.string()});
    const fs::path file = cached_files_in(folder).front();
    const std::string bytes = read_file(file);
    write_file(file, bytes.substr(0, bytes.size() / 2));

    std::vector<std::string> words = short_flight({"--order-cache", folder.string(), "--json"});
    words.insert(words.begin(), "fly");
    const tests::ProgramRun run = run_octant(words);
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.err, Contains("note: order cache " + file.string() + ": at byte 16: expected "));
    CHECK_THAT(run.err, Contains(": computed anew\n"));
    CHECK(recorded_hashes_in(tests::PrintedJson(run.out)) == before);
    CHECK(read_file(file) == bytes);
}

TEST_CASE("draw-order says whether the order was kept, and else the same") {
    const std::string folder = (tests::empty_folder("order-cache-figures") / "orders").string();
    const auto cold = results_of_run("draw-order", {"f15", "--order-cache", folder});
    const auto warm = results_of_run("draw-order", {"f15", "--order-cache", folder, "--check"});
    const auto other = results_of_run("draw-order", {"f15", "--order-cache", folder, "--method", "bsp"});
    CHECK(cold["from_cache"] == false);
    CHECK(warm["from_cache"] == true);
    CHECK(warm["right"] == true);
    CHECK(other["from_cache"] == false);
    for (const std::string& name : cold.names()) {
        if (name != "from_cache" && name != "build_ms") {
            CAPTURE(name);
            CHECK(warm[name] == cold[name]);
        }
    }
    CHECK_FALSE(results_of_run("draw-order", {"concave"}).contains("from_cache"));
    CHECK_FALSE(results_of_run("draw-order", {"concave", "--order-cache", "none"}).contains("from_cache"));
    CHECK_FALSE(fs::exists("none")); // no folder of that name
}

TEST_CASE("two programs may order one model into one cache at once") {
    const fs::path folder = tests::empty_folder("order-cache-shared");
    std::array<tests::ProgramRun, 2> runs;
    {
        std::vector<std::jthread> team;
        for (tests::ProgramRun& run : runs) {
            team.emplace_back([&] {
                run = run_octant({"draw-order", "concave", "--order-cache", folder.string(), "--json"});
            });
        }
    }
    for (const tests::ProgramRun& run : runs) {
        CHECK(run.exit_code == 0);
        CHECK(run.err.empty());
    }
    CHECK(cached_files_in(folder).size() == 1);
    const auto warm = results_of_run("draw-order", {"concave", "--order-cache", folder.string()});
    CHECK(warm["from_cache"] == true);
}

TEST_CASE("an order cache that cannot be written in is refused before any work") {
    const fs::path folder = tests::empty_folder("order-cache-refused");
    write_file(folder / "file", "");
    const std::string inside = (folder / "file" / "cache").string();
    tests::check_refused("draw-order", {"f15", "--order-cache", inside}, "order cache " + inside);
    tests::check_refused("fly", short_flight({"--order-cache", inside}), "order cache " + inside);
}
