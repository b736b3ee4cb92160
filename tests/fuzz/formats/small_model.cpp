#include "tests/fuzz/formats/small_model.h"

#include <utility>

namespace octant::tests::formats {

models::polygons::PolygonModel small_model() {
    models::polygons::PolygonModel model;
    model.name = "box and wall";
    for (int corner = 0; corner < 8; ++corner) {
        model.vertices_m.emplace_back(corner & 1, corner >> 1 & 1, corner >> 2);
    }
    for (const auto& [y, z] : {std::pair(-1, -1), std::pair(2, -1), std::pair(2, 2), std::pair(-1, 2)}) {
        model.vertices_m.emplace_back(3, y, z);
    }
    model.corner_vertices = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5, 8, 9, 10, 11};
    for (std::uint32_t polygon = 0; polygon < 7; ++polygon) {
        model.polygons.push_back({4 * polygon, 4, 0, polygon == 6 ? 1U : 0U});
    }
    model.materials = {{"grey", {0.5F, 0.5F, 0.5F}}};
    model.parts = {"box", "wall"};
    return model;
}

std::vector<glm::dvec3> some_eyes() {
    std::vector<glm::dvec3> eyes_m{{0.5, 0.5, 0.5}, {0.0, 0.0, 0.0}, {1e9, -1e9, 3.0}};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(
            (corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0);
        eyes_m.push_back(sign * glm::dvec3(5.0, 6.0, 7.0));
        eyes_m.push_back(sign * glm::dvec3(0.9, 1.1, 0.3));
    }
    return eyes_m;
}

} // namespace octant::tests::formats
