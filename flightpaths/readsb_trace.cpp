// The trace of an aircraft as readsb writes it (README-json.md of readsb): "timestamp", and in "trace" a list of lists
// of seconds since then, latitude, longitude, pressure height in feet or "ground", ground speed in knots, track, flags,
// climb in feet a minute, details or null, source, height above the ellipsoid in feet, its climb, indicated airspeed,
// roll.

#include "flightpaths/fix_table.h"
#include "flightpaths/track_readers.h"
#include "sim/base/error.h"
#include "sim/base/units.h"

#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace octant::flightpaths {

namespace {

using Json = nlohmann::json;

/// Places of the quantities in a row.
struct TraceField {
    enum : std::size_t {
        Seconds,
        Latitude,
        Longitude,
        PressureHeight,
        GroundSpeed,
        Track,
        Climb = 7,
        Details = 8,
        Height = 10
    };
};

double number_of(const Json& row, std::size_t at) {
    return at < row.size() && row[at].is_number() ? row[at].get<double>() : not_measured;
}

Fix fix_of_trace(const Json& row, double begin_s) {
    Fix fix;
    fix.time_s = begin_s + number_of(row, TraceField::Seconds);
    fix.latitude_deg = number_of(row, TraceField::Latitude);
    fix.longitude_deg = number_of(row, TraceField::Longitude);
    fix.pressure_height_m = static_cast<float>(m_from_ft(number_of(row, TraceField::PressureHeight)));
    fix.altitude_m = m_from_ft(number_of(row, TraceField::Height));
    fix.ground_speed_mps = static_cast<float>(mps_from_kt(number_of(row, TraceField::GroundSpeed)));
    fix.track_deg = static_cast<float>(number_of(row, TraceField::Track));
    fix.up_mps = static_cast<float>(m_from_ft(number_of(row, TraceField::Climb)) / 60.0);
    if (row[TraceField::PressureHeight].is_string() && row[TraceField::PressureHeight].get<std::string>() == "ground") {
        fix.contact = GroundContact::OnGround;
    }
    return fix;
}

/// Text of a member; empty where there is none.
std::string text_of_member(const Json& object, const char* name) {
    const auto found = object.find(name);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

} // namespace

bool is_readsb_trace(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != text.npos && text[first] == '{' && text.find("\"trace\"") != text.npos;
}

TrackRecording readsb_recording(const TrackSource& source) {
    constexpr std::size_t largest_bytes = std::size_t{64} << 20U;
    if (source.bytes.size() > largest_bytes) { throw_error_in(source.file, "expected a trace of at most 64 MiB"); }
    const Json trace = Json::parse(source.bytes, nullptr, false);
    if (trace.is_discarded() || !trace.contains("timestamp") || !trace["timestamp"].is_number() ||
        !trace.contains("trace") || !trace["trace"].is_array()) {
        throw_error_in(source.file, "expected JSON with a number \"timestamp\" and a list \"trace\", got none");
    }
    FixTable fixes("readsb trace", source.file);
    fixes.time_scale = TimeScale::Utc;
    fixes.heights = HeightKind::Ellipsoid;
    FixSeries& series = fixes.series(text_of_member(trace, "icao"));
    series.name = text_of_member(trace, "t");
    const double begin_s = trace["timestamp"].get<double>();
    for (const Json& row : trace["trace"]) {
        constexpr std::size_t fewest = 4;
        if (!row.is_array() || row.size() < fewest || std::isnan(number_of(row, TraceField::Seconds)) ||
            std::isnan(number_of(row, TraceField::Latitude)) || std::isnan(number_of(row, TraceField::Longitude))) {
            fixes.skip_row();
            continue;
        }
        if (series.call_sign.empty() && row.size() > TraceField::Details && row[TraceField::Details].is_object()) {
            const std::string flight = text_of_member(row[TraceField::Details], "flight");
            series.call_sign = flight.substr(0, flight.find_last_not_of(' ') + 1);
        }
        fixes.add(series, fix_of_trace(row, begin_s));
    }
    return std::move(fixes).recording(source.follow);
}

} // namespace octant::flightpaths
