// The torus of the 2008 hybrid-shading paper. Deviations: the paper prints the numbers of quads and vertices only;
// radii and colour are made up. Vertices on the seams are shared here (416 of them), not doubled.

#include "models/procedural/background60.h"
#include "sim/base/units.h"

#include <array>
#include <cassert>
#include <cmath>

namespace octant::models::procedural {

namespace {

constexpr double ring_radius_m = 1.0;
constexpr double tube_radius_m = 0.4;

glm::dvec3 torus_point(double around_rad, double across_rad) {
    const double from_axis_m = ring_radius_m + tube_radius_m * std::cos(across_rad);
    return {
        from_axis_m * std::cos(around_rad), from_axis_m * std::sin(around_rad), tube_radius_m * std::sin(across_rad)};
}

} // namespace

polygons::PolygonModel torus(int around, int across) {
    assert(around >= 3 && across >= 3);
    polygons::PolygonModel model;
    model.name = "torus";
    model.materials.push_back({.name = "torus", .colour = glm::vec3(0.80F, 0.55F, 0.25F)});
    model.parts.emplace_back("torus");
    const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>((j % across) * around + i % around); };
    for (int j = 0; j < across; ++j) {
        for (int i = 0; i < around; ++i) {
            model.vertices_m.push_back(torus_point(2.0 * pi * i / around, 2.0 * pi * j / across));
            model.polygons.push_back(
                {.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size()), .corner_count = 4});
            const std::array<std::uint32_t, 4> corners{
                vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
            model.corner_vertices.insert(model.corner_vertices.end(), corners.begin(), corners.end());
        }
    }
    return model;
}

} // namespace octant::models::procedural
