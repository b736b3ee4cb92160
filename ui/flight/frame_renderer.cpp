#include "ui/flight/frame_renderer.h"

#include "sim/base/error.h"
#include "sim/base/stopwatch.h"

#include <algorithm>
#include <stdexcept>

namespace octant::ui::flight {

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

/// The inset's side by the picture's, and its margin by the picture's shorter side.
constexpr int inset_side_divisor = 3;
constexpr int inset_margin_divisor = 40;
constexpr int inset_triangle_divisor = 4;
constexpr int min_inset_triangles = 1000;

/// The settings with the inset's view in place of the picture's.
settings::RunSettings inset_settings(settings::RunSettings settings, const scene::PixelRect& rectangle) {
    settings.ground.triangles =
        std::max(min_inset_triangles, scene::triangle_target(settings) / inset_triangle_divisor);
    settings.view.kind = *settings.view.inset;
    settings.view.inset.reset();
    settings.view.size_px = {rectangle.width, rectangle.height};
    settings.view.azimuth_deg = 0.0;
    settings.view.elevation_deg = 0.0;
    settings.view.zoom = 1.0;
    return settings;
}

} // namespace

scene::PixelRect inset_rectangle(const glm::ivec2& picture_px) {
    const glm::ivec2 size_px = glm::max(picture_px / inset_side_divisor, glm::ivec2(1));
    const int margin_px = std::min(picture_px.x, picture_px.y) / inset_margin_divisor;
    const glm::ivec2 at_px = picture_px - size_px - margin_px;
    return {at_px.x, at_px.y, size_px.x, size_px.y};
}

void FrameRenderer::load_models(PictureContent content) {
    if (content == PictureContent::PolygonIds) {
        ids_.emplace(scene_);
        renderer_.load_models(ids_->models());
        return;
    }
    std::vector<scene::ModelBuffers> buffers;
    for (const auto& model : scene_.models) { buffers.push_back(model->buffers); }
    renderer_.load_models(buffers);
}

// The views, which follow the settings and the scene.

void FrameRenderer::update_views(const scene::Camera& now) {
    const std::size_t count = settings_.view.inset ? 2 : 1;
    views_.resize(std::min(count, views_.size()));
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_new = i == views_.size();
        if (is_new) { views_.push_back(std::make_unique<PictureView>()); }
        PictureView& view = *views_[i];
        update_settings(i);
        view.plan = nullptr;
        if (is_new) {
            view.planner.emplace(scene_, view.settings);
        } else {
            view.planner->apply_settings();
        }
    }
    views_.front()->planner->settle_detail(now); // loading work, which is not left to the first picture
}

/// Gives a view its part of the run's settings.
void FrameRenderer::update_settings(std::size_t view) {
    const glm::ivec2& picture_px = settings_.view.size_px;
    const bool is_first = view == 0;
    views_[view]->rectangle =
        is_first ? scene::PixelRect{0, 0, picture_px.x, picture_px.y} : inset_rectangle(picture_px);
    views_[view]->settings = is_first ? settings_ : inset_settings(settings_, views_[view]->rectangle);
}

void FrameRenderer::set_sun(const scene::Camera& now) {
    apply_look();
    for (const auto& view : views_) {
        view->plan = nullptr;
        view->planner->set_sun();
    }
    views_.front()->planner->settle_detail(now);
}

void FrameRenderer::apply_look() {
    for (std::size_t i = 0; i < views_.size(); ++i) { update_settings(i); }
}

// A frame: planned, drawn, shown.

planning::PlanRequest FrameRenderer::request(
    const FrameState& now, std::size_t view, const planning::SmoothTarget& smooth) {
    // A view that was added after this state has no camera in it.
    planning::PlanRequest wanted{now.cameras[std::min(view, now.cameras.size() - 1)], now.states};
    wanted.smooth = smooth;
    wanted.articulated_parts = now.articulated_parts;
    if (view == 0) {
        wanted.triangle_target = now.triangle_target;
        wanted.overlay_lines = overlay_lines_;
    }
    return wanted;
}

