#pragma once

#include "visuals/gl/aircraft_painter.h"
#include "visuals/gl/context.h"
#include "visuals/gl/draw_state.h"
#include "visuals/gl/framebuffer.h"
#include "visuals/gl/object.h"
#include "visuals/gl/triangle_painter.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/renderer.h"

#include <glm/vec2.hpp>

#include <memory>
#include <optional>
#include <span>

namespace octant::visuals::gl {

/// Draws frame plans by OpenGL into a picture of its own, with a 32-bit float depth buffer that is attached only where
/// a plan asks for depth.
///
/// Colours are display values from input to picture: nothing is converted. Back faces of aircraft are not drawn. Those
/// of the ground are: the plan has left them out but for triangles seen edge-on, which the driver must judge by the
/// positions it draws. A flat triangle of an aircraft has the colour of its first vertex: a polygon split into a fan
/// around its first corner keeps one colour.
///
/// Every call that needs it makes the context current by itself, so that renderers can take turns in a thread. A change
/// from one context to another takes 1 or 2 us.
class Renderer final : public scene::Renderer {
public:
    /// Picture size in pixels, 1 or 4 samples a pixel. The context stays alive as long as a renderer that draws with
    /// it. Throws Error when the driver cannot.
    Renderer(std::shared_ptr<Context> context, const glm::ivec2& size_px, int samples);
    ~Renderer() override;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    Renderer(Renderer&&) = delete;
    Renderer& operator=(Renderer&&) = delete;

    const scene::RendererInfo& info() const override { return context_->info(); }

    std::unique_ptr<scene::Renderer> sibling(const glm::ivec2& size_px, int samples) const override;

    void resize(const glm::ivec2& size_px, std::optional<int> samples) override;
    void load_models(std::span<const scene::ModelBuffers> models) override;
    void load_ground_texture(const scene::GroundTexture& texture) override;
    void warm_up() override;
    void draw(const scene::FramePlan& plan) override;
    void draw_inset(const scene::FramePlan& plan, const scene::PixelRect& rect) override;
    void finish() override;
    void finish_and_read(scene::Picture& picture) override;

    int draw_calls() const override { return state_.draw_calls(); }

    /// Pictures are drawn straight into framebuffer 0, the window's, where they have its size, one sample a pixel and
    /// no depth, not even for meshes that later plans may draw.
    void set_window_target(const glm::ivec2& window_px) override { window_px_ = window_px; }

    bool is_drawn_to_window() const override { return row_order_ == RowOrder::BottomUp; }

    void copy_to_window(const glm::ivec2& size_px) override;

private:
    /// Where on the target a plan is drawn.
    struct DrawTarget {
        GLuint target = 0; ///< framebuffer
        scene::PixelRect rect;
        bool is_inset = false; ///< the scissor leaves no more than `rect`
    };

    GLuint target_of(const scene::FramePlan& plan) const;
    scene::PixelRect on_target(const scene::PixelRect& rect) const;
    void draw_into(const scene::FramePlan& plan, const DrawTarget& place);
    void upload(const scene::FramePlan& plan, const scene::PixelRect& rect);
    void paint(const scene::FramePlan& plan, const DrawTarget& place);
    void clear_depth(const scene::PixelBox& box, const DrawTarget& place);

    std::shared_ptr<Context> context_; ///< declared first, so that it is destroyed last
    const Functions& gl_;
    Framebuffer framebuffer_;
    StreamBuffer frame_uniforms_; ///< what all shaders read about the picture
    DrawState state_;
    TrianglePainter triangles_;
    AircraftPainter aircraft_;
    RefinedPainter refined_;
    OverlayPainter overlay_;
    glm::ivec2 window_px_{0};
    RowOrder row_order_ = RowOrder::TopDown; ///< of the last picture
};

} // namespace octant::visuals::gl
