#include "models/made_up.h"
#include "models/obj_reader.h"
#include "models/obj_writer.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fmt/format.h>

using namespace octant::models;

namespace {

std::filesystem::path scratch(const std::string& name) {
    return octant::tests::scratch_folder() / name;
}

PolygonModel model_of(const std::string& text, const FileAxes& axes = {}) {
    octant::write_file(scratch("m.obj"), text);
    return read_obj(scratch("m.obj"), axes);
}

/// What read_obj says about a text, without the folder before the file's name.
std::string message(const std::string& text) {
    try {
        model_of(text);
    } catch (const octant::Error& error) {
        const std::string folder = scratch("").string();
        const std::string what = error.what();
        return what.find(folder) == 0 ? what.substr(folder.size()) : what;
    }
    return "accepted";
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::vector<std::uint32_t> corners(const PolygonModel& model, std::size_t polygon) {
    const auto span = model.corners(polygon);
    return {span.begin(), span.end()};
}

void check_same(const PolygonModel& a, const PolygonModel& b) {
    CHECK(a.vertices_m == b.vertices_m);
    CHECK(a.corner_vertices == b.corner_vertices);
    REQUIRE(a.polygons.size() == b.polygons.size());
    for (std::size_t i = 0; i < a.polygons.size(); ++i) {
        CHECK(a.polygons[i].first_corner == b.polygons[i].first_corner);
        CHECK(a.polygons[i].corner_count == b.polygons[i].corner_count);
        CHECK(a.polygons[i].material == b.polygons[i].material);
        CHECK(a.polygons[i].part == b.polygons[i].part);
    }
    CHECK(a.parts == b.parts);
    REQUIRE(a.materials.size() == b.materials.size());
    for (std::size_t i = 0; i < a.materials.size(); ++i) {
        CHECK(a.materials[i].name == b.materials[i].name);
        CHECK(a.materials[i].colour == b.materials[i].colour);
    }
    REQUIRE(a.pivots.size() == b.pivots.size());
    for (std::size_t i = 0; i < a.pivots.size(); ++i) {
        CHECK(a.pivots[i].part == b.pivots[i].part);
        CHECK(a.pivots[i].point_m == b.pivots[i].point_m);
        CHECK(a.pivots[i].axis == b.pivots[i].axis);
    }
}

} // namespace

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
    for (const char* face :
         {"f 1/1 2/1 3/1 4/1",
          "f 1//7 2//7 3//7 4//7",
          "f 1/1/1 2/2/1 3/3/1 4/4/1",
          "f -4 -3 -2 -1",
          "f\t-4//1   2 3/9  -1 \r"}) {
        CHECK(corners(model_of(square + face + "\n"), 0) == std::vector<std::uint32_t>{0, 1, 2, 3});
    }
}

