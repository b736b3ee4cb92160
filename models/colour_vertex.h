#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace octant::models {

/// A vertex as it goes to the graphics card. 16 bytes.
struct ColourVertex {
    glm::vec3 position_m{0.0F}; ///< world axes, metres, eye point subtracted
    /// Red in the lowest byte, then green, blue, alpha; each 0..255. Red, green and blue are display values
    /// (models/material.h). Alpha means
    /// - for transparent triangles: the opacity;
    /// - for ground and shadows with a ground texture: the share of its light that is left; 0: the vertex has its own
    ///   colour, without the texture;
    /// - for ground coloured by its vertices: the number of its mixture of land covers (scene::LandCoverContrast).
    std::uint32_t colour = 0;
};

/// Packs display values 0..1 (clamped, rounded) with full alpha.
inline std::uint32_t packed_colour(const glm::vec3& rgb) {
    const auto byte = [](float part) {
        const float scaled = 255.0F * (part > 0.0F ? (part < 1.0F ? part : 1.0F) : 0.0F);
        // As std::lround(), which is a function of the C library.
        const auto below = static_cast<std::uint32_t>(scaled);
        return below + (scaled - static_cast<float>(below) >= 0.5F ? 1U : 0U);
    };
    return byte(rgb.x) | byte(rgb.y) << 8U | byte(rgb.z) << 16U | 0xff000000U;
}

} // namespace octant::models
