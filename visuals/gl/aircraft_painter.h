#pragma once

#include "visuals/gl/draw_state.h"
#include "visuals/gl/object.h"
#include "visuals/scene/frame_plan.h"

#include <cstddef>
#include <cstdint>
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
    std::uint32_t first_texture = 0; ///< of its model, among those of all models
};

/// The textures of all loaded models, in buffers that shaders read (texture.glsl).
class TextureBuffers {
public:
    explicit TextureBuffers(const Functions& gl);

    /// Uploads the textures of the models in place of those before. Pictures lose their finest levels where the driver
    /// has no room for all.
    void load(std::span<const scene::ModelBuffers> models);

    bool is_empty() const { return is_empty_; }

    /// The number of a model's first texture.
    std::uint32_t first_texture(std::size_t model) const { return firsts_[model]; }

    void bind() const;

private:
    const Functions& gl_;
    Object table_;
    Object levels_;
    Object texels_;
    std::vector<std::uint32_t> firsts_; ///< one a model
    bool is_empty_ = true;
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
    const ProgramPair& programs() const {
        const std::optional<ProgramPair>& other = lights_pixels_ ? phong_programs_ : textured_programs_;
        return other ? *other : programs_;
    }

    bool has_textures() const { return !textures_.is_empty(); }

    /// The number of the first texture of a loaded model.
    std::uint32_t first_texture(std::size_t model) const { return textures_.first_texture(model); }

    /// Prepares a step of aircraft or refined meshes for programs(): which program, and how it blends.
    void begin_step(const scene::PaintStep& step, const scene::Clip* clip);
    void end_step(const scene::PaintStep& step);

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
    struct IndirectDraw {
        GLuint index_count = 0;
        GLuint instance_count = 0;
        GLuint first_index = 0;
        GLint first_vertex = 0;
        GLuint first_instance = 0; ///< of instance_buffer_
    };

    /// Appends the indices of a draw of several ranges to joined_indices_ and lets its command read them there.
    void append_ranges(const scene::AircraftDraw& draw, IndirectDraw& command);
    void draw_commands(std::size_t first, std::size_t count);

    const Functions& gl_;
    DrawState& state_;
    ProgramPair programs_;
    std::optional<ProgramPair> textured_programs_; ///< made for the first models with textures
    std::optional<ProgramPair> phong_programs_;    ///< made for the first plan that lights pixels
    TextureBuffers textures_;
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
    std::vector<IndirectDraw> commands_;            ///< one for each aircraft
    std::vector<std::uint8_t> uses_joined_indices_; ///< whether a command reads joined_index_buffer_
    std::vector<ModelInstance> instances_;
    bool has_depth_drawn_meshes_ = false;
};

/// Draws FramePlan::refined: meshes that are uploaded anew for each picture, by the programs and the buffers of the
/// aircraft. From a plan's upload on, each step is one of that plan.
class RefinedPainter {
public:
    RefinedPainter(const Functions& gl, DrawState& state);

    /// To be called after AircraftPainter::upload, which uploads parts and bits for both.
    void upload(const scene::FramePlan& plan, const AircraftPainter& aircraft);

    /// A step of Refined, by the aircraft's programs. No clip = not cut.
    void draw(const scene::PaintStep& step, const scene::Clip* clip, AircraftPainter& aircraft);

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

} // namespace octant::visuals::gl
