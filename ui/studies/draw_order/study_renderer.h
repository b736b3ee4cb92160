#pragma once

#include "visuals/scene/renderer.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace octant::ui::studies::draw_order {

/// A renderer that draws plans by others, in place of a session's own. Its session keeps the size of its pictures and
/// has neither a window nor an inset.
class StudyRenderer : public visuals::scene::Renderer {
public:
    const visuals::scene::RendererInfo& info() const final { return info_; }

    void load_models(std::span<const visuals::scene::ModelBuffers> models) override {
        for (const auto& renderer : renderers_) { renderer->load_models(models); }
    }

    void load_ground_texture(const visuals::scene::GroundTexture& texture) final {
        for (const auto& renderer : renderers_) { renderer->load_ground_texture(texture); }
    }

    void warm_up() final {
        for (const auto& renderer : renderers_) { renderer->warm_up(); }
    }

    void finish() final {}

    int draw_calls() const final { return 0; }

    // What needs a window, an inset or another size.

    std::unique_ptr<visuals::scene::Renderer> sibling(const glm::ivec2&, int) const final { return nullptr; }

    void resize(const glm::ivec2&, std::optional<int>) final {}

    void draw_inset(const visuals::scene::FramePlan&, const visuals::scene::PixelRect&) final {}

    void set_window_target(const glm::ivec2&) final {}

    bool is_drawn_to_window() const final { return false; }

    void copy_to_window(const glm::ivec2&) final {}

protected:
    visuals::scene::RendererInfo info_;
    std::vector<std::unique_ptr<visuals::scene::Renderer>> renderers_;
};

} // namespace octant::ui::studies::draw_order
