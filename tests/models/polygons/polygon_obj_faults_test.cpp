#include "models/polygons/obj_reader.h"
#include "sim/base/output_file.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <fmt/format.h>
#include <string>
#include <vector>

#include "obj_texts.h"

using namespace octant::models;
using namespace octant::models::polygons;
using namespace octant::models::polygons::test;

TEST_CASE("messages name the line where a continued line begins, and later lines as they are") {
    CHECK(message("\nv 0 \\\n0 x1\n") == "m.obj:2: expected a number, got 'x1'");
    CHECK(message("v 0 \\\n\\\n0 0\nv 1 0\n") == "m.obj:4: expected three coordinates, got 2");
    CHECK(message(square + "\nf 1 \\\n2 \\\n9\n") == "m.obj:6: expected a vertex 1 to 4 (or -4 to -1), got 9");
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
    CHECK(message(square + "f 1 2 5\n") == "m.obj:5: expected a vertex 1 to 4 (or -4 to -1), got 5");
    CHECK(message(square + "f 1 2 0\n") == "m.obj:5: expected a vertex 1 to 4 (or -4 to -1), got 0");
    CHECK(message(square + "f 1 2 -5\n") == "m.obj:5: expected a vertex 1 to 4 (or -4 to -1), got -5");
    CHECK(message("f 1 2 3\n") == "m.obj:1: expected vertices before a polygon, got 1");
    for (const std::string corner : {"x", "1.5", "1/", "1/2/3/4", "/1", "1/x/1", "1/1/"}) {
        CHECK(message(square + fmt::format("f 1 2 {}\n", corner)) ==
              "m.obj:5: expected a corner such as 7, 7/1, 7//3 or 7/1/3, got '" + corner + "'");
    }
    CHECK(message("vertex 1 2 3\n") == "m.obj:1: expected an OBJ line (v, f, g, o, usemtl, mtllib), got 'vertex'");
    CHECK(message("usemtl\n") == "m.obj:1: expected a material name, got none");
    CHECK(message("mtllib \n") == "m.obj:1: expected a file name, got none");
    CHECK(message("mtllib //\n") == "m.obj:1: expected a material file, got the folder '//'");
}

TEST_CASE("polygons without an area are left out, and those that meet themselves become triangles") {
    const PolygonModel model = model_of("v 0 10 0\nv -6 -8 0\nv 9 3 0\nv -9 3 0\nv 6 -8 0\nv 0 20 0\n"
                                        "f 1 2 2\nf 1 1 6\nf 1 2 3 4 5\nf 1 2 2 3\n");
    REQUIRE(model.polygons.size() == 4);
    CHECK(model.parents == std::vector<std::uint32_t>{2, 2, 2, 3});
    CHECK(model.corners(3).size() == 3);
    const auto notes = notes_of(model);
    REQUIRE(notes.size() == 3);
    CHECK(notes[0] == "m.obj:7: polygon of 3 corners has no area: left out");
    CHECK(notes[1] == "m.obj:8: polygon of 3 corners has no area: left out");
    CHECK(notes[2] == "m.obj:9: polygon of 5 corners meets itself: drawn as 3 triangles");
    CHECK(message("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n") ==
          "m.obj: expected at least one polygon with an area, got none");
}

TEST_CASE("a hole that a doubled side joins to its outline stays open") {
    const PolygonModel model = model_of("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\n"
                                        "f 1 2 3 4 1 5 6 7 8 5\n");
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto corners = model.corners(i);
        REQUIRE(corners.size() == 3);
        const auto at = [&](std::size_t corner) { return model.vertices_m[corners[corner]]; };
        area_m2 += 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
    }
    CHECK(area_m2 == Approx(12.0));
    CHECK(notes_of(model) ==
          std::vector<std::string>{"m.obj:9: polygon of 10 corners meets itself: drawn as 8 triangles"});
}

