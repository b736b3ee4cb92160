#pragma once

#include "flightpaths/track_recording.h"
#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// Reads a recorded flight from the bytes of a file of any known format, which is recognised by its content:
///   text tables with a line of column names, separated by commas, tabs or semicolons (with semicolons, numbers may
///   have decimal commas); names are found in any order and case, other columns are ignored:
///     Octant: t_s, north_m, east_m, alt_m; optional roll_deg, pitch_deg, yaw_deg, v_north_mps, v_east_mps, v_up_mps
///             (all three), n_g; q_w, q_x, q_y, q_z (all four or none): the rotation from body to world
///     JSBSim: Time, Latitude Geodetic (deg) or Latitude (deg), Longitude (deg), Altitude ASL (ft); optional Phi (deg),
///             Theta (deg), Psi (deg), and V_{North} (ft/s), V_{East} (ft/s), V_{Down} (ft/s)
///     others: names that log_columns() of log_columns.h knows, such as Timestamp, Latitude, Longitude, Altitude (ft);
///             rows of several aircraft are told apart by columns such as icao24 or callsign
///   tables of numbers without names (FlightGear's generic protocol), FlySight 2's tables
///   Tacview ACMI 2.x, GPX, KML, IGC, X-Plane's FDR and Data.txt, ArduPilot's DataFlash (binary and text), PX4's ULog,
///   MAVLink telemetry logs, BaseStation messages, traces of readsb
/// `follow`: the name, call sign, id or pilot of the aircraft that becomes the first; empty: the one that is flown by
/// the recording's pilot, else the one recorded longest. `file` names the bytes in messages. Throws Error with file and
/// line for text that is none of these and for values that are none; with the file where fewer than 2 samples are left.
TrackRecording parse_track_recording(
    std::string_view bytes, const std::filesystem::path& file, const std::string& follow = {});

struct RecordedTrack {
    /// At least 2 samples.
    sim::Trajectory trajectory;
    /// Where the first sample lies, set when the recording gives latitude and longitude: it is at x = y = 0 of a
    /// TransverseMercator frame there; heights stay those of the recording, above datum.
    std::optional<GeoPosition> origin;
    /// What a person should be told of it.
    std::vector<std::string> notes;
};

/// The motion of the followed aircraft of a file that parse_track_recording() reads. A quaternion
/// of unit length, rounding aside, is not normalised again, so a track that exact_track_csv wrote is read back to the
/// last bit. Throws Error as parse_track_recording(); for tables of Octant and JSBSim with file and line also for a
/// missing or doubled column, too few or too many fields, a value that is not a finite number, times that do not
/// increase, span more than a day or are more than 1e7 s from zero, a speed above 3000 m/s, or a quaternion whose
/// length differs from 1 by more than 1e-6.
RecordedTrack read_recorded_track(const std::filesystem::path& file);

} // namespace octant::flightpaths
