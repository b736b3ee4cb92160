#include "models/polygons/polygon_model.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <vector>

using namespace octant::models::polygons;

namespace {

PolygonModel model_of(const std::vector<std::vector<std::uint32_t>>& polygons) {
    PolygonModel model;
    model.materials.resize(1);
    model.parts = {"all"};
    model.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 0}};
    for (const auto& corners : polygons) {
        Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size());
        polygon.corner_count = static_cast<std::uint32_t>(corners.size());
        model.polygons.push_back(polygon);
        model.corner_vertices.insert(model.corner_vertices.end(), corners.begin(), corners.end());
    }
    return model;
}

} // namespace

TEST_CASE("of polygons that repeat each other the last one of the file is kept") {
    using Numbers = std::vector<std::uint32_t>;
    CHECK(distinct_polygons(model_of({})).empty());
    // The second one begins elsewhere, and has a vertex of its own in one of the places.
    CHECK(distinct_polygons(model_of({{0, 1, 2, 3}, {4, 3, 0, 1}, {0, 1, 2}})) == Numbers{1, 2});
    // Its back, and another polygon with corners in the same places, are no repeats.
    CHECK(distinct_polygons(model_of({{0, 1, 2}, {2, 1, 0}, {0, 1, 3}})) == Numbers{0, 1, 2});
}
