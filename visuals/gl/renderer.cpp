#include "visuals/gl/renderer.h"

#include "sim/base/error.h"
#include "visuals/gl/make_renderer.h"
#include "visuals/gl/object.h"
#include "visuals/gl/shader_sources.h"
#include "visuals/gl/window_context.h"
#include "visuals/scene/frame_plan.h"

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <utility>

namespace octant::visuals::gl {

namespace {

using scene::ModelVertex;

constexpr GLuint vertex_binding = 0;
constexpr GLuint instance_binding = 1;

} // namespace

Object make_model_array(const Functions& gl, GLuint vertices, GLuint indices, GLuint instances, const char* label) {
    Object array = make_vertex_array(gl, label);
    gl.vertex_array_vertex_buffer(array.name(), vertex_binding, vertices, 0, sizeof(ModelVertex));
    gl.vertex_array_vertex_buffer(array.name(), instance_binding, instances, 0, sizeof(ModelInstance));
    gl.vertex_array_binding_divisor(array.name(), instance_binding, 1);
    gl.vertex_array_element_buffer(array.name(), indices);
    add_vector_input(gl, array, position_input, offsetof(ModelVertex, position_m));
    add_vector_input(gl, array, normal_input, offsetof(ModelVertex, normal));
    add_colour_input(gl, array, offsetof(ModelVertex, colour));
    add_colour_input(gl, array, offsetof(ModelVertex, face_colour), face_colour_input);
    add_number_input(gl, array, part_input, vertex_binding, offsetof(ModelVertex, part));
    add_vector_input(gl, array, face_normal_input, offsetof(ModelVertex, face_normal));
    add_number_input(gl, array, polygon_input, vertex_binding, offsetof(ModelVertex, polygon));
    add_number_input(gl, array, first_part_input, instance_binding, offsetof(ModelInstance, first_part));
    add_number_input(gl, array, first_smooth_input, instance_binding, offsetof(ModelInstance, first_smooth));
    add_colour_input(gl, array, offsetof(ModelInstance, smooth_tint), smooth_tint_input, instance_binding);
    add_colour_input(gl, array, offsetof(ModelInstance, flat_tint), flat_tint_input, instance_binding);
    return array;
}

namespace {

constexpr std::size_t first_capacity_bytes = std::size_t{1} << 12;

} // namespace

RefinedPainter::RefinedPainter(const Functions& gl, DrawState& state)
    : gl_(gl), state_(state), vertices_(gl, "refined vertices", first_capacity_bytes),
      indices_(gl, "refined indices", first_capacity_bytes), instances_(gl, "refined instances", first_capacity_bytes),
      array_(make_model_array(gl, vertices_.name(), indices_.name(), instances_.name(), "refined aircraft")) {}

void RefinedPainter::upload(const scene::FramePlan& plan) {
    ranges_.clear();
    instance_values_.clear();
    if (plan.refined.empty()) { return; }
    pieces_.clear();
    std::size_t vertices = 0;
    std::size_t indices = 0;
    for (const scene::RefinedDraw& draw : plan.refined) {
        assert(draw.first_smooth < plan.smooth.size() && draw.first_part < plan.parts.size());
        ranges_.push_back({indices, draw.indices.size(), static_cast<GLint>(vertices)});
        instance_values_.push_back({draw.first_part, draw.first_smooth, draw.tints.smooth, draw.tints.flat});
        vertices += draw.vertices.size();
        indices += draw.indices.size();
        pieces_.push_back(std::as_bytes(draw.vertices));
    }
    vertices_.fill(pieces_);
    pieces_.clear();
    for (const scene::RefinedDraw& draw : plan.refined) { pieces_.push_back(std::as_bytes(draw.indices)); }
    indices_.fill(pieces_);
    instances_.fill({std::as_bytes(std::span(instance_values_))});
}

void RefinedPainter::draw(const scene::PaintStep& step, const scene::Clip* clip, const ProgramPair& programs) {
    assert(std::size_t{step.first} + step.count <= ranges_.size());
    assert(step.depth != scene::DepthUse::DepthOnly);
    if (step.count == 0) { return; }
    state_.use_depth(step.depth);
    state_.cull_back_faces(true);
    state_.use_program(programs, clip);
    gl_.bind_vertex_array(array_.name());
    for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
        gl_.draw_elements_instanced(GL_TRIANGLES, static_cast<GLsizei>(ranges_[i].index_count), GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(ranges_[i].first_index * sizeof(std::uint32_t)), 1, ranges_[i].first_vertex,
            i);
        state_.count_draw_call();
    }
}

