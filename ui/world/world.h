#pragma once

#include "flightpaths/fly_script.h"
#include "models/heights/height_field.h"
#include "sim/aircraft_kind.h"
#include "sim/trajectory.h"
#include "ui/settings/settings.h"
#include "ui/world/formation.h"
#include "ui/world/ground_texture_file.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/camera_rig.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// A path as it is flown over the ground of a run.
struct Flight {
    sim::Trajectory trajectory; ///< world axes
    std::string title;
    double rate_hz = 20.0;    ///< samples a second
    glm::dvec2 place_m{0.0};  ///< where the path's origin lies
    double heading_rad = 0.0; ///< how far the path was turned, clockwise
    double offset_m = 0.0;    ///< how far it was lifted
    double lowest_clearance_m = 0.0;
    double lowest_clearance_s = 0.0; ///< when
    std::vector<flightpaths::LegBegin> legs;
};

/// Everything a run needs, loaded.
struct World {
    visuals::planning::Scene scene;
    /// The row of the first aircraft; null where only its shape is known.
    const sim::AircraftKind* leader_kind = nullptr;
    Flight flight{
        .trajectory = sim::Trajectory(std::vector<sim::AircraftState>(1)), .title = {}, .legs = {}};
    visuals::scene::FixedPoints points;
    std::string ground_name;
    std::optional<models::heights::GeoPlace> ground_place;
    /// What a person should be told: voids filled, legs clipped, ...
    std::vector<std::string> notes;
    /// Kept painting orders that were used.
    std::vector<std::filesystem::path> order_files;
};

/// The formation in which the scene's aircraft fly.
Formation formation_of(const visuals::planning::Scene& scene);

/// Where the views of these settings stand that do not follow the aircraft. Throws Error for eye
/// points that the view does not take.
visuals::scene::FixedPoints fixed_points(const settings::RunSettings& settings, const World& world);

/// Loads aircraft, ground and path of a run and lays the path over the ground. Throws Error.
World load_world(const settings::RunSettings& settings, DrawnBy drawn_by = DrawnBy::Processor);

} // namespace octant::ui::world
