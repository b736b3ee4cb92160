#pragma once

#include "visuals/overlay/overlay_canvas.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::overlay {

/// Lines of text in the upper left corner of a picture, in the strokes of the head-up display:
/// small letters become capitals. A line that is too long for the picture is cut.
class PictureText {
public:
    /// The lines over what the picture shows otherwise. Sizes go with the picture's height. Valid
    /// until the next call.
    scene::OverlayDraw draw(
        std::span<const std::string> lines,
        const glm::ivec2& size_px,
        const scene::OverlayDraw& under);

private:
    OverlayCanvas canvas_;
    std::vector<scene::OverlayVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

} // namespace octant::visuals::overlay
