#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "ui/report/recording_writer.h"
#include "ui/report/zip_file.h"
#include "ui/sweep/paper.h"
#include "ui/sweep/sweep_file.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

using namespace octant;
using namespace octant::ui::sweep;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

/// A finished recording of `count` counted frames after two of warm-up; frame k took base_ms + k / 100 ms.
void record(const fs::path& folder, int count, double base_ms) {
    ui::report::RunInfo info;
    info.version = "0.1.0";
    info.machine.host = "here";
    info.machine.cpu = "cpu";
    ui::report::RecordingWriter writer(folder, info);
    for (int i = -2; i < count; ++i) {
        ui::report::FrameRecord frame;
        frame.frame = i + 2;
        frame.warm_up = i < 0;
        frame.sim_time_s = 0.05 * frame.frame;
        frame.frame_ms = frame.warm_up ? 99.0 : base_ms + 0.01 * i;
        writer.add(frame);
    }
    writer.finish({1, 2, {}});
}

/// A folder with a sweep, its recordings and sweep.csv. The first frame takes 9 ms and one more with each repeat, and 3
/// ms more with a field of view of 50 degrees.
struct FlownSweep {
    fs::path made;
    fs::path file;
    Sweep sweep;
    SweepFolder folder;
    std::vector<RunResult> results;

    FlownSweep(const std::string& name, const std::string& text, int frames)
        : made(tests::empty_folder(name)), file(made / "my sweep" / "s.toml"), folder(made / "out") {
        make_folder(file.parent_path());
        write_file(file, text);
        sweep = read_sweep(file);
        make_folder(folder.path());
        for (std::size_t i = 0; i < sweep.runs.size(); ++i) {
            const SweepRun& run = sweep.runs[i];
            record(
                folder.recording(run.name), frames, 9.0 + run.repeat + (run.settings.view.fov_deg == 50.0 ? 3.0 : 0.0));
            results.push_back({sweep.runs[i].name, RunState::Flown, "", "here", "1", "2", ""});
        }
        write_file(folder.path() / "sweep.csv", "run\n");
    }

    fs::path paper(const std::string& name) const { return folder.path() / "paper" / name; }

    std::vector<std::string> write() const { return write_paper(file, sweep, folder, results); }
};

constexpr const char* two_variants = R"(
repeats = 3
[vary]
path = ["straight"]
fov = [40, 50]
)";

} // namespace

