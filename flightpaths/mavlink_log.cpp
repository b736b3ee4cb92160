// A telemetry log of a ground station: eight bytes with the microseconds since 1970, the highest first, and a MAVLink
// frame, again and again.

#include "flightpaths/fix_table.h"
#include "flightpaths/track_readers.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/links/mavlink.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace octant::flightpaths {

namespace {

namespace links = sim::links;

constexpr std::size_t time_bytes = 8;
constexpr auto version_1 = static_cast<char>(0xFE);
constexpr auto version_2 = static_cast<char>(0xFD);

double time_at(std::string_view bytes) {
    std::uint64_t us = 0;
    for (std::size_t i = 0; i < time_bytes; ++i) { us = us << 8U | static_cast<unsigned char>(bytes[i]); }
    constexpr double us_per_s = 1e6;
    return static_cast<double>(us) / us_per_s;
}

/// The bytes of a frame that a log has at this place, its time before it; 0 where none begins.
std::size_t record_length(std::string_view bytes) {
    if (bytes.size() <= time_bytes || (bytes[time_bytes] != version_1 && bytes[time_bytes] != version_2)) { return 0; }
    constexpr double latest_s = 4e9;
    if (!(time_at(bytes) < latest_s)) { return 0; }
    const auto parse = links::parse_mavlink(std::as_bytes(std::span(bytes.substr(time_bytes))));
    const bool is_frame =
        parse.result.fault == links::PacketError::None || parse.result.fault == links::PacketError::Unused;
    return is_frame ? time_bytes + parse.length : 0;
}

/// The poses of one vehicle, and its clock against the log's.
struct Vehicle {
    links::MavLinkPose pose;
    std::optional<double> clock_offset_s;
};

/// A vehicle's own clock is evener than the log's; it is set anew where the vehicle was started again.
double time_of(Vehicle& vehicle, const links::Fix& fix, double logged_s) {
    if (!fix.sent_s) { return logged_s; }
    constexpr double most_apart_s = 5.0;
    const double offset_s = logged_s - *fix.sent_s;
    if (!vehicle.clock_offset_s || std::abs(offset_s - *vehicle.clock_offset_s) > most_apart_s) {
        vehicle.clock_offset_s = offset_s;
    }
    return *fix.sent_s + *vehicle.clock_offset_s;
}

Fix fix_of(const links::Fix& read, bool has_attitude) {
    Fix fix;
    fix.latitude_deg = read.latitude_deg;
    fix.longitude_deg = read.longitude_deg;
    fix.altitude_m = read.altitude_m;
    if (read.velocity_ned_mps) {
        fix.north_mps = static_cast<float>(read.velocity_ned_mps->x);
        fix.east_mps = static_cast<float>(read.velocity_ned_mps->y);
        fix.up_mps = static_cast<float>(-read.velocity_ned_mps->z);
    }
    if (has_attitude) {
        fix.heading_deg = deg_from_rad(read.attitude.heading_rad);
        fix.pitch_deg = deg_from_rad(read.attitude.pitch_rad);
        fix.roll_deg = deg_from_rad(read.attitude.roll_rad);
    }
    return fix;
}

} // namespace

bool is_mavlink_log(std::string_view bytes) {
    const std::size_t first = record_length(bytes);
    return first > 0 && (first == bytes.size() || record_length(bytes.substr(first)) > 0);
}

TrackRecording mavlink_log_recording(const TrackSource& source) {
    FixTable fixes("MAVLink telemetry log", source.file);
    fixes.time_scale = TimeScale::Utc;
    fixes.heights = HeightKind::Sea;
    std::map<std::uint8_t, Vehicle> vehicles;
    std::size_t skipped = 0;
    for (std::string_view rest = source.bytes; rest.size() > time_bytes;) {
        const std::size_t length = record_length(rest);
        if (length == 0) {
            rest.remove_prefix(1);
            ++skipped;
            continue;
        }
        const auto parse = links::parse_mavlink(std::as_bytes(std::span(rest.substr(time_bytes))));
        const double logged_s = time_at(rest);
        rest.remove_prefix(length);
        if (!parse.frame) { continue; }
        Vehicle& vehicle = vehicles[parse.frame->system];
        const auto read = vehicle.pose.take(*parse.frame);
        if (!read) { continue; }
        Fix fix = fix_of(*read, parse.frame->kind != links::MavLinkKind::GlobalPositionInt);
        fix.time_s = time_of(vehicle, *read, logged_s);
        fixes.add(fixes.series(fmt::format("{}", parse.frame->system)), fix);
    }
    if (skipped > 0) { fixes.add_note(fmt::format("left out {} bytes between the frames of the log", skipped)); }
    if (fixes.fix_count() == 0) {
        throw_error_in(
            source.file, "expected places on the earth (GLOBAL_POSITION_INT or HIL_STATE_QUATERNION), got none");
    }
    return std::move(fixes).recording(source.follow);
}

} // namespace octant::flightpaths
