#include "models/polygons/obj_reader.h"
#include "models/polygons/obj_writer.h"
#include "models/polygons/polygon_model.h"
#include "models/polygons/polygon_outlines.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "obj_texts.h"

using namespace octant::models;
using namespace octant::models::polygons;
using namespace octant::models::polygons::test;

namespace {

using Corners = std::vector<glm::dvec3>;

double area_m2(const Corners& corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return glm::length(sum) * 0.5;
}

/// Number of pieces, after checking that they are convex, planar and together the whole polygon.
std::size_t checked_pieces(const Corners& corners) {
    const double tolerance_m = 1e-4;
    const ConvexPieces cut = convex_pieces(corners, tolerance_m);
    CHECK(cut.fault.empty());
    double pieces_m2 = 0.0;
    for (const auto& places : cut.pieces) {
        Corners piece;
        for (const std::size_t place : places) { piece.push_back(corners[place]); }
        CHECK_FALSE(corners_fault(piece, tolerance_m).has_value());
        pieces_m2 += area_m2(piece);
    }
    if (is_planar(corners, tolerance_m)) { CHECK(pieces_m2 == Approx(area_m2(corners))); }
    return cut.pieces.size();
}

/// A wheel with as many teeth: all of its ears are alike, and so are many of its diagonals.
Corners wheel(int teeth) {
    Corners corners;
    const double step = glm::radians(180.0) / teeth;
    for (int i = 0; i < 2 * teeth; ++i) {
        const double radius_m = i % 2 == 0 ? 1.0 : 0.4;
        corners.push_back(radius_m * glm::dvec3(std::cos(i * step), std::sin(i * step), 0.0));
    }
    return corners;
}

/// An outline with `teeth` dents along its top.
Corners saw(int teeth) {
    Corners corners{{0, 0, 0}, {2.0 * teeth, 0, 0}};
    for (int i = teeth; i > 0; --i) {
        corners.emplace_back(2.0 * i, 3, 0);
        corners.emplace_back(2.0 * i - 1, 1, 0);
    }
    corners.emplace_back(0, 3, 0);
    return corners;
}

const std::string saddle = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\n";

} // namespace

TEST_CASE("a polygon is cut alike wherever it lies and whichever way it is turned") {
    for (const int teeth : {3, 4, 5, 8, 12}) {
        const Corners corners = wheel(teeth);
        const auto pieces = convex_pieces(corners, 1e-4).pieces;
        CHECK(pieces.size() > 1);
        for (int degrees = 7; degrees < 180; degrees += 10) {
            const glm::dquat turn = glm::angleAxis(glm::radians(double(degrees)), glm::normalize(glm::dvec3(1, -2, 3)));
            Corners moved;
            for (const glm::dvec3& corner : corners) { moved.push_back(turn * corner + glm::dvec3(1e4, -1e4, 0.0)); }
            INFO(teeth << " teeth turned by " << degrees << " degrees");
            CHECK(convex_pieces(moved, 1e-4).pieces == pieces);
        }
    }
}

