#pragma once

#include "sim/base/geo_position.h"
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

/// Reads a recorded flight as text: a line of column names, then a line a sample, separated by commas, tabs or
/// semicolons. Columns are found by name, in any order; others are passed over.
///   own:    t_s, north_m, east_m, alt_m; optional roll_deg, pitch_deg, yaw_deg (all three),
///           v_north_mps, v_east_mps, v_up_mps (all three), n_g; q_w, q_x, q_y, q_z (all four or
///           none): the rotation from body to world, taken in place of the angles
///   JSBSim: Time, Latitude Geodetic (deg) or Latitude (deg), Longitude (deg), Altitude ASL (ft);
///           optional Phi (deg), Theta (deg), Psi (deg), and V_{North} (ft/s), V_{East} (ft/s),
///           V_{Down} (ft/s)
///   others: what log_columns.h knows of other programs' names, such as Timestamp, Latitude,
///           Longitude, Altitude (ft) (logged_track.h)
/// Files of flight recorders (IGC, igc_fixes.h) and GPX (gpx_points.h) are known by their content. Names are found in
/// capitals, too; empty lines and lines that begin with # may stand before them. What is optional and missing is made
/// from the motion (motion_fill.h). Throws Error with file and line for a missing or doubled column, too few or too
/// many fields, what is no finite number, times that do not increase, span more than a day or lie more than 1e7 s from
/// zero, fewer than 2 samples, a speed above 3000 m/s, a quaternion whose length is not 1 within 1e-6. One that is unit
/// but for rounding is not touched: what exact_track_csv wrote comes back to the last bit.
RecordedTrack read_recorded_track(const std::filesystem::path& file);

} // namespace octant::flightpaths
