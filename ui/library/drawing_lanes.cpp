#include "ui/library/drawing_lanes.h"

#include "sim/base/thread_pool.h"
#include "visuals/landscape/ground.h"
#include "visuals/planning/control_positions.h"
#include "visuals/planning/fleet.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <utility>

namespace octant::ui::library {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

constexpr glm::ivec2 first_size_px{16, 16};
constexpr int most_samples = 16;

} // namespace

DrawnScenes drawn_scenes(const planning::Scene& scene, const scene::Settings& settings) {
    DrawnScenes scenes{scene, settings, scene, settings};
    scenes.alone.ground = landscape::make_polygon_ground({}, settings.air);
    scenes.alone.ground_texture = nullptr;
    scenes.alone.path = nullptr;
    scenes.alone_settings.air.sky = false;
    scenes.alone_settings.air.clouds = 0.0;
    scenes.alone_settings.surface.shadows = false;
    if (settings.surface.effects == true) { scenes.alone_settings.surface.effects.reset(); } // the same solid surfaces
    scenes.alone_settings.view.path_ribbon = false;
    return scenes;
}

std::unique_ptr<visuals::raster::Renderer> SharedRenderers::take() {
    {
        const std::scoped_lock lock(mutex_);
        if (!idle_.empty()) {
            std::unique_ptr<visuals::raster::Renderer> renderer = std::move(idle_.back());
            idle_.pop_back();
            return renderer;
        }
    }
    auto made =
        std::make_unique<visuals::raster::Renderer>(std::make_shared<ThreadPool>(1), first_size_px, most_samples);
    std::vector<scene::ModelBuffers> buffers;
    for (const auto& model : models_) { buffers.push_back(model->buffers); }
    made->load_models(buffers);
    if (ground_texture_) { made->load_ground_texture(*ground_texture_); }
    return made;
}

void SharedRenderers::give_back(std::unique_ptr<visuals::raster::Renderer> renderer) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(renderer));
}

DrawingLane::DrawingLane(const DrawnScenes& scenes) : scenes_(scenes), planner_(scenes.whole, scenes.whole_settings) {}

std::unique_ptr<visuals::raster::Renderer> DrawingLane::use(std::unique_ptr<visuals::raster::Renderer> renderer) {
    return std::exchange(renderer_, std::move(renderer));
}

const scene::FramePlan& DrawingLane::plan_by(
    planning::Planner& planner, const PictureRequest& request, std::span<const models::ControlPositions> controls) {
    planner.forget_frames();
    planning::PlanRequest wanted{request.camera, request.states};
    wanted.size_px = request.size_px;
    wanted.previous = request.previous;
    wanted.controls = controls;
    plan_ = &planner.plan(wanted).plan;
    renderer_->resize(request.size_px, request.samples);
    return *plan_;
}

const scene::FramePlan& DrawingLane::plan(const PictureRequest& request) { return plan_by(planner_, request); }

const scene::FramePlan& DrawingLane::plan_alone(const PictureRequest& request) {
    if (!alone_planner_) { alone_planner_.emplace(scenes_.alone, scenes_.alone_settings); }
    // Sunk as over the ground that is left out: each pixel is then that of the whole picture.
    sunk_.clear();
    for (const sim::AircraftState& state : request.states) {
        sunk_.push_back(planning::sunk(state, request.camera.eye_m, planner_.earth_radius_m()));
    }
    // Their gear is down over that ground, too.
    controls_.clear();
    for (const sim::AircraftState& state : request.states) {
        controls_.push_back(planning::control_positions(state, *scenes_.whole.ground));
    }
    PictureRequest alone = request;
    alone.states = sunk_;
    return plan_by(*alone_planner_, alone, controls_);
}

const scene::Picture& DrawingLane::draw() {
    renderer_->draw(*plan_);
    renderer_->finish_and_read(picture_);
    return picture_;
}

void DrawingLane::draw_deep(std::span<std::uint16_t> colours) { renderer_->draw_deep(*plan_, colours); }

void DrawingLane::prepare_truth() { renderer_->prepare_truth(*plan_); }

void DrawingLane::draw_truth(const scene::TruthArrays& to, std::span<const glm::vec2> at_px) {
    renderer_->draw_truth(*plan_, to, at_px);
}

std::unique_ptr<DrawingLane> DrawingLanes::take() {
    std::unique_ptr<DrawingLane> lane;
    {
        const std::scoped_lock lock(mutex_);
        if (!idle_.empty()) {
            lane = std::move(idle_.back());
            idle_.pop_back();
        }
    }
    if (!lane) { lane = std::make_unique<DrawingLane>(scenes_); }
    lane->use(renderers_->take());
    return lane;
}

void DrawingLanes::give_back(std::unique_ptr<DrawingLane> lane) {
    renderers_->give_back(lane->use(nullptr));
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(lane));
}

bool DrawingLanes::for_each(std::size_t count, int threads, const std::function<bool()>& is_stopped,
    const std::function<void(std::size_t index, DrawingLane& lane)>& work) {
    if (count == 0) { return true; }
    std::atomic<std::size_t> next{0};
    std::atomic<bool> ends{false};
    std::atomic<bool> has_failed{false};
    std::exception_ptr exception; // of the thread that set has_failed
    bool was_stopped = false;
    const auto draw = [&](bool is_caller) {
        try {
            std::unique_ptr<DrawingLane> lane = take();
            for (std::size_t index = next++; index < count && !ends; index = next++) {
                if (is_caller && is_stopped && is_stopped()) {
                    was_stopped = true;
                    ends = true;
                    break;
                }
                work(index, *lane);
            }
            give_back(std::move(lane));
        } catch (...) {
            ends = true;
            if (!has_failed.exchange(true)) { exception = std::current_exception(); }
        }
    };
    const std::size_t helpers = std::min(count, static_cast<std::size_t>(std::max(threads, 1))) - 1;
    {
        std::vector<std::jthread> running; // joined at the end of the block
        running.reserve(helpers);
        try {
            for (std::size_t i = 0; i < helpers; ++i) { running.emplace_back(draw, false); }
        } catch (const std::system_error&) {} // The system gives no more threads: those that run draw everything.
        draw(true);
    }
    if (exception) { std::rethrow_exception(exception); }
    return !was_stopped;
}

} // namespace octant::ui::library
