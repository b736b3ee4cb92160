#pragma once

#include "visuals/gl/draw_state.h"
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

    /// That every draw names a model, indices and parts that are there is asserted.
    void upload(const scene::FramePlan& plan);

    /// Puts an aircraft 100 m ahead into a plan without any, if a model is loaded.
    void add_any(scene::FramePlan& plan) const;

    /// FramePlan::aircraft `first` to `first + count - 1` in this order, without depth. No clip =
    /// not cut.
    void paint(std::uint32_t first, std::uint32_t count, const scene::Clip* clip);

    /// The same into the depth buffer, model by model: the order is kept only within a model.
    void draw_by_depth(std::uint32_t first, std::uint32_t count);

private:
    struct ModelPlace {
        std::size_t first_index = 0;
        std::size_t index_count = 0;
        GLint first_vertex = 0;
        std::size_t parts = 0; ///< body and turning parts
    };

    void draw_range(std::uint32_t first, std::uint32_t count, bool join);

    const Functions& gl_;
    DrawState& state_;
    ProgramPair programs_;
    Object model_vertices_;
    Object model_indices_;
    StreamBuffer parts_;
    StreamBuffer instances_; ///< AircraftDraw::first_part of each aircraft
    StreamBuffer commands_;
    Object array_;
    std::vector<ModelPlace> models_;
    std::span<const scene::AircraftDraw> aircraft_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> first_parts_;
};

} // namespace octant::visuals::gl
