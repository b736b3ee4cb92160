#include "models/planar/t_junctions.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <vector>

using namespace octant::models::planar;
using octant::models::polygons::PolygonModel;

namespace {

/// A plate of two metres in the plane z = 0 and, at its side x = 1, two plates of one metre; their common corners are
/// `beside_m` off that side.
PolygonModel three_plates(double beside_m) {
    PolygonModel model;
    model.materials.resize(1);
    model.parts = {"all"};
    model.vertices_m = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {1.0 + beside_m, 0, 0}, {2, -1, 0}, {2, 0, 0},
        {2, 1, 0}, {1.0 + beside_m, 0, 0}};
    model.corner_vertices = {0, 1, 2, 3, 1, 5, 6, 4, 8, 6, 7, 2};
    model.polygons = {{0, 4, 0, 0}, {4, 4, 0, 0}, {8, 4, 0, 0}};
    return model;
}

} // namespace

TEST_CASE("a corner between the ends of another polygon's side is found once") {
    for (const double beside_m : {0.0, 1e-6, -1e-6}) {
        const auto found = t_junctions(three_plates(beside_m));
        REQUIRE(found.size() == 1);
        CHECK(found.front().corner == 1);
        CHECK(found.front().vertex == 4);
        CHECK(found.front().share == Approx(0.5));
    }
    CHECK(t_junctions(three_plates(1e-3)).empty());
}

TEST_CASE("a sliver's own corner does not lie on its side") {
    PolygonModel model;
    model.vertices_m = {{0, 0, 0}, {10, 0, 0}, {5, 1e-5, 0}, {5, -4, 0}};
    model.corner_vertices = {0, 1, 2, 0, 3, 1};
    model.parts = {"all"};
    model.polygons = {{0, 3, 0, 0}, {3, 3, 0, 0}};
    const auto found = t_junctions(model);
    REQUIRE(found.size() == 1);
    CHECK(found.front().corner == 5);
    CHECK(found.front().vertex == 2);
}

TEST_CASE("of a part that turns no corner belongs to a side of another part") {
    PolygonModel model = three_plates(0.0);
    model.parts = {"all", "rotor"};
    model.pivots = {{.part = 1}};
    model.polygons[1].part = 1;
    model.polygons[2].part = 1;
    CHECK(t_junctions(model).empty());
    model.polygons[0].part = 1;
    CHECK(t_junctions(model).size() == 1);
}

TEST_CASE("corners on one side come in their order along it") {
    PolygonModel model = three_plates(0.0);
    model.vertices_m.insert(model.vertices_m.end(), {{-0.5, -1, 0}, {0.5, -1, 0}, {0, -2, 0}});
    model.polygons.push_back({12, 3, 0, 0});
    model.corner_vertices.insert(model.corner_vertices.end(), {10, 9, 11});
    const auto found = t_junctions(model);
    REQUIRE(found.size() == 3);
    CHECK(found[0].vertex == 9);
    CHECK(found[1].vertex == 10);
    CHECK(found[0].corner == 0);
    CHECK(found[1].corner == 0);
    CHECK(found[2].corner == 1);
}
