#include "visuals/gl/renderer.h"

#include "sim/base/error.h"

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <span>

namespace octant::visuals::gl {
namespace {

using models::ColourVertex;
using scene::FramePlan;
using scene::HiddenSurface;
using scene::PaintStep;

constexpr GLuint picture_binding = 0; ///< place in the shaders

/// The block Picture of the shaders.
struct PictureValues {
    glm::mat4 world_to_clip;
    glm::vec4 haze;
    glm::vec4 to_sun;
    glm::vec4 ambient;
    glm::vec4 sunlight;
    glm::mat4 ray_from_pixel;
    scene::TexturePlaces ground_texture;
};

constexpr glm::vec4 inset_frame{0.08F, 0.09F, 0.1F, 1.0F};
constexpr int frame_rows = 360; ///< of the picture for each pixel of the frame's width

/// Pixels of the target to world axes, one unit deep; `rect` lies on the target.
glm::mat4 ray_from_pixel(const FramePlan& plan, const PixelRect& rect, Rows rows) {
    const float across = 1.0F / plan.view_to_clip[0][0];
    const float up = (rows == Rows::FromTop ? 1.0F : -1.0F) / plan.view_to_clip[1][1];
    glm::mat4 view_ray(0.0F);
    view_ray[0].x = 2.0F * across / static_cast<float>(rect.width);
    view_ray[1].y = -2.0F * up / static_cast<float>(rect.height);
    view_ray[2] = glm::vec4(-across, up, -1.0F, 0.0F) - static_cast<float>(rect.x) * view_ray[0] -
                  static_cast<float>(rect.y) * view_ray[1];
    return glm::transpose(plan.world_to_view) * view_ray;
}

PictureValues values_of(const FramePlan& plan, const PixelRect& rect, Rows rows) {
    const float visibility_m = plan.haze.visibility_m;
    return {
        plan.view_to_clip * plan.world_to_view,
        glm::vec4(plan.haze.colour, visibility_m > 0.0F ? 1.0F / visibility_m : 0.0F),
        glm::vec4(plan.to_sun, 0.0F),
        glm::vec4(plan.ambient, 0.0F),
        glm::vec4(plan.sunlight, 0.0F),
        ray_from_pixel(plan, rect, rows),
        plan.ground_texture.value_or(scene::TexturePlaces())};
}

} // namespace

Renderer::Renderer(const Functions& gl, int width, int height, int samples)
    : gl_(gl)
    , framebuffer_(gl, width, height, samples)
    , picture_values_(gl, sizeof(PictureValues))
    , state_(gl)
    , triangles_(gl, state_)
    , aircraft_(gl, state_)
    , refined_(gl, state_)
    , overlay_(gl, state_) {}

void Renderer::resize(const glm::ivec2& size_px, int samples) {
    if (framebuffer_.fits(size_px, samples)) {
        return;
    }
    framebuffer_ = Framebuffer(gl_, size_px.x, size_px.y, samples);
}

void Renderer::copy_to(GLuint framebuffer, const glm::ivec2& size_px) {
    framebuffer_.copy_to(framebuffer, size_px);
}

void Renderer::load_models(std::span<const scene::ModelBuffers> models) {
    aircraft_.load_models(models);
}

void Renderer::load_ground_texture(const scene::GroundTexture& texture) {
    triangles_.load_texture(texture);
}

void Renderer::draw(const FramePlan& plan) {
    const PixelRect whole{0, 0, framebuffer_.width(), framebuffer_.height()};
    const bool fits = plan.hidden_surface != HiddenSurface::DepthBuffer &&
                      !aircraft_.has_meshes() && framebuffer_.fits(window_px_, 1);
    rows_ = fits ? Rows::FromBelow : Rows::FromTop;
    gl_.bind_framebuffer(GL_FRAMEBUFFER, target_of(plan));
    state_.begin_picture(rows_);
    draw_into(plan, {whole, false});
}

void Renderer::draw_inset(const FramePlan& plan, const PixelRect& rect) {
    assert(rect.width > 0 && rect.height > 0 && rect.x >= 0 && rect.y >= 0);
    assert(rect.x + rect.width <= framebuffer_.width());
    assert(rect.y + rect.height <= framebuffer_.height());
    const GLuint target = target_of(plan);
    gl_.bind_framebuffer(GL_FRAMEBUFFER, target);
    const int frame = std::max(framebuffer_.height() / frame_rows, 1);
    gl_.enable(GL_SCISSOR_TEST);
    const PixelRect at = on_target(rect);
    gl_.scissor(at.x - frame, at.y - frame, at.width + 2 * frame, at.height + 2 * frame);
    gl_.clear_named_framebufferfv(target, GL_COLOR, 0, glm::value_ptr(inset_frame));
    gl_.scissor(at.x, at.y, at.width, at.height);
    draw_into(plan, {at, true});
    gl_.disable(GL_SCISSOR_TEST);
}

PixelRect Renderer::on_target(const PixelRect& rect) const {
    PixelRect at = rect;
    if (rows_ == Rows::FromBelow) {
        at.y = framebuffer_.height() - rect.y - rect.height;
    }
    return at;
}

GLuint Renderer::target_of(const FramePlan& plan) const {
    if (rows_ == Rows::FromBelow) {
        return 0;
    }
    const bool with_depth =
        plan.hidden_surface == HiddenSurface::DepthBuffer || !plan.depth_boxes.empty();
    return with_depth ? framebuffer_.name() : framebuffer_.name_without_depth();
}

/// Into what is bound.
void Renderer::draw_into(const FramePlan& plan, const Place& place) {
    const PixelRect& rect = place.rect;
    gl_.viewport(rect.x, rect.y, rect.width, rect.height);
    clear(plan);
    upload(plan, rect);
    if (plan.hidden_surface == HiddenSurface::DepthBuffer) {
        draw_by_depth(plan);
    } else {
        paint(plan, place);
    }
    overlay_.draw(plan.overlay, rect.width, rect.height);
}

void Renderer::clear(const FramePlan& plan) {
    const GLuint target = target_of(plan);
    const glm::vec4 background(plan.background, 1.0F);
    gl_.clear_named_framebufferfv(target, GL_COLOR, 0, glm::value_ptr(background));
    if (plan.hidden_surface == HiddenSurface::DepthBuffer) {
        // A mask left by the sky of the picture before would keep the clearing out, too.
        gl_.depth_mask(GL_TRUE);
        const float infinitely_far = 0.0F;
        gl_.clear_named_framebufferfv(target, GL_DEPTH, 0, &infinitely_far);
    }
}

void Renderer::upload(const FramePlan& plan, const PixelRect& rect) {
    const PictureValues values = values_of(plan, rect, rows_);
    picture_values_.fill({std::as_bytes(std::span(&values, 1))});
    gl_.bind_buffer_base(GL_UNIFORM_BUFFER, picture_binding, picture_values_.name());
    triangles_.upload(plan);
    aircraft_.upload(plan);
    refined_.upload(plan);
}

/// Background, sky, ground, then each step over what is there: no depth but that of solids.
void Renderer::paint(const FramePlan& plan, const Place& place) {
    triangles_.draw_sky(Depth::Unused);
    triangles_.draw_ground(Depth::Unused);
    for (const PaintStep& step : plan.steps) {
        const scene::Clip* const clip =
            step.clip == PaintStep::whole ? nullptr : &plan.clips[step.clip];
        switch (step.what) {
        case PaintStep::What::Aircraft:
            aircraft_.draw(step.first, step.count, Depth::Unused, clip);
            break;
        case PaintStep::What::Ground:
            triangles_.repaint(step.first, step.count, clip);
            break;
        case PaintStep::What::ClearDepth:
            clear_depth(plan, plan.depth_boxes[step.first], place);
            break;
        case PaintStep::What::GroundDepth:
            triangles_.draw_depth(step.first, step.count);
            break;
        case PaintStep::What::Solid:
            aircraft_.draw(step.first, step.count, Depth::Nearest);
            break;
        case PaintStep::What::Refined:
            refined_.draw(step.first, step.count, aircraft_.programs());
            break;
        }
    }
}

/// In a box of the plan's picture.
void Renderer::clear_depth(const FramePlan& plan, const scene::PixelBox& box, const Place& place) {
    const PixelRect& rect = place.rect;
    const glm::ivec2 least = glm::max(box.least, glm::ivec2(0));
    const glm::ivec2 size = glm::min(box.most, glm::ivec2(rect.width, rect.height)) - least;
    if (size.x <= 0 || size.y <= 0) {
        return;
    }
    gl_.depth_mask(GL_TRUE);
    gl_.enable(GL_SCISSOR_TEST);
    gl_.scissor(rect.x + least.x, rect.y + least.y, size.x, size.y);
    const float infinitely_far = 0.0F;
    gl_.clear_named_framebufferfv(target_of(plan), GL_DEPTH, 0, &infinitely_far);
    if (place.is_inset) {
        gl_.scissor(rect.x, rect.y, rect.width, rect.height);
    } else {
        gl_.disable(GL_SCISSOR_TEST);
    }
}

/// From near to far, so that what is hidden is not coloured first. Where aircraft and ground are
/// equally near the aircraft is seen.
void Renderer::draw_by_depth(const FramePlan& plan) {
    aircraft_.draw(0, static_cast<std::uint32_t>(plan.aircraft.size()), Depth::Nearest);
    refined_.draw(0, static_cast<std::uint32_t>(plan.refined.size()), aircraft_.programs());
    triangles_.draw_ground(Depth::Nearest);
    triangles_.draw_shadows();
    triangles_.draw_sky(Depth::InfinitelyFar);
}

void Renderer::finish() {
    gl_.finish();
    const GLenum fault = gl_.get_error();
    if (fault != GL_NO_ERROR) {
        throw Error(fmt::format("expected OpenGL to draw without error, got {:#06x}", fault));
    }
}

void Renderer::finish_and_read(Picture& picture) {
    assert(!is_in_window());
    finish();
    picture.width = framebuffer_.width();
    picture.height = framebuffer_.height();
    picture.rgba.resize(
        std::size_t{4} * static_cast<std::size_t>(picture.width) *
        static_cast<std::size_t>(picture.height));
    framebuffer_.read(picture.rgba);
}

void Renderer::warm_up() {
    const std::array<ColourVertex, 3> corners{
        ColourVertex{{-1.0F, -1.0F, -2.0F}, 0U},
        ColourVertex{{1.0F, -1.0F, -2.0F}, 0U},
        ColourVertex{{0.0F, 1.0F, -2.0F}, 0U}};
    const std::array<std::uint32_t, 3> triangle{0, 1, 2};
    const std::array<scene::ModelVertex, 3> mesh_corners{
        scene::ModelVertex{.position_m = corners[0].position_m},
        scene::ModelVertex{.position_m = corners[1].position_m},
        scene::ModelVertex{.position_m = corners[2].position_m}};
    FramePlan plan;
    plan.view_to_clip = glm::mat4(0.0F);
    plan.view_to_clip[0][0] = 1.0F;
    plan.view_to_clip[1][1] = 1.0F;
    plan.view_to_clip[2][3] = -1.0F;
    plan.view_to_clip[3][2] = 0.5F;
    plan.sky = {corners, triangle};
    plan.ground = {corners, triangle};
    plan.shadow_indices = {0, 1, 2};
    if (triangles_.has_texture()) {
        plan.ground_texture.emplace();
    }
    plan.repaint_indices = {0, 1, 2};
    plan.clips.push_back({{glm::vec4(1.0F, 0.0F, 0.0F, 0.0F)}, 1});
    plan.steps = {
        {PaintStep::What::Ground, 0, 3, PaintStep::whole}, {PaintStep::What::Ground, 0, 3, 0}};
    const std::array<scene::OverlayVertex, 3> overlay_corners{
        {{{0.0F, 0.0F}, 0U}, {{4.0F, 0.0F}, 0U}, {{0.0F, 4.0F}, 0U}}};
    plan.overlay = {overlay_corners, triangle};
    aircraft_.add_any(plan);
    const auto aircraft = static_cast<std::uint32_t>(plan.aircraft.size());
    plan.steps.push_back({PaintStep::What::Aircraft, 0, aircraft, PaintStep::whole});
    plan.steps.push_back({PaintStep::What::Aircraft, 0, aircraft, 0});
    if (aircraft_.has_meshes()) {
        plan.depth_boxes.push_back({{0, 0}, {1, 1}});
        plan.steps.push_back({PaintStep::What::ClearDepth, 0, 1, PaintStep::whole});
        plan.steps.push_back({PaintStep::What::GroundDepth, 0, 3, PaintStep::whole});
        plan.steps.push_back({PaintStep::What::Solid, 0, aircraft, PaintStep::whole});
        plan.refined.push_back({mesh_corners, triangle, 0, 0, {}});
        plan.steps.push_back({PaintStep::What::Refined, 0, 1, PaintStep::whole});
    }
    Picture picture;
    for (const HiddenSurface way : {HiddenSurface::Octant, HiddenSurface::DepthBuffer}) {
        plan.hidden_surface = way;
        draw(plan);
        draw_inset(plan, {0, 0, framebuffer_.width(), framebuffer_.height()});
        finish_and_read(picture);
    }
}

} // namespace octant::visuals::gl
