#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>

namespace octant::visuals::refine {

/// A unit vector in 32 bits by octahedral coding: it is projected onto an octahedron, which is unfolded into a square
/// with 16 bits an axis. The error is below 1e-4 rad.
struct PackedNormal {
    std::int16_t x = 0;
    std::int16_t y = 0;

    bool operator==(const PackedNormal&) const = default;
};

/// Packs a vector of any length. A zero vector becomes +z.
inline PackedNormal packed(const glm::vec3& normal) {
    const float sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    if (!(sum > 0.0F)) { return {}; }
    float x = normal.x / sum;
    float y = normal.y / sum;
    if (normal.z < 0.0F) {
        const float folded_x = (1.0F - std::abs(y)) * (x < 0.0F ? -1.0F : 1.0F);
        y = (1.0F - std::abs(x)) * (y < 0.0F ? -1.0F : 1.0F);
        x = folded_x;
    }
    return {static_cast<std::int16_t>(std::lround(x * 32767.0F)), static_cast<std::int16_t>(std::lround(y * 32767.0F))};
}

/// The unit vector that was packed.
inline glm::vec3 unpacked(const PackedNormal& normal) {
    float x = static_cast<float>(normal.x) / 32767.0F;
    float y = static_cast<float>(normal.y) / 32767.0F;
    const float z = 1.0F - std::abs(x) - std::abs(y);
    const float fold = z < 0.0F ? -z : 0.0F;
    x += x < 0.0F ? fold : -fold;
    y += y < 0.0F ? fold : -fold;
    return glm::normalize(glm::vec3(x, y, z));
}

/// A colour as three display values, 0 to 1 each, in 16 bits.
struct PackedColour {
    std::uint16_t red = 65535;
    std::uint16_t green = 65535;
    std::uint16_t blue = 65535;

    bool operator==(const PackedColour&) const = default;
};

/// Packs a colour; parts outside 0 to 1 are clamped.
inline PackedColour packed_rgb16(const glm::vec3& colour) {
    const auto part = [](float value) {
        return static_cast<std::uint16_t>(std::lround(glm::clamp(value, 0.0F, 1.0F) * 65535.0F));
    };
    return {part(colour.x), part(colour.y), part(colour.z)};
}

inline glm::vec3 unpacked(const PackedColour& colour) {
    return glm::vec3(colour.red, colour.green, colour.blue) / 65535.0F;
}

/// The colour as the renderer takes it, 8 bits a part: the same rounding as models::packed_colour.
inline std::uint32_t packed_rgba8(const PackedColour& colour) {
    const auto byte = [](std::uint32_t part) { return (part * 255U + 32767U) / 65535U; };
    return byte(colour.red) | byte(colour.green) << 8U | byte(colour.blue) << 16U | 0xff000000U;
}

} // namespace octant::visuals::refine
