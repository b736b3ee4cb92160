#pragma once

#include "sim/aircraft_kind.h"
#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"
#include "ui/settings/settings.h"
#include "ui/world/aircraft_loader.h"
#include "ui/world/flight.h"
#include "ui/world/formation.h"
#include "ui/world/scene_ground.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/camera_rig.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Everything a run needs, loaded.
struct World {
    visuals::planning::Scene scene;
    /// The row of the first aircraft; null where only its shape is known.
    const sim::AircraftKind* leader_kind = nullptr;
    Flight flight{.trajectory = sim::Trajectory(std::vector<sim::AircraftState>(1)),
        .title = {},
        .legs = {},
        .other_trajectories = {}};
    visuals::scene::FixedViewpoints points;
    /// What `scene` has its aircraft of.
    LoadedAircraft aircraft;
    TerrainSources terrain;
    std::int64_t filled_voids = 0; ///< of the terrain
    std::string ground_name;
    std::optional<GeoPosition> ground_place;
    /// How the ground lies on the earth; null where that is not known.
    std::shared_ptr<const EarthFrame> ground_frame;
    /// What a person should be told: voids filled, legs clipped, ...
    std::vector<std::string> notes;
};

/// The formation of those aircraft that fly no path of their own.
Formation formation_of(const visuals::planning::Scene& scene, const Flight& flight);

/// The states of all aircraft at a time at which the first one's is `leader`.
void formation_states(const Flight& flight, const Formation& formation, const sim::AircraftState& leader, double time_s,
    std::span<sim::AircraftState> states);

/// Where the views of these settings stand that do not follow the aircraft. Throws Error for eye points that the view
/// does not take.
visuals::scene::FixedViewpoints fixed_points(const settings::RunSettings& settings, const World& world);

/// Throws Error where clouds would lie in the ground.
void check_clouds(const visuals::scene::AirSettings& air, const visuals::landscape::Ground& ground);

/// Loads aircraft, ground and path of a run and lays the path over the ground. `shared_world`: a world with which the
/// two share what is loaded of the same inputs: aircraft with their orders, heights, and the whole ground where these
/// settings mesh and colour it alike. Throws Error.
World load_world(const settings::RunSettings& settings, RenderDevice device = RenderDevice::Cpu,
    const World* shared_world = nullptr);

/// When the pictures of a run are taken.
struct PictureTimes {
    /// At least one.
    std::vector<double> times_s;
    double rate_hz = 0.0;
    /// The time of the last simulation step of the run.
    double last_step_s = 0.0;

    /// Leaves the first so many, at least one; does nothing where there are no more.
    void truncate_to(std::size_t frames);
};

/// Throws Error when the run would start behind the path's end.
PictureTimes picture_times_of(const settings::RunSettings& settings, const Flight& flight);

/// What a person should be told who asked for detail or scenery near the eye on ground that cannot show it. `given`:
/// names of the options that stand on the command line.
std::vector<std::string> near_detail_warnings(
    const World& world, const visuals::scene::GroundSettings& settings, std::span<const std::string> given);

} // namespace octant::ui::world
