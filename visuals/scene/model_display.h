#pragma once

#include "visuals/scene/frame_plan.h"

#include <cstdint>

namespace octant::visuals::scene {

/// What colours show of models.
enum class ModelDisplay {
    /// Aircraft have their own colours.
    None,
    /// Smooth polygons have one colour, flat ones another.
    Shading,
    /// A colour for each halving of what the surface is wrong by there; white where it is exact.
    Levels
};

/// Of smooth and of flat polygons where the look is at shading.
inline constexpr PolygonTints shading_tints{.smooth = 0xffe6a050U, .flat = 0xff3090ffU};

/// As ColourVertex::colour: of a surface of that error in a model of that radius.
std::uint32_t level_colour(double error_m, double radius_m);

} // namespace octant::visuals::scene
