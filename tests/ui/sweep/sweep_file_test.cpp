#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/sweep/engine.h"
#include "ui/sweep/sweep_file.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <set>

using namespace octant;
using namespace octant::ui::sweep;
using Catch::Contains;

namespace {

std::filesystem::path file_of(const std::string& text) {
    const auto file = tests::scratch_folder() / "budgets.toml";
    write_file(file, text);
    return file;
}

Sweep sweep_of(const std::string& text) { return read_sweep(file_of(text)); }

std::vector<std::string> names_of(const Sweep& sweep) {
    std::vector<std::string> names;
    for (const SweepRun& run : sweep.runs) { names.push_back(run.name); }
    return names;
}

void check_refused(const std::string& text, const std::string& fault) {
    const auto file = file_of(text);
    CHECK_THROWS_WITH(read_sweep(file), Catch::StartsWith(file.string() + ":") && Contains(fault) && !Contains("\n"));
}

} // namespace

TEST_CASE("a sweep flies every combination, the last thing varied changing fastest") {
    const Sweep sweep = sweep_of(R"(
name = "two by three"
[settings]
size = "64x48"
[vary]
path = ["straight", "turn"]
triangles = { from = 1000, to = 3000, step = 1000 }
)");
    CHECK(sweep.name == "two-by-three");
    CHECK(names_of(sweep) == std::vector<std::string>{"straight-1000", "straight-2000", "straight-3000", "turn-1000",
                                 "turn-2000", "turn-3000"});
    CHECK(sweep.runs[4].settings.path.name == "turn");
    CHECK(sweep.runs[4].settings.ground.triangles == 2000);
    CHECK(sweep.runs[4].settings.view.size_px == glm::ivec2(64, 48));
    CHECK(sweep.runs[4].varied[1] == std::pair<std::string, std::string>("triangles", "2000"));
}

TEST_CASE("a sweep varies formations and groups of settings, and repeats") {
    const Sweep sweep = sweep_of(R"(
repeats = 2
[vary]
aircraft = ["f15", ["f15", "500md"]]
[vary.order.paper]
order-method = "paper"
fov = 50
[vary.order.tree]
order-method = "tree"
)");
    CHECK(sweep.name == "budgets");
    CHECK(names_of(sweep) == std::vector<std::string>{"f15-paper-r1", "f15-paper-r2", "f15-tree-r1", "f15-tree-r2",
                                 "f15+500md-paper-r1", "f15+500md-paper-r2", "f15+500md-tree-r1", "f15+500md-tree-r2"});
    CHECK(sweep.runs[5].settings.path.aircraft == std::vector<std::string>{"f15", "500md"});
    CHECK(sweep.runs[5].settings.view.fov_deg == 50.0);
    CHECK(sweep.runs[5].repeat == 2);
    CHECK(sweep.runs[4].settings == sweep.runs[5].settings);
    CHECK(sweep_of("").runs.size() == 1);
}

TEST_CASE("named groups stay in the order of the file, not of the alphabet") {
    const Sweep sweep = sweep_of("[vary.ground.usual]\ntriangles = 8000\n[vary.ground.coarse]\ntriangles = 2000\n"
                                 "[vary.ground.as-printed]\nterrain-lod = \"paper\"\n");
    CHECK(names_of(sweep) == std::vector<std::string>{"usual", "coarse", "as-printed"});
    CHECK(names_of(sweep_of("[vary]\norder = { b = { fov = 40 }, a = { fov = 50 } }")) ==
          std::vector<std::string>{"b", "a"});
}

TEST_CASE("ranges of decimals end where they say, and names are fit for folders") {
    CHECK(names_of(sweep_of("[vary]\nerror-px = { from = 0.1, to = 0.3, step = 0.1 }")) ==
          std::vector<std::string>{"0.1", "0.2", "0.3"});
    CHECK(names_of(sweep_of("[vary]\npath = [\"../a b/x.toml\", \"c/x.toml\", \"..\"]")) ==
          std::vector<std::string>{"x", "xx", "_.."});
    CHECK(names_of(sweep_of("name = \"a/\"")) == std::vector<std::string>{"a-"});
}

TEST_CASE("a sweep's faults are told by file and line") {
    check_refused("a = ", ":1: expected TOML");
    check_refused("a = t\nb = 1", ":1: expected TOML, got a fault: ");
    check_refused("\nflights = 3", ":2: expected name, repeats, [settings] or [vary], got 'flights'");
    check_refused("name = 3", ":1: name: expected a text");
    check_refused("repeats = 0", ":1: repeats: expected a whole number from 1 to 1000");
    check_refused("[settings]\nsize = \"64\"", ":2: size: expected");
    check_refused("[vary]\naircraft = [\"=f15\"]", ":2: aircraft: expected NAME=PATH");
    check_refused("[vary]\naircraft = [\"f15\", \"f16\"]", ":2: aircraft: expected f15, 500md");
    check_refused("[vary]\naircraft = [\"f15=loop\"]", ":2: path: expected straight, jinking");
    check_refused("[settings]\n\npath = \"loop\"", ":3: path: expected straight, jinking");
    check_refused("[settings]\nwings = 2", ":2: wings: expected the name of a setting");
    check_refused("[vary]\npath = \"turn\"", ":2: path: expected a list, a range or named groups");
    check_refused("[vary]\npath = []", ":2: path: expected values, got none");
    check_refused("[vary]\nfov = { from = 1, to = 2 }", ":2: expected a range");
    check_refused("[vary]\nfov = { from = 1, to = 2, step = 0 }", ":2: expected from <= to");
    check_refused("[vary]\nfov = { from = 0, to = 1e9, step = 1e-9 }", "values, got others");
    check_refused("[vary]\nsize = [\"64x48\", 7]", ":2: size: expected");
    check_refused("[vary]\nsize = [1979-05-27]", "expected a text, a number or a truth value");
    check_refused("vary = 3", ":1: expected a table [vary]");
    check_refused("repeats = 1000\n[vary]\nfov = { from = 20, to = 90, step = 0.1 }", "flights");
}

