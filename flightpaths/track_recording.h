#pragma once

#include "sim/base/earth_frame.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// Marks a quantity that a file does not have.
inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// What a recording says about the wheels of an aircraft.
enum class GroundContact : std::uint8_t { Unknown, InAir, OnGround };

/// One moment of a recorded aircraft as its file has it: quantities that the file does not have at that moment are
/// not_measured. Axes: those of the TransverseMercator frame at TrackRecording::origin, x east, y north, z up.
struct TrackSample {
    /// Since the recording's first sample of any aircraft; increases from sample to sample.
    double time_s = 0.0;
    /// Always there; z is the height of HeightKind, assumed_height_m where that is Absent.
    glm::dvec3 position_m{0.0};
    /// Each part alone may be missing.
    glm::dvec3 velocity_mps{not_measured};
    double ground_speed_mps = not_measured;
    /// Direction of the way over the ground, clockwise from the y axis.
    double track_rad = not_measured;
    /// Of the nose, clockwise from the y axis; magnetic headings have been converted.
    double heading_rad = not_measured;
    double pitch_rad = not_measured;
    double roll_rad = not_measured;
    /// In g.
    double load_factor = not_measured;
    /// Of the aircraft in the air.
    double true_airspeed_mps = not_measured;
    /// One standard deviation of the place, as the recorder states it.
    double horizontal_error_m = not_measured;
    double vertical_error_m = not_measured;
    /// Height of the standard atmosphere, where the file has it beside another height.
    double pressure_height_m = not_measured;
    /// The whole attitude, where the file has a quaternion; otherwise all zeros.
    glm::dquat body_to_world{0.0, 0.0, 0.0, 0.0};
    GroundContact contact = GroundContact::Unknown;
};

/// What the heights of a recording count from.
enum class HeightKind : std::uint8_t {
    Sea,
    Ellipsoid,
    /// Heights of the standard atmosphere.
    Pressure,
    /// The file does not say.
    Unknown,
    AboveGround,
    /// The file has no heights.
    Absent
};

/// In plain words: "above the sea", "pressure heights".
std::string_view text_of(HeightKind kind);

/// One flight of one aircraft of a recording.
struct TrackedAircraft {
    /// Address (icao24) or number of the object; empty where the file has none.
    std::string id;
    std::string call_sign;
    /// The type in the recorder's words, such as "F-15C".
    std::string name;
    /// Tags such as "Air+Rotorcraft".
    std::string type;
    std::string pilot;
    /// At least 2.
    std::vector<TrackSample> samples;
    HeightKind heights = HeightKind::Unknown;
};

/// The name by which a person knows an aircraft: call sign, name, id or "aircraft N" (`index` counts from 0).
std::string display_name(const TrackedAircraft& aircraft, std::size_t index);

/// A recorded flight of one aircraft or of several on one clock.
struct TrackRecording {
    /// Such as "GPX" or "Tacview ACMI".
    std::string format;
    /// Where x and y are 0; the followed aircraft's first place. Nothing where the file has no latitudes and
    /// longitudes.
    std::optional<GeoPosition> origin;
    /// The time of 0 s in seconds since 1970, UTC; nothing where the file does not tell.
    std::optional<double> begin_utc_s;
    /// At least one; the followed one is the first.
    std::vector<TrackedAircraft> aircraft;
    /// What a person should be told: what was guessed, mended and left out.
    std::vector<std::string> notes;
};

/// A recording has no more aircraft; the others are left out and counted in a note.
inline constexpr std::size_t max_recorded_aircraft = 256;

/// Height above the ground at which tracks without heights are flown.
inline constexpr double assumed_height_m = 300.0;

} // namespace octant::flightpaths
