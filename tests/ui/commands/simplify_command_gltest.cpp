#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/mesh_join.h"
#include "models/repair/repair.h"
#include "models/triangle_mesh.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace octant;
using octant::tests::run_octant;

namespace {

std::filesystem::path simplify_folder() {
    static const auto made = tests::empty_folder("simplify");
    return made;
}

std::string file_named(const std::string& name) { return (simplify_folder() / name).string(); }

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
                {2.0 * i + side * (corner & 1), side * ((corner >> 1) & 1), side * ((corner >> 2) & 1)});
        }
        const std::vector<models::Triangle> sides{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
            {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
        for (const auto& [a, b, c] : sides) { mesh.triangles.push_back({first + a, first + b, first + c}); }
    }
    const std::string file = file_named("cubes.obj");
    models::meshfile::write_mesh(file, mesh);
    return file;
}

tests::PrintedJson simplify_figures(const std::vector<std::string>& arguments) {
    return tests::results_of_run("simplify", arguments);
}

void check_simplify_refused(const std::vector<std::string>& arguments, const std::string& expected) {
    tests::check_refused("simplify", arguments, expected);
}

/// Rows of a short flight's frames.csv.
std::vector<ui::report::FrameRecord> flown_frames(
    const std::string& aircraft, const std::string& size, const std::string& error_px) {
    const std::string recording = file_named("flown");
    const tests::ProgramRun run = run_octant({"fly", "straight", "--aircraft", aircraft, "--terrain", "hills", "--size",
        size, "--frames", "4", "--warm-up", "0", "--aircraft-error-px", error_px, "--record", recording, "--quiet"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return ui::report::read_frame_csv(recording + "/frames.csv").records;
}

} // namespace

TEST_CASE("a mesh is simplified to the faces asked for, and its error is that of mesh-error") {
    const std::string in = waves(24);
    const std::string out = file_named("small.ply");
    for (const char* method : {"surface", "fast"}) {
        const tests::PrintedJson found = simplify_figures({in, out, "--faces", "200", "--method", method});
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
        const auto measured = tests::results_of_run("mesh-error", {rough, flat});
        const double certified = made["error_of_diagonal"].number();
        const double least = measured["both"]["hausdorff_least"].number();
        CHECK(least > 0.0);
        CHECK(certified >= least);
        CHECK(certified <= 1.3 * measured["both"]["hausdorff_most"].number());
    }
}

TEST_CASE("a goal below what all shells need drops small ones; kept, it is missed with exit 1") {
    const std::string in = cubes(5);
    const std::string out = file_named("fewer.obj");
    const tests::PrintedJson fewer = simplify_figures({in, out, "--faces", "12"});
    CHECK(fewer["faces"] <= 12);
    CHECK(fewer["shells_gone"] == 2);
    CHECK(fewer["error"].number() < 5.5); // without the three smallest: from 2.5 to 8
    for (const std::string option : {"--keep-shells", "--keep-topology"}) {
        const tests::ProgramRun kept = run_octant({"simplify", in, out, "--faces", "12", option, "--json"});
        CHECK(kept.exit_code == 1);
        CHECK_THAT(kept.err, Catch::Contains("no edge can collapse any more"));
        CHECK(tests::PrintedJson(kept.out)["faces"] == 20);
        CHECK(tests::PrintedJson(kept.out)["shells_gone"] == 0);
        CHECK(models::meshfile::read_mesh(out).triangles.size() == 20);
    }
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

TEST_CASE("the error of a mesh far from the origin is kept in the written file, or refused") {
    models::TriangleMesh far = models::meshfile::read_mesh(waves(24));
    for (glm::dvec3& vertex_m : far.vertices_m) { vertex_m += glm::dvec3(523'000.0, 5'200'000.0, 0.0); }
    const std::string in = file_named("far.obj");
    models::meshfile::write_mesh(in, far);
    for (const std::string ending : {".glb", ".gltf", ".ply", ".obj"}) {
        INFO(ending);
        const std::string out = file_named("far-small" + ending);
        const auto found = simplify_figures({in, out, "--error", "0.05", "--method", "fast"});
        CHECK(found["error"] <= 0.05);
        CHECK(found["faces"] < 1152);
        const auto measured = tests::results_of_run("mesh-error", {in, out});
        CHECK(measured["both"]["hausdorff_least_units"] <= 0.05);
    }
    check_simplify_refused(
        {in, file_named("far-small.stl"), "--error", "0.05"}, "expected a format that keeps --error 0.05");
}

TEST_CASE("files simplified together keep their common border to the byte") {
    const models::TriangleMesh both = models::meshfile::read_mesh(waves(24));
    std::vector<std::string> tiles;
    for (const bool is_east : {false, true}) {
        models::TriangleMesh tile = both;
        std::erase_if(tile.triangles, [&](const models::Triangle& triangle) {
            double sum_x = 0.0;
            for (const std::uint32_t vertex : triangle) { sum_x += both.vertices_m[vertex].x; }
            return (sum_x > 3.0 * 12.0) != is_east;
        });
        tiles.push_back(file_named(is_east ? "east.obj" : "west.obj"));
        models::meshfile::write_mesh(tiles.back(), tile);
    }
    const std::string folder = file_named("tiles");
    const auto found = simplify_figures(
        {tiles[0], tiles[1], "--shared-border", "--out-dir", folder, "--faces", "400", "--method", "fast"});
    CHECK(found["faces"] <= 400);
    REQUIRE(found["files"].size() == 2);
    std::vector<std::set<std::string>> borders(2);
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string file = folder + (i == 0 ? "/west.obj" : "/east.obj");
        const models::TriangleMesh tile = models::meshfile::read_mesh(file);
        CHECK(found["files"][i]["faces"] == tile.triangles.size());
        const std::string text = read_file(file);
        for (const std::string_view line : split_lines(text)) {
            const auto words = split_words(line);
            if (words.size() == 4 && words[0] == "v" && words[1] == "12") { borders[i].insert(std::string(line)); }
        }
    }
    CHECK(borders[0].size() >= 2);
    CHECK(borders[0] == borders[1]);
    // Text has a line for each file.
    const std::string lines = run_octant(
        {"simplify", tiles[0], tiles[1], "--shared-border", "--out-dir", folder, "--faces", "300", "--method", "fast"})
                                  .out;
    CHECK_THAT(lines, Catch::Contains("west.obj: ") && Catch::Contains(" faces, error "));
    CHECK(lines.find('{') == lines.npos);
    // Where one cannot be written none is, and nothing is left over.
    const std::string blocked = file_named("blocked");
    std::filesystem::create_directories(blocked + "/east.obj");
    check_simplify_refused(
        {tiles[0], tiles[1], "--shared-border", "--out-dir", blocked, "--faces", "300"}, "east.obj: cannot be written");
    CHECK(std::distance(std::filesystem::directory_iterator(blocked), {}) == 1);
    std::filesystem::remove(blocked + "/east.obj");
    simplify_figures({tiles[0], tiles[1], "--shared-border", "--out-dir", blocked, "--faces", "300"});
    CHECK(std::distance(std::filesystem::directory_iterator(blocked), {}) == 2);
    // Put together again the tiles have no edge inside that lies in one triangle only.
    models::TriangleMesh joined = models::meshfile::read_mesh(folder + "/west.obj");
    models::meshfile::join_mesh(joined, models::meshfile::read_mesh(folder + "/east.obj"), {});
    CHECK(models::repair::repaired(joined).counts.boundary_loops == 1);
}

TEST_CASE("no file of --shared-border is left without triangles") {
    const auto box = [](const std::string& name, double side_m, double x_m) {
        const std::string file = file_named(name);
        std::string text;
        for (int i = 0; i < 8; ++i) {
            text += fmt::format("v {} {} {}\n", x_m + side_m * (i / 4), side_m * (i / 2 % 2), side_m * (i % 2));
        }
        text += "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
        write_file(file, text);
        return file;
    };
    const std::string folder = file_named("boxes");
    const tests::ProgramRun run = run_octant({"simplify", box("large-box.obj", 10.0, 0.0),
        box("small-box.obj", 0.1, 10.2), "--shared-border", "--out-dir", folder, "--faces", "12"});
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.err, Catch::Contains("small-box.obj would be left, so --keep-shells is taken"));
    CHECK_FALSE(models::meshfile::read_mesh(folder + "/small-box.obj").triangles.empty());
}

TEST_CASE("texture coordinates keep their bound at an error as large as the mesh's tube") {
    constexpr std::uint32_t around = 24;
    constexpr std::uint32_t along = 12;
    models::TriangleMesh torus;
    for (std::uint32_t i = 0; i <= around; ++i) {
        for (std::uint32_t j = 0; j <= along; ++j) {
            const double turn = 2.0 * std::acos(-1.0) * (i % around) / around;
            const double tube = 2.0 * std::acos(-1.0) * (j % along) / along;
            const double radius_m = 3.0 + std::cos(tube);
            torus.vertices_m.push_back({radius_m * std::cos(turn), radius_m * std::sin(turn), std::sin(tube)});
            torus.texture_coordinates.emplace_back(1.0 * i / around, 1.0 * j / along);
        }
    }
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < along; ++j) {
            const std::uint32_t at = i * (along + 1) + j;
            torus.triangles.push_back({at, at + along + 1, at + along + 2});
            torus.triangles.push_back({at, at + along + 2, at + 1});
        }
    }
    torus.corner_texture_coordinates = torus.triangles;
    const std::string in = file_named("torus.obj");
    models::meshfile::write_mesh(in, torus);
    // Dividing a mesh so far off ended at 576 triangles whose coordinates were off by 0.7.
    const auto made = simplify_figures(
        {in, file_named("torus-small.obj"), "--error", "10%", "--method", "fast", "--uv-error", "0.05"});
    CHECK(made["uv_error"] <= 0.05);
    CHECK(made["faces"] < 300);
}

