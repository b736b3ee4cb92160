#include "models/meshfile/mesh_file.h"
#include "models/triangle_mesh.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace octant;
using octant::tests::run_octant;

namespace {

std::filesystem::path simplify_folder() {
    static const auto made = tests::empty_folder("simplify");
    return made;
}

std::string file_named(const std::string& name) {
    return (simplify_folder() / name).string();
}

/// A square of `side` x `side` fields of two triangles each, with gentle waves, as an OBJ file.
std::string waves(int side) {
    models::TriangleMesh mesh;
    for (int y = 0; y <= side; ++y) {
        for (int x = 0; x <= side; ++x) {
            mesh.vertices_m.push_back({x, y, 0.6 * std::sin(0.5 * x) * std::cos(0.4 * y)});
        }
    }
    const auto at = [side](int x, int y) { return static_cast<std::uint32_t>(y * (side + 1) + x); };
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
            mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
        }
    }
    const std::string file = file_named("waves.obj");
    models::meshfile::write_mesh(file, mesh);
    return file;
}

/// Cubes in a row, each half as large as the one before, as an OBJ file.
std::string cubes(int count) {
    models::TriangleMesh mesh;
    double side = 1.0;
    for (int i = 0; i < count; ++i, side *= 0.5) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
        for (int corner = 0; corner < 8; ++corner) {
            mesh.vertices_m.push_back(
                {2.0 * i + side * (corner & 1),
                 side * ((corner >> 1) & 1),
                 side * ((corner >> 2) & 1)});
        }
        const std::vector<models::Triangle> sides{
            {0, 2, 3},
            {0, 3, 1},
            {4, 5, 7},
            {4, 7, 6},
            {0, 1, 5},
            {0, 5, 4},
            {2, 6, 7},
            {2, 7, 3},
            {0, 4, 6},
            {0, 6, 2},
            {1, 3, 7},
            {1, 7, 5}};
        for (const auto& [a, b, c] : sides) {
            mesh.triangles.push_back({first + a, first + b, first + c});
        }
    }
    const std::string file = file_named("cubes.obj");
    models::meshfile::write_mesh(file, mesh);
    return file;
}

tests::PrintedJson simplify_figures(const std::vector<std::string>& arguments) {
    return tests::figures_of("simplify", arguments);
}

void check_simplify_refused(
    const std::vector<std::string>& arguments, const std::string& expected) {
    tests::check_refused("simplify", arguments, expected);
}

