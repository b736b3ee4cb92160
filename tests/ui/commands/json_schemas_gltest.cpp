#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/json_schema.h"
#include "tests/ui/flight/small_ground.h"
#include "ui/commands/commands.h"
#include "ui/report/comparison.h"
#include "ui/report/frame_csv.h"
#include "ui/report/statistics.h"
#include "ui/report/table.h"
#include "ui/studies/program/bench.h"
#include "ui/studies/program/study_program.h"
#include "ui/sweep/sweep_folder.h"
#include "ui/terrain/terrain_query.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

using namespace octant;
using octant::tests::run_octant;

namespace {

namespace fs = std::filesystem;

fs::path schema(const std::string& name) { return fs::path(OCTANT_SOURCE_DIR) / "ui/schemas" / (name + ".json"); }

/// Runs a command with --json and holds what it prints against a schema.
void check(const std::string& name, std::vector<std::string> line) {
    line.emplace_back("--json");
    const tests::ProgramRun run = run_octant(line);
    INFO(line[0] << " " << line[1] << ": " << run.err);
    CHECK((run.exit_code <= 1 || run.exit_code == 3)); // a failed check; cannot tell
    CHECK(tests::schema_faults(run.out, schema(name)) == std::vector<std::string>());
}

bool prints_json(const ui::command_line::Command& command) {
    return std::ranges::any_of(command.options, [](const auto& option) { return option.name == "--json"; });
}

/// Names of all commands that do something, with --json or without, as "terrain info".
std::set<std::string> commands_with_json(bool with) {
    std::set<std::string> names;
    const auto visit = [&](const auto& self, const ui::command_line::Command& command,
                           const std::string& before) -> void {
        if (command.commands.empty() && prints_json(command) == with) { names.insert(before + command.name); }
        for (const auto& inner : command.commands) { self(self, inner, before + command.name + " "); }
    };
    for (const auto& command : ui::commands::octant_program().commands) {
        if (command.program.empty()) { visit(visit, command, ""); }
    }
    for (const auto& command : ui::studies::program::study_program().commands) {
        visit(visit, command, command.name == "bench" || command.name == "manual" ? "" : "study ");
    }
    return names;
}

} // namespace

TEST_CASE("what recordings and their commands print is as their schemas say") {
    const auto made = tests::empty_folder("schemas-recording");
    const std::string rec = (made / "rec").string();
    const std::vector<std::string> flight = {"fly", "straight", "--terrain", tests::small_ground(), "--size", "32x24",
        "--frames", "12", "--record", rec, "--quiet"};
    check("fly", flight);
    CHECK(tests::schema_faults(read_file(made / "rec/run.json"), schema("run")).empty());
    check("fly", {"fly", "--replay", rec, "--quiet"});
    check("report", {"report", rec, "--out", (made / "page.html").string(), "--quiet"});
    check("report", {"report", rec, rec, "--gate", "p50=0%", "--out", (made / "page.html").string(), "--quiet"});
    check("pack", {"pack", rec, "--quiet"});
    write_file(
        made / "s.toml", "[settings]\nterrain = \"none\"\nsize = \"16x16\"\nframes = 2\n[vary]\nfov = [40, 50]\n");
    const std::string sweep = (made / "s.toml").string();
    const std::string out = (made / "out").string();
    check("sweep-list", {"sweep", sweep, "--list"});
    check("sweep", {"sweep", sweep, "--out", out, "--quiet"});
    check("sweep", {"sweep", sweep, "--out", (made / "two").string(), "--split", "2", "--quiet"});
    CHECK(tests::schema_faults(read_file(made / "two/runs/40/run.json"), schema("run")).empty());
}

TEST_CASE("what a data set's command prints and its files have is as their schemas say") {
    const auto made = tests::empty_folder("schemas-dataset");
    const fs::path out = made / "out";
    check("dataset", {"dataset", "--terrain", "none", "--size", "32x24", "--count", "2", "--vary", "clouds=0:0.5",
                         "--out", out.string(), "--quiet"});
    CHECK(tests::schema_faults(read_file(out / "dataset.json"), schema("dataset-folder")).empty());
    CHECK(tests::schema_faults(read_file(out / "samples/000001.json"), schema("dataset-sample")).empty());
}

