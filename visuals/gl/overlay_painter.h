#pragma once

#include "visuals/gl/draw_state.h"
#include "visuals/gl/stream_buffer.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <cstddef>

namespace octant::visuals::gl {

/// Draws what lies over the picture. From an upload on, each step is one of that overlay.
class OverlayPainter {
public:
    OverlayPainter(const Functions& gl, DrawState& state);

    /// For a viewport of this size in pixels.
    void upload(const scene::OverlayDraw& overlay, const glm::ivec2& size_px);

    /// A step of Overlay. Leaves blending off.
    void draw(const scene::PaintStep& step);

private:
    const Functions& gl_;
    DrawState& state_;
    ProgramPair programs_; ///< never cut
    StreamBuffer vertices_;
    StreamBuffer indices_;
    Object array_;
    std::size_t index_count_ = 0;
};

} // namespace octant::visuals::gl
