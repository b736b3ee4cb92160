#pragma once

#include "visuals/gl/draw_state.h"
#include "visuals/gl/stream_buffer.h"
#include "visuals/scene/frame_plan.h"

namespace octant::visuals::gl {

/// Draws what lies over the picture.
class OverlayPainter {
public:
    OverlayPainter(const Functions& gl, DrawState& state);

    /// Over whatever the viewport, of this size in pixels, shows. Touches nothing where the overlay
    /// is empty. Leaves blending off.
    void draw(const scene::OverlayDraw& overlay, int width, int height);

private:
    const Functions& gl_;
    DrawState& state_;
    ProgramPair programs_; ///< never cut
    StreamBuffer vertices_;
    StreamBuffer indices_;
    Object array_;
};

} // namespace octant::visuals::gl
