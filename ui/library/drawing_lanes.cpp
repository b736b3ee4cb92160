#include "ui/library/drawing_lanes.h"

#include "sim/base/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <utility>

namespace octant::ui::library {

namespace scene = visuals::scene;

namespace {

constexpr glm::ivec2 first_size_px{16, 16};
constexpr int most_samples = 16;

} // namespace

DrawingLane::DrawingLane(const visuals::planning::Scene& scene, const scene::Settings& settings)
    : planner_(scene, settings), renderer_(std::make_shared<ThreadPool>(1), first_size_px, most_samples) {
    std::vector<scene::ModelBuffers> buffers;
    for (const auto& model : scene.models) { buffers.push_back(model->buffers); }
    renderer_.load_models(buffers);
    if (scene.ground_texture) { renderer_.load_ground_texture(*scene.ground_texture); }
}

const scene::Picture& DrawingLane::draw(
    const scene::Camera& camera, const glm::ivec2& size_px, int samples, std::span<const sim::AircraftState> states) {
    planner_.forget_frames();
    visuals::planning::PlanRequest request{camera, states};
    request.size_px = size_px;
    const visuals::planning::PlannedFrame frame = planner_.plan(request);
    renderer_.resize(size_px, samples);
    renderer_.draw(frame.plan);
    renderer_.finish_and_read(picture_);
    return picture_;
}

std::unique_ptr<DrawingLane> DrawingLanes::take() {
    {
        const std::scoped_lock lock(mutex_);
        if (!idle_.empty()) {
            std::unique_ptr<DrawingLane> lane = std::move(idle_.back());
            idle_.pop_back();
            return lane;
        }
    }
    return std::make_unique<DrawingLane>(scene_, settings_);
}

void DrawingLanes::give_back(std::unique_ptr<DrawingLane> lane) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(lane));
}

bool DrawingLanes::for_each(std::size_t count, int threads, const std::function<bool()>& is_stopped,
    const std::function<void(std::size_t index, DrawingLane& lane)>& work) {
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
    const std::size_t helpers = std::min(count, static_cast<std::size_t>(std::max(threads, 1))) - (count > 0 ? 1 : 0);
    {
        std::vector<std::jthread> running; // joined at the end of the block
        for (std::size_t i = 0; i < helpers; ++i) { running.emplace_back(draw, false); }
        draw(true);
    }
    if (exception) { std::rethrow_exception(exception); }
    return !was_stopped;
}

} // namespace octant::ui::library
