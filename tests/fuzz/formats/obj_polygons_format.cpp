#include "models/polygons/obj_reader.h"
#include "models/polygons/obj_writer.h"
#include "models/polygons/polygon_model.h"
#include "tests/fuzz/formats/target.h"

namespace octant::tests::formats::obj_polygons_format {

namespace {

using models::polygons::PolygonModel;

/// Every polygon is planar and convex, and the model is the same when it is written and read again.
void use(const std::filesystem::path& file) {
    const PolygonModel model = models::polygons::read_obj(file);
    const double tolerance_m = models::polygons::flatness_tolerance_m(model);
    for (std::size_t polygon = 0; polygon < model.polygons.size(); ++polygon) {
        expect(model.polygons[polygon].material < model.materials.size(), "a material");
        expect(model.polygons[polygon].part < model.parts.size(), "a part");
        const auto fault = models::polygons::polygon_fault(model, polygon, tolerance_m);
        expect(!fault, "polygons without faults, got: " + fault.value_or(""));
    }
    const std::filesystem::path written = file.parent_path() / "again.obj";
    models::polygons::write_obj(written, model);
    const PolygonModel again = models::polygons::read_obj(written);
    expect(again.vertices_m == model.vertices_m, "the same vertices again");
    expect(again.corner_vertices == model.corner_vertices, "the same polygons again");
    expect(again.pivots.size() == model.pivots.size(), "the same pivots again");
}

std::vector<std::string> seeds() {
    return {
        // A box with an open lid that turns, and a decal.
        "# pivot lid 0 0 1 axis 0 1 0 rpm 30\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 1\nv 2 0 "
        "1\n"
        "v 2 1 1\nv 0 1 1\ng box\nusemtl grey\nf 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
        "f 4 1 5 8\ng lid\nusemtl red\nf 5 6 7 8\n",
        // Dented, bent and with sides that meet; corners of all forms.
        "mtllib none.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 0 0 2\nv 4 0 2.5\nv 4 4 "
        "2\n"
        "v 0 4 2.1\nvt 0 0\nvn 0 0 1\no dent\nf 1/1/1 2//1 3/1 4 5\no bent\nf -4 -3 -2 -1\n"
        "f 6 7 \\\n 8\n",
    };
}

const Registered target({
    .name = "obj_polygons",
    .file = "input.obj",
    .use = use,
    .seeds = seeds,
    .words = {"v ", "f ", "g ", "o ", "usemtl ", "mtllib ", "# pivot ", " axis ", " rpm ", "\\\n", "-1", "1/2/3", "//",
        "bzp", "f 1 2 3 4 5 6 7 8\n"},
});

} // namespace

} // namespace octant::tests::formats::obj_polygons_format
