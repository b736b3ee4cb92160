#pragma once

#include "visuals/overlay/overlay_canvas.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <span>
#include <string>

namespace octant::visuals::overlay {

/// Lines of text in the upper left corner of a picture, in the strokes of the head-up display: small letters become
/// capitals. A line that is too long for the picture goes on below, indented.
class PictureText {
public:
    /// Sizes go with the picture's height. Valid until the next call.
    scene::OverlayDraw draw(std::span<const std::string> lines, const glm::ivec2& size_px);

private:
    OverlayCanvas canvas_;
};

} // namespace octant::visuals::overlay
