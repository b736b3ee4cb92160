#include "visuals/gl/bare_grid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::visuals::gl {
namespace {

constexpr float nearest_m = 600.0F;
constexpr float relief_m = 300.0F;

/// Distance ahead at a place of the picture, x and y from -1 to 1: hills a quarter of it wide.
float ahead_m(glm::vec2 place) {
    return nearest_m + relief_m * (1.0F + std::sin(12.0F * place.x) * std::cos(12.0F * place.y));
}

glm::vec3 point_m(glm::vec2 place, const glm::mat4& view_to_clip) {
    const float ahead = ahead_m(place);
    return {place.x * ahead / view_to_clip[0][0], place.y * ahead / view_to_clip[1][1], -ahead};
}

models::ColourVertex vertex_at(glm::vec2 place, const glm::mat4& view_to_clip) {
    constexpr float step = 1e-3F;
    const glm::vec3 sun = glm::normalize(glm::vec3(0.5F, 0.6F, 0.6F));
    const glm::vec3 here = point_m(place, view_to_clip);
    const glm::vec3 right = point_m(place + glm::vec2(step, 0.0F), view_to_clip) - here;
    const glm::vec3 up = point_m(place + glm::vec2(0.0F, step), view_to_clip) - here;
    const glm::vec3 normal = glm::normalize(glm::cross(right, up));
    const float light = 0.35F + 0.65F * std::max(glm::dot(normal, sun), 0.0F);
    return {here, models::packed_colour(glm::vec3(0.45F, 0.60F, 0.30F) * light)};
}

} // namespace

BareGrid bare_grid(int triangles, const glm::mat4& view_to_clip) {
    assert(triangles >= 2);
    const int cells = (triangles + 1) / 2;
    const int rows = std::max(1, static_cast<int>(std::lround(std::sqrt(cells))));
    const int columns = (cells + rows - 1) / rows;
    BareGrid grid;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const glm::vec2 share(static_cast<float>(column) / static_cast<float>(columns),
                static_cast<float>(row) / static_cast<float>(rows));
            grid.vertices.push_back(vertex_at(2.0F * share - 1.0F, view_to_clip));
        }
    }
    const auto wide = static_cast<std::uint32_t>(columns + 1);
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
        for (std::uint32_t column = 0; column + 1 < wide; ++column) {
            const std::uint32_t corner = row * wide + column;
            grid.indices.insert(
                grid.indices.end(), {corner, corner + 1, corner + wide + 1, corner, corner + wide + 1, corner + wide});
        }
    }
    return grid;
}

} // namespace octant::visuals::gl
