#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

using namespace octant;
using namespace octant::tests;

namespace {

std::string made_terrain_file(const std::filesystem::path& folder) {
    const std::string file = (folder / "made.tif").string();
    REQUIRE(run_octant({"terrain", "make", "--kind", "canyon", "--size", "129", "--out", file}).exit_code == 0);
    return file;
}

} // namespace

TEST_CASE("octant terrain mesh writes a PLY whose corners are the map's") {
    const auto folder = empty_folder("terrain-mesh");
    const std::string terrain = made_terrain_file(folder);
    const std::string ply = (folder / "mesh.ply").string();
    const ProgramRun run = run_octant({"terrain", "mesh", terrain, "--eye", "0,0,4000", "--look", "0,1,0", "--fov",
        "120", "--triangles", "500", "--terrain-mesh", "ascii", "--json", "--out", ply});
    REQUIRE(run.exit_code == 0);
    const auto results = tests::PrintedJson(run.out);
    CHECK(results["triangles"].number() <= 500);
    CHECK(results["triangles"].number() > 300);
    std::ifstream in(ply);
    std::string word;
    while (word != "end_header") { REQUIRE(in >> word); }
    double west_m = 0.0;
    double x_m = 0.0;
    double y_m = 0.0;
    double z_m = 0.0;
    for (int k = 0; k < results["vertices"].number(); ++k) {
        REQUIRE(in >> x_m >> y_m >> z_m);
        west_m = std::min(west_m, x_m);
    }
    CHECK(west_m == Approx(-64.0 * 20.0));
    int corners = 0;
    REQUIRE(in >> corners);
    CHECK(corners == 3);
}

TEST_CASE("octant terrain error solves for a percentile and refuses what it cannot do") {
    const auto folder = empty_folder("terrain-error");
    const std::string terrain = made_terrain_file(folder);
    const std::string points = (folder / "points.csv").string();
    write_file(points, "map,x_m,y_m,agl_m,heading_deg,pitch_deg\nmade,0,-900,300,0,-8\nmade,900,0,300,270,-8\n");
    const ProgramRun run = run_octant(
        {"terrain", "error", terrain, "--eye-points", points, "--solve", "4", "--compare", "--json", "--quiet"});
    REQUIRE(run.exit_code == 0);
    const auto tables = tests::PrintedJson(run.out);
    const auto& rows = tables[0]["rows"];
    REQUIRE(rows.size() == 3);
    CHECK(rows[0]["99.9 % px"].number() <= 4.0);
    CHECK(rows[0]["99.9 % px"].number() > 3.5);
    CHECK(rows[2]["view"] == "mean");
    CHECK(rows[2]["uncovered"] == 0);
    REQUIRE(tables[1]["rows"].size() == 3);
    CHECK(tables[1]["rows"][1]["ratio"].number() < 1.0);

    CHECK(run_octant({"terrain", "error", terrain}).exit_code == 2);
    CHECK(run_octant({"terrain", "error", terrain, "--eye-points", points, "--map", "other"}).exit_code == 2);
    CHECK(run_octant({"terrain", "error", terrain, "--eye-points", points}).exit_code == 2);
}

TEST_CASE("octant terrain query tells heights, heights above ground and what hides") {
    const auto folder = empty_folder("terrain-query");
    const std::string terrain = made_terrain_file(folder);
    const std::string points = (folder / "points.csv").string();
    write_file(points, "x,y,z\n0,0,3000\n5000,0\n");
    const ProgramRun run = run_octant(
        {"terrain", "query", terrain, "--at", "0,0", points, "--from", "-1000,0,3500", "--to", "1000,0,0", "--json"});
    REQUIRE(run.exit_code == 0);
    const auto answers = tests::PrintedJson(run.out);
    const double ground_m = answers["points"][0]["ground_m"].number();
    CHECK(answers["points"][1]["above_ground_m"].number() == Approx(3000.0 - ground_m));
    CHECK(answers["points"][2]["ground_m"].is_null());
    CHECK(answers["sight"]["visible"] == false);
    CHECK(answers["sight"]["hidden_at_m"].size() == 3);

    const ProgramRun drawn = run_octant({"terrain", "query", terrain, "--at", "0,0", "--as-drawn", "--eye",
        "0,-800,3000", "--look", "0,0,1500", "--error-px", "0.5"});
    REQUIRE(drawn.exit_code == 0);
    CHECK(lines_in(drawn.out) == 2);

    write_file(points, "0,0\nnorth,0\n");
    const ProgramRun wrong = run_octant({"terrain", "query", terrain, "--at", points});
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.err.find("points.csv:2: expected x,y or x,y,z") != std::string::npos);
}

TEST_CASE("octant terrain check says how many views it looked at") {
    const ProgramRun run =
        run_octant({"terrain", "check", "hills", "--views", "40", "--every", "4", "--json", "--quiet"});
    REQUIRE(run.exit_code == 0);
    const auto results = tests::PrintedJson(run.out);
    CHECK(results["views"] == 10);
    CHECK(results["cracked_views"] == 0);
    CHECK(results["drawn"] == 1);
}