TEST_CASE("files that are no model are refused") {
    CHECK(message("") == "m.obj: expected at least one polygon (f), got none");
    CHECK(message(square) == "m.obj: expected at least one polygon (f), got none");
    CHECK(message(std::string("v 0 0 0\n\0\1", 10)) == "m.obj: expected text, got binary data");
    CHECK(message("\x89PNG\r\n") == "m.obj:1: expected an OBJ line (v, f, g, o, usemtl, mtllib), got '?PNG'");
    CHECK_THROWS_WITH(
        read_obj(scratch("absent.obj")), scratch("absent.obj").string() + ": expected a file, found none");
}

TEST_CASE("a polygon with too many corners is refused") {
    std::string face = "f";
    for (int i = 0; i < 1001; ++i) { face += " 1"; }
    CHECK(message(square + face + "\n") == "m.obj:5: expected at most 1000 corners, got 1001");
}

TEST_CASE("too many vertices are refused") {
    std::string text;
    for (std::size_t i = 0; i <= max_obj_vertices; ++i) { text += "v 0 0 0\n"; }
    CHECK(message(text) == "m.obj:1000001: expected at most 1000000 vertices, got more");
}

TEST_CASE("material faults are refused at their line") {
    octant::write_file(scratch("one.mtl"), "newmtl red\nKd 1 0 0\n");
    CHECK(message("mtllib one.mtl\n" + square + "usemtl rd\n\nf 1 2 3\n") ==
          "m.obj:6: expected a material of the material file, got 'rd'");
    const auto mtl = [](const std::string& text) {
        octant::write_file(scratch("bad.mtl"), text);
        return message("mtllib bad.mtl\n");
    };
    CHECK(mtl("newmtl\n") == "bad.mtl:1: expected a material name after newmtl, got none");
    CHECK(mtl("Kd 1 1 1\n") == "bad.mtl:1: expected newmtl before Kd, got Kd");
    CHECK(mtl("newmtl a\nKd 1 1\n") == "bad.mtl:2: expected Kd and three numbers 0..1, got 'Kd 1 1'");
    CHECK(mtl("newmtl a\nKd 1 1 1.5\n") == "bad.mtl:2: expected Kd and three numbers 0..1, got 'Kd 1 1 1.5'");
    CHECK(mtl("newmtl a\nKd 1 nan 1\n") == "bad.mtl:2: expected Kd and three numbers 0..1, got 'Kd 1 nan 1'");
    CHECK(mtl("newmtl a\nillum glass\n") == "bad.mtl:2: expected illum and a whole number of 0 to 10, got 'glass'");
    CHECK(mtl("newmtl a\nillum\n") == "bad.mtl:2: expected illum and a whole number of 0 to 10, got none");
    for (const std::string line : {"illum 5", "d 1", "Tr 0", "map_Kd a.png", "map_Ke a.png"}) {
        const std::string word = line.substr(0, line.find(' '));
        CHECK(mtl(line + "\n") == "bad.mtl:1: expected newmtl before " + word + ", got " + word);
    }
    CHECK(mtl("newmtl a\nnewmtl b\nnewmtl a\n") == "bad.mtl:3: expected a new material name, got 'a' again");
}

TEST_CASE("lines of materials that are not read are told, the first of each kind, and leave the material as it is") {
    const auto read = [](const std::string& text) {
        octant::write_file(scratch("odd.mtl"), text);
        return read_mtl(scratch("odd.mtl"));
    };
    const auto notes = [&](const std::string& text) {
        std::vector<std::string> told = read(text).notes;
        for (std::string& note : told) { note.erase(0, scratch("").string().size()); }
        return told;
    };
    const auto one = [](const std::string& note) { return std::vector<std::string>{"odd.mtl:" + note}; };
    CHECK(notes("newmtl a\nillum 30\nnewmtl b\nillum 5\nillum -1\nillum 2.5\nillum 5 7\n") ==
          one("2: expected illum and a whole number of 0 to 10, got 'illum 30', and 3 more like it: not read"));
    CHECK(read("newmtl a\nillum 5\nillum 30\n").materials[0].is_mirror);
    CHECK(notes("newmtl a\nd 1,000\n") == one("2: expected d and a number, got 'd 1,000': not read"));
    CHECK(notes("newmtl a\nTr nan\n") == one("2: expected Tr and a number, got 'Tr nan': not read"));
    CHECK(
        notes("newmtl a\nTr 1\nnewmtl b\nd 1.5\nnewmtl c\nTr 1.0\nd -halo 0.5\n") ==
        std::vector<std::string>{"odd.mtl:2: expected Tr below 1, or d, too, got 'Tr 1', and 1 more like it: not read",
            "odd.mtl:4: expected d of 0 to 1, got 'd 1.5': not read",
            "odd.mtl:7: expected d without -halo, got 'd -halo 0.5': not read"});
    CHECK(read("newmtl a\nd 1.5\nnewmtl b\nTr 1\n").materials[0].opacity == 1.0F);
    CHECK(notes("newmtl a\nTr 1.0\nd 1.0\nnewmtl b\nd 0.5\nTr x\n").empty());
}

