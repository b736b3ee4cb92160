#pragma once

#include "sim/aircraft_state.h"
#include "visuals/planning/planner.h"
#include "visuals/planning/scene.h"
#include "visuals/raster/renderer.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/settings.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace octant::ui::library {

/// What one thread needs to draw pictures of a scene: a planner and a renderer of its own, with their memory. Pictures
/// do not depend on those before them.
class DrawingLane {
public:
    /// The scene and the settings must outlive it. Loading work: milliseconds.
    DrawingLane(const visuals::planning::Scene& scene, const visuals::scene::Settings& settings);
    DrawingLane(const DrawingLane&) = delete;
    DrawingLane& operator=(const DrawingLane&) = delete;
    DrawingLane(DrawingLane&&) = delete;
    DrawingLane& operator=(DrawingLane&&) = delete;
    ~DrawingLane() = default;

    /// Plans and draws a picture. Valid until the next one: 4 bytes a pixel, rows from the top.
    const visuals::scene::Picture& draw(const visuals::scene::Camera& camera, const glm::ivec2& size_px, int samples,
        std::span<const sim::AircraftState> states);

private:
    visuals::planning::Planner planner_;
    visuals::raster::Renderer renderer_;
    visuals::scene::Picture picture_;
};

/// The lanes of a scene. Grows to the number of threads that have drawn at the same time.
class DrawingLanes {
public:
    /// As DrawingLane.
    DrawingLanes(const visuals::planning::Scene& scene, const visuals::scene::Settings& settings)
        : scene_(scene), settings_(settings) {}

    /// Calls work(index, lane) once for each index below `count` on at most `threads` threads, this one among them:
    /// each takes the next index that is left, and draws with a lane of its own. `is_stopped`, if not empty, is asked
    /// by this thread before each index of its own; true ends the loop early. Returns whether the loop came to its end.
    /// The first exception of `work` ends the loop and is thrown here. May be called by several threads at once.
    bool for_each(std::size_t count, int threads, const std::function<bool()>& is_stopped,
        const std::function<void(std::size_t index, DrawingLane& lane)>& work);

private:
    std::unique_ptr<DrawingLane> take();
    void give_back(std::unique_ptr<DrawingLane> lane);

    const visuals::planning::Scene& scene_;
    const visuals::scene::Settings& settings_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<DrawingLane>> idle_;
};

} // namespace octant::ui::library
