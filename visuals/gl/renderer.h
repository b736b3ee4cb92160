#pragma once

#include "visuals/gl/aircraft_painter.h"
#include "visuals/gl/draw_state.h"
#include "visuals/gl/framebuffer.h"
#include "visuals/gl/overlay_painter.h"
#include "visuals/gl/picture.h"
#include "visuals/gl/refined_painter.h"
#include "visuals/gl/stream_buffer.h"
#include "visuals/gl/triangle_painter.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/ground_texture.h"

#include <glm/vec2.hpp>

#include <span>

namespace octant::visuals::gl {

/// A part of a picture, pixels from its upper left corner.
struct PixelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// Draws frame plans into a picture of its own. The context whose functions it was given must be
/// current in every call, the destructor too, and outlive it.
///
/// With HiddenSurface::DepthBuffer hidden surfaces are removed by a 32-bit float depth buffer and
/// FramePlan::steps are not looked at: all aircraft in their order, ground, shadows, sky. Else
/// sky, ground and steps are painted, each over what is there, and no depth buffer is attached
/// but for solids, which ask for it.
/// FramePlan::overlay comes last.
///
/// Colours are display values from input to picture: nothing is converted. Back faces of
/// aircraft are not drawn. Those of the ground are: the plan has left them out but for triangles
/// seen edge-on, which the driver must judge by the positions it draws. A flat triangle of an
/// aircraft has the colour of its first vertex: a polygon split into a fan around its first corner
/// keeps one colour.
class Renderer {
public:
    /// Picture size in pixels, 1 or 4 samples a pixel. Throws Error when the driver cannot.
    Renderer(const Functions& gl, int width, int height, int samples);

    /// Draws pictures of another size or with other samples from now on. Throws Error and leaves it
    /// as it is when the driver cannot.
    void resize(const glm::ivec2& size_px, int samples);

    /// From now on pictures are drawn straight into framebuffer 0, the window's, where they are as
    /// large as it, have one sample a pixel and need no depth, not even for meshes: that saves
    /// copying them there. 0,0 = no window.
    void aim_at_window(const glm::ivec2& window_px) { window_px_ = window_px; }

    /// Whether the last picture was: it cannot be read then.
    bool is_in_window() const { return rows_ == Rows::FromBelow; }

    /// Waits for the picture and copies it into the lower left corner of another framebuffer (0 =
    /// the window's), stretched to `size_px`, upright there.
    void copy_to(GLuint framebuffer, const glm::ivec2& size_px);

    /// Uploads the aircraft models, in place of those uploaded before. AircraftDraw::model counts
    /// in this list.
    void load_models(std::span<const scene::ModelBuffers> models);

    /// Uploads the ground's texture, in place of one uploaded before: FramePlan::ground_texture
    /// asks for it. Throws Error when the driver has no memory for it.
    void load_ground_texture(const scene::GroundTexture& texture);

    /// Draws once in every state that a plan can ask for, because drivers compile on first use
    /// (14-18 ms each). To be called after loading; what the picture holds afterwards is
    /// undefined.
    void warm_up();

    /// Starts the drawing of a picture; the plan's memory is free again on return.
    void draw(const scene::FramePlan& plan);

    /// Draws a second plan, made for a picture of the size of `rect`, over that part of the picture
    /// that draw() has begun, as if it were a picture of its own, with a thin frame around it.
    /// `rect` must lie within the picture (asserted). The plan's memory is free again on return.
    void draw_inset(const scene::FramePlan& plan, const PixelRect& rect);

    /// Waits until the picture is drawn. Throws Error when the driver reports one.
    void finish();

    /// finish(), then copies the picture, top row first. `picture` keeps its memory between calls.
    void finish_and_read(Picture& picture);

    /// Of the last draw() and the insets since; consecutive aircraft of a step are one.
    int draw_calls() const { return state_.draw_calls(); }

private:
    /// Where on the target a plan is drawn.
    struct Place {
        PixelRect rect;
        bool is_inset = false; ///< the scissor leaves no more than `rect`
    };

    GLuint target_of(const scene::FramePlan& plan) const;
    PixelRect on_target(const PixelRect& rect) const;
    void draw_into(const scene::FramePlan& plan, const Place& place);
    void clear(const scene::FramePlan& plan);
    void upload(const scene::FramePlan& plan, const PixelRect& rect);
    void paint(const scene::FramePlan& plan, const Place& place);
    void clear_depth(const scene::FramePlan& plan, const scene::PixelBox& box, const Place& place);
    void draw_by_depth(const scene::FramePlan& plan);

    const Functions& gl_;
    Framebuffer framebuffer_;
    StreamBuffer picture_values_; ///< what all shaders read about the picture
    DrawState state_;
    TrianglePainter triangles_;
    AircraftPainter aircraft_;
    RefinedPainter refined_;
    OverlayPainter overlay_;
    glm::ivec2 window_px_{0};
    Rows rows_ = Rows::FromTop; ///< of the last picture
};

} // namespace octant::visuals::gl
