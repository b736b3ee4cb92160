#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "ui/report/zip_file.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

using namespace octant;
using Catch::Contains;
using octant::tests::make_program;
using octant::tests::run_octant;
using octant::tests::SearchPath;

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
    const std::string table = read_file(out / "sweep.csv");
    CHECK(tests::lines_in(table) == 9);
    CHECK_THAT(table, Contains("\nstraight-f15-r1,straight,f15,1,flown,1,"));
    CHECK(table.find("\nstraight-f15-r1,") < table.find("\nstraight-f15-r2,"));
    CHECK(table.find("\nstraight-f15-r2,") < table.find("\nstraight-concave-r1,"));
    const std::string jobs = read_file(out / "jobs.txt");
    CHECK(tests::lines_in(jobs) == 8);
    CHECK(jobs.rfind("-r1\n") < jobs.find("-r2\n"));
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

TEST_CASE("a flight does not outlive a sweep that is killed, and its recording is free") {
    const auto made = tests::empty_folder("sweep");
    const std::string file = (made / "long.toml").string();
    write_file(file, "[settings]\nsize = \"64x48\"\nframes = 200000\nterrain = \"background60\"\n"
                     "[vary]\npath = [\"straight\"]\n");
    const fs::path out = made / "out";
    const fs::path rows = out / "runs/straight/frames.csv";
    CHECK(tests::run_octant_and_signal({"sweep", file, "--out", out.string(), "--quiet"}, rows, SIGKILL).exit_code ==
          128 + SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const auto bytes = fs::file_size(rows);
    std::this_thread::sleep_for(std::chrono::milliseconds(1500)); // rows are written each half second
    CHECK(fs::file_size(rows) == bytes);
    // Its recording is free.
    const tests::ProgramRun again = run_octant({"fly", "--settings", (out / "jobs/straight.json").string(), "--frames",
        "2", "--record", (out / "runs/straight").string(), "--quiet"});
    INFO(again.err);
    CHECK(again.exit_code == 0);
}

TEST_CASE("a sweep goes on past flights that fail, and tries them again") {
    const auto made = tests::empty_folder("sweep-faults");
    const std::string file = (made / "faults.toml").string();
    write_file(file, "[settings]\nsize = \"64x48\"\nframes = 2\nterrain = \"none\"\n[vary]\n"
                     "path = [\"nowhere.toml\", \"straight\"]\n");
    const tests::ProgramRun run = run_octant({"sweep", file, "--out", (made / "out").string(), "--batch", "retries=2"});
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.out, Contains("1 of 2 flights done (1 failed), one at a time\n"));
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

TEST_CASE("a recording of a newer program stops a sweep, settings and replays with one line") {
    const auto made = tests::empty_folder("sweep-newer");
    const std::string file = (made / "one.toml").string();
    write_file(file, "[settings]\nsize = \"32x24\"\nframes = 2\nterrain = \"none\"\n");
    const std::string out = (made / "out").string();
    REQUIRE(run_octant({"sweep", file, "--out", out, "--quiet"}).exit_code == 0);
    const fs::path recording = made / "out/runs/one";
    std::string text = read_file(recording / "run.json");
    text.replace(text.find("\"format_version\": 1") + 18, 1, "99");
    write_file(recording / "run.json", text);
    const std::string told = "run.json: expected format_version 1 or earlier, got 99: a newer Octant wrote it";
    tests::check_refused("sweep", {file, "--out", out}, told);
    tests::check_refused("report", {recording.string()}, told);
    tests::check_refused("fly", {"--settings", recording.string()}, told);
    tests::check_refused("fly", {"--replay", recording.string()}, told);
    tests::check_refused(
        "fly", {"straight", "--frames", "2", "--terrain", "none", "--record", recording.string()}, told);
    CHECK(read_file(recording / "run.json") == text);
}

namespace {

/// An sbatch that runs the tasks of its array one after the other.
constexpr const char* working_sbatch = R"sh(
[ "$1" = --version ] && exit 0
echo "Submitted batch job 7"
cd "$(dirname "$3")" || exit 1
fault=0
for task in $(echo "${2#--array=}" | tr , ' ');
do SLURM_ARRAY_TASK_ID=$task bash "$3" || fault=1; done
exit $fault)sh";

/// A program that says that it is installed and does nothing else.
std::string failing(const std::string& words, int exit_code) {
    return "[ \"$1\" = --version ] && exit 0\n" + words + "\nexit " + std::to_string(exit_code);
}

} // namespace

