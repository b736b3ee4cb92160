#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <string>

using namespace octant;
using octant::tests::run_octant;

namespace {

std::filesystem::path order_cache_folder() {
    static const auto made = tests::empty_folder("draw-order");
    return made;
}

std::string order_file(const std::string& name) { return (order_cache_folder() / name).string(); }

tests::ProgramRun draw_order(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "draw-order");
    return run_octant(arguments);
}

tests::PrintedJson order_figures(const tests::ProgramRun& run) {
    INFO(run.err);
    return tests::PrintedJson(run.out);
}

/// Two rectangles that pass through one another, each with a back.
constexpr std::string_view crossing_plates = R"(v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
v -0.5 0 -1
v 0.5 0 -1
v 0.5 0.1 1
v -0.5 0.1 1
f 1 2 3 4
f 4 3 2 1
f 5 6 7 8
f 8 7 6 5
)";

} // namespace

TEST_CASE("the paper's table comes out in the paper's form and axes") {
    const auto run = draw_order({"concave", "--method", "paper", "--table"});
    CHECK(run.exit_code == 0);
    CHECK(tests::lines_in(run.out) == 8);
    CHECK(run.out.starts_with("+++\tP1, "));
    CHECK(run.out.find("\n+--\tP2, ") != std::string::npos);
}

TEST_CASE("the tree orders both aircraft for every eye, and the check agrees") {
    for (const char* name : {"f15", "500md"}) {
        const auto run = draw_order({name, "--check", "--rays", "20000", "--json", "--quiet"});
        CHECK(run.exit_code == 0);
        CHECK(run.err.empty());
        const auto result = order_figures(run);
        CHECK(result["right"] == true);
        CHECK(result["pairs"] > 1000);
        CHECK(result["pairs_not_certified"] == 0);
        CHECK(result["unlisted_not_certified"] == 0);
        CHECK(result["rays_wrong"] == 0);
        CHECK(result["eyes_without_cell"] == 0);
        CHECK(result["rays_that_hit"] > 1000);
    }
}

TEST_CASE("a check that says no ends with exit code 1 and names the polygons") {
    const auto run = draw_order({"f15", "--method", "paper", "--check", "--quiet"});
    CHECK(run.exit_code == 1);
    CHECK(run.err.empty());
    CHECK(run.out.find(" is painted before P") != std::string::npos);
}

TEST_CASE("exported orders and the exported model pass the check, split polygons too") {
    write_file(order_file("plates.obj"), crossing_plates);
    for (const char* axes : {"right,up,back", "forward,left,up"}) {
        for (const char* method : {"cells", "exact"}) {
            const auto out = draw_order({order_file("plates.obj"), "--axes", axes, "--method", method, "--export",
                order_file("orders.txt"), "--export-model", order_file("split.obj"), "--json"});
            CHECK(out.exit_code == 0);
            CHECK(order_figures(out)["splits"] > 0);
            CHECK(read_file(order_file("orders.txt")).find("\nparents 0 1 2 3 ") != std::string::npos);
            const auto check =
                draw_order({order_file("split.obj"), "--axes", axes, "--check", order_file("orders.txt"), "--json"});
            CHECK(check.exit_code == 0);
            CHECK(order_figures(check)["right"] == true);
            CHECK(draw_order({order_file("plates.obj"), "--check", order_file("orders.txt")}).exit_code == 2);
        }
    }
}

TEST_CASE("an order of another model's, or with two polygons exchanged, does not pass") {
    const auto out = draw_order({"concave", "--method", "paper", "--export", order_file("table.txt")});
    CHECK(out.exit_code == 0);
    CHECK(draw_order({"concave", "--check", order_file("table.txt")}).exit_code == 0);
    std::string text = read_file(order_file("table.txt"));
    const std::size_t at = text.find("order 1 5"); // +-+: P2 must come before P6
    REQUIRE(at != std::string::npos);
    write_file(order_file("swapped.txt"), text.replace(at, 9, "order 5 1"));
    const auto run = draw_order({"concave", "--check", order_file("swapped.txt"), "--rays", "0"});
    CHECK(run.exit_code == 1);
    CHECK(run.out.find("P6 is painted before P2 and may hide part of it") != std::string::npos);
    CHECK(draw_order({"concave", "--check", order_file("swapped.txt")}).exit_code == 1);
}

