#pragma once

#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "sim/trajectory.h"
#include "ui/settings/settings.h"
#include "ui/world/aircraft_loader.h"
#include "ui/world/path_placement.h"
#include "ui/world/scene_ground.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/camera_rig.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::world {

/// When the pictures of a run are taken.
struct PictureTimes {
    /// At least one.
    std::vector<double> times_s;
    double rate_hz = 0.0;
    /// The time of the last simulation step of the run.
    double last_step_s = 0.0;

    /// Keeps the first `frames` (>= 1) times, or all if there are no more.
    void truncate_to(std::size_t frames);
};

/// Throws Error if the run would start after the path's end.
PictureTimes picture_times_of(const settings::RunSettings& settings, const PlacedFlight& flight);

/// Where wingmen fly, in the leader's attitude and far enough apart for the largest of them: up to eight nearly abreast
/// of him, alternately to his right and left; more in lines one above and one behind the other, so that a thousand are
/// a block of ten by ten by ten.
class Formation {
public:
    /// `aircraft` >= 1 with the leader; `largest_radius_m` of any of them.
    Formation(int aircraft, double largest_radius_m);

    /// State of wingman `number` (from 1).
    sim::AircraftState wingman_state(const sim::AircraftState& leader, int number) const;

    /// Radius of the sphere that a chase camera should frame, so that all are in its picture: the leader's own radius
    /// unless the formation is too wide for it.
    double framed_radius_m(double leader_radius_m) const;

private:
    /// Aircraft in a line, the leader's place among them.
    int abreast_;
    /// Lines one above the other, in each layer.
    int lines_per_layer_;
    /// Wingmen to one side of a line's middle.
    int wingmen_per_side_;
    /// Sideways distance of neighbours in a line.
    double lateral_spacing_m_;
    /// Distance of neighbours along the flight.
    double trail_spacing_m_;
};

/// Of all aircraft of a scene.
double largest_radius_m(const visuals::planning::Scene& scene);

/// The formation of those aircraft that fly no path of their own.
Formation formation_of(const visuals::planning::Scene& scene, const PlacedFlight& flight);

/// The states of all aircraft at a time at which the first one's is `leader`.
void formation_states(const PlacedFlight& flight, const Formation& formation, const sim::AircraftState& leader,
    double time_s, std::span<sim::AircraftState> states);

/// Everything a run needs, loaded.
struct World {
    visuals::planning::Scene scene;
    /// The row of the first aircraft; null where only its shape is known.
    const sim::AircraftKind* leader_kind = nullptr;
    PlacedFlight flight{.trajectory = sim::Trajectory(std::vector<sim::AircraftState>(1)),
        .title = {},
        .legs = {},
        .name = {},
        .other_trajectories = {},
        .other_names = {},
        .recording = {},
        .inferences = {},
        .ground_contacts = {}};
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
