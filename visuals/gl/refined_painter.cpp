#include "visuals/gl/refined_painter.h"

#include <cassert>

namespace octant::visuals::gl {
namespace {

constexpr std::size_t first_capacity_bytes = std::size_t{1} << 12;

} // namespace

RefinedPainter::RefinedPainter(const Functions& gl, DrawState& state)
    : gl_(gl)
    , state_(state)
    , vertices_(gl, "refined vertices", first_capacity_bytes)
    , indices_(gl, "refined indices", first_capacity_bytes)
    , instances_(gl, "refined instances", first_capacity_bytes)
    , array_(make_model_array(
          gl, vertices_.name(), indices_.name(), instances_.name(), "refined aircraft")) {}

void RefinedPainter::upload(const scene::FramePlan& plan) {
    ranges_.clear();
    instance_values_.clear();
    if (plan.refined.empty()) {
        return;
    }
    pieces_.clear();
    std::size_t vertices = 0;
    std::size_t indices = 0;
    for (const scene::RefinedDraw& draw : plan.refined) {
        assert(draw.first_smooth < plan.smooth.size() && draw.first_part < plan.parts.size());
        ranges_.push_back({indices, draw.indices.size(), static_cast<GLint>(vertices)});
        instance_values_.push_back(
            {draw.first_part, draw.first_smooth, draw.tints.smooth, draw.tints.flat});
        vertices += draw.vertices.size();
        indices += draw.indices.size();
        pieces_.push_back(std::as_bytes(draw.vertices));
    }
    vertices_.fill(pieces_);
    pieces_.clear();
    for (const scene::RefinedDraw& draw : plan.refined) {
        pieces_.push_back(std::as_bytes(draw.indices));
    }
    indices_.fill(pieces_);
    instances_.fill({std::as_bytes(std::span(instance_values_))});
}

void RefinedPainter::draw(
    const scene::PaintStep& step, const scene::Clip* clip, const ProgramPair& programs) {
    assert(std::size_t{step.first} + step.count <= ranges_.size());
    assert(step.depth != scene::DepthUse::DepthOnly);
    if (step.count == 0) {
        return;
    }
    state_.use_depth(step.depth);
    state_.cull_back_faces(true);
    state_.use_program(programs, clip);
    gl_.bind_vertex_array(array_.name());
    for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
        gl_.draw_elements_instanced(
            GL_TRIANGLES,
            static_cast<GLsizei>(ranges_[i].index_count),
            GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(ranges_[i].first_index * sizeof(std::uint32_t)),
            1,
            ranges_[i].first_vertex,
            i);
        state_.count_draw_call();
    }
}

} // namespace octant::visuals::gl