/// Rows of a short flight's frames.csv.
std::vector<ui::report::FrameRecord>
flown_frames(const std::string& aircraft, const std::string& size, const std::string& error_px) {
    const std::string recording = file_named("flown");
    const tests::ProgramRun run = run_octant(
        {"fly",
         "straight",
         "--aircraft",
         aircraft,
         "--terrain",
         "hills",
         "--size",
         size,
         "--frames",
         "4",
         "--warm-up",
         "0",
         "--aircraft-error-px",
         error_px,
         "--record",
         recording,
         "--quiet"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return ui::report::read_frame_csv(recording + "/frames.csv").records;
}

} // namespace

TEST_CASE("a mesh is simplified to the faces asked for, and its error is that of mesh-error") {
    const std::string in = waves(24);
    const std::string out = file_named("small.ply");
    for (const char* method : {"surface", "fast"}) {
        const tests::PrintedJson found =
            simplify_figures({in, out, "--faces", "200", "--method", method});
        CHECK(found["faces"] <= 200);
        CHECK(found["faces"] >= 190);
        const models::TriangleMesh written = models::meshfile::read_mesh(out);
        CHECK(written.triangles.size() == found["faces"]);
        const tests::ProgramRun run = run_octant({"mesh-error", in, out, "--json", "--quiet"});
        REQUIRE(run.exit_code == 0);
        const tests::PrintedJson measured = tests::PrintedJson(run.out)["both"];
        CHECK(found["error"].number() >= measured["hausdorff_least_units"].number());
        CHECK(found["error"].number() <= 1.5 * measured["hausdorff_least_units"].number());
    }
}

TEST_CASE("a distance far below a millionth of the diagonal is certified as closely as any") {
    constexpr std::size_t side = 8;
    models::TriangleMesh plate = models::meshfile::read_mesh(waves(static_cast<int>(side)));
    for (std::size_t v = 0; v < plate.vertices_m.size(); ++v) {
        const std::size_t column = v % (side + 1);
        const std::size_t row = v / (side + 1);
        glm::dvec3& place_m = plate.vertices_m[v];
        if (column % side != 0 && row % side != 0) {
            const auto turn = static_cast<double>(v);
            place_m += 0.4 * glm::dvec3(std::sin(12.9 * turn), std::cos(7.7 * turn), 0.0);
        }
        place_m.z = v % 3 == 0 ? 1e-7 : 0.0;
    }
    const std::string rough = file_named("rough.obj");
    models::meshfile::write_mesh(rough, plate);
    for (const std::string ending : {".obj", ".ply", ".stl", ".glb"}) {
        INFO(ending);
        const std::string flat = file_named("flat" + ending);
        const auto made = simplify_figures({rough, flat, "--faces", "20", "--method", "fast"});
        const auto measured = tests::figures_of("mesh-error", {rough, flat});
        const double certified = made["error_of_diagonal"].number();
        const double least = measured["both"]["hausdorff_least"].number();
        CHECK(least > 0.0);
        CHECK(certified >= least);
        CHECK(certified <= 1.3 * measured["both"]["hausdorff_most"].number());
    }
}

TEST_CASE("a goal below what all shells need drops the smallest; kept, it is missed with exit 1") {
    const std::string in = cubes(5);
    const std::string out = file_named("fewer.obj");
    const tests::PrintedJson fewer = simplify_figures({in, out, "--faces", "12"});
    CHECK(fewer["faces"] <= 12);
    CHECK(fewer["shells_gone"] == 3);
    const tests::ProgramRun kept =
        run_octant({"simplify", in, out, "--faces", "12", "--keep-shells", "--json"});
    CHECK(kept.exit_code == 1);
    CHECK_THAT(kept.err, Catch::Contains("no edge can collapse any more"));
    CHECK(tests::PrintedJson(kept.out)["faces"] == 20);
    CHECK(tests::PrintedJson(kept.out)["shells_gone"] == 0);
    CHECK(models::meshfile::read_mesh(out).triangles.size() == 20);
}

TEST_CASE("an error that is asked for is certified not to be exceeded") {
    const std::string in = waves(24);
    const std::string out = file_named("within.obj");
    const tests::PrintedJson found = simplify_figures({in, out, "--error", "0.05"});
    CHECK(found["error"] <= 0.05);
    CHECK(found["faces"] < 1152);
    const tests::PrintedJson share = simplify_figures({in, out, "--error", "0.1%"});
    CHECK(share["error_of_diagonal"] <= 0.001);
}

TEST_CASE("the same input gives the same file for any number of threads") {
    const std::string in = waves(8);
    const std::string one = file_named("one.obj");
    const std::string two = file_named("two.obj");
    simplify_figures({in, one, "--faces", "50", "--threads", "1"});
    simplify_figures({in, two, "--faces", "50", "--threads", "2"});
    CHECK(read_file(one) == read_file(two));
}

TEST_CASE("the paper's methods state how the paper was read and what it prints") {
    const std::string in = waves(20);
    const std::string out = file_named("printed.obj");
    const tests::PrintedJson plane =
        simplify_figures({in, out, "--vertices", "100", "--method", "plane"});
    const tests::PrintedJson both =
        simplify_figures({in, out, "--vertices", "100", "--method", "bidirectional"});
    CHECK(plane["counted_vertices"] == 100);
    CHECK(plane["feet"] == 0);
    CHECK(both["feet"] > 1000);
    CHECK(both["share_outside"] > 0.5);
    CHECK(both["error_sum_triangle"] <= both["error_sum_bidirectional"]);
    CHECK(both["reading"].text().find("shortest edge first") == 0);
}

TEST_CASE("a chain of levels has rising certified errors and is flown") {
    const std::string in = waves(30);
    const std::string chain = file_named("waves.chain");
    const tests::PrintedJson found = simplify_figures({in, chain, "--chain"});
    const tests::PrintedJson levels = found["levels"];
    REQUIRE(levels.size() >= 3);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        CHECK(levels[i]["error"] > levels[i - 1]["error"]);
        CHECK(levels[i]["faces"] < levels[i - 1]["faces"]);
    }
    const auto last_row = [&](const char* error_px) {
        return flown_frames(chain, "160x90", error_px).back();
    };
    const auto near = last_row("0.01");
    CHECK(near.aircraft_level == 0);
    CHECK(near.aircraft_polygons == levels[0]["faces"]);
    const auto far = last_row("100");
    CHECK(far.aircraft_level > 0);
    CHECK(far.aircraft_polygons < near.aircraft_polygons);
}

TEST_CASE("simplify refuses wrong input in one line with exit code 2") {
    const std::string in = waves(4);
    check_simplify_refused({in, in, "--faces", "10"}, "another file than the input");
    check_simplify_refused(
        {in, file_named("x.xyz"), "--faces", "10"}, "expected a name that ends in");
    check_simplify_refused(
        {in, file_named("x.obj")}, "expected one of --vertices, --faces and --error");
    check_simplify_refused(
        {in, file_named("x.obj"), "--error", "-1"}, "--error: expected a number above 0");
    check_simplify_refused(
        {in, file_named("none/x.obj"), "--faces", "10"}, "none/x.obj: cannot be written");
    check_simplify_refused({in, file_named("x.obj"), "--chain"}, "ends in .chain");
    check_simplify_refused(
        {in, file_named("x.chain"), "--chain", "--method", "plane"}, "--method plane: expected");
    check_simplify_refused(
        {file_named("absent.obj"), file_named("x.obj"), "--faces", "3"}, "absent.obj");
    write_file(simplify_folder() / "bad.obj", "v 0 0 0\nv 1 0 x\n");
    check_simplify_refused(
        {file_named("bad.obj"), file_named("x.obj"), "--faces", "3"}, "bad.obj:2:");
    CHECK_FALSE(std::filesystem::exists(simplify_folder() / "x.obj"));
    CHECK_FALSE(std::filesystem::exists(simplify_folder() / "x.chain"));
}

TEST_CASE("a plain mesh is refined in flight to the error asked for") {
    const auto triangles = [&](const char* error_px) {
        const auto rows = flown_frames(waves(60), "320x180", error_px);
        CHECK(rows.back().aircraft_level == 0);
        return rows.back().aircraft_polygons;
    };
    const int fine = triangles("0.1");
    CHECK(fine > 250);
    CHECK(triangles("0.3") < fine);
}
