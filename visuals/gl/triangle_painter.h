#pragma once

#include "visuals/gl/draw_state.h"
#include "visuals/gl/object.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace octant::visuals::gl {

/// Draws what lies in world axes: ground, shadows, sky. From a plan's upload on, each step is one of that plan.
class TrianglePainter {
public:
    TrianglePainter(const Functions& gl, DrawState& state);

    /// Uploads the ground's texture in place of one loaded before. Throws Error and keeps that one when the driver has
    /// no memory for it.
    void load_texture(const scene::GroundTexture& texture);

    bool has_texture() const { return texture_.has_value(); }

    void upload(const scene::FramePlan& plan);

    /// A step of Sky, Ground or GroundRepaint. No clip = not cut; the sky never is.
    void draw(const scene::PaintStep& step, const scene::Clip* clip);

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
        return shows_mesh_            ? *mesh_programs_
               : is_textured_         ? texture_->programs
               : has_polygon_numbers_ ? *polygon_number_programs_
                                      : ground_programs_;
    }

    void use_mesh_display(const scene::FramePlan& plan);
    void use_detail_texture(const scene::FramePlan& plan);

    const Functions& gl_;
    DrawState& state_;
    ProgramPair ground_programs_;
    ProgramPair sky_programs_;
    std::shared_ptr<const scene::LandCoverContrast> uploaded_contrast_; ///< in the next two
    std::optional<Object> contrast_;
    std::optional<Object> detail_texture_;
    std::optional<GroundTexturing> texture_;
    std::optional<ProgramPair> mesh_programs_;
    std::optional<ProgramPair> polygon_number_programs_;
    bool shows_mesh_ = false;          ///< as the plan says
    bool is_textured_ = false;         ///< as the plan says
    bool has_polygon_numbers_ = false; ///< as the plan says
    StreamMesh mesh_;                  ///< vertices of ground, shadows and sky; indices of ground, repaint and sky
    Range ground_;
    Range repaint_range_;
    Range sky_;
    GLint first_sky_vertex_ = 0;
};

/// Draws steps of Overlay and Transparent: upload() once for each plan, then draw() for each step.
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
    StreamMesh mesh_;
    std::size_t index_count_ = 0;
};

} // namespace octant::visuals::gl
