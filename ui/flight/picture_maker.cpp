#include "ui/flight/picture_maker.h"

#include "sim/base/error.h"
#include "visuals/landscape/ground.h"

#include <algorithm>
#include <stdexcept>

namespace octant::ui::flight {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

void PictureMaker::load_models(Shows shows) {
    if (shows == Shows::PolygonNumbers) {
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

void PictureMaker::begin(const scene::Camera& first) {
    follow_inset();
    planner_.emplace(scene_, settings_);
    planner_->settle(first);
}

void PictureMaker::end() {
    plan_ = nullptr;
    planner_.reset();
    inset_.reset();
}

planning::PlanRequest PictureMaker::request(const Moment& now, std::optional<int> smooth) const {
    return {
        .camera = now.camera,
        .states = now.states,
        .triangle_target = now.triangle_target,
        .smooth = {.polygons = smooth, .share = std::nullopt},
        .when_refined = nullptr,
        .words = words_,
        .turned = now.turned};
}

planning::PlanCounts PictureMaker::plan(
    const Moment& now, std::optional<int> smooth, std::function<void()> when_refined) {
    planning::PlanRequest wanted = request(now, smooth);
    wanted.when_refined = std::move(when_refined);
    const planning::PlannedFrame frame = planner_->plan(wanted);
    plan_ = ids_ ? &ids_->of(frame.plan) : &frame.plan;
    std::optional<double> share; // of the picture's polygons, and so of the inset's
    if (smooth && frame.counts.may_be_smooth > 0) {
        share = std::min(static_cast<double>(*smooth) / frame.counts.may_be_smooth, 1.0);
    }
    inset_plan_ = inset_ ? &inset_->plan(now.inset_camera, now.states, now.turned, share) : nullptr;
    return frame.counts;
}

void PictureMaker::pass_over(const Moment& now, std::optional<int> smooth) {
    planner_->pass_over(request(now, smooth));
    if (inset_) {
        inset_->pass_over(now.inset_camera, now.states, now.turned);
    }
}

void PictureMaker::mesh_ahead(const Moment& next) {
    const auto beside = [this](std::function<void()> work) {
        return renderer_.begin_beside(std::move(work));
    };
    planner_->prepare(next.camera, next.triangle_target, beside);
    if (inset_) {
        inset_->prepare(next.inset_camera, beside);
    }
}

void PictureMaker::draw_plans() {
    renderer_.draw(*plan_);
    if (inset_plan_ != nullptr) {
        renderer_.draw_inset(*inset_plan_, inset_->rectangle());
    }
}

void PictureMaker::draw() {
    draw_plans();
    renderer_.finish();
}

void PictureMaker::show() {
    picture_is_read_ = !presenter_ || reads_first_;
    if (!presenter_) {
        renderer_.finish_and_read(picture_);
        return;
    }
    if (reads_first_) {
        renderer_.finish_and_copy(picture_);
    }
    presenter_(renderer_);
}

void PictureMaker::read(const Moment& now, std::optional<int> smooth) {
    if (picture_is_read_) {
        return;
    }
    if (renderer_.is_in_window()) {
        if (plan_ == nullptr) {
            plan(now, smooth, nullptr);
        }
        renderer_.aim_at_window(glm::ivec2(0));
        draw_plans();
    }
    renderer_.finish_and_read(picture_);
    picture_is_read_ = true;
}

void PictureMaker::wait_for_first_view() {
    planner_->wait();
}

void PictureMaker::wait() {
    wait_for_first_view();
    if (inset_) {
        inset_->wait();
    }
}

void PictureMaker::make_ready(
    const scene::ViewSettings& view, const scene::GroundTexture* texture) {
    renderer_.resize(view.size_px, view.samples);
    if (texture == nullptr) {
        return;
    }
    try {
        renderer_.load_ground_texture(*texture);
    } catch (const Error&) {
        give_size_back();
        throw;
    }
}

/// Gives the renderer its size back and draws the last picture once more. A driver that has no
/// memory any more for what it held before ends it all.
void PictureMaker::give_size_back() {
    try {
        renderer_.resize(settings_.view.size_px, settings_.view.samples);
    } catch (const Error& fault) {
        throw std::runtime_error(fault.what());
    }
    if (plan_ != nullptr) {
        draw_plans();
    }
}

void PictureMaker::follow(bool other_control, const scene::Camera& now) {
    plan_ = nullptr;
    follow_ground(other_control, now);
    follow_inset();
}

void PictureMaker::follow_ground(bool other_control, const scene::Camera& now) {
    std::unique_ptr<landscape::GroundMesher> mesher = planner_->take_mesher();
    const landscape::GroundMesher* const before = mesher.get();
    mesher = landscape::mesher_after(
        std::move(mesher),
        *scene_.ground,
        landscape::mesh_settings(settings_, scene_.ground_texture != nullptr));
    const bool settles = other_control || mesher.get() != before;
    planner_.reset();
    planner_.emplace(scene_, settings_, std::move(mesher));
    if (settles) {
        planner_->settle(now);
    }
}

void PictureMaker::follow_inset() {
    if (!settings_.view.inset) {
        inset_.reset();
    } else if (inset_) {
        inset_->follow(settings_);
    } else {
        inset_ = std::make_unique<InsetView>(settings_, scene_);
    }
}

void PictureMaker::relight(const scene::Camera& now) {
    plan_ = nullptr;
    if (!planner_->relight()) {
        planner_->settle(now);
    }
    if (inset_) {
        inset_->relight(settings_);
    }
}

void PictureMaker::follow_look() {
    if (inset_) {
        inset_->look(settings_);
    }
}

} // namespace octant::ui::flight
