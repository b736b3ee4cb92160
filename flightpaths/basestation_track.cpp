// Lines of a Mode S receiver (dump1090's port 30003) as Kinetic's BaseStation defined them: MSG, kind of message,
// session, aircraft, address, flight, date and time of the message, date and time of the log, call sign, pressure
// height in feet, ground speed in knots, track, latitude, longitude, climb in feet a minute, squawk, alert, emergency,
// identification, on ground.

#include "flightpaths/fix_table.h"
#include "flightpaths/log_columns.h"
#include "flightpaths/track_readers.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

enum Field : std::size_t {
    Address = 4,
    Date = 6,
    Clock = 7,
    CallSign = 10,
    Height = 11,
    GroundSpeed = 12,
    Track = 13,
    Latitude = 14,
    Longitude = 15,
    Climb = 16,
    OnGround = 21,
    FieldCount = 22
};

/// What an aircraft reported last beside its place; each for a few seconds.
struct LastMotion {
    double time_s = -1e18;
    double ground_speed_kt = not_measured;
    double track_deg = not_measured;
    double climb_fpm = not_measured;
};

} // namespace

bool is_basestation(std::string_view text) {
    // Programs that record may write a few lines of their own first.
    constexpr std::size_t head = 1024;
    const auto lines = split_lines(text.substr(0, head));
    return std::ranges::any_of(lines, [](std::string_view line) {
        return line.starts_with("MSG,") && split_fields(line, ',').size() + 1 >= FieldCount;
    });
}

TrackRecording basestation_recording(const TrackSource& source) {
    FixTable fixes("BaseStation", source.file);
    fixes.time_scale = TimeScale::Utc;
    fixes.heights = HeightKind::Pressure;
    std::map<std::string, LastMotion, std::less<>> motions;
    int line = 0;
    for (const std::string_view row : split_lines(source.bytes)) {
        ++line;
        auto fields = split_fields(row, ',');
        if (fields.front() != "MSG" || fields.size() + 1 < FieldCount) {
            if (!split_words(row).empty()) { fixes.skip_row(); }
            continue;
        }
        fields.resize(FieldCount);
        const auto number = [&](Field at) {
            if (fields[at].empty()) { return not_measured; }
            const auto value = finite_number(fields[at]);
            if (!value) {
                throw_error_at(source.file, line, fmt::format("expected a number, got {}", in_quotes(fields[at])));
            }
            return *value;
        };
        const auto time = log_time(fmt::format("{} {}", fields[Date], fields[Clock]));
        if (!time || !time->is_date) {
            throw_error_at(source.file, line,
                fmt::format(
                    "expected a date and a time, got {} and {}", in_quotes(fields[Date]), in_quotes(fields[Clock])));
        }
        FixSeries& series = fixes.series(fields[Address]);
        if (!fields[CallSign].empty()) { series.call_sign = fields[CallSign]; }
        LastMotion& motion = motions[std::string(fields[Address])];
        if (!fields[GroundSpeed].empty()) {
            motion = {time->seconds, number(GroundSpeed), number(Track), number(Climb)};
        }
        if (fields[Latitude].empty() || fields[Longitude].empty()) { continue; }
        Fix fix;
        fix.line = line;
        fix.time_s = time->seconds;
        fix.is_leap_second = time->is_leap_second;
        fix.latitude_deg = number(Latitude);
        fix.longitude_deg = number(Longitude);
        fix.altitude_m = m_from_ft(number(Height));
        constexpr double longest_s = 5.0;
        if (std::abs(time->seconds - motion.time_s) <= longest_s) {
            fix.ground_speed_mps = static_cast<float>(mps_from_kt(motion.ground_speed_kt));
            fix.track_deg = static_cast<float>(motion.track_deg);
            fix.up_mps = static_cast<float>(m_from_ft(motion.climb_fpm) / 60.0);
        }
        const std::string_view contact = fields[OnGround];
        fix.contact = contact == "-1" || contact == "1" ? GroundContact::OnGround
                      : contact == "0"                  ? GroundContact::InAir
                                                        : GroundContact::Unknown;
        // A message that was received wrongly.
        if (!(std::abs(fix.latitude_deg) <= 90.0 && std::abs(fix.longitude_deg) <= 180.0)) {
            fixes.skip_row();
            continue;
        }
        fixes.add(series, fix);
    }
    return std::move(fixes).recording(source.follow);
}

} // namespace octant::flightpaths