TEST_CASE("the interval of a median needs three repeats and is made from logarithms") {
    CHECK_FALSE(median_interval(std::vector{1.0, 2.0}));
    // Logarithms 0, 1, 2 times ln 2: their deviation is ln 2, the quantile for two degrees of freedom 4.30265.
    const auto three = median_interval(std::vector{4.0, 1.0, 2.0});
    REQUIRE(three);
    const double half = 4.30265 * std::log(2.0) / std::sqrt(3.0);
    CHECK(three->first == Approx(2.0 * std::exp(-half)).epsilon(1e-4));
    CHECK(three->second == Approx(2.0 * std::exp(half)).epsilon(1e-4));
    const auto equal = median_interval(std::vector(7, 5.0));
    CHECK(equal->first == Approx(5.0));
    CHECK(equal->second == Approx(5.0));
    // Ranks of six: only the least and the greatest of the values' means in pairs can be left out at 5 %.
    const auto six = median_interval(std::vector{1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
    CHECK(six->first == Approx(1.0));
    CHECK(six->second == Approx(6.0));
}

TEST_CASE("a paper's table has the medians over repeats of each cell") {
    const FlownSweep flown("paper-table", two_variants, 100);
    flown.write();
    // Repeats of the first cell take 10, 11 and 12 ms and 0.01 ms more with each of 100 frames: by nearest rank the
    // median of a run is its 50th frame, P95 the 95th, P99 the 99th; the slowest one of 100 is the last.
    const std::string csv = read_file(flown.paper("table.csv"));
    CHECK_THAT(
        csv, Catch::StartsWith("path,aircraft,fov,repeats,frames,\"median, ms\",\"95 % from, ms\",\"95 % to, ms\","
                               "\"P95, ms\",\"P99, ms\",\"mean, ms\",\"1 % low, frames/s\"\n"
                               "straight,f15,40,3,100,11.490,"));
    CHECK_THAT(csv, Contains(",11.940,11.980,11.495,83.40\n"));
    CHECK_THAT(csv, Contains("straight,f15,50,3,100,14.490,"));
    CHECK_THAT(read_file(flown.paper("table.md")),
        Contains("| straight | f15 | 40 | 3 | 100 | 11.490 |") && Contains("P99.9 1000"));
    CHECK_THAT(read_file(flown.paper("table.tex")), Contains("straight & f15 & 40 & 3 & 100 & 11.490 &"));
    for (const char* name : {"flight-straight-f15.svg", "flight-straight-f15.pdf", "cells.svg", "cells.pdf"}) {
        CHECK(is_file(flown.paper(name)));
    }
    const std::string figure = read_file(flown.paper("cells.pdf"));
    const std::string archive = read_file(flown.paper("s.zip"));
    flown.write();
    CHECK(read_file(flown.paper("cells.pdf")) == figure);
    CHECK(read_file(flown.paper("s.zip")) == archive);
}

TEST_CASE("what a sweep is too short for is left out of its table, with the reason") {
    FlownSweep flown("paper-short", "repeats = 2\n[vary]\nfov = [40, 50]\n", 99);
    for (std::size_t i = 0; i < flown.results.size(); ++i) {
        flown.results[i].state = flown.sweep.runs[i].settings.view.fov_deg != 50.0 ? RunState::Flown : RunState::Failed;
    }
    flown.write();
    const std::string table = read_file(flown.paper("table.md"));
    CHECK_THAT(table, Contains("| path | aircraft | fov | repeats | frames | median, ms | P95, ms | mean, ms |\n"));
    CHECK_THAT(table, Contains("| 40 | 2 | 99 |") && !Contains("| 50 |"));
    CHECK_THAT(table, Contains("A cell with fewer than 3 repeats has no interval") &&
                          Contains("Only 2 of 4 flights are done") && Contains("none of their flights is done: 1."));
    for (RunResult& result : flown.results) { result.state = RunState::Failed; }
    const auto notes = flown.write();
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes.front(), Contains("--paper writes nothing"));
}

TEST_CASE("a paper's archive has the files that the sweep names, wherever they lie, under names of its own") {
    const fs::path outside = tests::empty_folder("paper-outside");
    const std::string source = OCTANT_SOURCE_DIR;
    fs::copy_file(source + "/flightpaths/f15-straight.toml", outside / "p \xc3\xbc.toml");
    fs::copy_file(source + "/models/f15.obj", outside / "shape.obj");
    fs::copy_file(source + "/models/f15.mtl", outside / "f15.mtl");
    const std::string text =
        fmt::format("[settings] # \xc3\xbc\naircraft = [\"{0}/shape.obj=turn\", 'f15'] # \"{0}\"\n[vary]\n"
                    "path = [\"straight\", '{0}/p \xc3\xbc.toml', \"near.toml\"]\n",
            outside.string());
    const FlownSweep flown("paper-archive", "", 3);
    fs::copy_file(source + "/flightpaths/f15-turn.toml", flown.file.parent_path() / "near.toml");
    write_file(flown.file, text);
    const Sweep sweep = read_sweep(flown.file);
    const RunResult done{flown.sweep.runs[0].name, RunState::Flown, "", "here", "1", "2", ""};
    Sweep three = sweep;
    three.runs[0].name = flown.sweep.runs[0].name;
    write_paper(flown.file, three, flown.folder, std::vector{done, RunResult{}, RunResult{}});
    const fs::path zip = flown.paper("s.zip");
    std::vector<std::string> names;
    for (const auto& entry : ui::report::zip_entries(zip)) { names.push_back(entry.name); }
    const auto has = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
    CHECK(has("near.toml"));
    CHECK(has("inputs/p \xc3\xbc.toml"));
    CHECK(has("inputs/shape.obj"));
    CHECK(has("inputs/f15.mtl"));
    CHECK_FALSE(has("missing.csv"));
    const std::string renamed = ui::report::zip_text(zip, "s.toml", 10000);
    CHECK(renamed ==
          fmt::format("[settings] # \xc3\xbc\naircraft = [\"inputs/shape.obj=turn\", 'f15'] # \"{0}\"\n[vary]\n"
                      "path = [\"straight\", \"inputs/p \xc3\xbc.toml\", \"near.toml\"]\n",
              outside.string()));
    const std::string readme = ui::report::zip_text(zip, "README.txt", 10000);
    CHECK_THAT(readme, Contains("\n  octant sweep s.toml --out again --paper\n"));
    CHECK(std::ranges::count(readme, '\n') <= 15);
    CHECK_THAT(ui::report::zip_text(zip, "machines.csv", 10000), Contains("here,cpu,cpu\n"));
    CHECK_THAT(ui::report::zip_text(zip, "jobs/" + sweep.runs[2].name + ".json", 100000), Contains("\"./near.toml\""));

    // A large map is named with its checksum in place of being packed.
    write_file(outside / "large.asc",
        "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 30\n1 2\n3 4\n" + std::string(20'000'001, ' '));
    write_file(flown.file, fmt::format("[settings]\nterrain = \"{}/large.asc\"\n", outside.string()));
    Sweep with_map = read_sweep(flown.file);
    with_map.runs[0].name = flown.sweep.runs[0].name;
    const auto notes = write_paper(flown.file, with_map, flown.folder, std::vector{done});
    CHECK_THAT(notes.back(), Contains("note: not in s.zip: ") && Contains("large.asc"));
    CHECK_THAT(ui::report::zip_text(zip, "missing.csv", 10000), Contains("large.asc,20000"));
    CHECK_THAT(ui::report::zip_text(zip, "s.toml", 10000), Contains(outside.string() + "/large.asc"));
}