TEST_CASE(
    "materials are read as exporters write them: reals for whole numbers, comments, names that begin with dashes") {
    octant::write_file(scratch("real.mtl"), "newmtl a\nKd 1 0 0 # red\nillum 5.0\nmap_Kd -S 1 1 1 a.png\n"
                                            "newmtl b\nillum 7 # glass\nd 0.5 # half\nmap_Kd -clamp on -Left Wing.png\n"
                                            "newmtl c\nillum 2.0\nmap_Kd - Kopie.png\nnewmtl d\nmap_Kd -wing.png\n");
    const MtlFile read = read_mtl(scratch("real.mtl"));
    CHECK(read.materials[0].colour == glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(read.materials[0].is_mirror);
    CHECK(read.materials[1].is_mirror);
    CHECK_FALSE(read.materials[2].is_mirror);
    CHECK(read.materials[1].opacity == 0.5F);
    REQUIRE(read.pictures.size() == 4);
    CHECK(read.pictures[0].second.file == "a.png");
    CHECK(read.pictures[0].second.is_moved);
    CHECK(read.pictures[1].second.file == "-Left Wing.png");
    CHECK(read.pictures[1].second.is_clamped);
    CHECK(read.pictures[2].second.file == "- Kopie.png");
    CHECK(read.pictures[3].second.file == "-wing.png");
    REQUIRE(read.notes.size() == 1);
    CHECK(read.notes[0] == scratch("real.mtl").string() +
                               ":8: expected an option of MTL pictures, got 'map_Kd -clamp on -Left Wing.png', and 1 "
                               "more like it: read as part of the name");
}

TEST_CASE("pivot faults are refused at their line") {
    const std::string rotor = square + "g rotor\nf 1 2 3\n";
    CHECK(message(rotor + "# pivot rotor 0 0 axis 0 1 0\n") ==
          "m.obj:7: expected # pivot NAME X Y Z axis AX AY AZ [rpm N], got '# pivot rotor 0 0 axis 0 "
          "1 0'");
    CHECK(message(rotor + "# pivot rotor 0 0 0 axis 0 0 0\n") ==
          "m.obj:7: expected an axis with a length, got '# pivot rotor 0 0 0 axis 0 0 0'");
    CHECK(message(rotor + "# pivot rotor 0 0 0 axis 0 1 0 rpm\n") ==
          "m.obj:7: expected # pivot NAME X Y Z axis AX AY AZ [rpm N], got "
          "'# pivot rotor 0 0 0 axis 0 1 0 rpm'");
    CHECK(message(rotor + "# pivot rotor 0 0 0 axis 0 1 0 rpm fast\n") == "m.obj:7: expected a number, got 'fast'");
    CHECK(message(rotor + "# pivot rotor 0 0 a axis 0 1 0\n") == "m.obj:7: expected a number, got 'a'");
    CHECK(
        message(rotor + "# pivot roter 0 0 0 axis 0 1 0\n") == "m.obj:7: expected a group with polygons, got 'roter'");
    CHECK(message(rotor + "# pivot rotor 0 0 0 axis 0 1 0\n# pivot rotor 0 0 0 axis 1 0 0\n") ==
          "m.obj:8: expected one pivot a group, got 'rotor' again");
}
