#pragma once

#include "sim/aircraft_state.h"
#include "visuals/scene/aircraft_model.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/ground.h"
#include "visuals/scene/settings.h"
#include "visuals/scene/sky.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::scene {

/// Everything that is loaded once and looked at in every frame.
struct Scene {
    std::unique_ptr<Ground> ground;
    std::vector<AircraftModel> models;    ///< each once, however many aircraft fly it
    std::vector<std::uint32_t> aircraft;  ///< model of each aircraft
    std::optional<std::uint32_t> cockpit; ///< model of what the first pilot sees around the eye
};

/// What one frame drew.
struct PlanCounts {
    GroundCounts ground;
    int aircraft_polygons = 0;
    int draw_cell = 0; ///< of the first aircraft
    int cuts = 0;      ///< ground triangles and aircraft polygons painted again, cut by planes
    int unordered = 0; ///< overlaps for which no order was found; 0 but for aircraft that touch
    int shadow_triangles = 0;
};

/// Decides what is drawn in each frame. Keeps memory that the plans point into, and the ground's
/// detail control from frame to frame.
class Planner {
public:
    /// The scene and the settings must outlive the planner.
    Planner(Scene& scene, const Settings& settings);

    /// Prepares the ground for the camera of the first frame. Loading work.
    void settle(const Camera& camera);

    /// The plan of the next frame; `states` are those of Scene::aircraft. Valid until the next
    /// call. No allocation once the first frames have been planned.
    const FramePlan&
    plan(const Camera& camera, std::span<const sim::AircraftState> states, PlanCounts& counts);

private:
    void plan_sky(const Camera& camera);
    void plan_aircraft(
        const Camera& camera, std::span<const sim::AircraftState> states, PlanCounts& counts);

    Scene& scene_;
    const Settings& settings_;
    double aspect_;
    Sky sky_;
    std::vector<std::uint32_t> facing_indices_;
    std::vector<std::uint32_t> sorted_indices_;
    FramePlan plan_;
};

} // namespace octant::visuals::scene
