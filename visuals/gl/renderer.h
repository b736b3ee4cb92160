#pragma once

#include "visuals/gl/context.h"
#include "visuals/gl/draw_state.h"
#include "visuals/gl/object.h"
#include "visuals/gl/triangle_painter.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/renderer.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::gl {

/// What the vertices of one aircraft have in common: scene::AircraftDraw, scene::RefinedDraw.
struct ModelInstance {
    std::uint32_t first_part = 0;
    std::uint32_t first_smooth = 0;
    std::uint32_t smooth_tint = 0;
    std::uint32_t flat_tint = 0;
};

/// The vertex array of scene::ModelVertex, one ModelInstance an instance.
Object make_model_array(
    const Functions& gl, GLuint vertices, GLuint indices, GLuint instances, const char* label = "aircraft");

/// Draws FramePlan::refined: meshes that are uploaded anew for each picture, by the programs and the buffers of the
/// aircraft. From a plan's upload on, each step is one of that plan.
class RefinedPainter {
public:
    RefinedPainter(const Functions& gl, DrawState& state);

    /// To be called after AircraftPainter::upload, which uploads parts and bits for both.
    void upload(const scene::FramePlan& plan);

    /// A step of Refined, by the aircraft's programs. No clip = not cut.
    void draw(const scene::PaintStep& step, const scene::Clip* clip, const ProgramPair& programs);

private:
    struct BufferRange {
        std::size_t first_index = 0;
        std::size_t index_count = 0;
        GLint first_vertex = 0;
    };

    const Functions& gl_;
    DrawState& state_;
    StreamBuffer vertices_;
    StreamBuffer indices_;
    StreamBuffer instances_;
    Object array_;
    std::vector<BufferRange> ranges_; ///< one a draw
    std::vector<ModelInstance> instance_values_;
    std::vector<std::span<const std::byte>> pieces_;
};

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

/// Colour (8 bits a part) and depth (32-bit float) to draw into, with 1 or 4 samples a pixel. Rows come out from the
/// top when it was drawn with the clip origin at the upper left.
class Framebuffer {
public:
    /// Throws Error when the driver cannot hold that size or `samples` is neither 1 nor 4.
    Framebuffer(const Functions& gl, int width, int height, int samples);

    int width() const { return width_; }

    int height() const { return height_; }

    /// The framebuffer object to draw into colour and depth.
    GLuint name() const { return with_depth_.name(); }

    /// The framebuffer object to draw into the same colour, without depth.
    GLuint name_without_depth() const { return without_depth_.name(); }

    /// Waits for the drawing and copies it, 4 * width * height bytes (asserted). Several samples are averaged. Leaves
    /// another framebuffer bound.
    void read(std::span<std::uint8_t> rgba) const;

    bool fits(const glm::ivec2& size_px, int samples) const {
        return size_px == glm::ivec2(width_, height_) && samples == samples_;
    }

    /// Copies it upside down into the lower left corner of another framebuffer, so that rows drawn from the top stand
    /// upright in a window; stretched where `size_px` is another size.
    void copy_to(GLuint target, const glm::ivec2& size_px) const;

private:
    GLuint averaged() const;
    Object make_storage(const char* label, int samples, GLenum format) const;
    Object make_target(const char* label, const Object& colour, const Object* depth) const;

    const Functions* gl_;
    int width_;
    int height_;
    int samples_;
    Object colour_;
    Object depth_;
    Object with_depth_;
    Object without_depth_;
    Object averaged_colour_; ///< empty with 1 sample
    Object averaged_;
};

/// Draws aircraft. From a plan's upload on, each step is one of that plan.
class AircraftPainter {
public:
    AircraftPainter(const Functions& gl, DrawState& state);

    /// Uploads the models in place of those loaded before; AircraftDraw::model counts in this list.
    void load_models(std::span<const scene::ModelBuffers> models);

    /// Whether a plan may draw an aircraft by depth among others that are painted in order.
    bool has_depth_drawn_meshes() const { return has_depth_drawn_meshes_; }

    /// Of the last upload's plan. They draw any mesh that comes as scene::ModelVertex.
    const ProgramPair& programs() const { return lights_pixels_ ? *phong_programs_ : programs_; }

    /// Asserts that every draw names a model, indices and parts that are there.
    void upload(const scene::FramePlan& plan);

    /// Puts an aircraft 100 m ahead into a plan without any, if a model is loaded.
    void add_one_of_each(scene::FramePlan& plan) const;

    /// A step of Aircraft, by one call unless aircraft of one range and of several take turns. No clip = not cut.
    void draw(const scene::PaintStep& step, const scene::Clip* clip);

private:
    struct ModelRange {
        std::size_t first_index = 0;
        std::size_t index_count = 0;
        GLint first_vertex = 0;
        std::size_t parts = 0; ///< body and turning parts
    };

    /// A draw as glMultiDrawElementsIndirect reads it.
    struct Command {
        GLuint index_count = 0;
        GLuint instance_count = 0;
        GLuint first_index = 0;
        GLint first_vertex = 0;
        GLuint first_instance = 0; ///< of instance_buffer_
    };

    /// Appends the indices of a draw of several ranges to joined_indices_ and lets its command read them there.
    void append_ranges(const scene::AircraftDraw& draw, Command& command);
    void draw_commands(std::size_t first, std::size_t count);

    const Functions& gl_;
    DrawState& state_;
    ProgramPair programs_;
    std::optional<ProgramPair> phong_programs_; ///< made for the first plan that lights pixels
    bool lights_pixels_ = false;
    Object model_vertices_;
    Object model_indices_;
    StreamBuffer part_buffer_;
    StreamBuffer smooth_buffer_;
    StreamBuffer instance_buffer_;
    StreamBuffer command_buffer_;
    StreamBuffer joined_index_buffer_;
    Object array_;
    Object joined_array_; ///< with joined_index_buffer_ in place of model_indices_
    std::vector<ModelRange> models_;
    std::vector<std::uint32_t> indices_;            ///< of all models
    std::vector<std::uint32_t> joined_indices_;     ///< of the draws of several ranges, one after the other
    std::vector<Command> commands_;                 ///< one for each aircraft
    std::vector<std::uint8_t> uses_joined_indices_; ///< whether a command reads joined_index_buffer_
    std::vector<ModelInstance> instances_;
    bool has_depth_drawn_meshes_ = false;
};

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

    std::shared_ptr<Context> context_; ///< goes after all that was made with it
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
