#include "tests/paper_example.h"

#include <algorithm>
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

bool keeps_table_4(const std::function<std::span<const std::uint32_t>(const glm::dvec3& signs)>& list_at) {
    struct Row {
        glm::dvec3 signs;
        std::uint32_t first;
        std::array<std::uint32_t, 3> later; // polygons from 0
    };
    const std::array<Row, 4> rows{{{{1, -1, 1}, 1, {3, 5, 7}}, {{1, -1, -1}, 1, {3, 5, 9}}, {{-1, 1, 1}, 2, {0, 4, 6}},
        {{-1, 1, -1}, 2, {0, 4, 8}}}};
    return std::ranges::all_of(rows, [&](const Row& row) {
        const auto list = list_at(row.signs);
        const auto first = std::ranges::find(list, row.first);
        return std::ranges::all_of(row.later, [&](std::uint32_t later) {
            return first < std::ranges::find(list, later) && std::ranges::count(list, later) == 1;
        });
    });
}

} // namespace octant::tests