FrameRenderer::PlannedPicture FrameRenderer::plan(const FrameState& now, std::optional<int> smooth) {
    PlannedPicture planned;
    planning::SmoothTarget smooth_target{.polygons = smooth, .share = std::nullopt};
    for (std::size_t i = 0; i < views_.size(); ++i) {
        PictureView& view = *views_[i];
        const planning::PlanRequest wanted = request(now, i, smooth_target);
        if (i == 0) {
            Stopwatch stage;
            view.planner->place_aircraft(wanted);
            planned.refine_ms = stage.lap_ms();
            view.planner->wait();
            planned.mesh_wait_ms = stage.lap_ms();
        }
        const planning::PlannedFrame frame = view.planner->plan(wanted);
        view.plan = ids_ && i == 0 ? &ids_->of(frame.plan) : &frame.plan;
        if (i > 0) { continue; }
        planned.counts = frame.counts;
        smooth_target = {}; // the other views show the same share of their polygons
        if (smooth && frame.counts.smoothable_polygons > 0) {
            smooth_target.share = std::min(static_cast<double>(*smooth) / frame.counts.smoothable_polygons, 1.0);
        }
    }
    return planned;
}

void FrameRenderer::advance_without_drawing(const FrameState& now, std::optional<int> smooth) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const planning::SmoothTarget smooth_target{.polygons = i == 0 ? smooth : std::nullopt, .share = std::nullopt};
        views_[i]->planner->advance_without_drawing(request(now, i, smooth_target));
    }
}

void FrameRenderer::mesh_async(const FrameState& next) {
    const auto on_idle_thread = [this](std::function<void()> work) {
        return renderer_.begin_on_idle_thread(std::move(work));
    };
    for (std::size_t i = 0; i < views_.size(); ++i) {
        views_[i]->planner->begin_next_mesh(
            next.cameras[i], i == 0 ? std::optional(next.triangle_target) : std::nullopt, on_idle_thread);
    }
}

void FrameRenderer::wait() {
    for (const auto& view : views_) { view->planner->wait(); }
}

void FrameRenderer::draw_plans() {
    renderer_.draw(*views_.front()->plan);
    for (std::size_t i = 1; i < views_.size(); ++i) { renderer_.draw_inset(*views_[i]->plan, views_[i]->rectangle); }
}

void FrameRenderer::draw() {
    draw_plans();
    renderer_.finish();
}

void FrameRenderer::show() {
    picture_is_read_ = !presenter_ || reads_before_presenting_;
    if (!presenter_) {
        renderer_.finish_and_read(picture_);
        return;
    }
    if (reads_before_presenting_) { renderer_.finish_and_copy(picture_); }
    presenter_(renderer_);
}

void FrameRenderer::read(const FrameState& now, std::optional<int> smooth) {
    if (picture_is_read_) { return; }
    if (renderer_.is_drawn_to_window()) {
        if (views_.front()->plan == nullptr) { plan(now, smooth); }
        renderer_.set_window_target(glm::ivec2(0));
        draw_plans();
    }
    renderer_.finish_and_read(picture_);
    picture_is_read_ = true;
}

// The renderer's memory.

void FrameRenderer::prepare_renderer(const scene::ViewSettings& view, const scene::GroundTexture* texture) {
    renderer_.resize(view.size_px, view.samples);
    if (texture == nullptr) { return; }
    try {
        renderer_.load_ground_texture(*texture);
    } catch (const Error&) {
        restore_window_size();
        throw;
    }
}

/// Gives the renderer its size back and draws the last picture once more. A driver that has no memory any more for what
/// it held before ends it all.
void FrameRenderer::restore_window_size() {
    try {
        renderer_.resize(settings_.view.size_px, settings_.view.samples);
    } catch (const Error& fault) { throw std::runtime_error(fault.what()); }
    if (views_.front()->plan != nullptr) { draw_plans(); }
}

} // namespace octant::ui::flight
