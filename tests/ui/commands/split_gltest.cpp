#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/flight/small_ground.h"
#include "ui/report/frame_csv.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/slow_pictures.h"
#include "ui/sweep/split_flight.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <utility>

using namespace octant;
using Catch::Contains;
using octant::tests::run_octant;
using octant::tests::small_ground;
using octant::tests::small_map;

namespace {

namespace fs = std::filesystem;

/// A sweep of one flight, by the lines of its settings.
std::string sweep_in(const fs::path& folder, const std::string& settings) {
    write_file(folder / "one.toml", "[settings]\nsize = \"64x48\"\nwarm-up = 2\n" + settings + "\n");
    return (folder / "one.toml").string();
}

void fly(const std::string& sweep, const fs::path& out, const std::vector<std::string>& more) {
    std::vector<std::string> line = {"sweep", sweep, "--out", out.string(), "--batch", "share-cores", "--quiet"};
    line.insert(line.end(), more.begin(), more.end());
    const tests::ProgramRun run = run_octant(line);
    INFO(run.out << run.err << read_file(out / "sweep.csv"));
    REQUIRE(run.exit_code == 0);
}

std::string over(const std::string& ground) { return fmt::format("terrain = \"{}\"\n", ground); }

/// Rows without what the clock says.
std::vector<std::string> rows_in(const fs::path& recording) {
    std::vector<std::string> rows;
    for (ui::report::FrameRecord row : ui::report::read_frame_csv(recording / "frames.csv").records) {
        for (double* const time : {&row.wall_s, &row.frame_ms, &row.sim_ms, &row.plan_ms, &row.draw_ms, &row.read_ms,
                 &row.record_ms, &row.refine_ms, &row.mesh_wait_ms, &row.draw_wait_ms, &row.stress}) {
            *time = 0.0;
        }
        row.overrun = 0;
        rows.push_back(ui::report::frame_csv_line(row));
    }
    return rows;
}

constexpr std::size_t slow_pictures = ui::report::SlowPictures::max_shown;

void check_same(const fs::path& whole, const fs::path& merged, std::size_t frames) {
    const auto one = ui::report::load_recording(whole);
    const auto other = ui::report::load_recording(merged);
    CHECK(one.run.state_hash == other.run.state_hash);
    CHECK(one.run.picture_hash == other.run.picture_hash);
    CHECK(one.run.settings == other.run.settings);
    CHECK(other.disagreement.empty());
    CHECK(rows_in(whole).size() == frames);
    CHECK(rows_in(whole) == rows_in(merged));
    REQUIRE(one.pictures.size() == other.pictures.size());
    for (std::size_t i = 0; i < one.pictures.size(); ++i) {
        CHECK(read_file(one.pictures[i]) == read_file(other.pictures[i]));
    }
    CHECK(other.slowest.size() == one.slowest.size());
    for (const auto* recording : {&one, &other}) { // each has those of its own slowest frames
        for (std::size_t i = 0; i < std::min(slow_pictures, recording->slowest.size()); ++i) {
            const int frame = recording->slowest[i].record.frame;
            const auto file = recording->folder.path / ui::report::slow_picture_name(frame);
            CHECK(fs::exists(file) == !one.pictures.empty());
        }
    }
    for (const char* name : {"track.csv", "track.acmi"}) { CHECK(read_file(whole / name) == read_file(merged / name)); }
}

/// Flies the settings whole and in as many parts, and finds no difference; gives the levels of detail that the aircraft
/// was drawn with.
std::set<int> levels_of_checked_parts(const fs::path& folder, const std::string& settings, const std::string& parts) {
    INFO(settings);
    const std::string sweep = sweep_in(folder, settings);
    fs::remove_all(folder / "whole");
    fs::remove_all(folder / "parts");
    fly(sweep, folder / "whole", {});
    fly(sweep, folder / "parts", {"--split", parts});
    const fs::path whole = folder / "whole/runs/one";
    check_same(whole, folder / "parts/runs/one", rows_in(whole).size());
    std::set<int> levels;
    for (const auto& row : ui::report::read_frame_csv(whole / "frames.csv").records) {
        levels.insert(row.aircraft_level);
    }
    return levels;
}

} // namespace

TEST_CASE("a flight in four parts is the whole flight, picture by picture, and so is its video") {
    const auto made = tests::empty_folder("split");
    const std::string sweep = sweep_in(made, over(small_ground()) + "path = \"turn\"\nframes = 240\npictures = 1");
    fly(sweep, made / "whole", {"--video"});
    fly(sweep, made / "parts", {"--video", "--split", "4"});
    const fs::path merged = made / "parts/runs/one";
    check_same(made / "whole/runs/one", merged, 240);
    CHECK(ui::report::load_recording(merged).pictures.size() == 240);
    CHECK(read_file(made / "whole/videos/one.mp4") == read_file(made / "parts/videos/one.mp4"));
    CHECK_FALSE(fs::exists(made / "parts/parts/runs/one.1of4"));
    const auto when = fs::last_write_time(merged / "run.json");
    fly(sweep, made / "parts", {"--video", "--split", "4"});
    fly(sweep, made / "parts", {"--video", "--split", "3"});
    CHECK(fs::last_write_time(merged / "run.json") == when);
}