TEST_CASE("negative indices count back from the vertex read last") {
    const PolygonModel model =
        model_of(square + "f -4 -3 -2\nv 0 0 1\nv 1 0 1\nv 1 1 1\nf -3 -2 -1\n");
    CHECK(corners(model, 0) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(corners(model, 1) == std::vector<std::uint32_t>{4, 5, 6});
}

TEST_CASE("other OBJ lines, comments and numbers after the coordinates are ignored") {
    const PolygonModel model = model_of(
        "# made by hand\n\no thing\ns off\nvt 0 0\nvn 0 0 1\nvp 1 2\n"
        "v 0 0 0 1\nv +1 0 0 0.5 0.5 0.5\nv 1e0 1 0\nl 1 2\np 1\nf 1 2 3\n# pivot points: none\n");
    CHECK(model.vertices_m.size() == 3);
    CHECK(model.parts == std::vector<std::string>{"thing"});
    CHECK(model.pivots.empty());
}

TEST_CASE("parts and materials come in the order of their first polygon") {
    octant::write_file(
        scratch("two colours.mtl"),
        "# c\nnewmtl red paint\nNs 10\nKd 1 0.25 0\nnewmtl unused\nKd 0 0 0\nnewmtl plain\n");
    const PolygonModel model = model_of(
        "mtllib two colours.mtl\n" + square +
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

TEST_CASE("a line that ends in a backslash goes on in the next one") {
    const PolygonModel model =
        model_of("v 0 \\\n0 0\nv 1 0 0\nv 1 1 0\\\r\nv 0 1 0\nf 1\\\n\\\n2 3\nf 3 2 1\\");
    CHECK(model.vertices_m.size() == 3); // what follows three coordinates is ignored
    REQUIRE(model.polygons.size() == 2);
    CHECK(corners(model, 0) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(corners(model, 1) == std::vector<std::uint32_t>{2, 1, 0});
}

TEST_CASE("messages name the line where a continued line begins, and later lines as they are") {
    CHECK(message("\nv 0 \\\n0 x1\n") == "m.obj:2: expected a number, got 'x1'");
    CHECK(message("v 0 \\\n\\\n0 0\nv 1 0\n") == "m.obj:4: expected three coordinates, got 2");
    CHECK(
        message(square + "\nf 1 \\\n2 \\\n2\n") ==
        "m.obj:6: expected corners in different places, got corners 2 and 3 in one");
}

TEST_CASE("a comment that ends in a backslash hides no line") {
    CHECK(model_of("# C:\\models\\\n" + square + "f 1 2 3\n").vertices_m.size() == 4);
}

TEST_CASE("a byte order mark is skipped in both files") {
    octant::write_file(scratch("marked.mtl"), "\xef\xbb\xbfnewmtl red\nKd 1 0 0\n");
    const PolygonModel model =
        model_of("\xef\xbb\xbfmtllib marked.mtl\n" + square + "usemtl red\nf 1 2 3\n");
    CHECK(model.materials[0].colour == glm::vec3(1, 0, 0));
    CHECK(message("\xef\xbb\xbfv 0 0\n") == "m.obj:1: expected three coordinates, got 2");
}

TEST_CASE("the other keywords of the specification are ignored") {
    for (const char* keyword :
         {"mg",         "bevel",     "c_interp", "d_interp", "lod",    "maplib", "usemap",
          "shadow_obj", "trace_obj", "ctech",    "stech",    "cstype", "deg",    "bmat",
          "step",       "curv",      "curv2",    "surf",     "parm",   "trim",   "hole",
          "scrv",       "sp",        "end",      "con",      "call",   "csh"}) {
        CHECK(message(fmt::format("{} 1 x\n{}f 1 2 3\n", keyword, square)) == "accepted");
    }
}

TEST_CASE("mtllib reads several files, but one whose name has blanks goes first") {
    octant::write_file(scratch("first.mtl"), "newmtl red\nKd 1 0 0\n");
    octant::write_file(scratch("second.mtl"), "newmtl blue\nKd 0 0 1\n");
    const std::string text =
        "mtllib first.mtl second.mtl\n" + square + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4\n";
    const PolygonModel model = model_of(text);
    CHECK(model.materials[0].colour == glm::vec3(1, 0, 0));
    CHECK(model.materials[1].colour == glm::vec3(0, 0, 1));
    CHECK(model.notes.empty());
    CHECK(
        message(text + "usemtl green\nf 1 3 4\n") ==
        "m.obj:10: expected a material of the material file, got 'green'");
    octant::write_file(
        scratch("first.mtl second.mtl"), "newmtl red\nKd 0 1 0\nnewmtl blue\nKd 1 1 0\n");
    CHECK(model_of(text).materials[0].colour == glm::vec3(0, 1, 0));
    std::filesystem::remove(scratch("first.mtl second.mtl"));
}

TEST_CASE("a missing material file leaves its materials grey, and the model says so") {
    octant::write_file(scratch("there.mtl"), "newmtl red\nKd 1 0 0\n");
    const std::string faces = square + "usemtl red\nf 1 2 3\nusemtl other\nf 1 3 4\n";
    const auto note = [](const std::string& name) {
        return scratch("m.obj").string() + ":2: material file " + name +
               " is missing, its materials are drawn grey";
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
    const PolygonModel model =
        model_of("# pivot rotor 0.5 2 -1 axis 0 2 0\n" + square + "f 1 2 3\ng rotor\nf 1 3 4\n");
    REQUIRE(model.pivots.size() == 1);
    CHECK(model.pivots[0].part == 1);
    CHECK(model.pivots[0].point_m == glm::dvec3(1, 0.5, -2));
    CHECK(model.pivots[0].axis == glm::dvec3(0, 0, -1));
}

TEST_CASE("other file axes give the same body") {
    const PolygonModel model =
        model_of("v 3 1 2\nv 4 1 2\nv 3 2 2\nf 1 2 3\n", FileAxes::from_text("forward,left,up"));
    CHECK(model.vertices_m[0] == glm::dvec3(3, -1, -2));
    CHECK(normal_of(model, 0) == glm::dvec3(0, 0, -1));
}

TEST_CASE("wrong OBJ lines are refused with file, line, expected and got") {
    CHECK(message("v 0 0\n") == "m.obj:1: expected three coordinates, got 2");
    CHECK(message("v 0 0 x1\n") == "m.obj:1: expected a number, got 'x1'");
    CHECK(message("\nv 0 nan 0\n") == "m.obj:2: expected a number, got 'nan'");
    CHECK(message("v inf 0 0\n") == "m.obj:1: expected a number, got 'inf'");
    CHECK(message("v 1e400 0 0\n") == "m.obj:1: expected a number, got '1e400'");
    CHECK(message("v 1,5 0 0\n") == "m.obj:1: expected a number, got '1,5'");
    CHECK(message("v 1e8 0 0\n") == "m.obj:1: expected a number within 1e+07, got '1e8'");
    CHECK(message(square + "f 1 2\n") == "m.obj:5: expected at least three corners, got 2");
    CHECK(
        message(square + "f 1 2 5\n") == "m.obj:5: expected a vertex 1 to 4 (or -4 to -1), got 5");
    CHECK(
        message(square + "f 1 2 0\n") == "m.obj:5: expected a vertex 1 to 4 (or -4 to -1), got 0");
    CHECK(
        message(square + "f 1 2 -5\n") ==
        "m.obj:5: expected a vertex 1 to 4 (or -4 to -1), got -5");
    CHECK(message("f 1 2 3\n") == "m.obj:1: expected vertices before a polygon, got 1");
    for (const std::string corner : {"x", "1.5", "1/", "1/2/3/4", "/1", "1/x/1", "1/1/"}) {
        CHECK(
            message(square + fmt::format("f 1 2 {}\n", corner)) ==
            "m.obj:5: expected a corner such as 7, 7/1, 7//3 or 7/1/3, got '" + corner + "'");
    }
    CHECK(
        message("vertex 1 2 3\n") ==
        "m.obj:1: expected an OBJ line (v, f, g, o, usemtl, mtllib), got 'vertex'");
    CHECK(message("usemtl\n") == "m.obj:1: expected a material name, got none");
    CHECK(message("mtllib \n") == "m.obj:1: expected a file name, got none");
}

TEST_CASE("polygons that cannot be ordered are refused at their line") {
    CHECK(
        message(square + "f 1 2 3 4\nf 1 2 2\n") ==
        "m.obj:6: expected corners in different places, got corners 2 and 3 in one");
    CHECK(
        message("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n") ==
        "m.obj:4: expected a polygon with an area, got corners on one line");
    CHECK(
        message("v 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1 0\nf 1 2 3 4\n") ==
        "m.obj:5: expected a planar polygon (within 0.000142 m), got corner 1 0.0249 m off the "
        "plane");
    CHECK(
        message("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4\n") ==
        "m.obj:5: expected a convex polygon, got corner 4 2.53 m outside the edge from corner 2 "
        "to 3");
}

TEST_CASE("files that are no model are refused") {
    CHECK(message("") == "m.obj: expected at least one polygon (f), got none");
    CHECK(message(square) == "m.obj: expected at least one polygon (f), got none");
    CHECK(message(std::string("v 0 0 0\n\0\1", 10)) == "m.obj: expected text, got binary data");
    CHECK(
        message("\x89PNG\r\n") ==
        "m.obj:1: expected an OBJ line (v, f, g, o, usemtl, mtllib), got '?PNG'");
    CHECK_THROWS_WITH(
        read_obj(scratch("absent.obj")),
        scratch("absent.obj").string() + ": expected a file, found none");
}

TEST_CASE("a polygon with too many corners is refused") {
    std::string face = "f";
    for (int i = 0; i < 1001; ++i) {
        face += " 1";
    }
    CHECK(message(square + face + "\n") == "m.obj:5: expected at most 1000 corners, got 1001");
}

TEST_CASE("too many vertices are refused") {
    std::string text;
    for (std::size_t i = 0; i <= most_obj_vertices; ++i) {
        text += "v 0 0 0\n";
    }
    CHECK(message(text) == "m.obj:1000001: expected at most 1000000 vertices, got more");
}

TEST_CASE("material faults are refused at their line") {
    octant::write_file(scratch("one.mtl"), "newmtl red\nKd 1 0 0\n");
    CHECK(
        message("mtllib one.mtl\n" + square + "usemtl rd\n\nf 1 2 3\n") ==
        "m.obj:6: expected a material of the material file, got 'rd'");
    const auto mtl = [](const std::string& text) {
        octant::write_file(scratch("bad.mtl"), text);
        return message("mtllib bad.mtl\n");
    };
    CHECK(mtl("newmtl\n") == "bad.mtl:1: expected a material name after newmtl, got none");
    CHECK(mtl("Kd 1 1 1\n") == "bad.mtl:1: expected newmtl before Kd, got Kd");
    CHECK(
        mtl("newmtl a\nKd 1 1\n") == "bad.mtl:2: expected Kd and three numbers 0..1, got 'Kd 1 1'");
    CHECK(
        mtl("newmtl a\nKd 1 1 1.5\n") ==
        "bad.mtl:2: expected Kd and three numbers 0..1, got 'Kd 1 1 1.5'");
    CHECK(
        mtl("newmtl a\nKd 1 nan 1\n") ==
        "bad.mtl:2: expected Kd and three numbers 0..1, got 'Kd 1 nan 1'");
    CHECK(
        mtl("newmtl a\nnewmtl b\nnewmtl a\n") ==
        "bad.mtl:3: expected a new material name, got 'a' again");
}

TEST_CASE("pivot faults are refused at their line") {
    const std::string rotor = square + "g rotor\nf 1 2 3\n";
    CHECK(
        message(rotor + "# pivot rotor 0 0 axis 0 1 0\n") ==
        "m.obj:7: expected # pivot NAME X Y Z axis AX AY AZ, got '# pivot rotor 0 0 axis 0 1 0'");
    CHECK(
        message(rotor + "# pivot rotor 0 0 0 axis 0 0 0\n") ==
        "m.obj:7: expected an axis with a length, got '# pivot rotor 0 0 0 axis 0 0 0'");
    CHECK(
        message(rotor + "# pivot rotor 0 0 a axis 0 1 0\n") ==
        "m.obj:7: expected a number, got 'a'");
    CHECK(
        message(rotor + "# pivot roter 0 0 0 axis 0 1 0\n") ==
        "m.obj:7: expected a group with polygons, got 'roter'");
    CHECK(
        message(rotor + "# pivot rotor 0 0 0 axis 0 1 0\n# pivot rotor 0 0 0 axis 1 0 0\n") ==
        "m.obj:8: expected one pivot a group, got 'rotor' again");
}

TEST_CASE("a model survives the way to a file and back bit for bit, in any axes") {
    octant::write_file(scratch("odd.mtl"), "newmtl a\nKd 0.1 0.33333 1e-3\nnewmtl b\nKd 0 1 0.7\n");
    const PolygonModel model = model_of(
        "mtllib odd.mtl\n# pivot fan 0.1 0.2 0.3 axis 1 2 3\n"
        "v 0.1 0.2 0.3\nv 1.1000000000000001 -2.2 0.3\nv 3.3333333333333335 1e-17 0.3\nv 9 9 9\n"
        "usemtl b\nf 1 2 3\ng fan\nusemtl a\nf 3 2 1\nusemtl b\nf 2 3 1\n");
    for (const char* text : {"right,up,back", "forward,left,up", "forward,right,down"}) {
        const FileAxes axes = FileAxes::from_text(text);
        write_obj(scratch("copy.obj"), model, axes);
        check_same(read_obj(scratch("copy.obj"), axes), model);
    }
    write_obj(scratch("copy.obj"), background60());
    check_same(read_obj(scratch("copy.obj")), background60());
}

TEST_CASE("the written text is plain OBJ") {
    const PolygonModel model = model_of(square + "usemtl paint\nf 1 2 3 4\n");
    const ObjText text = obj_text(model, {}, "m.mtl");
    CHECK(
        text.obj == "# 4 vertices, 1 polygons; metres, x y z = right,up,back\nmtllib m.mtl\n"
                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng default\nusemtl paint\nf 1 2 3 4\n");
    CHECK(text.mtl == "newmtl paint\nKd 0.7 0.7 0.7\n");
}
