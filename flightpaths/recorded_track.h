#pragma once

#include "sim/base/earth_frame.h"
#include "sim/trajectory.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::flightpaths {

struct RecordedTrack {
    /// At least 2 samples.
    sim::Trajectory trajectory;
    /// Where the first sample lies, set when the recording gives latitude and longitude: it is at x = y = 0 of a
    /// TransverseMercator frame there; heights stay those of the recording, above datum.
    std::optional<GeoPosition> origin;
    /// What a person should be told of it.
    std::vector<std::string> notes;
};

/// Reads a recorded flight from a text file: a line of column names, then one line per sample, separated by commas,
/// tabs or semicolons. Columns are found by name, in any order and in upper or lower case; other columns are ignored.
/// Empty lines and lines that begin with # may precede the names.
///   Octant: t_s, north_m, east_m, alt_m; optional roll_deg, pitch_deg, yaw_deg (all three),
///           v_north_mps, v_east_mps, v_up_mps (all three), n_g; q_w, q_x, q_y, q_z (all four or
///           none): the rotation from body to world, used in place of the angles
///   JSBSim: Time, Latitude Geodetic (deg) or Latitude (deg), Longitude (deg), Altitude ASL (ft);
///           optional Phi (deg), Theta (deg), Psi (deg), and V_{North} (ft/s), V_{East} (ft/s),
///           V_{Down} (ft/s)
///   others: names that log_columns() of log_columns.h knows, such as Timestamp, Latitude, Longitude,
///           Altitude (ft)
/// Flight recorder files (IGC) and GPX files are recognised by their content. Optional quantities that are missing are
/// derived from the motion (derived_motion.h). A quaternion of unit length, rounding aside, is not normalised again, so
/// a track that exact_track_csv wrote is read back to the last bit. Throws Error with file and line for a missing or
/// doubled column, too few or too many fields, a value that is not a finite number, times that do not increase, span
/// more than a day or are more than 1e7 s from zero, fewer than 2 samples, a speed above 3000 m/s, or a quaternion
/// whose length differs from 1 by more than 1e-6.
RecordedTrack read_recorded_track(const std::filesystem::path& file);

} // namespace octant::flightpaths
