#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"
#include "tests/ui/flight/small_ground.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace octant;
using Catch::Matchers::Contains;
using octant::tests::run_octant;

namespace {

struct Hashes {
    std::string state;
    std::string picture;
    bool operator==(const Hashes&) const = default;
};

/// A dozen small frames, over small ground unless the arguments say what they are over.
Hashes fly(std::vector<std::string> arguments) {
    if (std::ranges::find(arguments, "--terrain") == arguments.end()) {
        arguments.insert(arguments.end(), {"--terrain", tests::small_ground()});
    }
    arguments.insert(arguments.begin(), "fly");
    arguments.insert(
        arguments.end(), {"--size", "160x90", "--frames", "12", "--triangles", "3000", "--json", "--quiet"});
    const tests::ProgramRun run = run_octant(arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const auto json = tests::PrintedJson(run.out);
    return {json["state_hash"].text(), json["picture_hash"].text()};
}

} // namespace

TEST_CASE("the same settings give the same hashes for any number of drawing threads") {
    const std::vector<std::string> settings = {"jinking", "--aircraft", "500md", "--terrain", "canyon"};
    const Hashes first = fly(settings);
    CHECK(fly(settings) == first);
    for (const char* threads : {"1", "3"}) {
        std::vector<std::string> with = settings;
        with.insert(with.end(), {"--raster-threads", threads});
        CHECK(fly(with) == first);
    }
    CHECK_FALSE(fly({"jinking", "--aircraft", "500md", "--terrain", "none"}) == first);
}

TEST_CASE("a run is repeated from its run.json") {
    const auto folder = tests::empty_folder("repeat") / "first";
    const Hashes first = fly({"turn", "--view", "orbit", "--heading", "40", "--record", folder.string()});
    const tests::ProgramRun repeat_option =
        run_octant({"fly", "--settings", (folder / "run.json").string(), "--json", "--quiet"});
    REQUIRE(repeat_option.exit_code == 0);
    CHECK(tests::PrintedJson(repeat_option.out)["picture_hash"] == first.picture);
    CHECK(tests::PrintedJson(repeat_option.out)["state_hash"] == first.state);
    for (const char* name :
        {"frames.csv", "mangohud.csv", "trace.json", "track.csv", "track.acmi", "report.html", "picture-00000.png"}) {
        CHECK(std::filesystem::exists(folder / name));
    }
}

TEST_CASE("only the columns of time may differ between two runs") {
    const auto folder = tests::empty_folder("columns");
    std::vector<std::vector<std::string>> lines;
    for (const std::string name : {"a", "b"}) {
        fly({"straight", "--record", (folder / name).string()});
        const std::string text = read_text_file(folder / name / "frames.csv");
        const auto rows = split_lines(text);
        const auto header = split_fields(rows.front(), ',');
        for (const std::string_view row : rows) {
            std::vector<std::string> kept;
            const auto fields = split_fields(row, ',');
            REQUIRE(fields.size() == header.size());
            for (std::size_t i = 0; i < fields.size(); ++i) {
                const bool timing = header[i] == "wall_s" || header[i].ends_with("_ms") || header[i] == "stress" ||
                                    header[i] == "overrun";
                if (!timing) { kept.emplace_back(fields[i]); }
            }
            lines.push_back(kept);
        }
    }
    REQUIRE(lines.size() == 2 * 13);
    CHECK(std::equal(lines.begin(), lines.begin() + 13, lines.begin() + 13));
}

TEST_CASE("a recorded track can be flown and gives the flight it came from") {
    const auto folder = tests::empty_folder("track");
    fly({"pop-up", "--heading", "0", "--frame-per-sample", "--record", (folder / "first").string()});
    fly({(folder / "first" / "track.csv").string(), "--heading", "0", "--place", "0,0", "--height-mode", "datum",
        "--frame-per-sample", "--record", (folder / "again").string()});
    const auto first = ui::report::read_frame_csv(folder / "first/frames.csv").records;
    const auto repeat_option = ui::report::read_frame_csv(folder / "again/frames.csv").records;
    REQUIRE(first.size() == 12);
    REQUIRE(repeat_option.size() == 12);
    for (std::size_t i = 0; i < repeat_option.size(); ++i) {
        CHECK(glm::length(first[i].aircraft_m - repeat_option[i].aircraft_m) < 2e-3);
        CHECK(glm::length(first[i].eye_m - repeat_option[i].eye_m) < 0.05);
    }
}

TEST_CASE("several aircraft fly together") {
    CHECK(fly({"straight", "--aircraft", "f15", "--aircraft", "f15", "--aircraft", "500md"}).picture !=
          fly({"straight", "--aircraft", "f15"}).picture);
}

TEST_CASE("who asks for detail near the eye is told where the ground cannot show it") {
    const auto told = [](std::vector<std::string> words) {
        words.insert(words.begin(), {"fly", "straight"});
        words.insert(words.end(), {"--frames", "1", "--size", "64x48"});
        return run_octant(words).err;
    };
    CHECK_THAT(told({"--terrain", "background60", "--scenery"}),
        Contains("note: scenery shows nothing: background60 has no samples"));
    CHECK_THAT(told({"--terrain", tests::small_map(), "--terrain-lod", "exact", "--near-detail"}),
        Contains("note: near-detail shows nothing: only ground that is refined by screen-error"));
    CHECK_THAT(told({"--terrain", tests::small_map(), "--ground-look", "shading=texture", "--scenery"}),
        Contains("note: scenery shows nothing: where a texture colours the ground"));
    CHECK_THAT(told({"--terrain", "background60"}), !Contains("shows nothing"));
    CHECK_THAT(told({"--terrain", tests::small_map(), "--scenery"}), !Contains("shows nothing"));
}

TEST_CASE("a finished flight is skipped when asked, unless something has changed") {
    const auto folder = tests::empty_folder("skip") / "out";
    const std::vector<std::string> flight = {"fly", "straight", "--size", "160x90", "--frames", "5", "--terrain",
        tests::small_ground(), "--record", folder.string(), "--if-new"};
    CHECK(run_octant(flight).out.find("picture hash") != std::string::npos);
    const tests::ProgramRun second = run_octant(flight);
    CHECK(second.exit_code == 0);
    CHECK(second.out.empty());
    CHECK(second.err.find("is done already") != std::string::npos);
    std::vector<std::string> other = flight;
    other.insert(other.end(), {"--fov", "50"});
    CHECK_FALSE(run_octant(other).out.empty());
}

TEST_CASE("help names every command and each setting with its unit and default") {
    const tests::ProgramRun help = run_octant({"--help"});
    CHECK(help.exit_code == 0);
    for (const char* command : {"fly", "report", "terrain", "study", "bench"}) {
        CHECK(help.out.find(command) != std::string::npos);
    }
    const std::string fly_help = run_octant({"fly", "--help"}).out;
    for (const char* option :
        {"--place", "--terrain-lod", "--triangles", "--record", "PIXELS", "Examples:"}) {
        INFO(option);
        CHECK(fly_help.find(option) != std::string::npos);
    }
}
