#pragma once

#include "flightpaths/fly_script.h"
#include "sim/aircraft_kind.h"
#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::flightpaths {

/// Another aircraft of a flight, on its clock.
struct WrittenTrack {
    /// Null only for aircraft whose states are written one by one.
    const sim::Trajectory* trajectory = nullptr;
    /// Its type; null if unknown.
    const sim::AircraftKind* kind = nullptr;
    /// Differs from aircraft to aircraft.
    std::string name;
};

/// A flight as comma-separated text with the columns t_s, north_m, east_m, alt_m, roll_deg, pitch_deg, yaw_deg,
/// tas_mps, n_g, v_north_mps, v_east_mps, v_up_mps; with other aircraft one more, aircraft, by whose names the rows of
/// all, in order of time, are told apart. parse_track_recording gives the same states back within 1e-3 (m, m/s, rad,
/// g).
std::string track_csv(
    const sim::Trajectory& trajectory, const std::string& name = {}, std::span<const WrittenTrack> others = {});

/// The line of column names, and the line of a state; with the column `aircraft` where a name is given.
std::string track_csv_names(bool of_several = false);
std::string track_csv_line(const sim::AircraftState& state, const std::optional<std::string>& aircraft = std::nullopt);

/// A flight as comma-separated text that repeats it: t_s, north_m, east_m, alt_m, v_north_mps, v_east_mps, v_up_mps,
/// n_g, q_w, q_x, q_y, q_z, each number with as many digits as it takes. read_recorded_track gives the same states back
/// to the last bit, if the reader takes them at all (two samples or more, unit attitudes, its limits of time, place and
/// speed).
std::string exact_track_csv(const sim::Trajectory& trajectory);

/// Information of a Tacview file besides the motion.
struct AcmiHeader {
    std::string title;
    /// The type of the aircraft, which has its Tacview name; null if unknown.
    const sim::AircraftKind* kind = nullptr;
    /// The name of an aircraft without a type.
    std::string aircraft;
    /// Position of the axes of the flight on the earth; null: at 0 N, 0 E.
    const EarthFrame* frame = nullptr;
    std::vector<LegStart> bookmarks;
    /// Written as CallSign where it is not empty.
    std::string call_sign = {};
    std::vector<WrittenTrack> others = {};
};

/// A flight and its other aircraft as Tacview ACMI 2.2 text with positions and headings on the globe and on the flat
/// local map. The reference time is fixed, so that the same flight gives the same bytes.
std::string track_acmi(const sim::Trajectory& trajectory, const AcmiHeader& header);

/// The head of the file, and the lines of one state without bookmarks; the first state has more of them.
std::string acmi_head(const AcmiHeader& header);
std::string acmi_state(const sim::AircraftState& state, const AcmiHeader& header, bool is_first);

/// The lines of a state of another aircraft, the first of which is number 2. `introduced`: for its first state.
std::string acmi_state_of_other(
    const sim::AircraftState& state, std::size_t number, const EarthFrame* frame, const WrittenTrack* introduced);

/// The line after the last state of an aircraft.
std::string acmi_end_of_other(std::size_t number);

} // namespace octant::flightpaths
