#pragma once

#include "visuals/overlay/head_up_glass.h"
#include "visuals/overlay/overlay_canvas.h"

#include <glm/vec3.hpp>

namespace octant::visuals::overlay {

/// Draws the horizon and the rungs of pitch where they are in the world, around the azimuth of
/// `anchor` (world axes, any length): whole lines above the horizon, dashes below, ends bent
/// towards the horizon, numbers beside them in degrees. As many degrees apart as fit.
void draw_pitch_ladder(
    const HudGlass& glass, const glm::dvec3& anchor, float letter_px, OverlayCanvas& canvas);

} // namespace octant::visuals::overlay