TEST_CASE("an arrowhead is cut into two triangles through its dent") {
    const PolygonModel model = model_of("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4\nf 1 2 3\nf 4 3 2 1\n");
    REQUIRE(model.polygons.size() == 5);
    CHECK(corners(model, 0) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(corners(model, 1) == std::vector<std::uint32_t>{0, 2, 3});
    CHECK(corners(model, 2) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(model.parents == std::vector<std::uint32_t>{0, 0, 1, 2, 2});
    CHECK(notes_of(model) == std::vector<std::string>{"m.obj:5: polygon of 4 corners is dented: cut into 2",
                                 "m.obj:7: polygon of 4 corners is dented: cut into 2"});
}

TEST_CASE("a saddle is cut into two triangles, a fold into its two planes") {
    const PolygonModel model = model_of(saddle + "f 1 2 3 4\n");
    CHECK(model.polygons.size() == 2);
    CHECK(notes_of(model) == std::vector<std::string>{"m.obj:5: polygon of 4 corners is bent: cut into 2"});
    for (const double height : {-2.0, -0.1, 0.1, 2.0}) {
        const Corners fold{{0, 0, 0}, {2, 0, 0}, {5, 0, height}, {5, 3, height}, {2, 3, 0}, {0, 3, 0}};
        CHECK(checked_pieces(fold) == 2);
    }
}

TEST_CASE("pieces keep part and material, and good models have no parents") {
    const PolygonModel model = model_of(saddle + "g a\nusemtl x\nf 1 2 3\ng b\nusemtl y\nf 1 2 3 4\n");
    REQUIRE(model.polygons.size() == 3);
    for (const std::size_t piece : {1U, 2U}) {
        CHECK(model.polygons[piece].part == 1);
        CHECK(model.polygons[piece].material == 1);
    }
    CHECK(model.parent_of(2) == 1);
    CHECK(model_of(saddle + "f 1 2 3\n").parents.empty());
    CHECK(model_of(saddle + "f 1 2 3\n").notes.empty());
}

TEST_CASE("dented outlines are cut into few convex pieces") {
    const Corners arrow{{0, -1, 0}, {4, -1, 0}, {4, -2, 0}, {6, 0, 0}, {4, 2, 0}, {4, 1, 0}, {0, 1, 0}};
    CHECK(checked_pieces(arrow) == 2);
    const Corners letter_l{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    CHECK(checked_pieces(letter_l) == 2);
    const Corners letter_u{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    CHECK(checked_pieces(letter_u) == 3);
    const Corners cross{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1, 0}, {3, 2, 0}, {2, 2, 0}, {2, 3, 0}, {1, 3, 0},
        {1, 2, 0}, {0, 2, 0}, {0, 1, 0}, {1, 1, 0}};
    CHECK(checked_pieces(cross) <= 4);
    CHECK(checked_pieces(saw(6)) <= 8);
}

TEST_CASE("outlines that wind and stars without crossings are cut without loss") {
    Corners spiral;
    for (int i = 0; i <= 24; ++i) {
        spiral.emplace_back((2.0 + 0.2 * i) * std::cos(0.4 * i), (2 + 0.2 * i) * std::sin(0.4 * i), 1);
    }
    for (int i = 24; i >= 0; --i) {
        spiral.emplace_back((1.5 + 0.2 * i) * std::cos(0.4 * i), (1.5 + 0.2 * i) * std::sin(0.4 * i), 1);
    }
    CHECK(checked_pieces(spiral) < 30);
    Corners star;
    for (int i = 0; i < 10; ++i) {
        const double angle_rad = 0.62831853071795862 * i;
        const double radius_m = i % 2 == 0 ? 2.0 : 0.8;
        star.emplace_back(0, radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad));
    }
    CHECK(checked_pieces(star) <= 6);
    CHECK(checked_pieces(saw(120)) <= 130);
}

TEST_CASE("corners in the middle of straight sides make no needles") {
    const Corners corners{{0, 0, 0}, {1, 1e-7, 0}, {2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {4, 4, 0}, {2, 3, 0}, {1, 3.5, 0},
        {0, 4, 0}, {0, 2, 0}};
    CHECK(checked_pieces(corners) <= 2);
}

TEST_CASE("sides that cross or touch are refused, seen along the mean normal") {
    const auto fault = [](const Corners& corners) { return convex_pieces(corners, 1e-4).fault; };
    const std::string meet = "expected a polygon whose sides do not meet, got the sides from corner ";
    CHECK(fault({{0, 0, 0}, {4, 0, 0}, {1, 2, 0}, {3, 3, 0}}) == meet + "2 to 3 and 4 to 1 meeting");
    CHECK(fault({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}) ==
          "expected corners in different places, got corners 2 and 5 in one");
    CHECK(fault({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}) == meet + "1 to 2 and 3 to 4 meeting");
    CHECK(fault({{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 3, 0}}) == meet + "1 to 2 and 2 to 3 meeting");
    CHECK(fault({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}) == "expected a polygon with an area, got corners on one line");
}

TEST_CASE("of many cut polygons ten are named and the others counted") {
    std::string text = saddle;
    for (int i = 0; i < 13; ++i) { text += "f 1 2 3 4\n"; }
    const std::vector<std::string> notes = notes_of(model_of(text));
    REQUIRE(notes.size() == 11);
    CHECK(notes[9] == "m.obj:14: polygon of 4 corners is bent: cut into 2");
    CHECK(notes[10] == "m.obj: 3 more polygons are dented, bent or without an area");
}

TEST_CASE("a model with pieces is written as what it is and read back whole") {
    const PolygonModel model = model_of(saddle + "f 1 2 3 4\nf 1 3 2\n");
    write_obj(scratch("pieces.obj"), model);
    const PolygonModel again = read_obj(scratch("pieces.obj"));
    CHECK(again.polygons.size() == 3);
    CHECK(again.corner_vertices == model.corner_vertices);
    CHECK(again.parents.empty());
    CHECK(again.notes.empty());
}

TEST_CASE("corners of cut polygons keep their texture coordinates, others have none") {
    const auto folder = octant::tests::empty_folder("painted");
    octant::write_file(
        folder / "painted.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd -clamp on my skin.png\nnewmtl plain\nKd 1 0 0\n");
    // A dented polygon whose texture coordinates are a tenth of its places, and a triangle without a picture.
    octant::write_file(folder / "painted.obj",
        "mtllib painted.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 9 9 9\n"
        "vt 0 0\nvt .4 0\nvt .4 .4\nvt .2 .1\nvt 0 .4\n"
        "usemtl skin\nf 1/1 2/2 3/3 4/4 5/5\nusemtl plain\nf 1/1 2/2 6/1\n");
    const PolygonModel model = read_obj(folder / "painted.obj", {}, true);
    REQUIRE(model.polygons.size() > 2);
    REQUIRE(model.corner_texture_coordinates.size() == model.corner_vertices.size());
    const FileAxes axes;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const bool is_plain = model.materials[model.polygons[i].material].name == "plain";
        std::size_t corner = model.polygons[i].first_corner;
        for (const std::uint32_t vertex : model.corners(i)) {
            const glm::vec2 place = model.corner_texture_coordinates[corner++];
            const glm::dvec3 at_m = axes.file_from_body(model.vertices_m[vertex]);
            CHECK(std::isnan(place.x) == is_plain);
            if (!is_plain) {
                CHECK(place.x == Approx(0.1 * at_m.x).margin(1e-6));
                CHECK(place.y == Approx(0.1 * at_m.y).margin(1e-6));
            }
        }
    }
    const auto skin = std::ranges::find(model.materials, "skin", &Material::name);
    REQUIRE(skin != model.materials.end());
    CHECK(skin->picture == "my skin.png");
    CHECK(skin->texture.wrap_u == TextureWrap::Clamp);
    CHECK(read_obj(folder / "painted.obj").corner_texture_coordinates.empty());
}
