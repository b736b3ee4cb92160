#include "visuals/gl/triangle_painter.h"

#include "sim/base/error.h"
#include "visuals/gl/context.h"
#include "visuals/gl/object.h"
#include "visuals/gl/shader_sources.h"
#include "visuals/scene/detail_pattern.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/land_cover_contrast.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <string_view>
#include <vector>

namespace octant::visuals::gl {

namespace {

/// What the texels of a ground image are.
enum class TextureKind {
    Colours, ///< red, green, blue: 3 bytes a texel
    Slopes   ///< x and y of a normal: 2 bytes a texel
};

// Along the line of sight. Where a processor draws, any but 1 makes a frame 3 to 5 times slower.
constexpr float max_anisotropy = 8.0F;

bool has_extension(const Functions& gl, std::string_view name) {
    GLint count = 0;
    gl.get_integerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* const found = gl.get_stringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (found != nullptr && name == reinterpret_cast<const char*>(found)) { return true; }
    }
    return false;
}

void set_filters(const Functions& gl, const Object& texture, GLenum beyond) {
    const auto set = [&](GLenum what, GLenum value) {
        gl.texture_parameteri(texture.name(), what, static_cast<GLint>(value));
    };
    set(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    set(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    set(GL_TEXTURE_WRAP_S, beyond);
    set(GL_TEXTURE_WRAP_T, beyond);
    set(GL_TEXTURE_WRAP_R, beyond);
    if (!is_software_renderer(gl) && (has_extension(gl, "GL_EXT_texture_filter_anisotropic") ||
                                         has_extension(gl, "GL_ARB_texture_filter_anisotropic"))) {
        GLfloat most = 1.0F;
        gl.get_floatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &most);
        gl.texture_parameterf(texture.name(), GL_TEXTURE_MAX_ANISOTROPY, std::min(most, max_anisotropy));
    }
}

/// A texture with all its mip levels, filtered between them (trilinear), on a GPU also along the line of sight
/// (anisotropic); beyond its edge it continues as at the edge. Throws Error when the driver has no memory for it.
Object make_texture(const Functions& gl, const scene::GroundImage& image, TextureKind kind) {
    const bool colours = kind == TextureKind::Colours;
    Object texture = make_texture(gl, colours ? "ground colours" : "ground slopes");
    const auto longer_side = static_cast<unsigned>(std::max(image.width, image.height));
    gl.texture_storage_2d(texture.name(), static_cast<GLsizei>(std::bit_width(longer_side)), colours ? GL_RGB8 : GL_RG8,
        image.width, image.height);
    gl.pixel_storei(GL_UNPACK_ALIGNMENT, 1);
    gl.texture_sub_image_2d(texture.name(), 0, 0, 0, image.width, image.height, colours ? GL_RGB : GL_RG,
        GL_UNSIGNED_BYTE, image.texels.data());
    gl.generate_texture_mipmap(texture.name());
    set_filters(gl, texture, GL_CLAMP_TO_EDGE);
    if (gl.get_error() != GL_NO_ERROR) {
        throw Error(fmt::format("expected memory for a ground texture of {} x {} texels, got a refusal by the driver",
            image.width, image.height));
    }
    return texture;
}

/// The ground's detail patterns, two bytes a texel: open ground, crowns; with their own levels. They repeat beyond the
/// cube's edge.
Object make_texture(const Functions& gl, const scene::DetailPattern& pattern) {
    using scene::DetailPattern;
    Object texture = make_texture(gl, "ground's detail texture", GL_TEXTURE_3D);
    gl.texture_storage_3d(texture.name(), DetailPattern::levels, GL_RG8, DetailPattern::side_texels,
        DetailPattern::side_texels, DetailPattern::side_texels);
    gl.pixel_storei(GL_UNPACK_ALIGNMENT, 1);
    for (int level = 0; level < DetailPattern::levels; ++level) {
        const GLsizei side = DetailPattern::side_texels >> level;
        std::vector<std::uint8_t> texels;
        texels.reserve(static_cast<std::size_t>(2 * side * side * side));
        for (int z = 0; z < side; ++z) {
            for (int y = 0; y < side; ++y) {
                for (int x = 0; x < side; ++x) {
                    texels.push_back(pattern.texel(DetailPattern::Kind::Open, level, {x, y, z}));
                    texels.push_back(pattern.texel(DetailPattern::Kind::Crowns, level, {x, y, z}));
                }
            }
        }
        gl.texture_sub_image_3d(
            texture.name(), level, 0, 0, 0, side, side, side, GL_RG, GL_UNSIGNED_BYTE, texels.data());
    }
    set_filters(gl, texture, GL_REPEAT);
    return texture;
}

/// A texel for each land cover (up) and pattern value (right): the shares by which a colour changes.
Object make_texture(const Functions& gl, const scene::LandCoverContrast& contrast) {
    Object texture = make_texture(gl, "contrast of ground's covers");
    // As the table has them, but from -1 on: one word is read for three shares.
    constexpr std::uint32_t signs = 0x80200800U;
    std::vector<std::uint32_t> shares;
    shares.reserve(contrast.table().size());
    for (const std::uint32_t entry : contrast.table()) { shares.push_back(entry ^ signs); }
    constexpr GLsizei width = scene::LandCoverContrast::pattern_step_count;
    constexpr GLsizei height = scene::LandCoverContrast::mixture_count;
    gl.texture_storage_2d(texture.name(), 1, GL_RGB10_A2, width, height);
    gl.texture_sub_image_2d(texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_INT_10_10_10_2, shares.data());
    return texture;
}

using models::ColourVertex;
using scene::PaintStep;

// Places in the shaders.
constexpr GLuint albedo_unit = 0;
constexpr GLuint normal_unit = 1;
constexpr GLuint detail_unit = 2;
constexpr GLuint contrast_unit = 3;
constexpr GLint mesh_look_uniform = 8;
constexpr GLint clip_per_px_uniform = 0; ///< of the overlay

constexpr std::size_t first_triangle_bytes = std::size_t{1} << 20;
constexpr std::size_t overlay_capacity_bytes = std::size_t{1} << 12;

} // namespace

TrianglePainter::TrianglePainter(const Functions& gl, DrawState& state)
    : gl_(gl), state_(state), ground_programs_(make_program_pair(gl, "ground", {ground_vert, ground_frag})),
      sky_programs_{make_program(gl, "sky", {sky_vert, ground_frag}), {}},
      mesh_(gl, "ground and sky", first_triangle_bytes, sizeof(ColourVertex),
          {{position_input, VertexInput::Kind::Floats3, offsetof(ColourVertex, position_m)},
              {colour_input, VertexInput::Kind::Colour, offsetof(ColourVertex, colour)}}) {}

void TrianglePainter::load_texture(const scene::GroundTexture& texture) {
    texture_ = {make_program_pair(gl_, "textured ground", {ground_textured_vert, ground_textured_frag}),
        make_texture(gl_, texture.albedo, TextureKind::Colours),
        make_texture(gl_, texture.normal, TextureKind::Slopes)};
}

/// The programs that show the mesh are made when first asked for: few runs look at it.
void TrianglePainter::use_mesh_display(const scene::FramePlan& plan) {
    shows_mesh_ = plan.mesh_display != scene::MeshDisplay::None;
    if (!shows_mesh_) { return; }
    if (!mesh_programs_) {
        mesh_programs_ =
            make_program_pair(gl_, "ground's mesh", {ground_vert, ground_mesh_frag, ground_mesh_geom}, {"MESH"});
    }
    const std::array<float, 4> look{
        plan.sample_spacing_m, plan.mesh_display == scene::MeshDisplay::Levels ? 1.0F : 0.0F, 0.0F, 0.0F};
    for (const Object* const program : {&mesh_programs_->unclipped, &mesh_programs_->clipped}) {
        gl_.program_uniform_4fv(program->name(), mesh_look_uniform, 1, look.data());
    }
}

void TrianglePainter::use_detail_texture(const scene::FramePlan& plan) {
    if (!plan.detail_texture) { return; }
    if (plan.detail_texture->contrast != uploaded_contrast_) {
        const scene::DetailPattern& pattern = plan.detail_texture->contrast->pattern();
        if (!uploaded_contrast_ || &uploaded_contrast_->pattern() != &pattern) {
            detail_texture_ = make_texture(gl_, pattern);
        }
        uploaded_contrast_ = plan.detail_texture->contrast;
        contrast_ = make_texture(gl_, *uploaded_contrast_);
    }
    gl_.bind_texture_unit(detail_unit, detail_texture_->name());
    gl_.bind_texture_unit(contrast_unit, contrast_->name());
}

void TrianglePainter::upload(const scene::FramePlan& plan) {
    use_mesh_display(plan);
    has_polygon_numbers_ = plan.ground_has_polygon_numbers;
    if (has_polygon_numbers_ && !polygon_number_programs_) {
        polygon_number_programs_ = make_program_pair(gl_, "ground's numbers", {ground_vert, ground_frag}, {"NUMBERS"});
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
    mesh_.vertices.fill(
        {std::as_bytes(plan.ground.vertices), std::as_bytes(shadow_vertices), std::as_bytes(plan.sky.vertices)});
    mesh_.indices.fill({std::as_bytes(plan.ground.indices), std::as_bytes(again), std::as_bytes(plan.sky.indices)});
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
    if (step.count == 0) { return; }
    const bool depth_only = step.depth == scene::DepthUse::DepthOnly;
    if (depth_only) { gl_.color_mask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE); }
    state_.use_depth(step.depth);
    state_.use_program(is_sky ? sky_programs_ : ground_programs(), clip);
    state_.cull_back_faces(false);
    gl_.bind_vertex_array(mesh_.array.name());
    gl_.draw_elements_base_vertex(GL_TRIANGLES, static_cast<GLsizei>(step.count), GL_UNSIGNED_INT,
        index_offset(list.first + step.first), is_sky ? first_sky_vertex_ : 0);
    state_.count_draw_call();
    if (depth_only) { gl_.color_mask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE); }
}

