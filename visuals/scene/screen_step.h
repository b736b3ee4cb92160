#pragma once

namespace octant::visuals::scene {

/// What renderers round screen positions to: 1/256 pixel.
inline constexpr double screen_step_px = 1.0 / 256.0;

} // namespace octant::visuals::scene