TEST_CASE("a certificate is checked by octant-verify, under its old name too, and a changed one is refused") {
    const std::string proof = order_file("proof.txt");
    CHECK(draw_order({"concave", "--certificate", proof, "--quiet"}).exit_code == 0);
    const auto run = run_octant({"verify", proof, "--json"});
    CHECK(run.exit_code == 0);
    CHECK(order_figures(run)["proved"] == true);
    CHECK(order_figures(run)["pairs"] > 0);
    const auto by_old_name = draw_order({"--verify", proof, "--json"});
    CHECK(by_old_name.exit_code == 0);
    CHECK(by_old_name.out == run.out);
    CHECK(by_old_name.err.find("octant verify") != std::string::npos);
    std::string text = read_file(proof);
    text.erase(text.rfind("\npairs ") + 1);
    write_file(proof, text);
    CHECK(run_octant({"verify", proof}).exit_code == 1);
    CHECK(run_octant({"verify", "/nowhere/proof.txt"}).exit_code == 2);
    write_file(order_file("triangle.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto swapped = run_octant({"verify", order_file("triangle.obj"), proof});
    CHECK(swapped.exit_code == 2);
    CHECK(swapped.err.find("triangle.obj:1: expected 'octant-certificate 2' first, got ") != std::string::npos);
    CHECK(run_octant({"verify"}).exit_code == 2);
}

TEST_CASE("a certificate is bound to its model: another one is refused in one line") {
    const std::string proof = order_file("bound.txt");
    CHECK(draw_order({"concave", "--certificate", proof, "--quiet"}).exit_code == 0);
    CHECK(run_octant({"verify", proof, "concave"}).exit_code == 0);
    const auto other = run_octant({"verify", proof, "f15"});
    CHECK(other.exit_code == 2);
    CHECK(other.out.empty());
    CHECK(tests::lines_in(other.err) == 1);
    CHECK(other.err.find("expected a certificate of f15, whose polygons have the hash") != std::string::npos);
    write_file(order_file("old.txt"), "octant-certificate 1\ntolerance 1\n");
    const auto old = run_octant({"verify", order_file("old.txt")});
    CHECK(old.exit_code == 2);
    CHECK(old.err.find("old.txt:1: expected version 2 of the format") != std::string::npos);
}

TEST_CASE("models of other formats than OBJ have proved orders, glass included") {
    const std::string folder = OCTANT_SOURCE_DIR "/tests/data/aircraft/";
    for (const std::string name : {"glass/canfirst.ac", "glass/glass.obj", "nose+y.glb", "fbx_cm.fbx", "dae_cm.dae"}) {
        INFO(name);
        const std::string proof = order_file("format.txt");
        const auto run = draw_order({folder + name, "--certificate", proof, "--rays", "4000", "--json", "--quiet"});
        CHECK(run.exit_code == 0);
        CHECK(order_figures(run)["certificate_unproved"] == 0);
        CHECK(order_figures(run)["rays_wrong"] == 0);
        CHECK(run_octant({"verify", proof, folder + name}).exit_code == 0);
    }
}

TEST_CASE("polygons that intersect themselves are cut with a note, and ordered") {
    write_file(order_file("bow.obj"), "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nv 0 0 1\nv 1 0 1\nv 0 1 1.5\nv 1 1 0\n"
                                      "f 1 2 3 4\nf 5 6 8 7\n");
    const std::string proof = order_file("bow.txt");
    const auto run = draw_order({order_file("bow.obj"), "--certificate", proof});
    CHECK(run.exit_code == 0);
    CHECK(run.err.find("polygon of 4 corners") != std::string::npos);
    CHECK(run_octant({"verify", proof, order_file("bow.obj")}).exit_code == 0);
}

TEST_CASE("the certificate of a soup of triangles stays small") {
    const std::string soup = OCTANT_SOURCE_DIR "/tests/data/aircraft/orders/s7-x-soup60.obj";
    const std::string proof = order_file("soup.txt");
    CHECK(draw_order({soup, "--certificate", proof, "--quiet"}).exit_code == 0);
    CHECK(std::filesystem::file_size(proof) < 100U * 5378U); // so many pairs overlap from some eye
    CHECK(run_octant({"verify", proof}).exit_code == 0);
}

TEST_CASE("a program that octant starts is looked for beside it and in PATH") {
    const auto folder = tests::empty_folder("other-programs");
    const std::string octant = (folder / "octant").string();
    std::filesystem::copy_file(OCTANT_PROGRAM, octant);
    const auto code_of = [&](const std::string& line) { return std::system(line.c_str()) / 256; };
    const std::string message = (folder / "message").string();
    CHECK(code_of(octant + " verify x 2>" + message) == 2);
    CHECK(read_file(message) ==
          "octant: expected the program octant-verify in the folder of this one or in PATH, got none\n");
    write_file(folder / "octant-hello", "#!/bin/sh\necho \"$@\"\nexit 7\n");
    CHECK(code_of(octant + " hello you 2>" + message) == 2);
    std::filesystem::permissions(folder / "octant-hello", std::filesystem::perms::owner_all);
    CHECK(code_of(octant + " hello you >" + message) == 7);
    CHECK(read_file(message) == "you\n");
    CHECK(code_of("PATH=" + (std::filesystem::path(OCTANT_PROGRAM).parent_path()).string() + ":$PATH " + octant +
                  " verify --version >" + message) == 0);
}

TEST_CASE("rays alone find the file order of a missing cell") {
    write_file(order_file("half.txt"), "draworder 1\nfaces 10\ncell half 1 0 1 0 0 order 0\n");
    const auto run = draw_order({"concave", "--check", order_file("half.txt"), "--json"});
    CHECK(run.exit_code == 1);
    const auto result = order_figures(run);
    CHECK(result["eyes_without_cell"] > 100);
    CHECK(result["unlisted_not_certified"] > 0);
}

TEST_CASE("draw-order refuses wrong input in one line with exit code 2") {
    tests::check_refusals("draw-order",
        {{"", "model"},
            {"f16", "model: expected f15, 500md, f15-detailed, 500md-detailed, concave, torus or a file, got 'f16'"},
            {"/nowhere/a.obj", "/nowhere/a.obj: expected a file, found none"}});
    write_file(order_file("empty.obj"), "");
    tests::check_refusals("draw-order",
        {{order_file("empty.obj"), "empty.obj"}, {"f15 --method magic", "--method: expected one of paper, exact"},
            {"f15 --min-distance nan", "--min-distance"}, {"f15 --rays -1", "--rays"},
            {"f15 --export /nowhere/x.txt", "/nowhere/x.txt"},
            {"f15 --export-model " + order_file("x.txt"), "ends in .obj"},
            {"f15 --export " + order_file("x.obj") + " --export-model " + order_file("x.obj"),
                "expected another file than --export-model"}});
    CHECK_FALSE(std::filesystem::exists(order_cache_folder() / "x.obj"));
    tests::check_refusals("draw-order", {{"f15 --check /nowhere/x.txt", "/nowhere/x.txt: expected a file"}});
    write_file(order_file("wrong.txt"), "draworder 1\nfaces 43\ncell ++- order 0 43\n");
    tests::check_refusals("draw-order", {{"f15 --check " + order_file("wrong.txt"),
                                            "wrong.txt:3: expected a polygon of the model (0 to 42), got '43'"}});
    write_file(order_file("plates.obj"), crossing_plates);
    tests::check_refusals("draw-order", {{order_file("plates.obj") + " --axes up,up,up", "axes: expected"},
                                            {order_file("plates.obj") + " --export-model " + order_file("plates.obj"),
                                                "expected another file than the model"}});
    CHECK_FALSE(std::filesystem::exists(order_cache_folder() / "x.txt"));
}

TEST_CASE("the study of draw orders writes its tables") {
    const auto run = run_octant({"study", "draw-order", "--out", order_file("study"), "--json", "--quiet"});
    CHECK(run.exit_code == 0);
    const auto tables = tests::PrintedJson(run.out);
    REQUIRE(tables.size() == 5);
    CHECK(tables[0]["rows"].size() == 2);
    REQUIRE(tables[1]["rows"].size() == 8);
    for (const auto& row : tables[1]["rows"].elements()) {
        CHECK(row["same polygons"] == "yes");
        CHECK(row["ours keeps them"] == "yes");
    }
    for (const auto& row : tables[2]["rows"].elements()) {
        CHECK((row["method"] == "paper" || row["pairs not certified"] == 0));
    }
    for (const auto& row : tables[3]["rows"].elements()) {
        CHECK(row["tree"] == 0);
        CHECK((row["eyes"] != "2 to 20 R" || row["cells"] == 0));
        CHECK(row["back faces removed only"] > 0.1);
    }
    for (const char* name : {"table-1.csv", "table-4.csv", "methods.csv", "wrong-pixels.csv", "bsp.csv"}) {
        CHECK(std::filesystem::exists(order_cache_folder() / "study" / name));
    }
    CHECK(run_octant({"study", "draw-order", "--out", "/proc/x"}).exit_code == 2);
}