TEST_CASE("what commands on models and ground print is as their schemas say") {
    const auto made = tests::empty_folder("schemas");
    const auto file = [&](const char* name) { return (made / name).string(); };
    check("draw-order", {"draw-order", "concave", "--table"});
    check("draw-order", {"draw-order", "concave", "--export", file("x.order")});
    check("draw-order-check", {"draw-order", "concave", "--check", file("x.order")});
    check("model-info", {"model", "info", "f15", "--picture", file("p.png")});
    check(
        "track-info", {"track", "info", std::string(OCTANT_SOURCE_DIR) + "/tests/flightpaths/tracks/opensky-two-b.csv",
                          "--picture", file("t.png")});
    check("simplify", {"simplify", "torus", file("s.ply"), "--faces", "300", "--method", "fast", "--quiet"});
    check(
        "simplify", {"simplify", "torus", file("s.chain"), "--faces", "300", "--method", "fast", "--chain", "--quiet"});
    check("simplify", {"simplify", file("s.ply"), file("t.ply"), "--faces", "200", "--method", "triangle", "--quiet"});
    check("simplify", {"simplify", file("s.ply"), file("t.ply"), "--shared-border", "--out-dir", file("together"),
                          "--faces", "300", "--method", "fast", "--quiet"});
    check("mesh-error", {"mesh-error", file("s.ply"), file("t.ply"), "--quiet"});
    check("refine", {"refine", "torus", "--region", "sphere", "0", "0", "0", "1"});
    check("terrain-make", {"terrain", "make", "--size", "65", "--out", file("m.tif"), "--quiet"});
    check("terrain-info", {"terrain", "info", file("m.tif")});
    check("terrain-import", {"terrain", "import", file("m.tif"), "--out", file("m.ground")});
    check("terrain-info", {"terrain", "info", file("m.ground"), "--verify"});
    check("terrain-mesh", {"terrain", "mesh", file("m.ground"), "--eye", "0,0,900", "--look", "1000,1000,0",
                              "--triangles", "500", "--out", file("g.ply")});
    check("terrain-query", {"terrain", "query", file("m.ground"), "--at", "0,0", "9e6,0,1"});
    check("terrain-query", {"terrain", "query", file("m.ground"), "--from", "0,0,900", "--to", "500,300,250"});
    check("terrain-check", {"terrain", "check", file("m.ground"), "--views", "4", "--draw-every", "0", "--quiet"});
    check("tables",
        {"terrain", "error", file("m.ground"), "--eye", "0,0,900", "--look", "1000,1000,0", "--triangles", "2000"});
    check("tables", {"study", "refinement", "--out", file("st"), "--mesh", file("s.ply"), "--frames", "20", "--quiet"});
    check("bench", {"bench", "--terrain", "none", "--size", "32x32", "--frames", "3", "--quiet"});
    check("bench", {"bench", "--features", "--terrain", "none", "--renderer", "raster", "--size", "32x32", "--frames",
                       "3", "--quiet"});
}

TEST_CASE("schemas of rows say what the columns in the program say") {
    using ui::report::schema_of;
    tests::check_row_schema(schema("frames"), "", ui::report::frame_schema());
    const auto statistics = schema_of(ui::report::all_statistics());
    tests::check_row_schema(schema("fly"), "", statistics);
    tests::check_row_schema(schema("report"), "/properties/recordings/items/properties/summary", statistics);
    tests::check_row_schema(schema("run"), "/properties/summary", statistics);
    tests::check_row_schema(
        schema("bench"), "/properties/scenes/items", schema_of(ui::studies::program::bench_columns()));
    tests::check_row_schema(schema("compare"), "/properties/flights/items", schema_of(ui::report::change_columns()));
    tests::check_row_schema(schema("sweep"), "/properties/runs/items", schema_of(ui::sweep::result_columns()));
    tests::check_row_schema(
        schema("terrain-query"), "/properties/points/items", schema_of(ui::terrain::query_columns()));
}

TEST_CASE("every command has --json but manual, which prints a page and completions") {
    CHECK(commands_with_json(false) == std::set<std::string>{"manual"});
}

TEST_CASE("every command that prints JSON has a schema, and all tables have one form") {
    const std::map<std::string, std::string> schemas = {{"fly", "fly"}, {"listen", "fly"}, {"report", "report"},
        {"compare", "compare"}, {"pack", "pack"}, {"sweep", "sweep"}, {"dataset", "dataset"},
        {"draw-order", "draw-order"}, {"simplify", "simplify"}, {"mesh-error", "mesh-error"}, {"refine", "refine"},
        {"model info", "model-info"}, {"track info", "track-info"}, {"terrain info", "terrain-info"},
        {"terrain make", "terrain-make"}, {"terrain import", "terrain-import"}, {"terrain mesh", "terrain-mesh"},
        {"terrain query", "terrain-query"}, {"terrain check", "terrain-check"}, {"terrain error", "tables"},
        {"bench", "bench"}, {"view", "view-bench"}};
    for (const std::string& command : commands_with_json(true)) {
        INFO(command);
        const auto found = schemas.find(command);
        const bool is_known = found != schemas.end() || command.starts_with("study ");
        CHECK(is_known);
        if (found != schemas.end()) { CHECK(fs::is_regular_file(schema(found->second))); }
    }
    CHECK(commands_with_json(true).size() >= schemas.size() + 8);
    std::vector<ui::report::ResultTable> tables(2);
    tables[0] = {.title = "T", .note = "note"};
    tables[0].add({{"a", "x"}, {"b", 1.5}});
    CHECK(tests::schema_faults(ui::report::json_of(tables), schema("tables")).empty());
    CHECK_FALSE(tests::schema_faults("[{\"title\": 3}]", schema("tables")).empty());
    CHECK_FALSE(tests::schema_faults("[", schema("tables")).empty());
}
