#pragma once

#include "visuals/scene/renderer.h"

namespace octant::ui::studies::draw_order {

/// A renderer that looks at plans in place of a session's own: it has no window, shows no inset and waits for nothing.
class StudyRenderer : public visuals::scene::Renderer {
public:
    void draw_inset(const visuals::scene::FramePlan&, const visuals::scene::PixelRect&) final {}

    void finish() final {}

    int draw_calls() const final { return 0; }

    void set_window_target(const glm::ivec2&) final {}

    bool is_drawn_to_window() const final { return false; }

    void copy_to_window(const glm::ivec2&) final {}
};

} // namespace octant::ui::studies::draw_order