TEST_CASE("texture coordinates keep the bound that is asked for") {
    models::TriangleMesh mesh = models::meshfile::read_mesh(waves(24));
    for (const glm::dvec3& at_m : mesh.vertices_m) {
        mesh.texture_coordinates.emplace_back(at_m.x * at_m.x / 576.0, at_m.y / 24.0);
    }
    mesh.corner_texture_coordinates = mesh.triangles;
    const std::string in = file_named("textured.obj");
    models::meshfile::write_mesh(in, mesh);
    const std::string out = file_named("textured-small.glb");
    const auto loose = simplify_figures({in, out, "--error", "0.6", "--method", "fast"});
    CHECK(loose["uv_error"] > 0.01);
    const auto tight = simplify_figures({in, out, "--error", "0.6", "--method", "fast", "--uv-error", "0.005"});
    CHECK(tight["uv_error"] <= 0.005);
    CHECK(tight["error"] <= 0.6);
    CHECK(tight["faces"] > loose["faces"]);
    const models::TriangleMesh written = models::meshfile::read_mesh(out);
    REQUIRE(written.corner_texture_coordinates.size() == written.triangles.size());
    for (std::size_t t = 0; t < written.triangles.size(); ++t) {
        glm::dvec3 middle_m(0.0);
        glm::dvec2 place(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            middle_m += written.vertices_m[written.triangles[t][k]] / 3.0;
            place += glm::dvec2(written.texture_coordinates[written.corner_texture_coordinates[t][k]]) / 3.0;
        }
        // The surface is off by up to 0.6 of 24.
        CHECK(std::abs(place.x - middle_m.x * middle_m.x / 576.0) < 0.005 + 0.05);
        CHECK(std::abs(place.y - middle_m.y / 24.0) < 0.03);
    }
    const auto few = simplify_figures({in, out, "--faces", "300", "--method", "fast", "--uv-error", "0.005"});
    CHECK(few["faces"] <= 300);
    CHECK(few["uv_error"] <= 0.005);
    const tests::ProgramRun unreached =
        run_octant({"simplify", in, out, "--faces", "20", "--method", "fast", "--uv-error", "0.005"});
    CHECK(unreached.exit_code == 1);
    CHECK_THAT(unreached.err, Catch::Contains("found that keep the bounds of attributes: "));
    const tests::ProgramRun run =
        run_octant({"simplify", in, file_named("t.stl"), "--faces", "300", "--method", "fast"});
    CHECK_THAT(run.err, Catch::Contains("the format holds no texture coordinates"));
}

