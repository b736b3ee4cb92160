#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "ui/report/zip_file.h"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace octant;
using Catch::Contains;
using octant::tests::run_octant;

namespace {

namespace fs = std::filesystem;

constexpr const char* small_sweep = R"(
name = "small"
repeats = 2
[settings]
size = "64x48"
frames = 3
warm-up = 0
pictures = 2
terrain = "background60"
[vary]
path = ["straight", "turn"]
aircraft = ["f15", "concave"]
)";

} // namespace

TEST_CASE("a sweep flies what is not done yet, tells what failed, and reports all of it") {
    const auto made = tests::empty_folder("sweep");
    const std::string file = (made / "small.toml").string();
    const fs::path out = made / "out";
    write_file(file, small_sweep);
    CHECK(tests::lines_in(run_octant({"sweep", file, "--list"}).out) == 8);
    const std::vector<std::string> line = {"sweep", file, "--out", out.string(), "--quiet"};
    const tests::ProgramRun first = run_octant(line);
    INFO(first.out << first.err);
    REQUIRE(first.exit_code == 0);
    CHECK_THAT(first.out, Contains("8 of 8 flights done, one at a time"));
    CHECK(tests::lines_in(read_file(out / "sweep.csv")) == 9);
    CHECK_THAT(read_file(out / "report.html"), Contains("8 flown by a sweep one at a time."));

    const auto when = fs::last_write_time(out / "runs/turn-f15-r1/run.json");
    const std::string before = read_file(out / "runs/turn-concave-r2/run.json");
    fs::remove_all(out / "runs/turn-concave-r2");
    CHECK(run_octant(line).exit_code == 0);
    CHECK(fs::last_write_time(out / "runs/turn-f15-r1/run.json") == when);
    const std::string after = read_file(out / "runs/turn-concave-r2/run.json");
    CHECK(after.substr(after.find("state_hash"), 80) == before.substr(before.find("state_hash"), 80));

    // Another machine's pictures differ from ours.
    std::string other = after;
    other.replace(other.find("picture_hash") + 16, 4, "dead");
    write_file(out / "runs/turn-concave-r2/run.json", other);
    const tests::ProgramRun differs = run_octant(line);
    CHECK(differs.exit_code == 1);
    CHECK_THAT(differs.out, Contains("pictures of turn-concave-r1 on "));
    CHECK_THAT(read_file(out / "report.html"), Contains("<td>pictures of turn-concave-r1 on "));
}

TEST_CASE("a sweep goes on past flights that fail, and tries them again") {
    const auto made = tests::empty_folder("sweep-faults");
    const std::string file = (made / "faults.toml").string();
    write_file(file, "[settings]\nsize = \"64x48\"\nframes = 2\nterrain = \"none\"\n[vary]\n"
                     "path = [\"nowhere.toml\", \"straight\"]\n");
    const tests::ProgramRun run = run_octant({"sweep", file, "--out", (made / "out").string(), "--batch", "retries=2"});
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.out, Contains("1 of 2 flights done"));
    CHECK_THAT(run.out, Contains("failed: nowhere.toml: ") && Contains("nowhere.toml: expected"));
    CHECK_THAT(run.err, Contains("flights that failed and are tried again: 1"));
    CHECK_THAT(read_file(made / "out/report.html"),
        Contains("Flights that are not done") && Contains("<td>nowhere.toml</td>"));
    write_file(file, "[settings]\nsize = \"64x48\"\npath = \"nowhere.toml\"\n");
    CHECK(run_octant({"sweep", file, "--out", (made / "none").string()}).exit_code == 1);
    CHECK_THAT(read_file(made / "none/report.html"), Contains("<td>faults</td>"));
    tests::check_refused("sweep", {file, "--out", made.string()}, "expected an empty folder or that of a sweep");
    // Others have files of that name too.
    const fs::path foreign = made / "foreign";
    fs::create_directories(foreign);
    write_file(foreign / "jobs.txt", "buy milk\n");
    tests::check_refused("sweep", {file, "--out", foreign.string()}, "expected an empty folder or that of a sweep");
    CHECK(read_file(foreign / "jobs.txt") == "buy milk\n");
    CHECK_FALSE(fs::exists(foreign / "jobs"));
    const fs::path searches = made / "searches";
    fs::create_directories(searches / "jobs");
    write_file(searches / "jobs/letter.txt", "Dear all\n");
    tests::check_refused("sweep", {file, "--out", searches.string()}, "expected an empty folder or that of a sweep");
    CHECK_FALSE(fs::exists(searches / "runs"));
    tests::check_refused("sweep", {file, "--out", (made / "out").string(), "--batch", "jobs=2"}, "--batch share-cores");
    tests::check_refused(
        "sweep", {file, "--batch", "hosts=machines.txt"}, "--batch hosts: expected --on parallel beside it");
    tests::check_refused(
        "sweep", {file, "--on", "parallel", "--batch", "tasks=4"}, "--batch tasks: expected --on slurm");
    tests::check_refused("sweep", {file, "--batch", "minutes=4"}, "--on slurm or parallel beside it");
    tests::check_refused("sweep", {(made / "none.toml").string()}, "expected a file, found none");
}

TEST_CASE("a sweep's archive flies everything again in another folder, with the same hashes") {
    const auto made = tests::empty_folder("sweep-paper");
    fs::copy_file(fs::path(OCTANT_SOURCE_DIR) / "flightpaths/f15-turn.toml", made / "mine.toml");
    fs::create_directories(made / "sweep");
    const std::string file = (made / "sweep/two.toml").string();
    write_file(file, "[settings]\nsize = \"64x48\"\nframes = 3\nwarm-up = 0\nterrain = \"background60\"\n[vary]\npath "
                     "= [\"straight\", "
                     "\"../mine.toml\"]\n");
    const fs::path out = made / "out";
    const tests::ProgramRun flown = run_octant({"sweep", file, "--out", out.string(), "--paper"});
    INFO(flown.out << flown.err);
    REQUIRE(flown.exit_code == 0);
    const fs::path again = made / "again";
    fs::create_directories(again);
    fs::remove(made / "mine.toml");
    for (const auto& entry : ui::report::zip_entries(out / "paper/two.zip")) {
        fs::create_directories((again / entry.name).parent_path());
        ui::report::extract(out / "paper/two.zip", entry.name, again / entry.name);
    }
    REQUIRE(run_octant({"sweep", (again / "two.toml").string(), "--out", (again / "again").string(), "--quiet"})
                .exit_code == 0);
    for (const char* run : {"straight", "mine"}) {
        const auto hashes = [&](const fs::path& folder) {
            const std::string text = read_file(folder / "runs" / run / "run.json");
            return text.substr(text.find("\"state_hash\""), 80);
        };
        CHECK(hashes(out) == hashes(again / "again"));
    }
}
