#include "models/polygons/obj_reader.h"
#include "models/polygons/obj_writer.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/output_file.h"

#include <catch2/catch.hpp>

#include "obj_texts.h"

using namespace octant::models;
using namespace octant::models::procedural;
using namespace octant::models::polygons;
using namespace octant::models::polygons::test;

namespace {

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
        CHECK(a.materials[i].is_mirror == b.materials[i].is_mirror);
    }
    REQUIRE(a.pivots.size() == b.pivots.size());
    for (std::size_t i = 0; i < a.pivots.size(); ++i) {
        CHECK(a.pivots[i].part == b.pivots[i].part);
        CHECK(a.pivots[i].point_m == b.pivots[i].point_m);
        CHECK(a.pivots[i].axis == b.pivots[i].axis);
        CHECK(a.pivots[i].turns_per_s == b.pivots[i].turns_per_s);
    }
}

} // namespace

TEST_CASE("a model survives the way to a file and back bit for bit, in any axes") {
    octant::write_file(scratch("odd.mtl"), "newmtl a\nKd 0.1 0.33333 1e-3\nnewmtl b\nKd 0 1 0.7\nillum 5\n");
    const PolygonModel model =
        model_of("mtllib odd.mtl\n# pivot fan 0.1 0.2 0.3 axis 1 2 3 rpm 3017.9\n"
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
    CHECK(text.obj == "# 4 vertices, 1 polygons; metres, x y z = right,up,back\nmtllib m.mtl\n"
                      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng default\nusemtl paint\nf 1 2 3 4\n");
    CHECK(text.mtl == "newmtl paint\nKd 0.7 0.7 0.7\n");
}