TEST_CASE("a chart of faces against error is one page with a plot and a table") {
    const std::string page = file_named("chart.html");
    const std::string in = waves(16);
    const auto found = simplify_figures({in, "--chart", page, "--method", "fast", "--lock-border"});
    REQUIRE(found["levels"].size() >= 4);
    const std::string html = read_file(page);
    CHECK(html.find("src=") == html.npos);
    CHECK(html.find("<h1>Faces against error of ") != html.npos);
    CHECK(html.find("<h3>Largest distance by the number of faces</h3>") != html.npos);
    CHECK(html.find("\"xlog\":true,\"log\":true") != html.npos);
    // A row gives the command that makes its level, with the options that were used.
    const std::size_t faces = models::meshfile::read_mesh(in).triangles.size() / 2;
    CHECK(html.find(fmt::format("OUT --faces {} --method fast --lock-border</td>", faces)) != html.npos);
    const auto alone = simplify_figures(
        {in, file_named("level.obj"), "--faces", std::to_string(faces), "--method", "fast", "--lock-border"});
    CHECK(found["levels"][1]["faces"] == alone["faces"].number());
    CHECK(found["levels"][1]["error"].number() == Approx(alone["error"].number()).epsilon(0.3));
    write_file(simplify_folder() / "one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    check_simplify_refused({file_named("one.obj"), "--chart", page}, "expected a mesh that can be simplified");
}

TEST_CASE("a chart and a mesh come from one reading of the file") {
    write_file(simplify_folder() / "plate.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0\nv 7 7 7\n"
                                                "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 1 1 2\n");
    const tests::ProgramRun run = run_octant({"simplify", file_named("plate.obj"), file_named("plate-2.obj"), "--faces",
        "2", "--chart", file_named("plate.html")});
    INFO(run.err);
    CHECK(run.exit_code != 2);
    const std::string said = "repaired: 1 triangle without an area taken out";
    CHECK_THAT(run.err, Catch::Contains(said));
    CHECK(run.err.find(said) == run.err.rfind(said));
}

TEST_CASE("the steps that are told for a limited time repeat its result, also of several tries") {
    const std::string in = waves(24);
    const std::string timed = file_named("timed.obj");
    const std::string repeated = file_named("repeated.obj");
    for (const std::vector<std::string>& goal :
        {std::vector<std::string>{"--error", "1%"}, {"--error", "0.5%", "--effort", "5"}, {"--faces", "300"}}) {
        for (const std::string seconds : {"0.001", "0.04"}) {
            INFO(goal[1] << " in " << seconds);
            std::vector<std::string> arguments{in, timed, "--max-seconds", seconds};
            arguments.insert(arguments.end(), goal.begin(), goal.end());
            const auto limited = simplify_figures(arguments);
            arguments[1] = repeated;
            arguments[2] = "--steps";
            arguments[3] = fmt::format("{:.0f}", limited["steps"].number());
            const auto repeat_option = simplify_figures(arguments);
            CHECK(repeat_option["steps"] == limited["steps"].number());
            CHECK(read_file(timed) == read_file(repeated));
        }
    }
}

TEST_CASE("the steps of a wanted error are those of all its tries and repeat its result") {
    const std::string in = waves(24);
    const auto found = simplify_figures({in, file_named("tries.obj"), "--error", "0.3%"});
    const auto fewer = simplify_figures({in, file_named("tries-again.obj"), "--error", "0.3%", "--steps",
        fmt::format("{:.0f}", found["steps"].number())});
    CHECK(read_file(file_named("tries.obj")) == read_file(file_named("tries-again.obj")));
    CHECK(fewer["steps"] == found["steps"].number());
}

TEST_CASE("a note names the options that put a number of faces out of reach") {
    const tests::ProgramRun run = run_octant(
        {"simplify", waves(12), file_named("locked.obj"), "--faces", "20", "--lock-border", "--method", "fast"});
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Catch::Contains("or losing what is held by --lock-border"));
}

