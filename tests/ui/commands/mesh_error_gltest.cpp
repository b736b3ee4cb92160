#include "sim/base/output_file.h"
#include "tests/ui/commands/command_line.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

using namespace octant;
using octant::tests::run_octant;

namespace {

std::filesystem::path folder() {
    static const auto made = tests::empty_folder("mesh-error");
    return made;
}

std::string file_with(const std::string& name, std::string_view bytes) {
    write_file(folder() / name, bytes);
    return (folder() / name).string();
}

tests::ProgramRun mesh_error(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "mesh-error");
    return run_octant(arguments);
}

/// What it prints, less the times and the number of threads.
nlohmann::json figures(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const tests::ProgramRun run = mesh_error(arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    nlohmann::json found = nlohmann::json::parse(run.out);
    CHECK(found.at("read_ms") > 0.0);
    CHECK(found.at("measure_ms") > 0.0);
    for (const char* key : {"read_ms", "measure_ms", "threads"}) {
        found.erase(key);
    }
    return found;
}

void check_refused(const std::vector<std::string>& arguments, const std::string& expected) {
    const tests::ProgramRun run = mesh_error(arguments);
    INFO(run.err);
    CHECK(run.exit_code == 2);
    CHECK(tests::lines_in(run.err) == 1);
    CHECK(run.err.find(expected) != std::string::npos);
    CHECK(run.out.empty());
}

/// 4 by 3, so that its diagonal is 5.
constexpr std::string_view floor_obj = "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nf 1 2 3\nf 1 3 4\n";

/// The same half a unit higher, one triangle turned round.
constexpr std::string_view raised_obj =
    "v 0 0 0.5\nv 4 0 0.5\nv 4 3 0.5\nv 0 3 0.5\nv 9 9 9\nf 1 2 3\nf 4 3 1\n";

} // namespace

TEST_CASE("two plates are as far apart in the report as in their files") {
    const std::string a = file_with("floor.obj", floor_obj);
    const std::string b = file_with("raised.obj", raised_obj);
    const nlohmann::json found = figures({a, b});
    CHECK(found.at("diagonal_units") == 5.0);
    CHECK(found.at("a_triangles") == 2);
    for (const char* way : {"both", "a_to_b", "b_to_a"}) {
        const nlohmann::json& figure = found.at(way);
        CHECK(figure.at("hausdorff_least_units").get<double>() == Approx(0.5));
        CHECK(figure.at("hausdorff_most_units").get<double>() >= 0.5);
        CHECK(figure.at("hausdorff_most").get<double>() == Approx(0.1).epsilon(0.011));
        CHECK(figure.at("rms").get<double>() == Approx(0.1));
        CHECK(figure.at("mean_units").get<double>() == Approx(0.5));
        CHECK_FALSE(figure.contains("colour_rms"));
    }
}

TEST_CASE("what is wrong with B is told") {
    const std::string a = file_with("floor.obj", floor_obj);
    const std::string b = file_with("raised.obj", raised_obj);
    const nlohmann::json found = figures({a, b});
    const nlohmann::json& defects = found.at("defects_of_b");
    CHECK(defects.at("turned_edges") == 1);
    CHECK(defects.at("boundary_edges") == 4);
    CHECK(defects.at("boundary_loops") == 1);
    CHECK(defects.at("unreferenced_vertices") == 1);
    CHECK(defects.at("shells") == 1);
    CHECK(defects.at("genus").is_null());
    CHECK(found.at("flipped_area_share").get<double>() == Approx(0.5).margin(1e-3));
}

TEST_CASE("the number of threads changes none of the figures") {
    const std::string a = file_with("floor.obj", floor_obj);
    const std::string b = file_with("raised.obj", raised_obj);
    CHECK(figures({a, b, "--threads", "1"}) == figures({a, b, "--threads", "4"}));
}

TEST_CASE("the difference in colour is given where both meshes have colours") {
    const std::string a =
        file_with("dark.obj", "v 0 0 0 0 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n");
    const std::string b =
        file_with("red.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n");
    CHECK(figures({a, b}).at("both").at("colour_rms").get<double>() == Approx(1.0));
    CHECK(mesh_error({a, b}).out.find("colour rms") != std::string::npos);
}

TEST_CASE("without --json the report is a table") {
    const std::string a = file_with("floor.obj", floor_obj);
    const tests::ProgramRun run = mesh_error({a, a, "--quiet", "--samples", "1000"});
    CHECK(run.exit_code == 0);
    CHECK(run.err.empty());
    CHECK(run.out.find("A to B") != std::string::npos);
    CHECK(run.out.find("boundary_edges") != std::string::npos);
}

TEST_CASE("files without a surface and wrong options are refused in one line") {
    const std::string a = file_with("floor.obj", floor_obj);
    const std::string points = file_with("points.obj", "v 0 0 0\nv 1 0 0\n");
    check_refused({a, points}, "points.obj");
    check_refused({a, (folder() / "none.obj").string()}, "none.obj");
    check_refused({a, a, "--threads", "0"}, "--threads");
    check_refused({a, a, "--samples", "0"}, "--samples");
    check_refused({a, a, "--tightness", "1"}, "--tightness");
    check_refused({a}, "B");
}