TEST_CASE("what a scheduler refuses ends with its message and exit code 2, and no flight counts as failed") {
    const auto made = tests::empty_folder("sweep-scheduler");
    const fs::path bin = made / "bin";
    const SearchPath path(bin.string() + ":" + std::getenv("PATH"));
    const std::string file = (made / "two.toml").string();
    write_file(file, "[settings]\nsize = \"32x24\"\nframes = 2\nterrain = \"none\"\n"
                     "[vary]\npath = [\"nowhere.toml\", \"straight\"]\n");
    const std::string out = (made / "out").string();
    const auto refused = [&](const std::string& engine, const std::string& script, const std::string& line) {
        make_program(bin, engine == "slurm" ? "sbatch" : engine, script);
        const tests::ProgramRun run = run_octant({"sweep", file, "--out", out, "--on", engine, "--quiet"});
        CHECK(run.exit_code == 2);
        CHECK(run.err == "octant: " + line + "\n");
        CHECK(run.out.empty());
        CHECK_FALSE(fs::exists(made / "out/sweep.csv"));
        CHECK(fs::is_empty(made / "out/runs"));
    };
    make_program(bin, "squeue", "exit 0");
    refused("slurm",
        failing("echo 'sbatch: error: invalid partition specified: x' >&2\n"
                "echo 'sbatch: error: Batch job submission failed: Invalid partition name specified' >&2",
            1),
        "sbatch: invalid partition specified: x; Batch job submission failed: Invalid partition name specified");
    refused("slurm", "echo 'sbatch: fatal: Could not establish a configuration source' >&2; exit 1",
        "sbatch: Could not establish a configuration source");
    refused("slurm", failing("echo 'Submitted batch job 7'", 1), "sbatch: ended with exit code 1 and no flight began");
    refused("parallel", failing("echo 'parallel: Error: Cannot open /machines.txt.' >&2", 255),
        "parallel: Cannot open /machines.txt.");
    refused("parallel", failing("for i in 1 2 3; do echo 'ssh: Could not resolve hostname x' >&2; done", 2),
        "parallel: ssh: Could not resolve hostname x");

    // Slurm does not answer any more: nobody knows how the flights end.
    make_program(bin, "squeue", "echo 'slurm_load_jobs error: Unable to contact slurm controller' >&2; exit 1");
    refused("slurm", failing("echo 'Submitted batch job 7'", 0),
        "squeue: slurm_load_jobs error: Unable to contact slurm controller");

    // Flights that fail are no fault of the scheduler.
    make_program(bin, "squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
    make_program(bin, "sbatch", working_sbatch);
    const tests::ProgramRun run = run_octant({"sweep", file, "--out", out, "--on", "slurm"});
    INFO(run.err);
    CHECK(run.exit_code == 1);
    CHECK_THAT(
        run.out, Contains("1 of 2 flights done (1 failed), by Slurm") && Contains("failed: nowhere.toml: octant: "));
    CHECK_THAT(read_file(made / "out/sweep.csv"), Contains("\nnowhere.toml,nowhere.toml,1,failed,0,"));
}

TEST_CASE("flights that a scheduler never began are told as such") {
    const auto made = tests::empty_folder("sweep-not-begun");
    const SearchPath path((made / "bin").string() + ":" + std::getenv("PATH"));
    const std::string file = (made / "three.toml").string();
    write_file(file,
        "name = \"three\"\n[settings]\nsize = \"32x24\"\nframes = 2\nterrain = \"none\"\n[vary]\nfov = [40, 50, 60]\n");
    make_program(made / "bin", "squeue", "exit 0");
    std::string first_only = working_sbatch;
    const std::size_t tasks = first_only.find("$(echo");
    first_only.replace(tasks, first_only.find(";\n", tasks) - tasks, "0");
    make_program(made / "bin", "sbatch", first_only);
    const std::vector<std::string> line = {
        "sweep", file, "--out", (made / "out").string(), "--on", "slurm", "--batch", "retries=0", "--quiet"};
    const tests::ProgramRun run = run_octant(line);
    INFO(run.out << run.err);
    CHECK(run.exit_code == 1);
    CHECK(tests::lines_in(run.out) == 1);
    CHECK_THAT(run.out, Contains("1 of 3 flights done (2 not begun), by Slurm"));
    // The first in the order of flying is the last of the file.
    CHECK_THAT(read_file(made / "out/sweep.csv"), Contains("\n40,40,1,not begun,0,") && Contains("\n60,60,1,flown,1,"));
    CHECK_THAT(read_file(made / "out/report.html"), Contains("<td>2 flights</td>"));
    make_program(made / "bin", "sbatch", working_sbatch);
    CHECK(run_octant(line).exit_code == 0);
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
