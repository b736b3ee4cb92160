#pragma once

#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"

#include <glm/vec2.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace octant::visuals::scene {

/// The name of a renderer, for reports.
struct RendererInfo {
    /// The context and the library: "osmesa, OpenGL 4.5 (...)".
    std::string description;
    /// The GPU, or the driver's name for a software renderer.
    std::string device;
    /// Whether the CPU draws and not a GPU.
    bool is_software = false;
};

/// Makes pictures of frame plans: draws their steps in their order and decides nothing. To be used only by the thread
/// that made it; that thread may use several renderers in turn.
///
/// Calls, in this order: load_models(), load_ground_texture(), warm_up(); then for each picture draw(), any number of
/// draw_inset(), and one of finish(), finish_and_read(), finish_and_copy() or copy_to_window().
class Renderer {
public:
    virtual ~Renderer() = default;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    Renderer(Renderer&&) = delete;
    Renderer& operator=(Renderer&&) = delete;

    virtual const RendererInfo& info() const = 0;

    /// Another renderer on the same device, with nothing loaded. Throws Error when the driver cannot hold that size.
    virtual std::unique_ptr<Renderer> sibling(const glm::ivec2& size_px, int samples) const = 0;

    /// Changes the size and the samples (1, 4 or 16 a pixel; nothing = this renderer's default) of the following
    /// pictures. Throws Error and changes nothing when it cannot.
    virtual void resize(const glm::ivec2& size_px, std::optional<int> samples) = 0;

    /// Loads the aircraft models and replaces those loaded before. AircraftDraw::model is an index into this list.
    virtual void load_models(std::span<const ModelBuffers> models) = 0;

    /// Loads the texture of plans with FramePlan::ground_texture and replaces the one loaded before. Throws Error and
    /// keeps the old one when the driver has no memory for it.
    virtual void load_ground_texture(const GroundTexture& texture) = 0;

    /// Draws once in every state that a plan may need, because drivers compile on first use (14-18 ms each). Follows
    /// loading; the contents of the picture are undefined afterwards.
    virtual void warm_up() = 0;

    /// Runs `work` on an idle drawing thread, so that it takes no core from drawing. Returns false, and runs nothing,
    /// if none is idle. `work` must not throw.
    virtual bool begin_on_idle_thread(std::function<void()> /*work*/) { return false; }

    /// Starts the drawing of a picture. The plan is not used after the return.
    virtual void draw(const FramePlan& plan) = 0;

    /// Draws a second plan, made for a picture of the size of `rect`, over that part of the picture of the last draw(),
    /// with a thin frame around it. `rect` must lie within the picture (asserted). The plan is not used after the
    /// return.
    virtual void draw_inset(const FramePlan& plan, const PixelRect& rect) = 0;

    /// Waits until the picture is drawn. Throws Error when the driver reports one.
    virtual void finish() = 0;

    /// finish(), then moves the picture to `picture`, at most once for each draw(); it cannot be copied to the window
    /// after that. The old memory of `picture` may be reused for the next one.
    virtual void finish_and_read(Picture& picture) = 0;

    /// finish(), then copies the picture, which may still be copied to the window. Not for a picture that was drawn
    /// straight into the window (asserted).
    virtual void finish_and_copy(Picture& picture) { finish_and_read(picture); }

    /// The number of draw calls to the graphics library for the last draw() and its insets; without a library, of
    /// painting steps. Consecutive aircraft of a step count as one.
    virtual int draw_calls() const = 0;

    /// Allows the following pictures to be drawn straight into a window of this size if they fit, which saves a copy.
    /// 0,0 = no window.
    virtual void set_window_target(const glm::ivec2& window_px) = 0;

    /// Whether the last picture was drawn straight into the window, so that it cannot be read.
    virtual bool is_drawn_to_window() const = 0;

    /// Waits for the picture and copies it into the lower left corner of the window, upright and stretched to
    /// `size_px`.
    virtual void copy_to_window(const glm::ivec2& size_px) = 0;

protected:
    Renderer() = default;
};

} // namespace octant::visuals::scene
