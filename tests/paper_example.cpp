#include "tests/paper_example.h"

#include <array>
#include <cstdint>

namespace octant::tests {

models::polygons::PolygonModel paper_example() {
    models::polygons::PolygonModel model;
    model.name = "concave";
    model.vertices_m = {{-100, 40, 50}, {-100, 40, -50}, {0, 40, 50}, {0, 40, -50}, {0, 0, 50}, {0, 0, -50},
        {100, 0, 50}, {100, 0, -50}, {-100, -40, 50}, {-100, -40, -50}, {100, -40, 50}, {100, -40, -50}, {0, -40, 50},
        {0, -40, -50}};
    constexpr std::array<std::array<std::uint32_t, 4>, 10> polygons{{{1, 3, 4, 2}, {3, 5, 6, 4}, {5, 7, 8, 6},
        {7, 11, 12, 8}, {1, 2, 10, 9}, {9, 10, 12, 11}, {1, 9, 13, 3}, {5, 13, 11, 7}, {2, 4, 14, 10}, {6, 8, 12, 14}}};
    for (const auto& corners : polygons) {
        models::polygons::Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size());
        polygon.corner_count = 4;
        for (const std::uint32_t corner : corners) { model.corner_vertices.push_back(corner - 1); }
        model.polygons.push_back(polygon);
    }
    model.materials.emplace_back();
    model.parts.emplace_back("default");
    return model;
}

} // namespace octant::tests
