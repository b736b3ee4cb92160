#include "models/meshfile/mesh_file.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using namespace octant;
using octant::tests::run_octant;

namespace {

using Faces = std::vector<std::array<int, 3>>;

std::filesystem::path refine_folder() {
    static const auto made = tests::empty_folder("refine");
    return made;
}

std::string refine_file(const std::string& name) { return (refine_folder() / name).string(); }

/// A wavy sheet of 30 x 30 vertices as an OBJ file, with its faces from 0.
Faces write_sheet(const std::string& path) {
    constexpr int size = 30;
    std::string text;
    Faces faces;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            text += fmt::format("v {} {} {:.4f}\n", x, y, std::sin(0.4 * x) * std::cos(0.3 * y));
        }
    }
    for (int y = 0; y + 1 < size; ++y) {
        for (int x = 0; x + 1 < size; ++x) {
            const int at = y * size + x;
            faces.push_back({at, at + 1, at + size + 1});
            faces.push_back({at, at + size + 1, at + size});
        }
    }
    for (const auto& [a, b, c] : faces) { text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1); }
    write_file(path, text);
    return faces;
}

std::array<int, 3> turned(std::array<int, 3> face) {
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
    return face;
}

Faces sorted(Faces faces) {
    std::ranges::transform(faces, faces.begin(), turned);
    std::ranges::sort(faces);
    return faces;
}

Faces faces_of_obj(const std::string& path) {
    const std::string text = read_file(path);
    Faces faces;
    for (const std::string_view line : split_lines(text)) {
        const auto words = split_words(line);
        if (!words.empty() && words[0] == "f") {
            std::array<int, 3> face{};
            for (std::size_t k = 0; k < 3; ++k) { face[k] = std::stoi(std::string(words[k + 1])) - 1; }
            faces.push_back(face);
        }
    }
    return sorted(faces);
}

/// Original faces with three different active ancestors, by the list of active nodes alone.
Faces expected_faces(const Faces& originals, const std::string& nodes_file) {
    std::vector<int> vertex_of(900, -1);
    const std::string text = read_file(nodes_file);
    int vertex = 0;
    for (const std::string_view line : split_lines(text)) {
        if (line.empty() || line[0] == '#') { continue; }
        const auto words = split_words(line);
        for (std::size_t k = 1; k < words.size(); ++k) { vertex_of[std::stoul(std::string(words[k]))] = vertex; }
        ++vertex;
    }
    Faces faces;
    for (const auto& [a, b, c] : originals) {
        const std::array<int, 3> face{vertex_of[static_cast<std::size_t>(a)], vertex_of[static_cast<std::size_t>(b)],
            vertex_of[static_cast<std::size_t>(c)]};
        if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) { faces.push_back(face); }
    }
    return sorted(faces);
}

tests::PrintedJson refine(const std::vector<std::string>& arguments) {
    return tests::results_of_run("refine", arguments);
}

} // namespace

TEST_CASE("a saved progressive mesh refined everywhere is the original, face for face") {
    const Faces originals = write_sheet(refine_file("sheet.obj"));
    const auto made = refine({refine_file("sheet.obj"), "--base", "50", "--save", refine_file("sheet.pm")});
    CHECK(made["original_vertices"] == 900);
    CHECK(made["base_vertices"] == 50);
    CHECK(made["vertices"] == 50);
    const auto full = refine(
        {refine_file("sheet.pm"), "--region", "sphere", "15", "15", "0", "100", "--out", refine_file("full.obj")});
    CHECK(full["vertices"] == 900);
    CHECK(full["requested_splits"] == 850);
    CHECK(full["forced_by_rule"] == 0);
    CHECK(faces_of_obj(refine_file("full.obj")) == sorted(originals));
    CHECK(models::meshfile::read_mesh(refine_file("full.obj")).colours.empty()); // as the original
    const auto coarse = refine({refine_file("sheet.pm"), "--vertices", "300"});
    CHECK(coarse["original_vertices"] == 300);
}

TEST_CASE("model info tells that a progressive mesh was cut off") {
    write_sheet(refine_file("sheet.obj"));
    refine({refine_file("sheet.obj"), "--base", "50", "--save", refine_file("cut.pm")});
    std::filesystem::resize_file(refine_file("cut.pm"), std::filesystem::file_size(refine_file("cut.pm")) / 2);
    const tests::ProgramRun info = run_octant({"model", "info", refine_file("cut.pm")});
    CHECK(info.exit_code == 0);
    CHECK_THAT(info.out + info.err, Catch::Contains("cut.pm: cut off at byte "));
}

