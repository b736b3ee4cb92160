#pragma once

#include "flightpaths/track_recording.h"

#include <filesystem>
#include <string>
#include <string_view>

// Readers of the formats of recorded flights, behind parse_track_recording() of recorded_track.h. A function is_... is
// true for the bytes of its format; the others read them and throw Error with file and line.

namespace octant::flightpaths {

/// What a reader is given.
struct TrackSource {
    /// Text formats: in UTF-8, without byte order mark and zero bytes.
    std::string_view bytes;
    std::filesystem::path file;
    std::string follow;
};

bool is_acmi(std::string_view text);
bool is_igc(std::string_view text);
bool is_gpx(std::string_view text);
bool is_kml(std::string_view text);
bool is_xplane_fdr(std::string_view text);
bool is_xplane_data(std::string_view text);
bool is_basestation(std::string_view text);
bool is_dataflash_binary(std::string_view bytes);
bool is_dataflash_text(std::string_view text);
bool is_ulog(std::string_view bytes);
bool is_readsb_trace(std::string_view text);
bool is_mavlink_log(std::string_view bytes);

/// Tacview's ACMI 2.x text ("Technical Reference - ACMI flight recordings 2.2"): objects whose tags have Air among
/// them, or that have none.
TrackRecording acmi_recording(const TrackSource& source);

/// Fixes (B records) of a flight recorder's file, as the FAI's "Technical Specification for GNSS Flight Recorders",
/// appendix A, lays them out. Heights are those of the receiver if most fixes have one, else pressure heights.
TrackRecording igc_recording(const TrackSource& source);

/// Track points of a GPX file (topografix.com/GPX/1/1), of all tracks and segments in their order.
TrackRecording gpx_recording(const TrackSource& source);

/// The tracks (gx:Track), else the points with times, else the lines of a KML file, each placemark's an aircraft of its
/// own where several have times. Lines have no times: they are flown at a speed that a note states.
TrackRecording kml_recording(const TrackSource& source);

/// A flight data recorder file of X-Plane, versions 1 to 4.
TrackRecording xplane_fdr_recording(const TrackSource& source);

/// What X-Plane's data output writes to Data.txt.
TrackRecording xplane_data_recording(const TrackSource& source);

/// Messages of a Mode S receiver in BaseStation's format (dump1090, port 30003).
TrackRecording basestation_recording(const TrackSource& source);

/// ArduPilot's DataFlash logs.
TrackRecording dataflash_binary_recording(const TrackSource& source);
TrackRecording dataflash_text_recording(const TrackSource& source);

/// PX4's log.
TrackRecording ulog_recording(const TrackSource& source);

/// The trace of an aircraft as readsb and its web sites keep it (trace_full_*.json).
TrackRecording readsb_recording(const TrackSource& source);

/// MAVLink frames, each after the eight bytes of its time.
TrackRecording mavlink_log_recording(const TrackSource& source);

/// A table with or without column names.
TrackRecording table_recording(const TrackSource& source);

} // namespace octant::flightpaths
