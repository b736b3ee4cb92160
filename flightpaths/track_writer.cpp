// Tacview's format as its makers document it: tacview.net, "ACMI 2.2 flight recordings". The form of T is
// Longitude|Latitude|Altitude|Roll|Pitch|Yaw|U|V|Heading, with longitude and latitude counted from the reference, and
// U, V metres east and north.

#include "flightpaths/track_writer.h"

#include "sim/aircraft_kind.h"
#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <string_view>
#include <vector>

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

/// `name`: of an aircraft without a type.
std::string properties_of(const sim::AircraftKind* kind, const std::string& name, const std::string& call_sign) {
    return (kind != nullptr ? fmt::format("Type={},Name={}", kind->tacview_type, kind->tacview_name)
                            : "Type=Air+FixedWing,Name=" + acmi_text(name)) +
           (call_sign.empty() ? "" : ",CallSign=" + acmi_text(call_sign));
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

namespace {

/// A field of a table, in quotes.
std::string csv_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) { out += static_cast<unsigned char>(c) < 0x20 || c == '"' ? ' ' : c; }
    return out + "\"";
}

} // namespace

std::string track_csv_names(bool of_several) {
    return fmt::format("t_s,north_m,east_m,alt_m,roll_deg,pitch_deg,yaw_deg,tas_mps,n_g,"
                       "v_north_mps,v_east_mps,v_up_mps{}\n",
        of_several ? ",aircraft" : "");
}

std::string track_csv_line(const sim::AircraftState& state, const std::optional<std::string>& aircraft) {
    const EulerAngles angles = euler_from_body_to_world(state.body_to_world);
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}{}\n", fixed(state.time_s, 6), fixed(state.position_m.y, 4),
        fixed(state.position_m.x, 4), fixed(state.position_m.z, 4), fixed(deg_from_rad(angles.roll_rad), 4),
        fixed(deg_from_rad(angles.pitch_rad), 4), compass(angles.heading_rad, 4),
        fixed(glm::length(state.velocity_mps), 4), fixed(state.load_factor, 4), fixed(state.velocity_mps.y, 4),
        fixed(state.velocity_mps.x, 4), fixed(state.velocity_mps.z, 4), aircraft ? "," + csv_text(*aircraft) : "");
}

namespace {

/// A sample of one of several aircraft; 0 is the first one.
struct SampleOfSeveral {
    double time_s = 0.0;
    std::size_t aircraft = 0;
    std::size_t sample = 0;
};

/// The samples of a flight and of its other aircraft in order of time, of one time in that of the aircraft.
std::vector<SampleOfSeveral> in_order_of_time(const sim::Trajectory& first, std::span<const WrittenTrack> others) {
    std::vector<SampleOfSeveral> all;
    const auto add = [&](std::size_t aircraft, const sim::Trajectory& trajectory) {
        for (std::size_t i = 0; i < trajectory.samples().size(); ++i) {
            all.push_back({trajectory.samples()[i].time_s, aircraft, i});
        }
    };
    add(0, first);
    for (std::size_t i = 0; i < others.size(); ++i) { add(i + 1, *others[i].trajectory); }
    std::ranges::stable_sort(all, {}, &SampleOfSeveral::time_s);
    return all;
}

} // namespace

std::string track_csv(
    const sim::Trajectory& trajectory, const std::string& name, std::span<const WrittenTrack> others) {
    std::string text = track_csv_names(!others.empty());
    if (others.empty()) {
        for (const sim::AircraftState& state : trajectory.samples()) { text += track_csv_line(state); }
        return text;
    }
    for (const SampleOfSeveral& at : in_order_of_time(trajectory, others)) {
        const sim::Trajectory& path = at.aircraft == 0 ? trajectory : *others[at.aircraft - 1].trajectory;
        text += track_csv_line(path.samples()[at.sample], at.aircraft == 0 ? name : others[at.aircraft - 1].name);
    }
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
        is_first ? "," + properties_of(header.kind, header.aircraft, header.call_sign) + ",Color=Blue" : "",
        fixed(glm::length(state.velocity_mps), 1));
}

std::string acmi_state_of_other(
    const sim::AircraftState& state, std::size_t number, const EarthFrame* frame, const WrittenTrack* introduced) {
    return fmt::format("#{}\n{:x},{}{},TAS={}\n", fixed(state.time_s, 3), number,
        acmi_transform(state, frame_or_at_zero(frame)),
        introduced != nullptr ? "," + properties_of(introduced->kind, introduced->name, introduced->name) + ",Color=Red"
                              : "",
        fixed(glm::length(state.velocity_mps), 1));
}

std::string acmi_end_of_other(std::size_t number) { return fmt::format("-{:x}\n", number); }

std::string track_acmi(const sim::Trajectory& trajectory, const AcmiHeader& header) {
    std::string text = acmi_head(header);
    auto bookmark = header.bookmarks.begin();
    for (const SampleOfSeveral& at : in_order_of_time(trajectory, header.others)) {
        if (at.aircraft > 0) {
            const WrittenTrack& other = header.others[at.aircraft - 1];
            const auto samples = other.trajectory->samples();
            text += acmi_state_of_other(
                samples[at.sample], at.aircraft + 1, header.frame, at.sample == 0 ? &other : nullptr);
            if (at.sample + 1 == samples.size()) { text += acmi_end_of_other(at.aircraft + 1); }
            continue;
        }
        const sim::AircraftState& state = trajectory.samples()[at.sample];
        text += acmi_state(state, header, at.sample == 0);
        for (; bookmark != header.bookmarks.end() && bookmark->time_s <= state.time_s + 1e-9; ++bookmark) {
            text += fmt::format("0,Event=Bookmark|1|{}\n", acmi_text(bookmark->label));
        }
    }
    return text;
}

} // namespace octant::flightpaths
