#include "visuals/gl/triangle_painter.h"

#include "visuals/gl/program.h"
#include "visuals/gl/shader_sources.h"
#include "visuals/gl/texture.h"
#include "visuals/gl/vertex_array.h"

#include <array>
#include <cassert>
#include <span>

namespace octant::visuals::gl {
namespace {

using models::ColourVertex;
using scene::PaintStep;

// Places in the shaders.
constexpr GLuint albedo_unit = 0;
constexpr GLuint normal_unit = 1;
constexpr GLuint detail_unit = 2;
constexpr GLuint contrast_unit = 3;
constexpr GLint mesh_look_uniform = 8;

constexpr std::size_t first_capacity_bytes = std::size_t{1} << 20;

Object make_array(const Functions& gl, const StreamBuffer& vertices, const StreamBuffer& indices) {
    Object array = make_vertex_array(gl, "ground and sky");
    gl.vertex_array_vertex_buffer(array.name(), 0, vertices.name(), 0, sizeof(ColourVertex));
    gl.vertex_array_element_buffer(array.name(), indices.name());
    add_vector_input(gl, array, position_input, offsetof(ColourVertex, position_m));
    add_colour_input(gl, array, offsetof(ColourVertex, colour));
    return array;
}

} // namespace

TrianglePainter::TrianglePainter(const Functions& gl, DrawState& state)
    : gl_(gl)
    , state_(state)
    , ground_programs_(make_program_pair(gl, "ground", {ground_vert, ground_frag}))
    , sky_programs_{make_program(gl, "sky", {sky_vert, ground_frag}), {}}
    , detail_texture_(make_detail_texture(gl))
    , vertices_(gl, "ground and sky vertices", first_capacity_bytes)
    , indices_(gl, "ground and sky indices", first_capacity_bytes)
    , array_(make_array(gl, vertices_, indices_)) {}

void TrianglePainter::load_texture(const scene::GroundTexture& texture) {
    texture_ = {
        make_program_pair(gl_, "textured ground", {ground_textured_vert, ground_textured_frag}),
        make_texture(gl_, texture.albedo, TextureKind::Colours),
        make_texture(gl_, texture.normal, TextureKind::Slopes)};
}

/// The programs that show the mesh are made when first asked for: few runs look at it.
void TrianglePainter::use_mesh_display(const scene::FramePlan& plan) {
    shows_mesh_ = plan.mesh_display != scene::MeshDisplay::None;
    if (!shows_mesh_) {
        return;
    }
    if (!mesh_programs_) {
        mesh_programs_ = make_program_pair(
            gl_, "ground's mesh", {ground_vert, ground_mesh_frag, ground_mesh_geom}, "MESH");
    }
    const std::array<float, 4> look{
        plan.sample_spacing_m, plan.mesh_display == scene::MeshDisplay::Levels ? 1.0F : 0.0F, 0.0F, 0.0F};
    for (const Object* const program : {&mesh_programs_->unclipped, &mesh_programs_->clipped}) {
        gl_.program_uniform_4fv(program->name(), mesh_look_uniform, 1, look.data());
    }
}

void TrianglePainter::use_detail_texture(const scene::FramePlan& plan) {
    if (!plan.detail_texture) {
        return;
    }
    if (plan.detail_texture->contrast != uploaded_contrast_) {
        uploaded_contrast_ = plan.detail_texture->contrast;
        contrast_ = make_texture(gl_, *uploaded_contrast_);
    }
    gl_.bind_texture_unit(detail_unit, detail_texture_.name());
    gl_.bind_texture_unit(contrast_unit, contrast_->name());
}

void TrianglePainter::upload(const scene::FramePlan& plan) {
    use_mesh_display(plan);
    has_polygon_numbers_ = plan.ground_has_polygon_numbers;
    if (has_polygon_numbers_ && !polygon_number_programs_) {
        polygon_number_programs_ =
            make_program_pair(gl_, "ground's numbers", {ground_vert, ground_frag}, "NUMBERS");
    }
    use_detail_texture(plan);
    is_textured_ = plan.ground_texture.has_value();
    if (is_textured_) {
        assert(texture_);
        gl_.bind_texture_unit(albedo_unit, texture_->albedo.name());
        gl_.bind_texture_unit(normal_unit, texture_->normal.name());
    }
    const std::span shadow_vertices(plan.shadow_vertices);
    const std::span again(plan.repaint_indices);
    vertices_.fill(
        {std::as_bytes(plan.ground.vertices),
         std::as_bytes(shadow_vertices),
         std::as_bytes(plan.sky.vertices)});
    indices_.fill(
        {std::as_bytes(plan.ground.indices),
         std::as_bytes(again),
         std::as_bytes(plan.sky.indices)});
    ground_ = {0, plan.ground.indices.size()};
    repaint_range_ = {ground_.count, again.size()};
    sky_ = {repaint_range_.first + repaint_range_.count, plan.sky.indices.size()};
    first_sky_vertex_ = static_cast<GLint>(plan.ground.vertices.size() + shadow_vertices.size());
}

void TrianglePainter::draw(const PaintStep& step, const scene::Clip* clip) {
    const bool is_sky = step.content == PaintStep::Content::Sky;
    const Range& list = is_sky ? sky_ : step.content == PaintStep::Content::Ground ? ground_ : repaint_range_;
    assert(std::size_t{step.first} + step.count <= list.count);
    assert(clip == nullptr || !is_sky);
    if (step.count == 0) {
        return;
    }
    const bool depth_only = step.depth == scene::DepthUse::DepthOnly;
    if (depth_only) {
        gl_.color_mask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    }
    state_.use_depth(step.depth);
    state_.use_program(is_sky ? sky_programs_ : ground_programs(), clip);
    state_.cull_back_faces(false);
    gl_.bind_vertex_array(array_.name());
    gl_.draw_elements_base_vertex(
        GL_TRIANGLES,
        static_cast<GLsizei>(step.count),
        GL_UNSIGNED_INT,
        reinterpret_cast<const void*>((list.first + step.first) * sizeof(std::uint32_t)),
        is_sky ? first_sky_vertex_ : 0);
    state_.count_draw_call();
    if (depth_only) {
        gl_.color_mask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
}

} // namespace octant::visuals::gl
