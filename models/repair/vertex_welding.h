#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::repair {

/// For each used vertex the first used one of the same position and colour, to the bit (-0 is 0); invalid_index
/// (triangle_mesh.h) for the others. `colours` may be empty.
std::vector<std::uint32_t> first_duplicates(
    std::span<const glm::dvec3> vertices_m, std::span<const glm::vec3> colours, const std::vector<bool>& used);

/// Gives each vertex that others are welded to the mean of all their colours. `welded` as first_duplicates returns it;
/// without colours nothing is done.
void average_colours(std::vector<glm::vec3>& colours, std::span<const std::uint32_t> welded);

} // namespace octant::models::repair
