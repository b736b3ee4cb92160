#pragma once

#include "visuals/gl/draw_state.h"
#include "visuals/gl/stream_buffer.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/ground_texture.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace octant::visuals::gl {

/// Draws what lies in world axes: ground, shadows, sky. From a plan's upload on, each call draws of
/// that plan.
class TrianglePainter {
public:
    TrianglePainter(const Functions& gl, DrawState& state);

    /// Throws Error when the driver has no memory for it.
    void load_texture(const scene::GroundTexture& texture);

    bool has_texture() const { return texture_.has_value(); }

    void upload(const scene::FramePlan& plan);

    void draw_sky(Depth depth);

    /// The whole list in its order.
    void draw_ground(Depth depth);

    /// FramePlan::shadow_indices.
    void draw_shadows();

    /// FramePlan::repaint_indices `first` to `first + count - 1`, without depth. No clip = not cut.
    void repaint(std::uint32_t first, std::uint32_t count, const scene::Clip* clip);

    /// The same triangles into the depth buffer alone, where they are nearest.
    void draw_depth(std::uint32_t first, std::uint32_t count);

private:
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    /// What the ground of a plan with a texture is drawn with.
    struct GroundTexturing {
        ProgramPair programs;
        Object albedo;
        Object normal;
    };

    const ProgramPair& ground_programs() const {
        return shows_mesh_ ? *mesh_programs_ : textured_ ? texture_->programs : ground_programs_;
    }

    void use_mesh_look(const scene::FramePlan& plan);
    void draw(Range indices, GLint first_vertex);

    const Functions& gl_;
    DrawState& state_;
    ProgramPair ground_programs_;
    ProgramPair sky_programs_;
    std::optional<GroundTexturing> texture_;
    std::optional<ProgramPair> mesh_programs_;
    bool shows_mesh_ = false; ///< the plan asks for it
    bool textured_ = false;   ///< the plan asks for it
    StreamBuffer vertices_;   ///< ground, shadows, sky
    StreamBuffer indices_;    ///< ground, repainted, shadows, sky
    Object array_;
    Range ground_;
    Range edge_on_;
    Range repainted_;
    Range shadows_;
    Range sky_;
    GLint first_sky_vertex_ = 0;
};

} // namespace octant::visuals::gl