TEST_CASE("parts of flights whose pictures depend on earlier frames are those of the whole") {
    const auto made = tests::empty_folder("split-memory");
    const std::string map = small_map();
    for (const auto& [ground, settings] :
        {std::pair(map, "path = \"jinking\"\nmesh = \"printed\"\ndetail = \"damped\"\nframes = 30\npictures "
                        "= 4"),
            std::pair(map, "path = \"straight\"\nmesh = \"midpoint\"\ndetail = \"previous\"\nframes = 20\n"
                           "pictures = 4"),
            std::pair(map, "path = \"turn\"\nmesh = \"midpoint\"\ndetail = \"fixed\"\ninset = \"tower\"\n"
                           "frames = 12"),
            std::pair(std::string("background60"),
                "path = \"pop-up\"\nframe-per-sample = true\nseconds = 1\ninset = \"tower\"")}) {
        levels_of_checked_parts(made, over(ground) + settings, "3");
    }
}

TEST_CASE("levels of detail and smooth polygons are kept over the seams between parts") {
    const auto made = tests::empty_folder("split-kept");
    const tests::ProgramRun chain = run_octant({"simplify", "torus", (made / "torus.chain").string(), "--faces", "100",
        "--method", "fast", "--chain", "--quiet"});
    REQUIRE(chain.exit_code == 0);
    const auto levels = levels_of_checked_parts(made,
        "path = \"straight\"\nterrain = \"none\"\nview = \"tower\"\nfov = 9.5\naircraft = "
        "\"torus.chain\"\naircraft-error-px = 0.02\nstart = 14\nframes = 45\nrate = 5",
        "15");
    CHECK(levels.size() >= 3);
    const std::string orders = fmt::format("order-cache = \"{}\"\n", (made / "orders").string());
    levels_of_checked_parts(made,
        orders + "path = \"turn\"\nterrain = \"none\"\naircraft = \"f15-detailed\"\n"
                 "smooth-share = 0.4\nstart = 10\nframes = 45\nrate = 20",
        "15");
}

TEST_CASE("an aircraft that is refined as it flies is the same in parts") {
    const auto made = tests::empty_folder("split-refined");
    const tests::ProgramRun globe = run_octant({"refine", "globe", "--save", (made / "globe.pm").string(), "--quiet"});
    INFO(globe.err);
    REQUIRE(globe.exit_code == 0);
    levels_of_checked_parts(made,
        "path = \"straight\"\nterrain = \"none\"\nview = \"orbit\"\naircraft = "
        "\"globe.pm\"\nsmooth-share = 0.5\nframes = 24\nrate = 4\npictures = 1",
        "6");
    std::set<std::uint64_t> polygons;
    for (const auto& row : ui::report::read_frame_csv(made / "whole/runs/one/frames.csv").records) {
        polygons.insert(static_cast<std::uint64_t>(row.aircraft_polygons));
    }
    CHECK(polygons.size() > 10); // it was refined anew
}

TEST_CASE("flights that cannot be divided are refused with the reason before anything is written") {
    const auto made = tests::empty_folder("split-refused");
    const std::string sweep = sweep_in(made, "adapt = \"terrain\"");
    tests::check_refused("sweep", {sweep, "--out", (made / "out").string(), "--split", "2"},
        "--split: one cannot be divided: --part: expected --adapt none");
    CHECK_FALSE(fs::exists(made / "out"));
    tests::check_refused("fly", {"straight", "--part", "3/2"}, "--part: expected K/N");
    tests::check_refused("fly", {"straight", "--frames", "2", "--size", "16x16", "--part", "1/3"},
        "as many parts as the flight has frames (2)");
}

TEST_CASE("a seam that does not fit is told with both machines") {
    const auto made = tests::empty_folder("split-seam");
    std::vector<fs::path> parts;
    for (const char* part : {"1/2", "2/2"}) {
        parts.push_back(made / fmt::format("part-{}", part[0]));
        REQUIRE(run_octant({"fly", "straight", "--terrain", "none", "--size", "32x32", "--frames", "6", "--part", part,
                               "--record", parts.back().string(), "--quiet"})
                    .exit_code == 0);
    }
    ui::sweep::SweepRun whole;
    whole.settings.path.name = "straight";
    whole.settings.path.terrain = "none";
    whole.settings.time.pictures = 0;
    ui::sweep::merge_parts(whole, made / "merged", parts, std::nullopt);
    CHECK(rows_in(made / "merged").size() == 6);
    std::string rows = read_file(parts[1] / "frames.csv");
    const std::size_t first_line_end = rows.find('\n', rows.find('\n') + 1);
    rows.replace(first_line_end - 4, 4, "dead");
    write_file(parts[1] / "frames.csv", rows);
    CHECK_THROWS_WITH(ui::sweep::merge_parts(whole, made / "merged", parts, std::nullopt),
        Contains("frames.csv: expected frame 2 on ") && Contains(", got other pictures"));
}
