#pragma once

#include "models/part_motion.h"
#include "sim/aircraft_state.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/planner.h"
#include "visuals/planning/scene.h"
#include "visuals/raster/renderer.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/settings.h"
#include "visuals/scene/truth.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::ui::library {

/// What lanes draw: all of a world, and its aircraft alone, without ground, sky and shadows.
struct DrawnScenes {
    visuals::planning::Scene whole;
    visuals::scene::Settings whole_settings;
    visuals::planning::Scene alone;
    visuals::scene::Settings alone_settings;
};

DrawnScenes drawn_scenes(const visuals::planning::Scene& scene, const visuals::scene::Settings& settings);

/// A pinhole picture.
struct PictureRequest {
    visuals::scene::Camera camera;
    glm::ivec2 size_px{0};
    int samples = 16;
    /// Of all aircraft.
    std::span<const sim::AircraftState> states;
    /// Nothing = no flow.
    std::optional<visuals::planning::PreviousFrame> previous = std::nullopt;
};

/// The renderers of all scenes with the same models and ground texture, which hold copies of these: as many as have
/// drawn at the same time. For several threads at once.
class SharedRenderers {
public:
    /// For scenes with the models and the texture of this one.
    explicit SharedRenderers(const visuals::planning::Scene& scene)
        : models_(scene.models), ground_texture_(scene.ground_texture) {}

    bool are_for(const visuals::planning::Scene& scene) const {
        return scene.models == models_ && scene.ground_texture == ground_texture_;
    }

    /// One that nobody else draws with, until it is given back.
    std::unique_ptr<visuals::raster::Renderer> take();
    void give_back(std::unique_ptr<visuals::raster::Renderer> renderer);

private:
    std::vector<std::shared_ptr<const visuals::planning::AircraftModel>> models_;
    std::shared_ptr<const visuals::scene::GroundTexture> ground_texture_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<visuals::raster::Renderer>> idle_;
};

/// What one thread needs to draw pictures of a scene: a planner of its own, with its memory, and while it draws a
/// renderer. Pictures do not depend on those before them.
class DrawingLane {
public:
    /// The scenes must outlive it. Loading work: milliseconds.
    explicit DrawingLane(const DrawnScenes& scenes);
    DrawingLane(const DrawingLane&) = delete;
    DrawingLane& operator=(const DrawingLane&) = delete;
    DrawingLane(DrawingLane&&) = delete;
    DrawingLane& operator=(DrawingLane&&) = delete;
    ~DrawingLane() = default;

    /// With which it draws from now on. Returns the one before; null = none.
    std::unique_ptr<visuals::raster::Renderer> use(std::unique_ptr<visuals::raster::Renderer> renderer);

    /// Plans a picture. Valid until the next plan.
    const visuals::scene::FramePlan& plan(const PictureRequest& request);

    /// The same of the aircraft alone; those that are absent in the states are absent.
    const visuals::scene::FramePlan& plan_alone(const PictureRequest& request);

    /// Draws what was planned. Valid until the next picture: 4 bytes a pixel, rows from the top.
    const visuals::scene::Picture& draw();

    /// The same with 16 bits: red, green, blue of each pixel, 65535 = full.
    void draw_deep(std::span<std::uint16_t> colours);

    /// In place of draw() where only truth is wanted.
    void prepare_truth();

    /// Writes the truth of what draw() or prepare_truth() was called for, as raster::Renderer::draw_truth.
    void draw_truth(const visuals::scene::TruthArrays& to, std::span<const glm::vec2> at_px = {});

    /// The radius by which distant aircraft sink in these pictures; 0 = they do not.
    double earth_radius_m() const { return planner_.earth_radius_m(); }

private:
    /// `controls`: PlanRequest::controls.
    const visuals::scene::FramePlan& plan_by(visuals::planning::Planner& planner, const PictureRequest& request,
        std::span<const models::ControlPositions> controls = {});

    const DrawnScenes& scenes_;
    visuals::planning::Planner planner_;
    std::optional<visuals::planning::Planner> alone_planner_; ///< made when it is first asked for
    std::unique_ptr<visuals::raster::Renderer> renderer_;
    visuals::scene::Picture picture_;
    std::vector<sim::AircraftState> sunk_; ///< states of pictures of aircraft alone
    std::vector<models::ControlPositions> controls_; ///< of the same
    const visuals::scene::FramePlan* plan_ = nullptr;
};

/// The lanes of a scene. Grows to the number of threads that have drawn at the same time.
class DrawingLanes {
public:
    /// `renderers`: for these scenes.
    DrawingLanes(DrawnScenes scenes, std::shared_ptr<SharedRenderers> renderers)
        : scenes_(std::move(scenes)), renderers_(std::move(renderers)) {}

    const std::shared_ptr<SharedRenderers>& renderers() const { return renderers_; }

    /// Calls work(index, lane) once for each index below `count` on at most `threads` threads, this one among them
    /// (fewer where the system gives no more): each takes the next index that is left, and draws with a lane of its own. `is_stopped`, if not empty, is asked
    /// by this thread before each index of its own; true ends the loop early. Returns whether the loop came to its end.
    /// The first exception of `work` ends the loop and is thrown here. May be called by several threads at once.
    bool for_each(std::size_t count, int threads, const std::function<bool()>& is_stopped,
        const std::function<void(std::size_t index, DrawingLane& lane)>& work);

private:
    std::unique_ptr<DrawingLane> take();
    void give_back(std::unique_ptr<DrawingLane> lane);

    DrawnScenes scenes_;
    std::shared_ptr<SharedRenderers> renderers_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<DrawingLane>> idle_;
};

} // namespace octant::ui::library
