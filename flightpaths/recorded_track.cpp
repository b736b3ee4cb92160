#include "flightpaths/recorded_track.h"

#include "flightpaths/geocentric_latitude.h"
#include "flightpaths/gpx_points.h"
#include "flightpaths/igc_fixes.h"
#include "flightpaths/log_columns.h"
#include "flightpaths/log_table.h"
#include "flightpaths/logged_track.h"
#include "flightpaths/derived_motion.h"
#include "flightpaths/track_columns.h"
#include "flightpaths/track_fields.h"
#include "flightpaths/track_limits.h"
#include "flightpaths/track_time.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/transverse_mercator.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

constexpr double latest_s = 1e7;
/// A quaternion whose length is as far from 1 is no attitude.
constexpr double off_unit = 1e-6;
/// Closer to 1 its length is rounding: it is taken as it stands, so that a state keeps its bits.
constexpr double rounding = 1e-12;

using Row = std::array<double, QuantityCount>;

Row row_from(std::string_view line, const TrackHeader& header, const TrackLineLocation& at) {
    const auto fields = unquoted_fields(line, header.separator);
    if (fields.size() < header.fields || !are_empty(std::span(fields).subspan(header.fields))) {
        at.refuse(fmt::format("expected {} fields, got {}", header.fields, fields.size()));
    }
    Row row{};
    for (std::size_t i = 0; i < row.size(); ++i) {
        const TrackColumn& column = header.columns[i];
        if (column.field < 0) {
            continue;
        }
        const std::string_view text = fields[static_cast<std::size_t>(column.field)];
        const auto value = finite_number(text);
        if (!value) {
            at.refuse(fmt::format(
                "expected a finite number in column {}, got \"{}\"",
                column.name,
                printable(std::string(text))));
        }
        row[i] = *value;
    }
    return row;
}

/// A JSBSim row in the units and axes of our own columns.
Row own_from_jsbsim(
    Row row,
    const TrackHeader& header,
    std::optional<TransverseMercator>& frame,
    const TrackLineLocation& at) {
    if (std::abs(row[North]) > 90.0 || std::abs(row[East]) > 360.0) {
        at.refuse(fmt::format(
            "expected a latitude within 90 deg and a longitude within 360 deg, got {} and {}",
            row[North],
            row[East]));
    }
    if (header.columns[North].name == geocentric_latitude) {
        row[North] = geodetic_from_geocentric_deg(row[North], m_from_ft(row[Altitude]));
    }
    const GeoPosition place{row[North], row[East]};
    if (!frame) {
        frame.emplace(place);
    }
    const FramePosition local = frame->place_of(place);
    const glm::dvec2 speed_mps = rotated_clockwise(
        {m_from_ft(row[EastSpeed]), m_from_ft(row[NorthSpeed])}, local.north_bearing_rad);
    row[North] = local.east_north_m.y;
    row[East] = local.east_north_m.x;
    row[Altitude] = m_from_ft(row[Altitude]);
    row[Yaw] += deg_from_rad(local.north_bearing_rad);
    row[NorthSpeed] = speed_mps.y;
    row[EastSpeed] = speed_mps.x;
    row[UpSpeed] = -m_from_ft(row[UpSpeed]);
    return row;
}

glm::dquat attitude_from(const Row& row, bool as_quaternion, const TrackLineLocation& at) {
    if (!as_quaternion) {
        return body_to_world_from_euler(
            {rad_from_deg(row[Yaw]), rad_from_deg(row[Pitch]), rad_from_deg(row[Roll])});
    }
    const glm::dquat attitude(
        row[QuaternionW], row[QuaternionX], row[QuaternionY], row[QuaternionZ]);
    const double off = std::abs(glm::length(attitude) - 1.0);
    if (!(off <= off_unit)) {
        at.refuse(fmt::format(
            "expected a unit quaternion q_w, q_x, q_y, q_z, got one of length {:.7g}",
            glm::length(attitude)));
    }
    return off <= rounding ? attitude : glm::normalize(attitude);
}

sim::AircraftState state_from(const Row& row, bool as_quaternion, const TrackLineLocation& at) {
    sim::AircraftState state;
    state.time_s = row[Time];
    if (std::abs(state.time_s) > latest_s) {
        at.refuse(fmt::format(
            "expected a time from -{:.0f} s to {:.0f} s, got {:.10g} s",
            latest_s,
            latest_s,
            state.time_s));
    }
    state.position_m = {row[East], row[North], row[Altitude]};
    if (!(glm::length(state.position_m) <= max_track_distance_m)) {
        at.refuse(fmt::format(
            "expected a place within {:.0f} km of the origin, got {:.0f} km",
            max_track_distance_m / 1000.0,
            glm::length(state.position_m) / 1000.0));
    }
    state.velocity_mps = {row[EastSpeed], row[NorthSpeed], row[UpSpeed]};
    state.body_to_world = attitude_from(row, as_quaternion, at);
    state.load_factor = row[LoadFactor];
    return state;
}

void check_times(double first_s, double before_s, double now_s, const TrackLineLocation& at) {
    if (!(now_s > before_s)) {
        at.refuse(fmt::format("expected a time after {:.3f} s, got {:.3f} s", before_s, now_s));
    }
    if (!(now_s - first_s <= max_track_duration_s)) {
        at.refuse(fmt::format(
            "expected a time within {:.0f} s of the first, got {:.3f} s", max_track_duration_s, now_s));
    }
}

