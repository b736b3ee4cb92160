#pragma once

#include "visuals/scene/frame_plan.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace octant::visuals::raster {

/// A vertex in screen coordinates.
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

/// Sides of the view frustum that a vertex is outside of.
enum OutcodeBits : std::uint32_t {
    left_of_view = 1,
    right_of_view = 2,
    above_view = 4,
    below_view = 8,
    beyond_range = 16 ///< nearer than the near plane, or too far aside for 32-bit coordinates in 1/256 pixel
};

/// Clip coordinates of a vertex, for clipping.
struct ClipPosition {
    float x = 0.0F;
    float y = 0.0F;
    float w = 0.0F;
};

/// Colour of a flat polygon, from its first vertex.
struct FlatColour {
    static constexpr std::uint32_t smooth = 1;
    static constexpr std::uint32_t back_facing = 2;

    std::array<float, 3> rgb{}; ///< 0..255
    std::uint32_t flags = 0;

    /// The corners' own colours count.
    bool is_smooth() const { return (flags & smooth) != 0; }

    /// The eye sees its back, by more than rounding. Of its triangles those that are as narrow as the rounding of
    /// corners may seem to face the eye nevertheless.
    bool is_back_facing() const { return (flags & back_facing) != 0; }
};

/// Vertex of a polygon that is lit at each pixel.
struct LitVertex {
    std::array<float, 3> normal{}; ///< world axes, unit
    std::array<float, 3> to_eye{}; ///< world axes, metres
    std::array<float, 3> rgb{};    ///< its own colour, 0..255
    std::array<float, 3> haze{};   ///< the haze's colour times its share, 0..255
    float transmittance = 1.0F;    ///< what the haze leaves of its own colour
};

/// From world axes with the eye subtracted to pixels.
struct Projection {
    glm::mat4 world_to_clip{1.0F};
    glm::vec2 half_px{0.0F}; ///< half of the picture's size
    float near_m = 0.0F;     ///< the near plane: parts with a smaller w are cut off
    /// Bounds of |x / w| and |y / w| of vertices that are projected.
    glm::vec2 max_over_w{0.0F};
    glm::ivec2 size_px{0};
};

/// For pictures of at most 8,192 pixels each way.
Projection projection_of(const scene::FramePlan& plan, const glm::ivec2& size_px);

/// Fills in all members of `vertex` but the values.
void place(const Projection& projection, const ClipPosition& clip, ScreenVertex& vertex);

} // namespace octant::visuals::raster