TEST_CASE("a mesh too small for squares of its distances is refused") {
    for (const std::string power : {"e-170", "e-310"}) {
        write_file(simplify_folder() / "minute.obj",
            fmt::format("v 0 0 0\nv 1{0} 0 0\nv 0 1{0} 0\nv 1{0} 1{0} 0\nf 1 2 3\nf 2 4 3\n", power));
        for (const char* method : {"surface", "triangle"}) {
            check_simplify_refused({file_named("minute.obj"), file_named("x.obj"), "--faces", "1", "--method", method},
                "expected a bounding box with a diagonal of");
        }
    }
}

TEST_CASE("options that would have no effect or overwrite an input are refused") {
    const std::string in = waves(4);
    const std::string before = read_file(in);
    const std::string out = file_named("unused.obj");
    const std::string page = file_named("unused.html");
    using Words = std::vector<std::string>;
    const std::vector<std::pair<Words, std::string>> cases{{{in, "--chart", in}, "ends in .html"},
        {{in, out, "--faces", "9", "--chart", out}, "ends in .html"},
        {{in, "--chart", page, "--faces", "9"}, "expected no --faces with it"},
        {{in, "--chart", page, "--max-seconds", "1"}, "expected no --max-seconds with it"},
        {{in, out, "--faces", "9", "--max-seconds", "0"}, "--max-seconds"},
        {{in, out, "--faces", "9", "--max-seconds", "1", "--steps", "5"}, "expected no --steps"},
        {{in, out, "--faces", "9", "--effort", "2", "--steps", "5"}, "expected no --steps"},
        {{in, out, "--faces", "9", "--method", "fast", "--effort", "9"}, "expected no --effort"},
        {{in, file_named("u.chain"), "--chain", "--max-seconds", "1"}, "no --max-seconds"},
        {{in, file_named("u.chain"), "--chain", "--attribute-error", "normal=5"}, "no --attribute-error normal"},
        {{in, in, "--shared-border", "--out-dir", "d", "--chart", page, "--faces", "9"},
            "--chart: expected no --shared-border"}};
    for (const auto& [words, expected] : cases) {
        INFO(expected);
        check_simplify_refused(words, expected);
    }
    for (const Words& unused : {Words{"--effort", "9"}, {"--steps", "5"}, {"--keep-shells"}, {"--max-seconds", "3"}}) {
        Words words{in, out, "--faces", "9", "--method", "plane"};
        words.insert(words.end(), unused.begin(), unused.end());
        check_simplify_refused(words, "expected no " + unused.front() + " with it");
    }
    std::filesystem::create_symlink(in, file_named("link.html"));
    check_simplify_refused({in, "--chart", file_named("link.html")}, "another file than");
    CHECK(read_file(in) == before);
    CHECK_FALSE(std::filesystem::exists(page));
    CHECK_FALSE(std::filesystem::exists(out));
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
    const tests::PrintedJson plane = simplify_figures({in, out, "--vertices", "100", "--method", "plane"});
    const tests::PrintedJson both = simplify_figures({in, out, "--vertices", "100", "--method", "bidirectional"});
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
    const auto last_row = [&](const char* error_px) { return flown_frames(chain, "160x90", error_px).back(); };
    const auto near = last_row("0.01");
    CHECK(near.aircraft_level == 0);
    CHECK(near.aircraft_polygons == levels[0]["faces"]);
    const auto far = last_row("100");
    CHECK(far.aircraft_level > 0);
    CHECK(far.aircraft_polygons < near.aircraft_polygons);
}

