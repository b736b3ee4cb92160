#include "flightpaths/recorded_track.h"

#include "flightpaths/geocentric_latitude.h"
#include "flightpaths/motion_fill.h"
#include "flightpaths/track_fields.h"
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

constexpr double fastest_mps = 3000.0;
constexpr double furthest_m = 1e7;
constexpr double longest_s = 86400.0;
constexpr double latest_s = 1e7;
/// A quaternion whose length is as far from 1 is no attitude.
constexpr double off_unit = 1e-6;
/// Closer to 1 its length is rounding: it is taken as it stands, so that a state keeps its bits.
constexpr double rounding = 1e-12;

/// What a column means; the value of each column is in the unit of its name.
enum Quantity {
    Time,
    North,
    East,
    Altitude,
    Roll,
    Pitch,
    Yaw,
    NorthSpeed,
    EastSpeed,
    UpSpeed,
    LoadFactor,
    QuaternionW,
    QuaternionX,
    QuaternionY,
    QuaternionZ,
    QuantityCount
};

struct Known {
    Quantity quantity;
    std::string_view name;
};

constexpr std::array<Known, 15> own_columns{{
    {Time, "t_s"},
    {North, "north_m"},
    {East, "east_m"},
    {Altitude, "alt_m"},
    {Roll, "roll_deg"},
    {Pitch, "pitch_deg"},
    {Yaw, "yaw_deg"},
    {NorthSpeed, "v_north_mps"},
    {EastSpeed, "v_east_mps"},
    {UpSpeed, "v_up_mps"},
    {LoadFactor, "n_g"},
    {QuaternionW, "q_w"},
    {QuaternionX, "q_x"},
    {QuaternionY, "q_y"},
    {QuaternionZ, "q_z"},
}};

/// What JSBSim calls so is geocentric.
constexpr std::string_view geocentric_latitude = "Latitude (deg)";

// The geodetic latitude stands first: it is taken where both are there.
constexpr std::array<Known, 11> jsbsim_columns{{
    {Time, "Time"},
    {North, "Latitude Geodetic (deg)"},
    {North, geocentric_latitude},
    {East, "Longitude (deg)"},
    {Altitude, "Altitude ASL (ft)"},
    {Roll, "Phi (deg)"},
    {Pitch, "Theta (deg)"},
    {Yaw, "Psi (deg)"},
    {NorthSpeed, "V_{North} (ft/s)"},
    {EastSpeed, "V_{East} (ft/s)"},
    {UpSpeed, "V_{Down} (ft/s)"},
}};

struct Column {
    /// Negative = it is not there.
    int field = -1;
    std::string_view name;
};

struct Header {
    char separator = ',';
    bool jsbsim = false;
    std::size_t fields = 0;
    std::array<Column, QuantityCount> columns;

    bool has(std::initializer_list<Quantity> quantities) const {
        for (const Quantity quantity : quantities) {
            if (columns[quantity].field < 0) {
                return false;
            }
        }
        return true;
    }
};

std::span<const Known> columns_of(const Header& header) {
    return header.jsbsim ? std::span<const Known>(jsbsim_columns) : own_columns;
}

struct Source {
    const std::filesystem::path& file;
    int line;

    [[noreturn]] void refuse(const std::string& what) const { error_at(file, line, what); }
};

int field_of(const std::vector<std::string_view>& names, std::string_view name, const Source& at) {
    int found = -1;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] != name) {
            continue;
        }
        if (found >= 0) {
            at.refuse(fmt::format("expected one column {}, got two", name));
        }
        found = static_cast<int>(i);
    }
    return found;
}

void need_columns(const Header& header, const Source& at) {
    for (const Known& known : columns_of(header)) {
        if (known.quantity <= Altitude && !header.has({known.quantity})) {
            at.refuse(fmt::format("expected a column {}, got none", known.name));
        }
    }
}

/// Refuses a header that names some but not all four columns of the quaternion.
void need_whole_quaternion(const Header& header, const Source& at) {
    const bool any = header.has({QuaternionW}) || header.has({QuaternionX}) ||
                     header.has({QuaternionY}) || header.has({QuaternionZ});
    for (const Known& known : own_columns) {
        if (any && known.quantity >= QuaternionW && !header.has({known.quantity})) {
            at.refuse(fmt::format(
                "expected all of the columns q_w, q_x, q_y, q_z, got no {}", known.name));
        }
    }
}

