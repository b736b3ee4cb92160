#pragma once

#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

namespace octant::tests {

/// Alpha 0..1 of the last triangle of that hue that covers a place; 0 where there is none. Green = cores of lines, else
/// their shades.
double ink_at(const visuals::scene::OverlayDraw& draw, const glm::vec2& at_px, bool green = true);

} // namespace octant::tests
