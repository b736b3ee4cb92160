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

/// Draws FramePlan::refined: meshes that are uploaded anew for each picture, by the programs and
/// the buffers of the aircraft. From a plan's upload on, each step is one of that plan.
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

} // namespace octant::visuals::gl
