#include "visuals/gl/renderer.h"

#include "sim/base/error.h"
#include "visuals/gl/gl_renderer.h"
#include "visuals/gl/window_context.h"
#include "visuals/scene/detail_pattern.h"

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <fmt/format.h>
#include <utility>

namespace octant::visuals::gl {

namespace {

using scene::FramePlan;
using scene::PaintStep;
using scene::PixelRect;

constexpr GLuint picture_binding = 0; ///< place in the shaders

/// The eye's place in the detail texture at each scale, then scene::detail_texels_per_m(); all 0 without a texture.
using DetailPositions = std::array<glm::vec4, scene::DetailPattern::scales>;

/// The block Picture of the shaders.
struct FrameUniforms {
    glm::mat4 world_to_clip;
    glm::vec4 haze;
    glm::vec4 haze_sunward;
    glm::vec4 haze_to_sun;
    glm::vec4 to_sun;
    glm::vec4 ambient;
    glm::vec4 sunlight;
    glm::vec4 mirrored_overhead;
    glm::vec4 mirrored_below;
    glm::mat4 ray_from_pixel;
    scene::GroundTextureTransforms ground_texture;
    DetailPositions detail_at_eye;
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

DetailPositions eye_detail_positions(const FramePlan& plan, const PixelRect& rect) {
    DetailPositions positions{};
    if (!plan.detail_texture) { return positions; }
    const double focal_px = 0.5 * rect.height * static_cast<double>(plan.view_to_clip[1][1]);
    const auto texels_per_m = static_cast<float>(scene::detail_texels_per_m(focal_px));
    for (std::size_t scale = 0; scale < positions.size(); ++scale) {
        positions[scale] = glm::vec4(plan.detail_texture->at_eye[scale], texels_per_m);
    }
    return positions;
}

FrameUniforms values_of(const FramePlan& plan, const PixelRect& rect, RowOrder row_order) {
    const float visibility_m = plan.haze.visibility_m;
    const scene::MirroredSky mirrored = plan.mirrored_sky.value_or(scene::MirroredSky());
    return {plan.view_to_clip * plan.world_to_view,
        glm::vec4(plan.haze.colour, visibility_m > 0.0F ? 1.0F / visibility_m : 0.0F),
        glm::vec4(plan.haze.sunward_colour, plan.haze.falloff_per_m),
        glm::vec4(plan.haze.horizontal_to_sun, 0.0F, 0.0F), glm::vec4(plan.to_sun, 0.0F), glm::vec4(plan.ambient, 0.0F),
        glm::vec4(plan.sunlight, 0.0F), glm::vec4(mirrored.overhead, plan.mirrored_sky ? 1.0F : 0.0F),
        glm::vec4(mirrored.below, 0.0F), ray_from_pixel(plan, rect, row_order),
        plan.ground_texture.value_or(scene::GroundTextureTransforms()), eye_detail_positions(plan, rect)};
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
    refined_.upload(plan, aircraft_);
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
            refined_.draw(step, clip, aircraft_);
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
    const glm::ivec2 min_px = glm::max(box.min, glm::ivec2(0));
    const glm::ivec2 size = glm::min(box.max, glm::ivec2(rect.width, rect.height)) - min_px;
    if (size.x <= 0 || size.y <= 0) { return; }
    // A mask left by an earlier step would keep the clearing out, too.
    gl_.depth_mask(GL_TRUE);
    gl_.enable(GL_SCISSOR_TEST);
    gl_.scissor(rect.x + min_px.x, rect.y + min_px.y, size.x, size.y);
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

std::unique_ptr<scene::Renderer> make_gl_renderer(OffscreenContext context, const glm::ivec2& size_px, int samples) {
    switch (context) {
    case OffscreenContext::Egl:
        return make_gl_renderer(make_egl_context(), size_px, samples);
    case OffscreenContext::HiddenWindow:
        return make_gl_renderer(make_window_context({.visible = false}), size_px, samples);
    case OffscreenContext::OsMesa:
        break;
    }
    return make_gl_renderer(make_osmesa_context(), size_px, samples);
}

std::unique_ptr<scene::Renderer> make_gl_renderer(
    std::shared_ptr<Context> context, const glm::ivec2& size_px, int samples) {
    return std::make_unique<Renderer>(std::move(context), size_px, samples);
}

} // namespace octant::visuals::gl