namespace {

/// The area of the transparent surfaces of a mesh, whose opacity must be 0.4.
double glass_m2(const models::TriangleMesh& mesh) {
    double doubled_m2 = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const models::Material& material = mesh.materials.at(mesh.triangle_materials.at(t));
        if (!models::is_transparent(material)) { continue; }
        CHECK(material.opacity == Approx(0.4F));
        doubled_m2 += glm::length(models::area_vector(mesh, mesh.triangles[t]));
    }
    return 0.5 * doubled_m2;
}

} // namespace

TEST_CASE("glass stays glass in chains, progressive meshes and simplified files of any format, and is told") {
    const std::string in = OCTANT_SOURCE_DIR "/tests/data/aircraft/glass/glassfine.obj";
    const models::TriangleMesh mesh = models::meshfile::read_mesh(in);
    const double whole_m2 = glass_m2(mesh);
    REQUIRE(whole_m2 > 1.0);
    const std::string chain = file_named("glass.chain");
    const tests::PrintedJson made = simplify_figures({in, chain, "--chain"});
    const models::meshfile::LevelChain read = models::meshfile::read_chain(chain);
    REQUIRE(read.levels.size() >= 2);
    CHECK(read.levels.back().mesh.triangles.size() < mesh.triangles.size() / 2);
    for (const models::meshfile::ChainLevel& level : read.levels) {
        CHECK(glass_m2(level.mesh) == Approx(whole_m2).epsilon(0.01));
    }
    const std::string hierarchy = file_named("glass.pm");
    const std::string coarse = file_named("coarse.obj");
    tests::results_of_run("refine", {in, "--base", "100", "--save", hierarchy});
    const tests::PrintedJson coarsest = tests::results_of_run("refine", {hierarchy, "--out", coarse});
    CHECK(coarsest["faces"].number() < static_cast<double>(mesh.triangles.size()) / 2.0);
    CHECK(glass_m2(models::meshfile::read_mesh(coarse)) == Approx(whole_m2).epsilon(0.01));
    std::vector<std::string> files{chain, hierarchy, coarse};
    for (const char* const ending : {".obj", ".gltf", ".glb", ".ac", ".wrl"}) {
        files.push_back(file_named(std::string("glass") + ending));
        simplify_figures({in, files.back(), "--faces", "200"});
        CHECK(glass_m2(models::meshfile::read_mesh(files.back())) == Approx(whole_m2).epsilon(0.01));
    }
    for (const std::string& file : files) {
        const tests::ProgramRun told = run_octant({"model", "info", file});
        INFO(file << told.err);
        CHECK(told.exit_code == 0);
        CHECK(told.out.find("opacity 0.40") != std::string::npos);
    }
}

