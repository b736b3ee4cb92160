#pragma once

#include "visuals/scene/frame_plan.h"
#include "visuals/scene/ground_texture.h"
#include "visuals/scene/picture.h"

#include <glm/vec2.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace octant::visuals::scene {

/// What draws, for reports.
struct RendererInfo {
    /// How it draws, and by what: "osmesa, OpenGL 4.5 (...)".
    std::string description;
    /// The GPU, or the driver's name for what stands in for one.
    std::string device;
    /// Whether a processor draws and not a GPU.
    bool is_software = false;
};

/// Makes pictures of frame plans: draws their steps in their order and decides nothing. Belongs to the thread that made
/// it, in which several may take turns.
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

    /// Draws pictures of another size or with other samples (1, 4 or 16 a pixel; nothing: as many as suit this
    /// renderer) from now on. Throws Error and leaves it as it is when it cannot.
    virtual void resize(const glm::ivec2& size_px, std::optional<int> samples) = 0;

    /// Loads the aircraft models, in place of those loaded before: AircraftDraw::model counts in this list.
    virtual void load_models(std::span<const ModelBuffers> models) = 0;

    /// Loads the ground's texture, in place of one loaded before: FramePlan::ground_texture asks for it. Throws Error
    /// and keeps that one when the driver has no memory for it.
    virtual void load_ground_texture(const GroundTexture& texture) = 0;

    /// Draws once in every state that a plan can ask for, because drivers compile on first use (14-18 ms each). To be
    /// called after loading; what the picture holds afterwards is undefined.
    virtual void warm_up() = 0;

    /// Begins other work on one of the threads that draw, so that it takes no core from them; false, and nothing is
    /// done, where there is none for it. `work` must not throw.
    virtual bool begin_on_idle_thread(std::function<void()> /*work*/) { return false; }

    /// Starts the drawing of a picture; the plan's memory is free again on return.
    virtual void draw(const FramePlan& plan) = 0;

    /// Draws a second plan, made for a picture of the size of `rect`, over that part of the picture that draw() has
    /// begun, as if it were a picture of its own, with a thin frame around it. `rect` must lie within the picture
    /// (asserted). The plan's memory is free again on return.
    virtual void draw_inset(const FramePlan& plan, const PixelRect& rect) = 0;

    /// Waits until the picture is drawn. Throws Error when the driver reports one.
    virtual void finish() = 0;

    /// finish(), then hands the picture over, once for each that is drawn; it cannot be copied to the window after
    /// that. What `picture` held may become the memory of the next one.
    virtual void finish_and_read(Picture& picture) = 0;

    /// finish(), then copies the picture, which may still be copied to the window. Not one that a driver drew straight
    /// into the window (asserted).
    virtual void finish_and_copy(Picture& picture) { finish_and_read(picture); }

    /// Calls of the graphics library for the last draw() and the insets since; without one, steps of painting.
    /// Consecutive aircraft of a step are one.
    virtual int draw_calls() const = 0;

    /// From now on pictures may be drawn straight into the window, which is so large, where they fit: that saves
    /// copying them there. 0,0 = no window.
    virtual void set_window_target(const glm::ivec2& window_px) = 0;

    /// Whether the last picture was drawn straight into the window: it cannot be read then.
    virtual bool is_drawn_to_window() const = 0;

    /// Waits for the picture and copies it into the lower left corner of the window, stretched to `size_px`, upright
    /// there.
    virtual void copy_to_window(const glm::ivec2& size_px) = 0;

protected:
    Renderer() = default;
};

} // namespace octant::visuals::scene
