#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace octant;
using octant::tests::run_octant;

namespace {

std::filesystem::path error_folder() {
    static const auto made = tests::empty_folder("mesh-error");
    return made;
}

std::string error_file_with(const std::string& name, std::string_view bytes) {
    write_file(error_folder() / name, bytes);
    return (error_folder() / name).string();
}

tests::ProgramRun mesh_error(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "mesh-error");
    return run_octant(arguments);
}

/// What it prints, less the times and the number of threads.
tests::PrintedJson error_figures(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const tests::ProgramRun run = mesh_error(arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const tests::PrintedJson found(run.out);
    CHECK(found["read_ms"] > 0.0);
    CHECK(found["measure_ms"] > 0.0);
    return found.without({"read_ms", "measure_ms", "threads"});
}

/// 4 by 3, so that its diagonal is 5.
constexpr std::string_view floor_obj = "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nf 1 2 3\nf 1 3 4\n";

/// The same half a unit higher, one triangle turned round.
constexpr std::string_view raised_obj = "v 0 0 0.5\nv 4 0 0.5\nv 4 3 0.5\nv 0 3 0.5\nv 9 9 9\nf 1 2 3\nf 4 3 1\n";

} // namespace

TEST_CASE("two plates are as far apart in the report as in their files") {
    const std::string a = error_file_with("floor.obj", floor_obj);
    const std::string b = error_file_with("raised.obj", raised_obj);
    const tests::PrintedJson found = error_figures({a, b});
    CHECK(found["diagonal_units"] == 5.0);
    CHECK(found["a_triangles"] == 2);
    for (const char* way : {"both", "a_to_b", "b_to_a"}) {
        const tests::PrintedJson figure = found[way];
        CHECK(figure["hausdorff_least_units"].number() == Approx(0.5));
        CHECK(figure["hausdorff_most_units"].number() >= 0.5);
        CHECK(figure["hausdorff_most"].number() == Approx(0.1).epsilon(0.011));
        CHECK(figure["rms"].number() == Approx(0.1));
        CHECK(figure["mean_units"].number() == Approx(0.5));
        CHECK_FALSE(figure.contains("colour_rms"));
    }
}

TEST_CASE("what is wrong with B is told") {
    const std::string a = error_file_with("floor.obj", floor_obj);
    const std::string b = error_file_with("raised.obj", raised_obj);
    const tests::PrintedJson found = error_figures({a, b});
    const tests::PrintedJson defects = found["defects_of_b"];
    CHECK(defects["turned_edges"] == 1);
    CHECK(defects["boundary_edges"] == 4);
    CHECK(defects["boundary_loops"] == 1);
    CHECK(defects["unreferenced_vertices"] == 1);
    CHECK(defects["shells"] == 1);
    CHECK(defects["genus"].is_null());
    CHECK(found["flipped_area_share"].number() == Approx(0.5).margin(1e-3));
}

TEST_CASE("the number of threads changes none of the figures") {
    const std::string a = error_file_with("floor.obj", floor_obj);
    const std::string b = error_file_with("raised.obj", raised_obj);
    CHECK(error_figures({a, b, "--threads", "1"}) == error_figures({a, b, "--threads", "4"}));
}

TEST_CASE("the difference in colour is given where both meshes have colours") {
    const std::string a = error_file_with("dark.obj", "v 0 0 0 0 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n");
    const std::string b = error_file_with("red.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n");
    CHECK(error_figures({a, b})["both"]["colour_rms"].number() == Approx(1.0));
    CHECK(mesh_error({a, b}).out.find("colour rms") != std::string::npos);
}

TEST_CASE("without --json the report is a table") {
    const std::string a = error_file_with("floor.obj", floor_obj);
    const tests::ProgramRun run = mesh_error({a, a, "--quiet", "--samples", "1000"});
    CHECK(run.exit_code == 0);
    CHECK(run.err.empty());
    CHECK(run.out.find("A to B") != std::string::npos);
    CHECK(run.out.find("boundary_edges") != std::string::npos);
}

TEST_CASE("files without a surface and wrong options are refused in one line") {
    const std::string a = error_file_with("floor.obj", floor_obj);
    const std::string points = error_file_with("points.obj", "v 0 0 0\nv 1 0 0\n");
    tests::check_refusals(
        "mesh-error", {{a + " " + points, "points.obj"}, {a + " " + (error_folder() / "none.obj").string(), "none.obj"},
                          {a + " " + a + " --threads 0", "--threads"}, {a + " " + a + " --samples 0", "--samples"},
                          {a + " " + a + " --tightness 1", "--tightness"}, {a, "B"}});
}
