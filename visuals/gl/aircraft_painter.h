#pragma once

#include "visuals/gl/draw_state.h"
#include "visuals/gl/model_array.h"
#include "visuals/gl/stream_buffer.h"
#include "visuals/scene/frame_plan.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::gl {

/// Draws aircraft. From a plan's upload on, each call draws of that plan.
class AircraftPainter {
public:
    AircraftPainter(const Functions& gl, DrawState& state);

    /// In place of those loaded before; AircraftDraw::model counts in this list.
    void load_models(std::span<const scene::ModelBuffers> models);

    /// Whether a plan may ask for solid aircraft, and so for depth.
    bool has_meshes() const { return has_meshes_; }

    /// Of any mesh that comes as scene::ModelVertex.
    const ProgramPair& programs() const { return programs_; }

    /// That every draw names a model, indices and parts that are there is asserted.
    void upload(const scene::FramePlan& plan);

    /// Puts an aircraft 100 m ahead into a plan without any, if a model is loaded.
    void add_any(scene::FramePlan& plan) const;

    /// FramePlan::aircraft `first` to `first + count - 1` in this order, by one call. No clip = not
    /// cut.
    void
    draw(std::uint32_t first, std::uint32_t count, Depth depth, const scene::Clip* clip = nullptr);

private:
    struct ModelPlace {
        std::size_t first_index = 0;
        std::size_t index_count = 0;
        GLint first_vertex = 0;
        std::size_t parts = 0; ///< body and turning parts
    };

    /// As glMultiDrawElementsIndirect reads it.
    struct Command {
        GLuint index_count = 0;
        GLuint instance_count = 0;
        GLuint first_index = 0;
        GLint first_vertex = 0;
        GLuint first_instance = 0; ///< of instance_buffer_
    };

    const Functions& gl_;
    DrawState& state_;
    ProgramPair programs_;
    Object model_vertices_;
    Object model_indices_;
    StreamBuffer part_buffer_;
    StreamBuffer smooth_buffer_;
    StreamBuffer instance_buffer_;
    StreamBuffer command_buffer_;
    Object array_;
    std::vector<ModelPlace> models_;
    std::vector<Command> commands_; ///< one for each aircraft
    std::vector<ModelInstance> instances_;
    bool has_meshes_ = false;
};

} // namespace octant::visuals::gl
