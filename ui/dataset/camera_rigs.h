#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
#include "ui/dataset/variation.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <octant/octant.h>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::dataset {

/// What a camera is fixed to, and how it looks.
enum class Mount {
    Aircraft, ///< a place in an aircraft, turned with it
    Chase,    ///< looks at an aircraft from a direction that turns with its heading; azimuth 0 is behind
    Orbit,    ///< looks at an aircraft from a compass direction
    Random,   ///< looks at an aircraft from any direction
    Ground    ///< anywhere over the map, in any direction
};

/// Ends of a range from which each sample draws a number.
struct NumberSpan {
    double low = 0.0;
    double high = 0.0;
};

/// A camera of a data set: its lens, and how each sample places it.
struct CameraRig {
    std::string name;
    octant::Camera camera;
    Mount mount = Mount::Chase;
    /// The aircraft it is fixed to or looks at, from 1 in the order of the settings.
    int aircraft = 1;
    /// Aircraft: the place of the eye in body axes.
    glm::dvec3 at_m{0.0};
    /// Aircraft: turns about the body's axes. Ground: of the camera in the world.
    NumberSpan heading_deg, pitch_deg, bank_deg;
    /// Chase, orbit, random: of the eye from the aircraft's reference point, above the level.
    NumberSpan distance_m, azimuth_deg, elevation_deg;
    /// Chase, orbit, random: how far from the picture's middle the aircraft may lie, as a share of half the height.
    double aim = 0.0;
    /// Ground: of the eye above the ground.
    NumberSpan height_m;
};

/// The least height of any eye above the ground.
inline constexpr double min_eye_height_m = 2.0;

/// Reads the [[camera]] tables of a file. A ring becomes as many cameras as its count says, NAME-1, NAME-2, ... `text`
/// receives what the file says. Throws Error "file:line: expected ..., got ...".
std::vector<CameraRig> read_camera_rigs(
    const std::filesystem::path& file, const octant::Camera& defaults, std::string* text = nullptr);

/// The one camera of data sets without a file of cameras: "chase", from any side.
CameraRig default_rig(const octant::Camera& camera);

/// The ground under cameras.
struct RigGround {
    GroundHeight height_at;
    glm::dvec2 half_extent_m{0.0};
};

/// Places a camera in a sample in which the aircraft are in these states, `previous_s` before in those. The rig's
/// aircraft must be there (asserted).
octant::Pose pose_of(const CameraRig& rig, const SampleKey& key, std::span<const sim::AircraftState> states,
    std::span<const sim::AircraftState> previous_states, double previous_s, const RigGround& ground);

} // namespace octant::ui::dataset
