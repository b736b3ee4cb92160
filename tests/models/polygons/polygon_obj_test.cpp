#include "sim/base/output_file.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fmt/format.h>

#include "obj_texts.h"

using namespace octant::models;
using namespace octant::models::polygons;
using namespace octant::models::polygons::test;

TEST_CASE("a square is read with its corners, in body axes") {
    const PolygonModel model = model_of(square + "f 1 2 3 4\n");
    CHECK(model.name == "m");
    REQUIRE(model.vertices_m.size() == 4);
    CHECK(model.vertices_m[1] == glm::dvec3(0, 1, 0));
    CHECK(model.vertices_m[2] == glm::dvec3(0, 1, -1));
    REQUIRE(model.polygons.size() == 1);
    CHECK(corners(model, 0) == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(model.parts == std::vector<std::string>{"default"});
    REQUIRE(model.materials.size() == 1);
    CHECK(model.materials[0].name == "default");
    // Seen from behind (+z in the file): the normal points back.
    CHECK(normal_of(model, 0) == glm::dvec3(-1, 0, 0));
}

TEST_CASE("all forms of a corner name the same vertex") {
    for (const char* face : {"f 1/1 2/1 3/1 4/1", "f 1//7 2//7 3//7 4//7", "f 1/1/1 2/2/1 3/3/1 4/4/1", "f -4 -3 -2 -1",
             "f\t-4//1   2 3/9  -1 \r"}) {
        CHECK(corners(model_of(square + face + "\n"), 0) == std::vector<std::uint32_t>{0, 1, 2, 3});
    }
}

TEST_CASE("negative indices count back from the vertex read last") {
    const PolygonModel model = model_of(square + "f -4 -3 -2\nv 0 0 1\nv 1 0 1\nv 1 1 1\nf -3 -2 -1\n");
    CHECK(corners(model, 0) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(corners(model, 1) == std::vector<std::uint32_t>{4, 5, 6});
}

TEST_CASE("other OBJ lines, comments and numbers after the coordinates are ignored") {
    const PolygonModel model =
        model_of("# made by hand\n\no thing\ns off\nvt 0 0\nvn 0 0 1\nvp 1 2\n"
                 "v 0 0 0 1\nv +1 0 0 0.5 0.5 0.5\nv 1e0 1 0\nl 1 2\np 1\nf 1 2 3\n# pivot points: none\n");
    CHECK(model.vertices_m.size() == 3);
    CHECK(model.parts == std::vector<std::string>{"thing"});
    CHECK(model.pivots.empty());
}

TEST_CASE("parts and materials come in the order of their first polygon") {
    octant::write_file(scratch("two colours.mtl"),
        "# c\nnewmtl red paint\nNs 10\nKd 1 0.25 0\nnewmtl unused\nKd 0 0 0\nnewmtl plain\n");
    const PolygonModel model =
        model_of("mtllib two colours.mtl\n" + square +
                 "g empty\ng wing left\nusemtl plain\nf 1 2 3\ng body\nusemtl red paint\nf 1 2 3 4\n"
                 "g wing left\nf 2 3 4\ng\nf 1 2 4\n");
    CHECK(model.parts == std::vector<std::string>{"wing left", "body", "default"});
    REQUIRE(model.materials.size() == 2);
    CHECK(model.materials[0].name == "plain");
    CHECK(model.materials[0].colour == glm::vec3(0.7F));
    CHECK(model.materials[1].colour == glm::vec3(1.0F, 0.25F, 0.0F));
    CHECK(model.polygons[0].part == 0);
    CHECK(model.polygons[1].part == 1);
    CHECK(model.polygons[2].part == 0);
    CHECK(model.polygons[2].material == 1);
    CHECK(model.polygons[3].part == 2);
}

TEST_CASE("without a material file the names are kept in the default colour") {
    const PolygonModel model = model_of(square + "usemtl glass\nf 1 2 3\n");
    REQUIRE(model.materials.size() == 1);
    CHECK(model.materials[0].name == "glass");
    CHECK(model.materials[0].colour == glm::vec3(0.7F));
}

TEST_CASE("materials with Fresnel's reflection are mirrors, those of other models of light are not") {
    octant::write_file(scratch("mirrors.mtl"), "newmtl pane\nillum 5\nnewmtl clear\nd 0.5\nillum 7\n"
                                               "newmtl paint\nillum 2\nnewmtl plain\nKd 1 1 1\n");
    const std::vector<Material> materials = read_mtl(scratch("mirrors.mtl")).materials;
    REQUIRE(materials.size() == 4);
    CHECK(materials[0].is_mirror);
    CHECK(materials[1].is_mirror);
    CHECK_FALSE(materials[2].is_mirror);
    CHECK_FALSE(materials[3].is_mirror);
    CHECK(is_glass(materials[0]));
    CHECK_FALSE(is_transparent(materials[0]));
    CHECK_FALSE(is_glass(materials[2]));
}

TEST_CASE("a line that ends in a backslash goes on in the next one") {
    const PolygonModel model = model_of("v 0 \\\n0 0\nv 1 0 0\nv 1 1 0\\\r\nv 0 1 0\nf 1\\\n\\\n2 3\nf 3 2 1\\");
    CHECK(model.vertices_m.size() == 3); // what follows three coordinates is ignored
    REQUIRE(model.polygons.size() == 2);
    CHECK(corners(model, 0) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(corners(model, 1) == std::vector<std::uint32_t>{2, 1, 0});
}

TEST_CASE("a comment that ends in a backslash hides no line") {
    CHECK(model_of("# C:\\models\\\n" + square + "f 1 2 3\n").vertices_m.size() == 4);
}

TEST_CASE("a byte order mark is skipped in both files") {
    octant::write_file(scratch("marked.mtl"), "\xef\xbb\xbfnewmtl red\nKd 1 0 0\n");
    const PolygonModel model = model_of("\xef\xbb\xbfmtllib marked.mtl\n" + square + "usemtl red\nf 1 2 3\n");
    CHECK(model.materials[0].colour == glm::vec3(1, 0, 0));
    CHECK(message("\xef\xbb\xbfv 0 0\n") == "m.obj:1: expected three coordinates, got 2");
}

TEST_CASE("the other keywords of the specification are ignored") {
    for (const char* keyword : {"mg", "bevel", "c_interp", "d_interp", "lod", "maplib", "usemap", "shadow_obj",
             "trace_obj", "ctech", "stech", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim",
             "hole", "scrv", "sp", "end", "con", "call", "csh"}) {
        CHECK(message(fmt::format("{} 1 x\n{}f 1 2 3\n", keyword, square)) == "accepted");
    }
}

TEST_CASE("mtllib reads several files, but one whose name has blanks goes first") {
    octant::write_file(scratch("first.mtl"), "newmtl red\nKd 1 0 0\n");
    octant::write_file(scratch("second.mtl"), "newmtl blue\nKd 0 0 1\n");
    const std::string text = "mtllib first.mtl second.mtl\n" + square + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4\n";
    const PolygonModel model = model_of(text);
    CHECK(model.materials[0].colour == glm::vec3(1, 0, 0));
    CHECK(model.materials[1].colour == glm::vec3(0, 0, 1));
    CHECK(model.notes.empty());
    CHECK(
        message(text + "usemtl green\nf 1 3 4\n") == "m.obj:10: expected a material of the material file, got 'green'");
    octant::write_file(scratch("first.mtl second.mtl"), "newmtl red\nKd 0 1 0\nnewmtl blue\nKd 1 1 0\n");
    CHECK(model_of(text).materials[0].colour == glm::vec3(0, 1, 0));
    std::filesystem::remove(scratch("first.mtl second.mtl"));
}

TEST_CASE("a missing material file leaves its materials grey, and the model says so") {
    octant::write_file(scratch("there.mtl"), "newmtl red\nKd 1 0 0\n");
    const std::string faces = square + "usemtl red\nf 1 2 3\nusemtl other\nf 1 3 4\n";
    const auto note = [](const std::string& name) {
        return scratch("m.obj").string() + ":2: material file " + name + " is missing, its materials are drawn grey";
    };
    const PolygonModel model = model_of("\nmtllib gone.mtl there.mtl\nmtllib gone.mtl\n" + faces);
    REQUIRE(model.materials.size() == 2);
    CHECK(model.materials[0].colour == glm::vec3(1, 0, 0));
    CHECK(model.materials[1].name == "other");
    CHECK(model.materials[1].colour == glm::vec3(0.7F));
    CHECK(model.notes == std::vector<std::string>{note("gone.mtl")});
    const PolygonModel grey = model_of("\nmtllib gone paints.mtl\n" + faces);
    CHECK(grey.materials[0].colour == glm::vec3(0.7F));
    CHECK(grey.notes == std::vector<std::string>{note("gone paints.mtl")});
}

TEST_CASE("a pivot comment says about which axis a part turns, in body axes") {
    const PolygonModel model = model_of("# pivot rotor 0.5 2 -1 axis 0 2 0\n" + square + "f 1 2 3\ng rotor\nf 1 3 4\n");
    REQUIRE(model.pivots.size() == 1);
    CHECK(model.pivots[0].part == 1);
    CHECK(model.pivots[0].point_m == glm::dvec3(1, 0.5, -2));
    CHECK(model.pivots[0].axis == glm::dvec3(0, 0, -1));
    CHECK(model.pivots[0].turns_per_s == 0.0);
}

TEST_CASE("a pivot comment may say how many turns a minute the part makes in flight") {
    const auto rate = [](const std::string& rpm) {
        const std::string pivot = "# pivot rotor 0 0 0 axis 0 1 0 rpm " + rpm + "\n";
        return model_of(pivot + square + "g rotor\nf 1 3 4\n").pivots[0].turns_per_s;
    };
    CHECK(rate("492") == 8.2);
    CHECK(rate("-30") == -0.5);
}

TEST_CASE("statements that the specification calls superseded are ignored with one note each") {
    const PolygonModel model = model_of("res 4 5\nbsp 1 2 3\nbsp 4\nbzp 1\ncdc 1\ncdp 1\n" + square + "f 1 2 3\n");
    const std::vector<std::string> notes = notes_of(model);
    REQUIRE(notes.size() == 5);
    CHECK(notes[0] == "m.obj:1: res is an old OBJ statement, ignored");
    CHECK(notes[1] == "m.obj:2: bsp is an old OBJ statement, ignored");
    CHECK(notes[4] == "m.obj:6: cdp is an old OBJ statement, ignored");
}

TEST_CASE("other file axes give the same body") {
    const PolygonModel model = model_of("v 3 1 2\nv 4 1 2\nv 3 2 2\nf 1 2 3\n", FileAxes::from_text("forward,left,up"));
    CHECK(model.vertices_m[0] == glm::dvec3(3, -1, -2));
    CHECK(normal_of(model, 0) == glm::dvec3(0, 0, -1));
}
