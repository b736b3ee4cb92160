#pragma once

#include "sim/aircraft_kind.h"
#include "sim/trajectory.h"
#include "ui/settings/settings.h"
#include "ui/world/aircraft_loader.h"
#include "ui/world/path_placement.h"
#include "ui/world/scene_ground.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/camera_rig.h"

#include <span>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Everything a run needs, loaded.
struct World {
    visuals::planning::Scene scene;
    /// The row of the first aircraft; null where only its shape is known.
    const sim::AircraftKind* leader_kind = nullptr;
    PlacedFlight flight{.trajectory = sim::Trajectory(std::vector<sim::AircraftState>(1)),
        .title = {},
        .legs = {},
        .other_trajectories = {}};
    visuals::scene::FixedViewpoints points;
    /// The loaded aircraft; `scene` shares their models.
    LoadedAircraft aircraft;
    GroundInfo ground;
    /// Notes for the user: voids filled, legs clipped, ...
    std::vector<std::string> notes;
};

/// Where the views of these settings stand that do not follow the aircraft. Throws Error for eye points that the view
/// does not take.
visuals::scene::FixedViewpoints fixed_points(const settings::RunSettings& settings, const World& world);

/// Throws Error where clouds would lie in the ground.
void check_clouds(const visuals::scene::AirSettings& air, const visuals::landscape::Ground& ground);

/// Loads aircraft, ground and path of a run and places the path over the ground. With `shared_world` the new world
/// shares what both load from the same inputs: aircraft with their painting orders, heights, and the whole ground where
/// these settings mesh and colour it alike. Throws Error.
World load_world(const settings::RunSettings& settings, RenderDevice device = RenderDevice::Cpu,
    const World* shared_world = nullptr);

/// Notes for options of detail or scenery near the eye that this ground cannot show. `given`: names of the options on
/// the command line.
std::vector<std::string> near_detail_warnings(
    const World& world, const visuals::scene::GroundSettings& settings, std::span<const std::string> given);

} // namespace octant::ui::world
