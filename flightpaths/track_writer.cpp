// Tacview's format as its makers document it: tacview.net, "ACMI 2.2 flight recordings". The form of T is
// Longitude|Latitude|Altitude|Roll|Pitch|Yaw|U|V|Heading, with longitude and latitude counted from the reference, and
// U, V metres east and north.

#include "flightpaths/track_writer.h"

#include "sim/aircraft_kind.h"
#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace octant::flightpaths {

namespace {

/// A value that prints as 0 and not as -0 when it rounds to zero at `decimals`.
double unsigned_zero(double value, int decimals) {
    return std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value;
}

std::string fixed(double value, int decimals) {
    return fmt::format("{:.{}f}", unsigned_zero(value, decimals), decimals);
}

/// A heading as text, degrees in [0, 360) even after rounding.
std::string compass(double heading_rad, int decimals) {
    const std::string text = fixed(deg_from_rad(heading_rad), decimals);
    return text == fixed(360.0, decimals) ? fixed(0.0, decimals) : text;
}

/// Commas and backslashes end or open something in ACMI, so text carries them escaped; a bar separates the parts of an
/// event and cannot be escaped.
std::string acmi_text(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == ',' || c == '\\') { out += '\\'; }
        const bool control = static_cast<unsigned char>(c) < 0x20;
        out += c == '|' ? '/' : (control ? ' ' : c);
    }
    return out;
}

std::string properties_of(const AcmiHeader& header) {
    if (header.kind != nullptr) {
        return fmt::format("Type={},Name={}", header.kind->tacview_type, header.kind->tacview_name);
    }
    return "Type=Air+FixedWing,Name=" + acmi_text(header.aircraft);
}

std::string acmi_transform(const sim::AircraftState& state, const EarthFrame& frame) {
    const glm::dvec2 east_north(state.position_m.x, state.position_m.y);
    const GeoPosition origin = frame.origin();
    const GeoPosition place = frame.geo_from_local(east_north);
    const EulerAngles angles = euler_from_body_to_world(state.body_to_world);
    const double true_rad = wrapped_to_two_pi(angles.heading_rad - frame.place_of(place).north_bearing_rad);
    return fmt::format("T={}|{}|{}|{}|{}|{}|{}|{}|{}",
        fixed(std::remainder(place.longitude_deg - origin.longitude_deg, 360.0), 7),
        fixed(place.latitude_deg - origin.latitude_deg, 7), fixed(state.position_m.z, 2),
        fixed(deg_from_rad(angles.roll_rad), 2), fixed(deg_from_rad(angles.pitch_rad), 2), compass(true_rad, 2),
        fixed(east_north.x, 2), fixed(east_north.y, 2), compass(angles.heading_rad, 2));
}

} // namespace

std::string track_csv_names() {
    return "t_s,north_m,east_m,alt_m,roll_deg,pitch_deg,yaw_deg,tas_mps,n_g,"
           "v_north_mps,v_east_mps,v_up_mps\n";
}

std::string track_csv_line(const sim::AircraftState& state) {
    const EulerAngles angles = euler_from_body_to_world(state.body_to_world);
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", fixed(state.time_s, 6), fixed(state.position_m.y, 4),
        fixed(state.position_m.x, 4), fixed(state.position_m.z, 4), fixed(deg_from_rad(angles.roll_rad), 4),
        fixed(deg_from_rad(angles.pitch_rad), 4), compass(angles.heading_rad, 4),
        fixed(glm::length(state.velocity_mps), 4), fixed(state.load_factor, 4), fixed(state.velocity_mps.y, 4),
        fixed(state.velocity_mps.x, 4), fixed(state.velocity_mps.z, 4));
}

std::string track_csv(const sim::Trajectory& trajectory) {
    std::string text = track_csv_names();
    for (const sim::AircraftState& state : trajectory.samples()) { text += track_csv_line(state); }
    return text;
}

std::string exact_track_csv(const sim::Trajectory& trajectory) {
    std::string text = "t_s,north_m,east_m,alt_m,v_north_mps,v_east_mps,v_up_mps,n_g,q_w,q_x,q_y,q_z\n";
    for (const sim::AircraftState& state : trajectory.samples()) {
        const glm::dquat& attitude = state.body_to_world;
        // Without a precision fmt writes the shortest text that reads back as the same number.
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", state.time_s, state.position_m.y,
            state.position_m.x, state.position_m.z, state.velocity_mps.y, state.velocity_mps.x, state.velocity_mps.z,
            state.load_factor, attitude.w, attitude.x, attitude.y, attitude.z);
    }
    return text;
}

std::string acmi_head(const AcmiHeader& header) {
    const GeoPosition origin = frame_or_at_zero(header.frame).origin();
    return fmt::format("FileType=text/acmi/tacview\nFileVersion=2.2\n"
                       "0,ReferenceTime=2026-01-01T00:00:00Z\n"
                       "0,DataSource=Octant\n0,DataRecorder=Octant\n0,Title={}\n"
                       "0,ReferenceLongitude={}\n0,ReferenceLatitude={}\n",
        acmi_text(header.title), fixed(origin.longitude_deg, 7), fixed(origin.latitude_deg, 7));
}

std::string acmi_state(const sim::AircraftState& state, const AcmiHeader& header, bool is_first) {
    return fmt::format("#{}\n1,{}{},TAS={}\n", fixed(state.time_s, 3),
        acmi_transform(state, frame_or_at_zero(header.frame)),
        is_first ? "," + properties_of(header) + ",Color=Blue" : "", fixed(glm::length(state.velocity_mps), 1));
}

std::string track_acmi(const sim::Trajectory& trajectory, const AcmiHeader& header) {
    std::string text = acmi_head(header);
    auto bookmark = header.bookmarks.begin();
    bool first = true;
    for (const sim::AircraftState& state : trajectory.samples()) {
        text += acmi_state(state, header, std::exchange(first, false));
        for (; bookmark != header.bookmarks.end() && bookmark->time_s <= state.time_s + 1e-9; ++bookmark) {
            text += fmt::format("0,Event=Bookmark|1|{}\n", acmi_text(bookmark->label));
        }
    }
    return text;
}

} // namespace octant::flightpaths