Header header_from(std::string_view line, const Source& at) {
    if (line.substr(0, 3) == "\xef\xbb\xbf") {
        line.remove_prefix(3);
    }
    Header header;
    header.separator = separator_of(line);
    const auto names = unquoted_fields(line, header.separator);
    header.fields = names.size();
    const bool own = field_of(names, "t_s", at) >= 0;
    header.jsbsim = !own && field_of(names, "Time", at) >= 0;
    if (!own && !header.jsbsim) {
        at.refuse(fmt::format(
            "expected column names with t_s or Time among them, got {}",
            printable(std::string(line))));
    }
    for (const Known& known : columns_of(header)) {
        Column& column = header.columns[known.quantity];
        if (column.field < 0) {
            column = {field_of(names, known.name, at), known.name};
        }
    }
    need_columns(header, at);
    need_whole_quaternion(header, at);
    return header;
}

using Row = std::array<double, QuantityCount>;

Row row_from(std::string_view line, const Header& header, const Source& at) {
    const auto fields = unquoted_fields(line, header.separator);
    if (fields.size() < header.fields || !are_empty(std::span(fields).subspan(header.fields))) {
        at.refuse(fmt::format("expected {} fields, got {}", header.fields, fields.size()));
    }
    Row row{};
    for (std::size_t i = 0; i < row.size(); ++i) {
        const Column& column = header.columns[i];
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
    Row row, const Header& header, std::optional<TransverseMercator>& frame, const Source& at) {
    if (std::abs(row[North]) > 90.0 || std::abs(row[East]) > 360.0) {
        at.refuse(fmt::format(
            "expected a latitude within 90 deg and a longitude within 360 deg, got {} and {}",
            row[North],
            row[East]));
    }
    if (header.columns[North].name == geocentric_latitude) {
        row[North] = geodetic_from_geocentric_deg(row[North], m_from_ft(row[Altitude]));
    }
    const GeoPlace place{row[North], row[East]};
    if (!frame) {
        frame.emplace(place);
    }
    const FramePlace local = frame->place_of(place);
    const glm::dvec2 speed_mps = turned_clockwise(
        {m_from_ft(row[EastSpeed]), m_from_ft(row[NorthSpeed])}, local.north_turn_rad);
    row[North] = local.east_north_m.y;
    row[East] = local.east_north_m.x;
    row[Altitude] = m_from_ft(row[Altitude]);
    row[Yaw] += deg_from_rad(local.north_turn_rad);
    row[NorthSpeed] = speed_mps.y;
    row[EastSpeed] = speed_mps.x;
    row[UpSpeed] = -m_from_ft(row[UpSpeed]);
    return row;
}

glm::dquat attitude_from(const Row& row, bool as_quaternion, const Source& at) {
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

sim::AircraftState state_from(const Row& row, bool as_quaternion, const Source& at) {
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
    if (!(glm::length(state.position_m) <= furthest_m)) {
        at.refuse(fmt::format(
            "expected a place within {:.0f} km of the origin, got {:.0f} km",
            furthest_m / 1000.0,
            glm::length(state.position_m) / 1000.0));
    }
    state.velocity_mps = {row[EastSpeed], row[NorthSpeed], row[UpSpeed]};
    state.body_to_world = attitude_from(row, as_quaternion, at);
    state.load_factor = row[LoadFactor];
    return state;
}

void check_times(double first_s, double before_s, double now_s, const Source& at) {
    if (!(now_s > before_s)) {
        at.refuse(fmt::format("expected a time after {:.3f} s, got {:.3f} s", before_s, now_s));
    }
    if (!(now_s - first_s <= longest_s)) {
        at.refuse(fmt::format(
            "expected a time within {:.0f} s of the first, got {:.3f} s", longest_s, now_s));
    }
}

void check_speed(
    const sim::AircraftState& before, const sim::AircraftState& now, const Source& at) {
    const double speed_mps = std::max(
        glm::length(now.velocity_mps),
        glm::length(now.position_m - before.position_m) / (now.time_s - before.time_s));
    if (!(speed_mps <= fastest_mps)) {
        at.refuse(fmt::format(
            "expected a speed of at most {:.0f} m/s, got {:.1f} m/s", fastest_mps, speed_mps));
    }
}

} // namespace

RecordedTrack read_recorded_track(const std::filesystem::path& file) {
    const std::string text = read_text_file(file);
    const auto lines = split_lines(text);
    if (lines.empty() || split_words(lines.front()).empty()) {
        error_at(file, 1, "expected a line of column names, got an empty one");
    }
    const Header header = header_from(lines.front(), {file, 1});
    const bool as_quaternion = header.has({QuaternionW});
    std::optional<TransverseMercator> frame;
    std::vector<sim::AircraftState> samples;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        if (split_words(lines[i]).empty()) {
            continue;
        }
        const Source at{file, static_cast<int>(i) + 1};
        Row row = row_from(lines[i], header, at);
        if (header.jsbsim) {
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
        error_in(file, fmt::format("expected at least 2 samples, got {}", samples.size()));
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
        sim::Trajectory(std::move(samples)), frame ? std::optional(frame->origin()) : std::nullopt};
}

} // namespace octant::flightpaths