namespace {

using scene::OverlayVertex;

constexpr GLint clip_per_px_uniform = 0; ///< place in the shader

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
    : gl_(gl), state_(state), programs_{make_program(gl, "overlay", {overlay_vert, overlay_frag}), {}},
      vertices_(gl, "overlay vertices", first_capacity_bytes), indices_(gl, "overlay indices", first_capacity_bytes),
      array_(make_array(gl, vertices_, indices_)) {}

void OverlayPainter::upload(const scene::OverlayDraw& overlay, const glm::ivec2& size_px) {
    index_count_ = overlay.indices.size();
    if (index_count_ == 0) { return; }
    vertices_.fill({std::as_bytes(overlay.vertices)});
    indices_.fill({std::as_bytes(overlay.indices)});
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
    gl_.bind_vertex_array(array_.name());
    gl_.draw_elements_base_vertex(GL_TRIANGLES, static_cast<GLsizei>(step.count), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(step.first * sizeof(std::uint32_t)), 0);
    state_.blend(false);
    state_.count_draw_call();
}

namespace {

void check_size(const Functions& gl, int width, int height, int samples) {
    GLint largest = 0;
    gl.get_integerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest) {
        throw Error(
            fmt::format("expected a picture of 1 x 1 to {0} x {0} pixels, got {1} x {2}", largest, width, height));
    }
    GLint max_samples = 0;
    gl.get_integerv(GL_MAX_SAMPLES, &max_samples);
    if ((samples != 1 && samples != 4) || samples > max_samples) {
        throw Error(
            fmt::format("expected 1 or 4 samples a pixel (the driver has up to {}), got {}", max_samples, samples));
    }
}

} // namespace

Framebuffer::Framebuffer(const Functions& gl, int width, int height, int samples)
    : gl_(&gl), width_(width), height_(height), samples_(samples) {
    check_size(gl, width, height, samples);
    colour_ = make_storage("picture's colour", samples, GL_RGBA8);
    depth_ = make_storage("picture's depth", samples, GL_DEPTH_COMPONENT32F);
    with_depth_ = make_target("picture", colour_, &depth_);
    without_depth_ = make_target("picture without depth", colour_, nullptr);
    if (samples > 1) {
        averaged_colour_ = make_storage("averaged picture's colour", 1, GL_RGBA8);
        averaged_ = make_target("averaged picture", averaged_colour_, nullptr);
    }
}

Object Framebuffer::make_storage(const char* label, int samples, GLenum format) const {
    Object storage = make_renderbuffer(*gl_, label);
    gl_->named_renderbuffer_storage_multisample(storage.name(), samples > 1 ? samples : 0, format, width_, height_);
    return storage;
}

Object Framebuffer::make_target(const char* label, const Object& colour, const Object* depth) const {
    Object target = make_framebuffer(*gl_, label);
    const auto attach = [&](GLenum place, const Object& storage) {
        gl_->named_framebuffer_renderbuffer(target.name(), place, GL_RENDERBUFFER, storage.name());
    };
    attach(GL_COLOR_ATTACHMENT0, colour);
    if (depth != nullptr) { attach(GL_DEPTH_ATTACHMENT, *depth); }
    const GLenum status = gl_->check_named_framebuffer_status(target.name(), GL_DRAW_FRAMEBUFFER);
    if (gl_->get_error() != GL_NO_ERROR || status != GL_FRAMEBUFFER_COMPLETE) {
        throw Error(fmt::format("expected memory for a picture of {} x {} pixels with {} samples, got a refusal by the "
                                "driver",
            width_, height_, samples_));
    }
    return target;
}