TEST_CASE("simplify refuses wrong input in one line with exit code 2") {
    const std::string in = waves(4);
    check_simplify_refused({in, in, "--faces", "10"}, "another file than the input");
    check_simplify_refused({in, file_named("x.xyz"), "--faces", "10"}, "expected a name that ends in");
    check_simplify_refused({in, "--faces", "10"}, "expected IN and OUT, got 1 files");
    check_simplify_refused({in, "--shared-border", "--faces", "10"}, "two meshes or more");
    check_simplify_refused({in, file_named("x.obj"), "--out-dir", "d", "--faces", "10"}, "--shared-border with it");
    check_simplify_refused({in, file_named("x.obj"), "--uv-error", "0.1", "--method", "plane", "--faces", "10"},
        "--method plane: expected no --uv-error with it");
    check_simplify_refused({in, file_named("x.obj")}, "expected one of --vertices, --faces and --error");
    check_simplify_refused({in, file_named("x.obj"), "--error", "-1"}, "--error: expected a number above 0");
    check_simplify_refused({in, file_named("none/x.obj"), "--faces", "10"}, "none/x.obj: cannot be written");
    check_simplify_refused({in, file_named("x.obj"), "--chain"}, "ends in .chain");
    check_simplify_refused({in, file_named("x.chain"), "--chain", "--method", "plane"}, "--method plane: expected");
    check_simplify_refused({file_named("absent.obj"), file_named("x.obj"), "--faces", "3"}, "absent.obj");
    write_file(simplify_folder() / "bad.obj", "v 0 0 0\nv 1 0 x\n");
    check_simplify_refused({file_named("bad.obj"), file_named("x.obj"), "--faces", "3"}, "bad.obj:2:");
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
