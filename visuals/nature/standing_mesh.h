#pragma once

#include "models/colour_vertex.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::nature {

/// Eight directions, counter-clockwise from east.
inline constexpr std::array<glm::vec2, 8> compass_directions = {glm::vec2(1.0F, 0.0F), {0.70710678F, 0.70710678F},
    {0.0F, 1.0F}, {-0.70710678F, 0.70710678F}, {-1.0F, 0.0F}, {-0.70710678F, -0.70710678F}, {0.0F, -1.0F},
    {0.70710678F, -0.70710678F}};

/// Of red, green and blue.
inline constexpr glm::vec3 luminance_weights(0.2126F, 0.7152F, 0.0722F);

/// Where a thing stands, world axes with the eye subtracted. Nothing of it lies below that plane, which may be painted
/// before it.
struct GroundAnchor {
    glm::vec3 at_m;
    glm::vec2 slope;        ///< metres up a metre east and north
    glm::vec3 colour{0.0F}; ///< of the ground, display values, lit

    /// The height of the ground over the foot, so far off.
    float height_at_offset_m(const glm::vec2& off_m) const { return glm::dot(slope, off_m); }
};

/// A share in [0, 1) of eight of the bits.
inline float share_of(std::uint32_t random_bits, unsigned shift) {
    return static_cast<float>(random_bits >> shift & 0xffU) * (1.0F / 256.0F);
}

/// The lists to which the triangles of a thing are appended, from near to far. Those that face away are left out: near
/// the outline of a thing far off, where renderers cannot tell, they would be painted over those before them.
struct StandingMesh {
    std::vector<models::ColourVertex>& vertices;
    std::vector<std::uint32_t>& indices;

    /// Appends a vertex. `covers`: the number of its land covers, whose detail pattern it shows; 0 = none.
    std::uint32_t add(const glm::vec3& at_m, const glm::vec3& colour, std::uint32_t covers = 0) {
        vertices.push_back({at_m, (models::packed_colour(colour) & 0x00ffffffU) | covers << 24U});
        return static_cast<std::uint32_t>(vertices.size() - 1);
    }

    /// Counter-clockwise seen from outside.
    static bool faces_eye(const glm::vec3& a_m, const glm::vec3& b_m, const glm::vec3& c_m) {
        return glm::dot(glm::cross(b_m - a_m, c_m - a_m), a_m) < 0.0F;
    }

    /// Appends a triangle of vertices that were added, if it faces the eye.
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (faces_eye(vertices[a].position_m, vertices[b].position_m, vertices[c].position_m)) {
            indices.insert(indices.end(), {a, b, c});
        }
    }

    /// Appends a plane convex polygon of one colour, if it faces the eye.
    template <std::size_t corners>
    void face(const std::array<glm::vec3, corners>& at_m, const glm::vec3& colour, std::uint32_t covers = 0) {
        if (!faces_eye(at_m[0], at_m[1], at_m[2])) { return; }
        const std::uint32_t first = add(at_m[0], colour, covers);
        for (std::size_t i = 1; i < corners; ++i) { add(at_m[i], colour, covers); }
        for (std::uint32_t i = 2; i < corners; ++i) { triangle(first, first + i - 1, first + i); }
    }
};

} // namespace octant::visuals::nature
