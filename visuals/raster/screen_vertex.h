#pragma once

#include <array>
#include <cstdint>

namespace octant::visuals::raster {

/// A corner on its way to the picture.
struct ScreenVertex {
    static constexpr std::int32_t per_px = 256;

    /// Right and down from the middle of the picture's upper left pixel, 1/256 pixel. Without meaning where `outcode`
    /// has the bit `beyond_range`.
    std::int32_t x = 0;
    std::int32_t y = 0;
    float inverse_w = 0.0F;    ///< one over the depth along the line of sight, 1/m
    std::uint32_t outcode = 0; ///< bits of Outside
    /// Red, green, blue and on ground the number of its covers, 0..255; on textured ground its place in the texture's
    /// texels (x, y), the share of light that a shadow leaves, and that of haze.
    std::array<float, 4> value{};
};

/// Where a corner lies outside the view frustum.
enum OutcodeBits : std::uint32_t {
    left_of_view = 1,
    right_of_view = 2,
    above_view = 4,
    below_view = 8,
    beyond_range = 16 ///< nearer than the near plane, or too far aside for a place in 1/256 pixels
};

/// Clip coordinates of a corner, which cutting needs.
struct ClipPosition {
    float x = 0.0F;
    float y = 0.0F;
    float w = 0.0F;
};

/// What a polygon of an aircraft has at its first corner.
struct FlatColour {
    std::array<float, 3> rgb{}; ///< 0..255
    bool is_smooth = false;     ///< the corners' own colours count
    /// The eye sees its back, by more than rounding. Of its triangles those that are as narrow as the rounding of
    /// corners may seem to face the eye nevertheless.
    bool is_back_facing = false;
};

/// What a corner of a polygon that is lit in each pixel brings.
struct LitVertex {
    std::array<float, 3> normal{}; ///< world axes, unit
    std::array<float, 3> to_eye{}; ///< world axes, metres
    std::array<float, 3> rgb{};    ///< its own colour, 0..255
    std::array<float, 3> haze{};   ///< the haze's colour times its share, 0..255
    float transmittance = 1.0F;    ///< what the haze leaves of its own colour
};

} // namespace octant::visuals::raster
