#pragma once

#include "visuals/scene/frame_plan.h"

#include <cstdint>

namespace octant::visuals::scene {

/// What colours show of models.
enum class ModelLook {
    None,    ///< their own colours
    Shading, ///< smooth polygons in one colour, flat ones in another
    Levels   ///< a colour for each halving of what the surface is wrong by there; white = exact
};

/// Of smooth and of flat polygons where the look is at shading.
inline constexpr Tints shading_tints{.smooth = 0xffe6a050U, .flat = 0xff3090ffU};

/// As ColourVertex::colour: of a surface of that error in a model of that radius.
std::uint32_t level_colour(double error_m, double radius_m);

} // namespace octant::visuals::scene