TEST_CASE("repeats are flown one after the other, and variants shuffled within each, the same for each call") {
    const Sweep sweep = sweep_of("repeats = 3\n[vary]\nfov = [40, 50, 60, 70]");
    std::vector<std::string> names;
    for (const std::size_t run : flying_order(sweep)) { names.push_back(sweep.runs[run].name); }
    // By a program of its own: 64-bit FNV-1a of the name seeds the numbers of a Fisher-Yates shuffle.
    CHECK(names == std::vector<std::string>{"50-r1", "60-r1", "40-r1", "70-r1", "60-r2", "40-r2", "50-r2", "70-r2",
                       "50-r3", "60-r3", "70-r3", "40-r3"});
    CHECK(flying_order(sweep_of("")) == std::vector<std::size_t>{0});
    CHECK(flying_order({}).empty());
    // Each of two variants is first in about half of the repeats.
    const Sweep pairs = sweep_of("repeats = 1000\n[vary]\nfov = [40, 50]");
    const std::vector<std::size_t> order = flying_order(pairs);
    int first = 0;
    for (std::size_t i = 0; i < order.size(); i += 2) {
        CHECK(pairs.runs[order[i]].repeat == static_cast<int>(i / 2) + 1);
        first += pairs.runs[order[i]].varied[0].second == "40" ? 1 : 0;
    }
    CHECK(std::abs(first - 500) < 80); // five standard deviations
    CHECK(std::set<std::size_t>(order.begin(), order.end()).size() == 2000);
}

TEST_CASE("a run is flown, failed, stopped or not begun by what lies in the sweep's folder") {
    const Sweep sweep = sweep_of("[settings]\nterrain = \"none\"\n[vary]\nfov = [40, 50, 60]");
    const SweepFolder folder(tests::empty_folder("states"));
    folder.prepare(sweep);
    const auto state_of = [&](std::size_t run) {
        const RunResult result = result_of(folder, sweep.runs[run]);
        return text_of(result.state) + ": " + result.fault;
    };
    CHECK(state_of(0) == "not begun: ");
    write_file(folder.log("40"), "");
    CHECK(state_of(0) == "failed: was not flown to its end");
    write_file(folder.log("40"), "note: slow\noctant: expected much, got little\n\n");
    CHECK(state_of(0) == "failed: octant: expected much, got little");
    const auto run_file = folder.recording("50") / "run.json";
    make_folder(run_file.parent_path());
    write_file(run_file, R"({"format": "octant recording", "stopped": "SIGTERM after 3 of 240 frames"})");
    CHECK(state_of(1) == "not begun: "); // an earlier call has stopped it
    write_file(folder.log("50"), "note: slow\n");
    CHECK(state_of(1) == "stopped: ended by SIGTERM after 3 of 240 frames");
    constexpr std::array<std::size_t, 2> last_two{1, 2};
    CHECK(folder.any_begun(sweep, last_two));
    folder.remove_logs(sweep, last_two);
    CHECK_FALSE(folder.any_begun(sweep, last_two));
    write_file(run_file, R"({"format": "octant recording", "format_version": 99})");
    CHECK_THROWS_WITH(
        state_of(1), run_file.string() + ": expected format_version 1 or earlier, got 99: a newer Octant wrote it");
}

TEST_CASE("scripts of engines name each run once, whatever the program is called") {
    Sweep sweep = sweep_of("[vary]\nfov = { from = 40, to = 49, step = 1 }");
    const SweepFolder folder("/a b/sweep");
    EngineOptions options;
    options.program = "/opt/it's/octant";
    options.sbatch_options = {"--partition=long"};
    CHECK(tasks_of(sweep, options) == 10);
    options.tasks = 4;
    CHECK(tasks_of(sweep, options) == 4);
    const std::string script = sbatch_script(sweep, folder, options, 4);
    CHECK_THAT(script, Contains("#SBATCH --array=0-3\n"));
    CHECK_THAT(script, Contains("#SBATCH --requeue\n"));
    CHECK_THAT(script, Contains("#SBATCH --exclusive\n"));
    CHECK_THAT(script, Contains("#SBATCH --partition=long\n"));
    CHECK_THAT(script, Contains("cd '/a b/sweep' || exit 2\n"));
    CHECK_THAT(script, Contains("'/opt/it'\\''s/octant' fly --settings"));
    constexpr std::array<std::size_t, 3> runs{1, 5, 6};
    CHECK(task_list(runs, 4) == "1,2");
    options.hosts = "/hosts.txt";
    const std::string parallel = parallel_script(sweep, folder, options);
    CHECK_THAT(parallel, Contains("cd '/a b/sweep' || exit 2\n"));
    CHECK_THAT(parallel, Contains("--jobs 1 --sshloginfile '/hosts.txt'"));
    CHECK_THAT(parallel, Contains("--arg-file todo.txt 'exec "));
}