/// The framebuffer object to copy from: of several samples a pixel their average, made now.
GLuint Framebuffer::averaged() const {
    if (averaged_.name() == 0) { return with_depth_.name(); }
    gl_->blit_named_framebuffer(with_depth_.name(), averaged_.name(), 0, 0, width_, height_, 0, 0, width_, height_,
        GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return averaged_.name();
}

void Framebuffer::read(std::span<std::uint8_t> rgba) const {
    assert(rgba.size() == std::size_t{4} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    gl_->bind_framebuffer(GL_FRAMEBUFFER, averaged());
    gl_->read_pixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

void Framebuffer::copy_to(GLuint target, const glm::ivec2& size_px) const {
    const bool same_size = size_px == glm::ivec2(width_, height_);
    gl_->blit_named_framebuffer(averaged(), target, 0, 0, width_, height_, 0, size_px.y, size_px.x, 0,
        GL_COLOR_BUFFER_BIT, same_size ? GL_NEAREST : GL_LINEAR);
}

namespace {

using scene::AircraftDraw;
using scene::ModelVertex;

// Places in the shaders.
constexpr GLuint parts_binding = 0;
constexpr GLuint smooth_binding = 1;

} // namespace

AircraftPainter::AircraftPainter(const Functions& gl, DrawState& state)
    : gl_(gl), state_(state), programs_(make_program_pair(gl, "aircraft", {aircraft_vert, aircraft_frag})),
      model_vertices_(make_buffer(gl, "model vertices")), model_indices_(make_buffer(gl, "model indices")),
      part_buffer_(gl, "parts of aircraft", first_capacity_bytes),
      smooth_buffer_(gl, "smooth polygons", first_capacity_bytes),
      instance_buffer_(gl, "aircraft instances", first_capacity_bytes),
      command_buffer_(gl, "aircraft draws", first_capacity_bytes),
      joined_index_buffer_(gl, "gathered model indices", first_capacity_bytes),
      array_(make_model_array(gl, model_vertices_.name(), model_indices_.name(), instance_buffer_.name())),
      joined_array_(
          make_model_array(gl, model_vertices_.name(), joined_index_buffer_.name(), instance_buffer_.name())) {}

void AircraftPainter::load_models(std::span<const scene::ModelBuffers> models) {
    std::vector<ModelVertex> vertices;
    indices_.clear();
    models_.clear();
    has_depth_drawn_meshes_ = false;
    for (const scene::ModelBuffers& model : models) {
        has_depth_drawn_meshes_ = has_depth_drawn_meshes_ || model.has_depth_drawn_meshes;
        std::size_t parts = 0;
        for (const ModelVertex& vertex : model.vertices) { parts = std::max(parts, std::size_t{vertex.part} + 1); }
        models_.push_back({indices_.size(), model.indices.size(), static_cast<GLint>(vertices.size()), parts});
        vertices.insert(vertices.end(), model.vertices.begin(), model.vertices.end());
        indices_.insert(indices_.end(), model.indices.begin(), model.indices.end());
    }
    gl_.named_buffer_data(model_vertices_.name(), static_cast<GLsizeiptr>(std::span(vertices).size_bytes()),
        vertices.data(), GL_STATIC_DRAW);
    gl_.named_buffer_data(model_indices_.name(), static_cast<GLsizeiptr>(std::span(indices_).size_bytes()),
        indices_.data(), GL_STATIC_DRAW);
}

void AircraftPainter::add_one_of_each(scene::FramePlan& plan) const {
    if (!models_.empty()) {
        const auto indices = static_cast<std::uint32_t>(models_.front().index_count);
        glm::mat4 body_to_eye_world(1.0F);
        body_to_eye_world[3].z = -100.0F;
        plan.parts.assign(models_.front().parts, body_to_eye_world);
        plan.aircraft.push_back({.model = 0, .first_index = 0, .index_count = indices});
        plan.smooth.assign(models_.front().index_count / 3 / 32 + 1, 0U);
    }
}

void AircraftPainter::upload(const scene::FramePlan& plan) {
    lights_pixels_ = plan.lights_pixels;
    if (lights_pixels_ && !phong_programs_) {
        phong_programs_ = make_program_pair(gl_, "aircraft", {aircraft_vert, aircraft_frag}, "PHONG");
    }
    commands_.clear();
    uses_joined_indices_.clear();
    joined_indices_.clear();
    instances_.clear();
    for (const AircraftDraw& draw : plan.aircraft) {
        assert(draw.model < models_.size());
        assert(draw.first_smooth < plan.smooth.size());
        const ModelRange& model = models_[draw.model];
        assert(std::size_t{draw.first_index} + draw.index_count <= model.index_count);
        assert(std::size_t{draw.first_part} + model.parts <= plan.parts.size());
        Command command{.index_count = draw.index_count,
            .instance_count = 1,
            .first_index = static_cast<GLuint>(model.first_index) + draw.first_index,
            .first_vertex = model.first_vertex,
            .first_instance = static_cast<GLuint>(commands_.size())};
        if (!draw.ranges.empty()) { append_ranges(draw, command); }
        commands_.push_back(command);
        uses_joined_indices_.push_back(draw.ranges.empty() ? 0 : 1);
        instances_.push_back({draw.first_part, draw.first_smooth, draw.tints.smooth, draw.tints.flat});
    }
    part_buffer_.fill({std::as_bytes(std::span(plan.parts))});
    smooth_buffer_.fill({std::as_bytes(std::span(plan.smooth))});
    instance_buffer_.fill({std::as_bytes(std::span(instances_))});
    command_buffer_.fill({std::as_bytes(std::span(commands_))});
    if (!joined_indices_.empty()) { joined_index_buffer_.fill({std::as_bytes(std::span(joined_indices_))}); }
    gl_.bind_buffer_base(GL_SHADER_STORAGE_BUFFER, parts_binding, part_buffer_.name());
    gl_.bind_buffer_base(GL_SHADER_STORAGE_BUFFER, smooth_binding, smooth_buffer_.name());
    gl_.bind_buffer(GL_DRAW_INDIRECT_BUFFER, command_buffer_.name());
}

void AircraftPainter::append_ranges(const AircraftDraw& draw, Command& command) {
    const ModelRange& model = models_[draw.model];
    const std::size_t before = joined_indices_.size();
    for (const scene::IndexRange& range : draw.ranges) {
        assert(std::size_t{range.first_index} + range.index_count <= model.index_count);
        const auto from = std::span(indices_).subspan(model.first_index + range.first_index, range.index_count);
        joined_indices_.insert(joined_indices_.end(), from.begin(), from.end());
    }
    command.first_index = static_cast<GLuint>(before);
    command.index_count = static_cast<GLuint>(joined_indices_.size() - before);
}

void AircraftPainter::draw(const scene::PaintStep& step, const scene::Clip* clip) {
    assert(std::size_t{step.first} + step.count <= commands_.size());
    assert(step.depth != scene::DepthUse::DepthOnly);
    if (step.count == 0) { return; }
    state_.use_depth(step.depth);
    // Where nothing else tells what hides what, the shader leaves out back faces (aircraft.frag).
    state_.cull_back_faces(step.depth != scene::DepthUse::None);
    state_.use_program(programs(), clip);
    if (step.opacity < 1.0F) { state_.blend_by(step.opacity); }
    const std::size_t end = std::size_t{step.first} + step.count;
    for (std::size_t first = step.first; first < end;) {
        std::size_t next = first + 1;
        while (next < end && uses_joined_indices_[next] == uses_joined_indices_[first]) { ++next; }
        draw_commands(first, next - first);
        first = next;
    }
    if (step.opacity < 1.0F) { state_.blend_by(1.0F); }
}

/// Draws by commands that all read the same index buffer.
void AircraftPainter::draw_commands(std::size_t first, std::size_t count) {
    gl_.bind_vertex_array((uses_joined_indices_[first] != 0 ? joined_array_ : array_).name());
    gl_.multi_draw_elements_indirect(GL_TRIANGLES, GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(first * sizeof(Command)), static_cast<GLsizei>(count), sizeof(Command));
    state_.count_draw_call();
}

namespace {

using scene::FramePlan;
using scene::PaintStep;
using scene::PixelRect;

constexpr GLuint picture_binding = 0; ///< place in the shaders

/// The block Picture of the shaders.
struct FrameUniforms {
    glm::mat4 world_to_clip;
    glm::vec4 haze;
    glm::vec4 haze_sunward;
    glm::vec4 haze_to_sun;
    glm::vec4 to_sun;
    glm::vec4 ambient;
    glm::vec4 sunlight;
    glm::mat4 ray_from_pixel;
    scene::GroundTextureTransforms ground_texture;
    glm::vec4 detail_x;
    glm::vec4 detail_y;
    glm::vec4 detail_up;
};

constexpr glm::vec4 inset_frame{0.08F, 0.09F, 0.1F, 1.0F};
constexpr int frame_rows = 360; ///< of the picture for each pixel of the frame's width

/// Pixels of the target to world axes, one unit deep; `rect` lies on the target.
glm::mat4 ray_from_pixel(const FramePlan& plan, const PixelRect& rect, RowOrder row_order) {
    const float across = 1.0F / plan.view_to_clip[0][0];
    const float up = (row_order == RowOrder::TopDown ? 1.0F : -1.0F) / plan.view_to_clip[1][1];
    glm::mat4 view_ray(0.0F);
    view_ray[0].x = 2.0F * across / static_cast<float>(rect.width);
    view_ray[1].y = -2.0F * up / static_cast<float>(rect.height);
    // The picture's middle need not lie straight ahead.
    const glm::vec2 aside(plan.view_to_clip[2][0] * across, plan.view_to_clip[2][1] / plan.view_to_clip[1][1]);
    view_ray[2] = glm::vec4(-across + aside.x, up + aside.y, -1.0F, 0.0F) - static_cast<float>(rect.x) * view_ray[0] -
                  static_cast<float>(rect.y) * view_ray[1];
    return glm::transpose(plan.world_to_view) * view_ray;
}

/// A part of the eye's place in the fine pattern at each scale; negative where there is none.
glm::vec4 eye_detail_position(const std::optional<scene::DetailTexture>& detail_texture, glm::length_t part) {
    glm::vec4 at_eye(-1.0F);
    if (detail_texture) {
        for (std::size_t scale = 0; scale < detail_texture->at_eye.size(); ++scale) {
            at_eye[static_cast<glm::length_t>(scale)] =
                part == 2 ? detail_texture->eye_height_tiles[scale] : detail_texture->at_eye[scale][part];
        }
    }
    return at_eye;
}

FrameUniforms values_of(const FramePlan& plan, const PixelRect& rect, RowOrder row_order) {
    const float visibility_m = plan.haze.visibility_m;
    return {plan.view_to_clip * plan.world_to_view,
        glm::vec4(plan.haze.colour, visibility_m > 0.0F ? 1.0F / visibility_m : 0.0F),
        glm::vec4(plan.haze.sunward_colour, plan.haze.falloff_per_m),
        glm::vec4(plan.haze.horizontal_to_sun, 0.0F, 0.0F), glm::vec4(plan.to_sun, 0.0F), glm::vec4(plan.ambient, 0.0F),
        glm::vec4(plan.sunlight, 0.0F), ray_from_pixel(plan, rect, row_order),
        plan.ground_texture.value_or(scene::GroundTextureTransforms()), eye_detail_position(plan.detail_texture, 0),
        eye_detail_position(plan.detail_texture, 1), eye_detail_position(plan.detail_texture, 2)};
}

} // namespace

Renderer::Renderer(std::shared_ptr<Context> context, const glm::ivec2& size_px, int samples)
    : context_(std::move(context)), gl_(context_->current_functions()),
      framebuffer_(gl_, size_px.x, size_px.y, samples), frame_uniforms_(gl_, "picture values", sizeof(FrameUniforms)),
      state_(gl_), triangles_(gl_, state_), aircraft_(gl_, state_), refined_(gl_, state_), overlay_(gl_, state_) {}

Renderer::~Renderer() { context_->make_current(); }

std::unique_ptr<scene::Renderer> Renderer::sibling(const glm::ivec2& size_px, int samples) const {
    return std::make_unique<Renderer>(context_, size_px, samples);
}

void Renderer::resize(const glm::ivec2& size_px, std::optional<int> wanted) {
    const int samples = wanted.value_or(1);
    if (framebuffer_.fits(size_px, samples)) { return; }
    context_->make_current();
    framebuffer_ = Framebuffer(gl_, size_px.x, size_px.y, samples);
}

void Renderer::copy_to_window(const glm::ivec2& size_px) {
    context_->make_current();
    framebuffer_.copy_to(0, size_px);
}

void Renderer::load_models(std::span<const scene::ModelBuffers> models) {
    context_->make_current();
    aircraft_.load_models(models);
}

void Renderer::load_ground_texture(const scene::GroundTexture& texture) {
    context_->make_current();
    triangles_.load_texture(texture);
}

void Renderer::draw(const FramePlan& plan) {
    context_->make_current();
    const bool fits =
        plan.depth_boxes.empty() && !aircraft_.has_depth_drawn_meshes() && framebuffer_.fits(window_px_, 1);
    row_order_ = fits ? RowOrder::BottomUp : RowOrder::TopDown;
    const GLuint target = target_of(plan);
    gl_.bind_framebuffer(GL_FRAMEBUFFER, target);
    state_.begin_picture(row_order_);
    draw_into(plan, {target, {0, 0, framebuffer_.width(), framebuffer_.height()}, false});
}

void Renderer::draw_inset(const FramePlan& plan, const PixelRect& rect) {
    assert(rect.width > 0 && rect.height > 0 && rect.x >= 0 && rect.y >= 0);
    assert(rect.x + rect.width <= framebuffer_.width());
    assert(rect.y + rect.height <= framebuffer_.height());
    context_->make_current();
    const GLuint target = target_of(plan);
    gl_.bind_framebuffer(GL_FRAMEBUFFER, target);
    const int frame = std::max(framebuffer_.height() / frame_rows, 1);
    gl_.enable(GL_SCISSOR_TEST);
    const PixelRect at = on_target(rect);
    gl_.scissor(at.x - frame, at.y - frame, at.width + 2 * frame, at.height + 2 * frame);
    gl_.clear_named_framebufferfv(target, GL_COLOR, 0, glm::value_ptr(inset_frame));
    gl_.scissor(at.x, at.y, at.width, at.height);
    draw_into(plan, {target, at, true});
    gl_.disable(GL_SCISSOR_TEST);
}

PixelRect Renderer::on_target(const PixelRect& rect) const {
    PixelRect at = rect;
    if (row_order_ == RowOrder::BottomUp) { at.y = framebuffer_.height() - rect.y - rect.height; }
    return at;
}

GLuint Renderer::target_of(const FramePlan& plan) const {
    if (row_order_ == RowOrder::BottomUp) {
        assert(plan.depth_boxes.empty());
        return 0;
    }
    return plan.depth_boxes.empty() ? framebuffer_.name_without_depth() : framebuffer_.name();
}

/// The place's target must be bound.
void Renderer::draw_into(const FramePlan& plan, const DrawTarget& place) {
    gl_.viewport(place.rect.x, place.rect.y, place.rect.width, place.rect.height);
    const glm::vec4 background(plan.background, 1.0F);
    gl_.clear_named_framebufferfv(place.target, GL_COLOR, 0, glm::value_ptr(background));
    upload(plan, place.rect);
    paint(plan, place);
}

void Renderer::upload(const FramePlan& plan, const PixelRect& rect) {
    const FrameUniforms values = values_of(plan, rect, row_order_);
    frame_uniforms_.fill({std::as_bytes(std::span(&values, 1))});
    gl_.bind_buffer_base(GL_UNIFORM_BUFFER, picture_binding, frame_uniforms_.name());
    triangles_.upload(plan);
    aircraft_.upload(plan);
    refined_.upload(plan);
    overlay_.upload(plan.overlay, {rect.width, rect.height});
}

void Renderer::paint(const FramePlan& plan, const DrawTarget& place) {
    for (const PaintStep& step : plan.steps) {
        const scene::Clip* const clip = step.clip == PaintStep::no_clip ? nullptr : &plan.clips[step.clip];
        switch (step.content) {
        case PaintStep::Content::ClearDepth:
            clear_depth(plan.depth_boxes[step.first], place);
            break;
        case PaintStep::Content::Sky:
        case PaintStep::Content::Ground:
        case PaintStep::Content::GroundRepaint:
            triangles_.draw(step, clip);
            break;
        case PaintStep::Content::Aircraft:
            aircraft_.draw(step, clip);
            break;
        case PaintStep::Content::Refined:
            refined_.draw(step, clip, aircraft_.programs());
            break;
        case PaintStep::Content::Transparent:
        case PaintStep::Content::Overlay:
            overlay_.draw(step);
            break;
        }
    }
}

/// In a box of the plan's picture; picture and target have their rows in one order where depth is used.
void Renderer::clear_depth(const scene::PixelBox& box, const DrawTarget& place) {
    const PixelRect& rect = place.rect;
    const glm::ivec2 least = glm::max(box.least, glm::ivec2(0));
    const glm::ivec2 size = glm::min(box.most, glm::ivec2(rect.width, rect.height)) - least;
    if (size.x <= 0 || size.y <= 0) { return; }
    // A mask left by an earlier step would keep the clearing out, too.
    gl_.depth_mask(GL_TRUE);
    gl_.enable(GL_SCISSOR_TEST);
    gl_.scissor(rect.x + least.x, rect.y + least.y, size.x, size.y);
    const float infinitely_far = 0.0F;
    gl_.clear_named_framebufferfv(place.target, GL_DEPTH, 0, &infinitely_far);
    if (place.is_inset) {
        gl_.scissor(rect.x, rect.y, rect.width, rect.height);
    } else {
        gl_.disable(GL_SCISSOR_TEST);
    }
}

void Renderer::finish() {
    context_->make_current();
    gl_.finish();
    const GLenum fault = gl_.get_error();
    if (fault != GL_NO_ERROR) { throw Error(fmt::format("expected OpenGL to draw without error, got {:#06x}", fault)); }
}

void Renderer::finish_and_read(scene::Picture& picture) {
    assert(!is_drawn_to_window());
    finish();
    picture.width = framebuffer_.width();
    picture.height = framebuffer_.height();
    picture.rgba.resize(
        std::size_t{4} * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    framebuffer_.read(picture.rgba);
}

std::unique_ptr<scene::Renderer> make_osmesa_renderer(const glm::ivec2& size_px, int samples) {
    return make_renderer(make_osmesa_context(), size_px, samples);
}

std::unique_ptr<scene::Renderer> make_egl_renderer(const glm::ivec2& size_px, int samples) {
    return make_renderer(make_egl_context(), size_px, samples);
}

std::unique_ptr<scene::Renderer> make_hidden_window_renderer(const glm::ivec2& size_px, int samples) {
    return make_renderer(make_window_context({.visible = false}), size_px, samples);
}

std::unique_ptr<scene::Renderer> make_renderer(
    std::shared_ptr<Context> context, const glm::ivec2& size_px, int samples) {
    return std::make_unique<Renderer>(std::move(context), size_px, samples);
}

} // namespace octant::visuals::gl
