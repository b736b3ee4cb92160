#include "visuals/gl/overlay_painter.h"

#include "visuals/gl/program.h"
#include "visuals/gl/shader_sources.h"
#include "visuals/gl/vertex_array.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec4.hpp>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

namespace octant::visuals::gl {
namespace {

using scene::OverlayVertex;

constexpr GLint clip_per_px_uniform = 0; ///< place in the shader
constexpr std::size_t first_capacity_bytes = std::size_t{1} << 12;

Object make_array(const Functions& gl, const StreamBuffer& vertices, const StreamBuffer& indices) {
    Object array = make_vertex_array(gl, "overlay");
    gl.vertex_array_vertex_buffer(array.name(), 0, vertices.name(), 0, sizeof(OverlayVertex));
    gl.vertex_array_element_buffer(array.name(), indices.name());
    add_place_input(gl, array, position_input, offsetof(OverlayVertex, at_px));
    add_colour_input(gl, array, offsetof(OverlayVertex, colour));
    return array;
}

} // namespace

OverlayPainter::OverlayPainter(const Functions& gl, DrawState& state)
    : gl_(gl)
    , state_(state)
    , programs_{make_program(gl, "overlay", {overlay_vert, overlay_frag}), {}}
    , vertices_(gl, "overlay vertices", first_capacity_bytes)
    , indices_(gl, "overlay indices", first_capacity_bytes)
    , array_(make_array(gl, vertices_, indices_)) {}

void OverlayPainter::upload(const scene::OverlayDraw& overlay, const glm::ivec2& size_px) {
    index_count_ = overlay.indices.size();
    if (index_count_ == 0) {
        return;
    }
    vertices_.fill({std::as_bytes(overlay.vertices)});
    indices_.fill({std::as_bytes(overlay.indices)});
    const glm::vec4 clip_per_px(
        2.0F / static_cast<float>(size_px.x), 2.0F / static_cast<float>(size_px.y), 0.0F, 0.0F);
    gl_.program_uniform_4fv(
        programs_.unclipped.name(), clip_per_px_uniform, 1, glm::value_ptr(clip_per_px));
}

void OverlayPainter::draw(const scene::PaintStep& step) {
    assert(std::size_t{step.first} + step.count <= index_count_);
    if (step.count == 0) {
        return;
    }
    state_.use_depth(step.depth);
    state_.cull_back_faces(false);
    state_.use_program(programs_);
    state_.blend(true);
    gl_.bind_vertex_array(array_.name());
    gl_.draw_elements_base_vertex(
        GL_TRIANGLES,
        static_cast<GLsizei>(step.count),
        GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(step.first * sizeof(std::uint32_t)),
        0);
    state_.blend(false);
    state_.count_draw_call();
}

} // namespace octant::visuals::gl
