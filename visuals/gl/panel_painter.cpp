#include "visuals/gl/panel_painter.h"

#include "visuals/gl/object.h"
#include "visuals/gl/shader_sources.h"

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec4.hpp>

#include <cassert>
#include <cstddef>

namespace octant::visuals::gl {
namespace {

// Places in the shaders.
constexpr GLint window_uniform = 0;
constexpr GLuint atlas_unit = 0;
constexpr GLuint atlas_input = 2;

constexpr std::size_t first_panel_bytes = std::size_t{1} << 18;

Object make_atlas(const Functions& gl, std::span<const std::uint8_t> texels, const glm::ivec2& size) {
    assert(texels.size() == static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    Object texture = make_texture(gl, "panel atlas");
    gl.texture_storage_2d(texture.name(), 1, GL_R8, size.x, size.y);
    gl.pixel_storei(GL_UNPACK_ALIGNMENT, 1);
    gl.texture_sub_image_2d(texture.name(), 0, 0, 0, size.x, size.y, GL_RED, GL_UNSIGNED_BYTE, texels.data());
    gl.texture_parameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.texture_parameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

} // namespace

PanelPainter::PanelPainter(Context& context, std::span<const std::uint8_t> atlas, const glm::ivec2& size)
    : context_(context), gl_(context.current_functions()),
      program_(make_program(gl_, "panels", {panel_vert, panel_frag})), atlas_(make_atlas(gl_, atlas, size)),
      mesh_(gl_, "panels", first_panel_bytes, sizeof(PanelVertex),
          {{position_input, VertexInput::Kind::Floats2, offsetof(PanelVertex, at)},
              {atlas_input, VertexInput::Kind::Floats2, offsetof(PanelVertex, atlas_at)},
              {colour_input, VertexInput::Kind::Colour, offsetof(PanelVertex, colour)}}) {}

PanelPainter::~PanelPainter() { context_.make_current(); }

void PanelPainter::begin(const PanelSurface& surface) {
    context_.make_current();
    surface_ = surface;
    gl_.bind_framebuffer(GL_FRAMEBUFFER, surface.framebuffer);
    gl_.viewport(0, 0, surface.size_px.x, surface.size_px.y);
    gl_.clip_control(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl_.disable(GL_DEPTH_TEST);
    gl_.disable(GL_CULL_FACE);
    gl_.enable(GL_BLEND);
    gl_.blend_func_separate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.enable(GL_SCISSOR_TEST);
    gl_.use_program(program_.name());
    const glm::vec4 window(2.0F / surface.size.x, -2.0F / surface.size.y, 0.0F, 0.0F);
    gl_.program_uniform_4fv(program_.name(), window_uniform, 1, glm::value_ptr(window));
    gl_.bind_texture_unit(atlas_unit, atlas_.name());
    gl_.bind_vertex_array(mesh_.array.name());
}

void PanelPainter::end() {
    gl_.disable(GL_SCISSOR_TEST);
    gl_.disable(GL_BLEND);
}

void PanelPainter::draw(
    std::span<const PanelVertex> vertices, std::span<const std::uint16_t> indices, std::span<const PanelDraw> draws) {
    mesh_.vertices.fill({std::as_bytes(vertices)});
    mesh_.indices.fill({std::as_bytes(indices)});
    const glm::vec2 px_per_unit = glm::vec2(surface_.size_px) / surface_.size;
    for (const PanelDraw& each : draws) {
        const glm::ivec2 min_px(glm::floor(each.min * px_per_unit));
        const glm::ivec2 max_px(glm::ceil(each.max * px_per_unit));
        if (each.index_count == 0 || max_px.x <= min_px.x || max_px.y <= min_px.y) { continue; }
        gl_.scissor(min_px.x, surface_.size_px.y - max_px.y, max_px.x - min_px.x, max_px.y - min_px.y);
        gl_.draw_elements_base_vertex(GL_TRIANGLES, static_cast<GLsizei>(each.index_count), GL_UNSIGNED_SHORT,
            reinterpret_cast<const void*>(each.first_index * sizeof(std::uint16_t)),
            static_cast<GLint>(each.first_vertex));
    }
}

} // namespace octant::visuals::gl