OverlayPainter::OverlayPainter(const Functions& gl, DrawState& state)
    : gl_(gl), state_(state), programs_{make_program(gl, "overlay", {overlay_vert, overlay_frag}), {}},
      mesh_(gl, "overlay", overlay_capacity_bytes, sizeof(scene::OverlayVertex),
          {{position_input, VertexInput::Kind::Floats2, offsetof(scene::OverlayVertex, at_px)},
              {colour_input, VertexInput::Kind::Colour, offsetof(scene::OverlayVertex, colour)},
              {depth_input, VertexInput::Kind::Float, offsetof(scene::OverlayVertex, depth)}}) {}

void OverlayPainter::upload(const scene::OverlayDraw& overlay, const glm::ivec2& size_px) {
    index_count_ = overlay.indices.size();
    if (index_count_ == 0) { return; }
    mesh_.vertices.fill({std::as_bytes(overlay.vertices)});
    mesh_.indices.fill({std::as_bytes(overlay.indices)});
    const glm::vec4 clip_per_px(2.0F / static_cast<float>(size_px.x), 2.0F / static_cast<float>(size_px.y), 0.0F, 0.0F);
    gl_.program_uniform_4fv(programs_.unclipped.name(), clip_per_px_uniform, 1, glm::value_ptr(clip_per_px));
}

void OverlayPainter::draw(const scene::PaintStep& step) {
    assert(std::size_t{step.first} + step.count <= index_count_);
    if (step.count == 0) { return; }
    state_.use_depth(step.depth);
    state_.cull_back_faces(false);
    state_.use_program(programs_);
    state_.blend(true);
    gl_.depth_mask(GL_FALSE);
    gl_.bind_vertex_array(mesh_.array.name());
    gl_.draw_elements_base_vertex(
        GL_TRIANGLES, static_cast<GLsizei>(step.count), GL_UNSIGNED_INT, index_offset(step.first), 0);
    gl_.depth_mask(GL_TRUE);
    state_.blend(false);
    state_.count_draw_call();
}

} // namespace octant::visuals::gl
