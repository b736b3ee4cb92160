#pragma once

#include "models/colour_vertex.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

// Things of few polygons that are convex, or nearly: seen from outside, none of their front faces
// hides another. Triangles are counter-clockwise seen from outside.

namespace octant::visuals::nature {

/// Eight directions, counter-clockwise from east.
inline constexpr std::array<glm::vec2, 8> compass_directions = {
    glm::vec2(1.0F, 0.0F),
    {0.70710678F, 0.70710678F},
    {0.0F, 1.0F},
    {-0.70710678F, 0.70710678F},
    {-1.0F, 0.0F},
    {-0.70710678F, -0.70710678F},
    {0.0F, -1.0F},
    {0.70710678F, -0.70710678F}};

/// Appends vertices and triangles of things, which have none of the ground's fine pattern.
struct LowPolyBuilder {
    std::vector<models::ColourVertex>& vertices;
    std::vector<std::uint32_t>& indices;

    std::uint32_t add(const glm::vec3& at_m, const glm::vec3& colour) {
        vertices.push_back({at_m, models::packed_colour(colour) & 0x00ffffffU});
        return static_cast<std::uint32_t>(vertices.size() - 1);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        indices.insert(indices.end(), {a, b, c});
    }
};

/// Where a thing stands. Nothing of it lies below that plane, which may be painted before it.
struct GroundAnchor {
    glm::vec3 at_m;
    glm::vec2 ground_slope; ///< metres up a metre east and north

    /// Height of the ground over the foot, so far off.
    float height_at_offset_m(const glm::vec2& off_m) const { return ground_slope.x * off_m.x + ground_slope.y * off_m.y; }
};

/// A tree's colours under light: of sides that face the compass, and from above.
struct TreeColours {
    std::array<glm::vec3, 8> sides;
    glm::vec3 top;
};

enum class TreeShape { Conical, Round };

/// How finely a tree is built. Far ones have four sides, others eight; near ones are rounder.
enum class TreeLod { Near, Medium, Far };

/// `size_m`: radius and height. The crown's rings lie along the ground.
void add_tree(
    LowPolyBuilder& to,
    const GroundAnchor& anchor,
    const glm::vec2& size_m,
    TreeShape shape,
    TreeLod detail,
    const TreeColours& light);

/// Four walls and a gable roof. `along` (unit) is the ridge's direction, `size_m` half the length,
/// half the width and the height; `height_share`, 0..1, says how much of the height there is yet; walls
/// face along, to the left, back and to the right, the roof's sides left and right.
void add_house(
    LowPolyBuilder& to,
    const GroundAnchor& anchor,
    const glm::vec2& along,
    const glm::vec3& size_m,
    float height_share,
    const std::array<glm::vec3, 4>& wall,
    const std::array<glm::vec3, 2>& roof);

} // namespace octant::visuals::nature