void check_speed(
    const sim::AircraftState& before, const sim::AircraftState& now, const TrackLineLocation& at) {
    const double speed_mps = std::max(
        glm::length(now.velocity_mps),
        glm::length(now.position_m - before.position_m) / (now.time_s - before.time_s));
    if (!(speed_mps <= max_track_speed_mps)) {
        at.refuse(fmt::format(
            "expected a speed of at most {:.0f} m/s, got {:.1f} m/s",
            max_track_speed_mps,
            speed_mps));
    }
}

/// Whether a line holds nothing but, at most, a comment.
bool is_empty(std::string_view line) {
    return line.starts_with('#') || split_words(line).empty();
}

std::size_t line_of_names(std::span<const std::string_view> lines) {
    return static_cast<std::size_t>(std::ranges::find_if_not(lines, is_empty) - lines.begin());
}

/// Whether a line names units below the names of columns: it holds something, and no number or
/// time.
bool are_units(const std::vector<std::string_view>& fields) {
    return !are_empty(fields) && std::ranges::none_of(fields, [](std::string_view field) {
        return log_time(field).has_value();
    });
}

/// The track that another program has logged, its units in a comment before the names or in a line
/// behind them; nothing where the columns are ours or JSBSim's, or no flight's.
std::optional<RecordedTrack> track_of_others(
    const std::filesystem::path& file,
    std::span<const std::string_view> lines,
    std::size_t names_line) {
    const char separator = separator_of(lines[names_line]);
    const auto names = unquoted_fields(lines[names_line], separator);
    if (are_track_columns(names)) {
        return std::nullopt;
    }
    std::vector<std::string_view> units;
    if (names_line > 0) {
        units = unquoted_fields(lines[names_line - 1], separator);
    }
    std::size_t header_line = names_line;
    if (names_line + 1 < lines.size()) {
        const auto below = unquoted_fields(lines[names_line + 1], separator);
        if (are_units(below)) {
            units = below;
            ++header_line;
        }
    }
    const auto columns = log_columns(names, units);
    if (!columns) {
        return std::nullopt;
    }
    LoggedTrack track = logged_track({file, lines, header_line, separator}, *columns);
    return RecordedTrack{
        sim::Trajectory(std::move(track.samples)), track.origin, std::move(track.notes)};
}

RecordedTrack track_of_table(const std::filesystem::path& file, LogTable table) {
    const std::vector<std::string_view> rows(table.rows.begin(), table.rows.end());
    constexpr char separator = ',';
    const auto columns = log_columns(unquoted_fields(log_table_columns, separator), {});
    LoggedTrack track = logged_track({file, rows, 0, separator, table.line_numbers}, *columns);
    table.notes.insert(table.notes.end(), track.notes.begin(), track.notes.end());
    return {sim::Trajectory(std::move(track.samples)), track.origin, std::move(table.notes)};
}

} // namespace

RecordedTrack read_recorded_track(const std::filesystem::path& file) {
    const std::string text = read_text_file(file);
    if (is_gpx(text)) {
        return track_of_table(file, gpx_points(file, text));
    }
    auto lines = split_lines(text);
    if (is_igc(lines)) {
        return track_of_table(file, igc_fixes(lines));
    }
    if (!lines.empty() && lines.front().starts_with("\xef\xbb\xbf")) {
        lines.front().remove_prefix(3);
    }
    const std::size_t names = line_of_names(lines);
    if (names == lines.size()) {
        throw_error_at(file, 1, "expected a line of column names, got an empty one");
    }
    if (auto track = track_of_others(file, lines, names)) {
        return std::move(*track);
    }
    const TrackHeader header = track_header(lines[names], {file, static_cast<int>(names) + 1});
    const bool as_quaternion = header.has({QuaternionW});
    std::optional<TransverseMercator> frame;
    std::vector<sim::AircraftState> samples;
    for (std::size_t i = names + 1; i < lines.size(); ++i) {
        if (is_empty(lines[i])) {
            continue;
        }
        const TrackLineLocation at{file, static_cast<int>(i) + 1};
        Row row = row_from(lines[i], header, at);
        if (header.is_jsbsim) {
            row = own_from_jsbsim(row, header, frame, at);
        }
        samples.push_back(state_from(row, as_quaternion, at));
        if (samples.size() > 1) {
            const sim::AircraftState& before = samples[samples.size() - 2];
            check_times(samples.front().time_s, before.time_s, samples.back().time_s, at);
            check_speed(before, samples.back(), at);
        }
    }
    if (samples.size() < 2) {
        throw_error_in(file, fmt::format("expected at least 2 samples, got {}", samples.size()));
    }
    if (!header.has({NorthSpeed, EastSpeed, UpSpeed})) {
        fill_velocities(samples);
    }
    if (!as_quaternion && !header.has({Roll, Pitch, Yaw})) {
        fill_attitudes(samples);
    }
    if (!header.has({LoadFactor})) {
        fill_load_factors(samples);
    }
    return {
        sim::Trajectory(std::move(samples)),
        frame ? std::optional(frame->origin()) : std::nullopt,
        {}};
}

} // namespace octant::flightpaths
