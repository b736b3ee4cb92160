#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// Values over the ground, row after row from the south, each from the west.
struct GroundImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> texels;
    /// The world place of the first texel's middle.
    glm::dvec2 first_m{0.0};
    /// The way from one texel's middle to the next.
    glm::dvec2 step_m{1.0};
};

/// What the ground is lit and coloured with at each pixel instead of at each vertex.
struct GroundTexture {
    /// 3 bytes a texel: red, green, blue as display values, before light falls on it.
    GroundImage albedo;
    /// 2 bytes a texel: x and y of the unit normal, each 128 + 127 x.
    GroundImage normal;
    /// The mean colour of the lit ground, display values 0..1.
    glm::vec3 mean_colour{0.0F};
};

} // namespace octant::visuals::scene