TEST_CASE("any active mesh is what the original file and the list of nodes say") {
    const Faces originals = write_sheet(refine_file("sheet.obj"));
    std::vector<double> vertices;
    for (const char* rule : {"selective", "hoppe", "xia"}) {
        const auto results = refine({refine_file("sheet.obj"), "--base", "50", "--rule", rule, "--region", "sphere",
            "5", "5", "0", "4", "--region", "sphere", "20", "-1.5", "0", "6", "--out", refine_file("part.obj"),
            "--nodes", refine_file("part.txt")});
        CHECK(results["turned_faces"] == 0);
        CHECK(faces_of_obj(refine_file("part.obj")) == expected_faces(originals, refine_file("part.txt")));
        vertices.push_back(results["vertices"].number());
    }
    CHECK(vertices[0] < vertices[1]);
    CHECK(vertices[1] < vertices[2]);
    CHECK(vertices[2] <= 900);
}

TEST_CASE("a view refines what it sees, and the same input gives the same bytes") {
    write_sheet(refine_file("sheet.obj"));
    const std::vector<std::string> arguments = {
        refine_file("sheet.obj"), "--base", "50", "--error-px", "2", "--eye", "-5,-5,6", "--look", "10,10,0"};
    auto first = arguments;
    first.insert(first.end(), {"--out", refine_file("one.ply")});
    auto second = arguments;
    second.insert(second.end(), {"--out", refine_file("two.ply")});
    const auto results = refine(first);
    CHECK(results["vertices"] > 60);
    CHECK(results["vertices"] < 900);
    refine(second);
    CHECK(read_file(refine_file("one.ply")) == read_file(refine_file("two.ply")));
}

TEST_CASE("the partition is the original mesh with as many colours as there are active vertices") {
    const Faces originals = write_sheet(refine_file("sheet.obj"));
    refine({refine_file("sheet.obj"), "--base", "20", "--out-partition", refine_file("partition.obj"), "--colour-by",
        "region", "--out", refine_file("base.obj")});
    CHECK(faces_of_obj(refine_file("partition.obj")) == sorted(originals));
    const auto colours = [](const std::string& name) {
        const std::string text = read_file(name);
        std::set<std::string> found;
        for (const std::string_view line : split_lines(text)) {
            const auto words = split_words(line);
            if (words.size() == 7 && words[0] == "v") {
                found.insert(fmt::format("{} {} {}", words[4], words[5], words[6]));
            }
        }
        return found;
    };
    CHECK(colours(refine_file("base.obj")).size() == 20);
    CHECK(colours(refine_file("partition.obj")) == colours(refine_file("base.obj")));
}

TEST_CASE("refine refuses wrong input in one line with exit code 2") {
    write_sheet(refine_file("sheet.obj"));
    tests::check_refusals("refine",
        {{"/nowhere/a.obj", "/nowhere/a.obj"}, {"/nowhere/a.pm", "/nowhere/a.pm: expected a file, found none"}});
    write_file(refine_file("bad.pm"), "nothing");
    tests::check_refusals("refine",
        {{refine_file("bad.pm"), "bad.pm: at byte 0: expected a progressive mesh"},
            {refine_file("sheet.obj") + " --rule magic", "--rule"},
            {refine_file("sheet.obj") + " --region box 0 0 0 1", "expected sphere"},
            {refine_file("sheet.obj") + " --region sphere nan 0 0 1", "--region"},
            {refine_file("sheet.obj") + " --error-px 1", "--eye"},
            {refine_file("sheet.obj") + " --error-px 1 --eye 0,0 --look 0,0,0", "--eye: expected X,Y,Z, got '0,0'"},
            {refine_file("sheet.obj") + " --save " + refine_file("x.obj"), "ends in .pm"},
            {refine_file("sheet.obj") + " --out " + refine_file("x.txt"), "--out: expected a mesh file"},
            {refine_file("sheet.obj") + " --save /nowhere/x.pm --quiet", "/nowhere/x.pm"}});
}

TEST_CASE("the study of refinement writes its tables") {
    write_sheet(refine_file("sheet.obj"));
    const auto run = run_octant({"study", "refinement", "--out", refine_file("study"), "--frames", "40", "--mesh",
        refine_file("sheet.obj"), "--base", "200", "--json", "--quiet"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const auto tables = tests::PrintedJson(run.out);
    REQUIRE(tables.size() == 3);
    CHECK(tables[0]["rows"].size() == 5);
    for (const auto& row : tables[0]["rows"].elements()) {
        CHECK(row["after repair (faces)"] == 0);
        CHECK(row["selective"] <= row["Hoppe 1997"]);
    }
    for (const char* name : {"forced-splits.csv", "refinement-path.csv", "refinement-speed.csv", "refinement.md",
             "refinement-original.png", "refinement-base.png", "refinement-partition.png", "refinement-region.png"}) {
        CHECK(std::filesystem::exists(refine_folder() / "study" / name));
    }
}
