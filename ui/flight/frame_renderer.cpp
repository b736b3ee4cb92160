#include "ui/flight/frame_renderer.h"

#include "sim/base/error.h"
#include "visuals/landscape/ground.h"

#include <algorithm>
#include <stdexcept>

namespace octant::ui::flight {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

void FrameRenderer::load_models(PictureContent content) {
    if (content == PictureContent::PolygonIds) {
        ids_.emplace(scene_);
        renderer_.load_models(ids_->models());
        return;
    }
    std::vector<scene::ModelBuffers> buffers;
    for (const auto& model : scene_.models) {
        buffers.push_back(model->buffers);
    }
    renderer_.load_models(buffers);
}

void FrameRenderer::begin(const scene::Camera& first) {
    update_inset();
    planner_.emplace(scene_, settings_);
    planner_->reset_detail(first);
}

void FrameRenderer::end() {
    plan_ = nullptr;
    planner_.reset();
    inset_.reset();
}

planning::PlanRequest FrameRenderer::request(const FrameState& now, std::optional<int> smooth) const {
    return {
        .camera = now.camera,
        .states = now.states,
        .triangle_target = now.triangle_target,
        .smooth = {.polygons = smooth, .share = std::nullopt},
        .on_refined = nullptr,
        .overlay_lines = overlay_lines_,
        .articulated_parts = now.articulated_parts};
}

planning::PlanCounts FrameRenderer::plan(
    const FrameState& now, std::optional<int> smooth, std::function<void()> on_refined) {
    planning::PlanRequest wanted = request(now, smooth);
    wanted.on_refined = std::move(on_refined);
    const planning::PlannedFrame frame = planner_->plan(wanted);
    plan_ = ids_ ? &ids_->of(frame.plan) : &frame.plan;
    std::optional<double> share; // of the picture's polygons, and so of the inset's
    if (smooth && frame.counts.smoothable_polygons > 0) {
        share = std::min(static_cast<double>(*smooth) / frame.counts.smoothable_polygons, 1.0);
    }
    inset_plan_ = inset_ ? &inset_->plan(now.inset_camera, now.states, now.articulated_parts, share) : nullptr;
    return frame.counts;
}

void FrameRenderer::advance_without_drawing(const FrameState& now, std::optional<int> smooth) {
    planner_->advance_without_drawing(request(now, smooth));
    if (inset_) {
        inset_->advance_without_drawing(now.inset_camera, now.states, now.articulated_parts);
    }
}

void FrameRenderer::mesh_async(const FrameState& next) {
    const auto on_idle_thread = [this](std::function<void()> work) {
        return renderer_.begin_on_idle_thread(std::move(work));
    };
    planner_->begin_next_mesh(next.camera, next.triangle_target, on_idle_thread);
    if (inset_) {
        inset_->begin_next_mesh(next.inset_camera, on_idle_thread);
    }
}

void FrameRenderer::draw_plans() {
    renderer_.draw(*plan_);
    if (inset_plan_ != nullptr) {
        renderer_.draw_inset(*inset_plan_, inset_->rectangle());
    }
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
    if (reads_before_presenting_) {
        renderer_.finish_and_copy(picture_);
    }
    presenter_(renderer_);
}

void FrameRenderer::read(const FrameState& now, std::optional<int> smooth) {
    if (picture_is_read_) {
        return;
    }
    if (renderer_.is_drawn_to_window()) {
        if (plan_ == nullptr) {
            plan(now, smooth, nullptr);
        }
        renderer_.set_window_target(glm::ivec2(0));
        draw_plans();
    }
    renderer_.finish_and_read(picture_);
    picture_is_read_ = true;
}

void FrameRenderer::wait_for_first_view() {
    planner_->wait();
}

void FrameRenderer::wait() {
    wait_for_first_view();
    if (inset_) {
        inset_->wait();
    }
}

void FrameRenderer::prepare_renderer(
    const scene::ViewSettings& view, const scene::GroundTexture* texture) {
    renderer_.resize(view.size_px, view.samples);
    if (texture == nullptr) {
        return;
    }
    try {
        renderer_.load_ground_texture(*texture);
    } catch (const Error&) {
        restore_window_size();
        throw;
    }
}

/// Gives the renderer its size back and draws the last picture once more. A driver that has no
/// memory any more for what it held before ends it all.
void FrameRenderer::restore_window_size() {
    try {
        renderer_.resize(settings_.view.size_px, settings_.view.samples);
    } catch (const Error& fault) {
        throw std::runtime_error(fault.what());
    }
    if (plan_ != nullptr) {
        draw_plans();
    }
}

void FrameRenderer::apply_settings(bool other_control, const scene::Camera& now) {
    plan_ = nullptr;
    update_ground(other_control, now);
    update_inset();
}

void FrameRenderer::update_ground(bool other_control, const scene::Camera& now) {
    std::unique_ptr<landscape::GroundMesher> mesher = planner_->take_mesher();
    const landscape::GroundMesher* const before = mesher.get();
    mesher = landscape::reuse_or_make_mesher(
        std::move(mesher),
        *scene_.ground,
        landscape::mesh_settings(settings_, scene_.ground_texture != nullptr));
    const bool settles = other_control || mesher.get() != before;
    planner_.reset();
    planner_.emplace(scene_, settings_, std::move(mesher));
    if (settles) {
        planner_->reset_detail(now);
    }
}

void FrameRenderer::update_inset() {
    if (!settings_.view.inset) {
        inset_.reset();
    } else if (inset_) {
        inset_->apply_settings(settings_);
    } else {
        inset_ = std::make_unique<InsetView>(settings_, scene_);
    }
}

void FrameRenderer::set_sun(const scene::Camera& now) {
    plan_ = nullptr;
    if (!planner_->set_sun()) {
        planner_->reset_detail(now);
    }
    if (inset_) {
        inset_->set_sun(settings_);
    }
}

void FrameRenderer::apply_look() {
    if (inset_) {
        inset_->apply_look(settings_);
    }
}

} // namespace octant::ui::flight
