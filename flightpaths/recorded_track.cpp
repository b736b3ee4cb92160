#include "flightpaths/recorded_track.h"

#include "flightpaths/derived_motion.h"
#include "flightpaths/log_columns.h"
#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
#include "sim/base/column_reader.h"
#include "sim/base/earth_frame.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <initializer_list>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

/// What no track goes beyond: a speed, a distance from its origin, a time from its first sample.
constexpr double max_track_speed_mps = 3000.0;
constexpr double max_track_distance_m = 1e7;
constexpr double max_track_duration_s = 86400.0;

/// Angles in degrees; a heading only where the log has one.
struct LoggedAngles {
    double roll = 0.0;
    double pitch = 0.0;
    std::optional<double> heading;
};

struct LeftOut {
    int without_place = 0;
    int not_later = 0;
    int jumps = 0;
};

/// Message about what was left out, after `before`; empty if nothing was.
std::string message_of(const LeftOut& left_out, std::string_view before = "") {
    if (left_out.without_place + left_out.not_later + left_out.jumps == 0) { return {}; }
    return fmt::format("{}left out of the log: {} without time, place or height, {} of a moment that had been, "
                       "{} that only a jump leads to",
        before, left_out.without_place, left_out.not_later, left_out.jumps);
}

/// Reads the rows of a log of another program. Rows without time, position or altitude, rows whose time does not
/// increase, and rows that imply a speed above 3000 m/s are left out and counted in the notes. Times begin at 0.
/// Attitudes are the log's if every row has roll and pitch, with its true heading or else the heading of the motion;
/// otherwise they are derived from the motion. Throws Error with file and line for a field that is neither empty nor a
/// number where there must be one, for a place off the earth, for more than a day, and for fewer than 2 samples.
class LogReader {
public:
    LogReader(const std::filesystem::path& file, const LogColumns& columns) : file_(file), columns_(columns) {}

    void read_row(int line, std::span<const std::string_view> fields) {
        line_ = line;
        fields_ = fields;
        const auto time_s = time();
        const auto place = this->place();
        const auto altitude_m = value(LogQuantity::Altitude);
        if (!time_s || !place || !altitude_m) {
            ++left_out_.without_place;
            return;
        }
        if (!frame_) { frame_.emplace(*place); }
        const FramePosition local = frame_->place_of(*place);
        sim::AircraftState state;
        state.time_s = *time_s;
        state.position_m = {local.east_north_m, *altitude_m};
        if (!(glm::length(state.position_m) <= max_track_distance_m)) {
            throw_error_at(file_, line_,
                fmt::format("expected a place within {:.0f} km of the first", max_track_distance_m / 1000.0));
        }
        if (!is_next(state)) { return; }
        take_velocity(state, local.north_bearing_rad);
        take_angles(deg_from_rad(local.north_bearing_rad));
        samples_.push_back(state);
    }

    /// Ends the track; its notes begin with `notes`.
    RecordedTrack track(std::vector<std::string> notes = {}) && {
        if (samples_.size() < 2) {
            throw_error_in(file_, fmt::format("expected at least 2 samples with a place, got {}{}", samples_.size(),
                                      message_of(left_out_, "; ")));
        }
        if (!has_velocities_) { fill_velocities(samples_); }
        fill_attitudes(samples_);
        if (angles_.size() == samples_.size()) { take_logged_angles(); }
        fill_load_factors(samples_);
        add_notes(notes);
        return {sim::Trajectory(std::move(samples_)), frame_->origin(), std::move(notes)};
    }

private:
    /// What a field holds; empty for none, and for what programs write where nothing is known.
    std::string_view field(LogQuantity what) const {
        const auto& column = columns_[what];
        if (!column || column->field >= fields_.size()) { return {}; }
        const std::string_view text = fields_[column->field];
        const bool nothing = text == "nan" || text == "NaN" || text == "null" || text == "None" || text == "-";
        return nothing ? std::string_view() : text;
    }

    std::optional<double> number(std::string_view text, LogQuantity what) const {
        if (text.empty()) { return std::nullopt; }
        const auto value = finite_number(text);
        if (!value) {
            throw_error_at(file_, line_,
                fmt::format(
                    "expected a finite number in column {}, got {}", printable(columns_[what]->name), in_quotes(text)));
        }
        return value;
    }

    std::optional<double> value(LogQuantity what) const {
        const auto found = number(field(what), what);
        return found ? std::optional(*found * columns_[what]->factor) : std::nullopt;
    }

    std::optional<GeoPosition> place() const {
        std::optional<double> latitude_deg;
        std::optional<double> longitude_deg;
        if (columns_[LogQuantity::Position]) {
            const auto parts = split_fields(field(LogQuantity::Position), ',');
            latitude_deg = number(parts.front(), LogQuantity::Position);
            longitude_deg = parts.size() == 2 ? number(parts.back(), LogQuantity::Position) : std::nullopt;
        } else {
            latitude_deg = value(LogQuantity::Latitude);
            longitude_deg = value(LogQuantity::Longitude);
        }
        // Receivers without a fix write zeros.
        if (!latitude_deg || !longitude_deg || (*latitude_deg == 0.0 && *longitude_deg == 0.0)) { return std::nullopt; }
        if (std::abs(*latitude_deg) > 90.0 || std::abs(*longitude_deg) > 360.0) {
            throw_error_at(file_, line_,
                fmt::format("expected a latitude within 90 deg and a longitude within 360 deg, got {} and "
                            "{}",
                    *latitude_deg, *longitude_deg));
        }
        return GeoPosition{*latitude_deg, *longitude_deg};
    }

    /// Seconds since the first line that has a time.
    std::optional<double> time() {
        const std::string_view text = field(LogQuantity::Time);
        if (text.empty()) { return std::nullopt; }
        const auto read = log_time(text);
        if (!read) {
            throw_error_at(file_, line_,
                fmt::format("expected a time such as 12.5, 07:41:03 or 2024-01-02T07:41:03Z in column {}, "
                            "got {}",
                    printable(columns_[LogQuantity::Time]->name), in_quotes(text)));
        }
        if (!first_time_s_) {
            first_time_s_ = read->seconds;
            time_factor_ = factor_of_times(read->seconds);
        }
        double since_s = (read->seconds - *first_time_s_) * time_factor_;
        if (read->is_time_of_day) { since_s += since_s < 0.0 ? day_s : 0.0; }
        return since_s;
    }

    /// Times since 1970 in thousandths or millionths of a second are known by their size.
    double factor_of_times(double first) const {
        const LogColumn& column = *columns_[LogQuantity::Time];
        if (column.has_unit) { return column.factor; }
        return std::abs(first) > 1e14 ? 1e-6 : std::abs(first) > 1e11 ? 1e-3 : 1.0;
    }

    bool is_next(const sim::AircraftState& state) {
        if (samples_.empty()) { return true; }
        const sim::AircraftState& last = samples_.back();
        if (!(state.time_s - samples_.front().time_s <= max_track_duration_s)) {
            throw_error_at(file_, line_,
                fmt::format(
                    "expected a time within {:.0f} s of the first, got {:.3f} s", max_track_duration_s, state.time_s));
        }
        if (!(state.time_s > last.time_s)) {
            ++left_out_.not_later;
            return false;
        }
        const double way_m = glm::length(state.position_m - last.position_m);
        if (!(way_m / (state.time_s - last.time_s) <= max_track_speed_mps)) {
            ++left_out_.jumps;
            return false;
        }
        return true;
    }

    void take_velocity(sim::AircraftState& state, double north_bearing_rad) {
        const auto north = value(LogQuantity::NorthSpeed);
        const auto east = value(LogQuantity::EastSpeed);
        const auto down = value(LogQuantity::DownSpeed);
        has_velocities_ = has_velocities_ && north && east && down;
        if (has_velocities_) {
            state.velocity_mps = {rotated_clockwise({*east, *north}, north_bearing_rad), -*down};
            has_velocities_ = glm::length(state.velocity_mps) <= max_track_speed_mps;
        }
    }

    void take_angles(double north_turn_deg) {
        const auto roll = value(LogQuantity::Roll);
        const auto pitch = value(LogQuantity::Pitch);
        auto heading = value(LogQuantity::Heading);
        if (roll && pitch) {
            heading = heading ? std::optional(*heading + north_turn_deg) : std::nullopt;
            angles_.push_back({*roll, *pitch, heading});
        }
    }

    void take_logged_angles() {
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const LoggedAngles& logged = angles_[i];
            const double flown_rad = euler_from_body_to_world(samples_[i].body_to_world).heading_rad;
            samples_[i].body_to_world =
                body_to_world_from_euler({logged.heading ? rad_from_deg(*logged.heading) : flown_rad,
                    rad_from_deg(logged.pitch), rad_from_deg(logged.roll)});
        }
    }

    void add_notes(std::vector<std::string>& notes) const {
        const LogColumn& altitude = *columns_[LogQuantity::Altitude];
        if (!altitude.has_unit) {
            notes.push_back(
                fmt::format("column {} names no unit: its heights are taken as metres (name it {}_ft for feet)",
                    printable(altitude.name), printable(altitude.name)));
        }
        if (std::string left_out = message_of(left_out_); !left_out.empty()) { notes.push_back(std::move(left_out)); }
    }

    static constexpr double day_s = 86400.0;

    const std::filesystem::path& file_;
    const LogColumns& columns_;
    int line_ = 0;
    std::span<const std::string_view> fields_;
    std::optional<TransverseMercator> frame_;
    std::optional<double> first_time_s_;
    double time_factor_ = 1.0;
    std::vector<sim::AircraftState> samples_;
    std::vector<LoggedAngles> angles_;
    bool has_velocities_ = true;
    LeftOut left_out_;
};

/// A fix of an IGC or GPX file: time, latitude and longitude in degrees, altitude in metres, as text; empty where
/// unknown.
struct FixRow {
    int line = 0; ///< of the file, from 1
    std::array<std::string, 4> fields;
};

RecordedTrack track_of_fixes(
    const std::filesystem::path& file, std::span<const FixRow> fixes, std::vector<std::string> notes = {}) {
    const auto columns = log_columns({"time", "latitude", "longitude", "altitude_m"}, {});
    LogReader reader(file, *columns);
    for (const FixRow& fix : fixes) {
        const std::array<std::string_view, 4> fields{fix.fields[0], fix.fields[1], fix.fields[2], fix.fields[3]};
        reader.read_row(fix.line, fields);
    }
    return std::move(reader).track(std::move(notes));
}

/// The integer in `count` characters from `at` on; pressure altitudes below the datum begin with a minus.
std::optional<int> integer_at(std::string_view record, std::size_t at, std::size_t count) {
    const std::string_view text = record.substr(at, count);
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    if (!std::all_of(text.begin() + static_cast<std::ptrdiff_t>(sign), text.end(), is_digit)) { return std::nullopt; }
    int value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    return fault == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Degrees of an angle that is written as whole degrees and thousandths of minutes.
std::optional<double> angle_deg(std::string_view record, std::size_t at, std::size_t degrees, std::string_view signs) {
    const auto whole = integer_at(record, at, degrees);
    const auto thousandths = integer_at(record, at + degrees, 5);
    const char side = record[at + degrees + 5];
    if (!whole || !thousandths || *whole < 0 || *thousandths < 0 || *thousandths >= 60'000 ||
        signs.find(side) == signs.npos) {
        return std::nullopt;
    }
    const double size_deg = *whole + *thousandths / 60'000.0;
    return side == signs.front() ? size_deg : -size_deg;
}

/// B, hhmmss, DDMMmmmN, DDDMMmmmE, A or V, pressure altitude, height over the ellipsoid.
constexpr std::size_t fix_length = 35;

struct Fix {
    int line = 0;
    std::string_view clock; ///< hhmmss; empty where the record is damaged
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    std::optional<int> receiver_m;
    std::optional<int> pressure_m;
};

Fix fix_of(std::string_view record, int line) {
    Fix fix;
    fix.line = line;
    if (!record.starts_with('B') || record.size() < fix_length) { return fix; }
    const auto latitude_deg = angle_deg(record, 7, 2, "NS");
    const auto longitude_deg = angle_deg(record, 15, 3, "EW");
    if (!latitude_deg || !longitude_deg || !integer_at(record, 1, 6)) { return fix; }
    fix.clock = record.substr(1, 6);
    fix.latitude_deg = *latitude_deg;
    fix.longitude_deg = *longitude_deg;
    fix.pressure_m = integer_at(record, 25, 5);
    const auto receiver_m = integer_at(record, 30, 5);
    if (record[24] == 'A' && receiver_m && *receiver_m != 0) { fix.receiver_m = receiver_m; }
    return fix;
}

FixRow row_of(const Fix& fix, const std::optional<int>& height_m) {
    if (fix.clock.empty()) { return {fix.line, {}}; }
    return {fix.line, {fmt::format("{}:{}:{}", fix.clock.substr(0, 2), fix.clock.substr(2, 2), fix.clock.substr(4, 2)),
                          fmt::format("{:.8f}", fix.latitude_deg), fmt::format("{:.8f}", fix.longitude_deg),
                          height_m ? std::to_string(*height_m) : ""}};
}

/// True for the lines of a glider's flight recorder: the first that holds anything is the record of its maker (A) or of
/// its head (H), and one is a fix.
bool is_igc(std::span<const std::string_view> lines) {
    const auto first = std::ranges::find_if(lines, [](std::string_view line) { return !split_words(line).empty(); });
    const bool has_head =
        first != lines.end() && (first->front() == 'A' || first->front() == 'H') && first->find(',') == first->npos;
    return has_head && std::ranges::any_of(lines, [](std::string_view line) { return !fix_of(line, 0).clock.empty(); });
}

/// The track of a flight recorder's file: its fixes (B records), as the FAI's "Technical Specification for GNSS Flight
/// Recorders", appendix A, lays them out. Heights are those of the receiver if most fixes have one, else pressure
/// altitudes; a fix without that height has none. Damaged B records count as fixes without a place.
RecordedTrack igc_track(const std::filesystem::path& file, std::span<const std::string_view> lines) {
    std::vector<Fix> fixes;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].starts_with('B')) { fixes.push_back(fix_of(lines[i], static_cast<int>(i) + 1)); }
    }
    const auto with_receiver = std::ranges::count_if(fixes, [](const Fix& fix) { return fix.receiver_m.has_value(); });
    const bool by_receiver = 2 * static_cast<std::size_t>(with_receiver) > fixes.size();
    std::vector<FixRow> rows;
    for (const Fix& fix : fixes) { rows.push_back(row_of(fix, by_receiver ? fix.receiver_m : fix.pressure_m)); }
    std::vector<std::string> notes;
    if (!by_receiver) { notes.emplace_back("heights are pressure altitudes: few fixes have one of the receiver"); }
    return track_of_fixes(file, rows, std::move(notes));
}

constexpr std::string_view point_start = "<trkpt";
constexpr std::string_view point_end = "</trkpt>";
constexpr std::string_view comment_start = "<!--";
constexpr std::string_view comment_end = "-->";

/// The text without blanks around it; empty if it has blanks, commas or quotes within.
std::string_view plain_word(std::string_view text) {
    const auto words = split_words(text);
    const bool is_plain = words.size() == 1 && words.front().find_first_of(",\"") == text.npos;
    return is_plain ? words.front() : std::string_view();
}

/// The value of an attribute in a tag; empty where it has none.
std::string_view attribute(std::string_view tag, std::string_view name) {
    for (std::size_t at = tag.find(name); at != tag.npos; at = tag.find(name, at + 1)) {
        const std::size_t quote = tag.find_first_not_of(" \t\r\n=", at + name.size());
        const bool is_whole = at > 0 && split_words(tag.substr(at - 1, 1)).empty();
        const bool is_value = quote != tag.npos && (tag[quote] == '"' || tag[quote] == '\'');
        if (is_whole && is_value) {
            const std::size_t end = tag.find(tag[quote], quote + 1);
            return end == tag.npos ? std::string_view() : plain_word(tag.substr(quote + 1, end - quote - 1));
        }
    }
    return {};
}

/// The text of the first element of this name; empty where there is none.
std::string_view element(std::string_view within, std::string_view name) {
    const std::string opening = fmt::format("<{}>", name);
    const std::size_t at = within.find(opening);
    if (at == within.npos) { return {}; }
    const std::string_view behind = within.substr(at + opening.size());
    return plain_word(behind.substr(0, behind.find('<')));
}

/// True for a text whose root element is GPX's.
bool is_gpx(std::string_view text) {
    constexpr std::size_t head = 4096;
    const std::string_view start = text.substr(0, head);
    const std::size_t first = start.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    return first != start.npos && start[first] == '<' && start.find("<gpx") != start.npos;
}

/// The track points of a GPX file (topografix.com/GPX/1/1), of all its tracks and segments in their order; waypoints
/// and routes have no times and are ignored. Throws Error with file and line for a comment or a track point without
/// an end, and with the file where there is no track point.
RecordedTrack gpx_track(const std::filesystem::path& file, std::string_view text) {
    std::vector<FixRow> points;
    int line = 1;
    std::size_t counted = 0;
    const auto line_at = [&](std::size_t at) {
        line += static_cast<int>(std::count(text.begin() + counted, text.begin() + at, '\n'));
        counted = at;
        return line;
    };
    const auto end_of = [&](std::size_t at, std::string_view end) {
        const std::size_t found = text.find(end, at);
        if (found == text.npos) {
            throw_error_at(file, line_at(at), fmt::format("expected {} further on, found none", end));
        }
        return found;
    };
    for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at + 1)) {
        const std::string_view rest = text.substr(at);
        if (rest.starts_with(comment_start)) {
            at = end_of(at, comment_end);
        } else if (rest.starts_with(point_start)) {
            const std::size_t tag_end = end_of(at, ">");
            const std::string_view tag = text.substr(at, tag_end - at);
            const bool is_bare = tag.ends_with('/');
            const std::size_t end = is_bare ? tag_end : end_of(at, point_end);
            const std::string_view within = text.substr(tag_end, end - tag_end);
            points.push_back(
                {line_at(at), {std::string(element(within, "time")), std::string(attribute(tag, "lat")),
                                  std::string(attribute(tag, "lon")), std::string(element(within, "ele"))}});
            at = end;
        }
    }
    if (points.empty()) {
        throw_error_in(file, "expected track points (trkpt), got none: waypoints and routes have no times");
    }
    return track_of_fixes(file, points);
}

/// The geodetic latitude of a place from its geocentric one, which is up to 0.19 degrees or 21 km less, and its height
/// above the ellipsoid.
double geodetic_from_geocentric_deg(double geocentric_deg, double height_m) {
    const double geocentric_rad = rad_from_deg(geocentric_deg);
    constexpr double e2 = wgs84.e2();
    double geodetic_rad = geocentric_rad;
    for (int i = 0; i < 5; ++i) { // each step leaves less than a hundredth of the error
        const double sine = std::sin(geodetic_rad);
        const double normal_m = wgs84.semi_major_m / std::sqrt(1.0 - e2 * sine * sine);
        geodetic_rad = std::atan2(std::sin(geocentric_rad) * (normal_m + height_m),
            std::cos(geocentric_rad) * (normal_m * (1.0 - e2) + height_m));
    }
    return deg_from_rad(geodetic_rad);
}

/// The quantities of a track of Octant or JSBSim. The unit of a value is the unit in the column's name.
enum TrackQuantity : std::size_t {
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

/// A column for each TrackQuantity; without a name if such tracks have none.
using TrackColumns = std::array<TableColumn, QuantityCount>;

constexpr TrackColumns octant_columns{
    {{"t_s", true}, {"north_m", true}, {"east_m", true}, {"alt_m", true}, {"roll_deg"}, {"pitch_deg"}, {"yaw_deg"},
        {"v_north_mps"}, {"v_east_mps"}, {"v_up_mps"}, {"n_g"}, {"q_w"}, {"q_x"}, {"q_y"}, {"q_z"}}};

constexpr std::string_view geocentric_latitude = "Latitude (deg)";

constexpr TrackColumns jsbsim_columns{
    {{"Time", true}, {"Latitude Geodetic (deg)", true}, {"Longitude (deg)", true}, {"Altitude ASL (ft)", true},
        {"Phi (deg)"}, {"Theta (deg)"}, {"Psi (deg)"}, {"V_{North} (ft/s)"}, {"V_{East} (ft/s)"}, {"V_{Down} (ft/s)"}}};

/// JSBSim's columns; the geocentric latitude takes the place of a missing geodetic one.
TrackColumns jsbsim_columns_in(std::span<const std::string_view> names) {
    TrackColumns columns = jsbsim_columns;
    if (!field_named(names, columns[North].name) && field_named(names, geocentric_latitude)) {
        columns[North].name = geocentric_latitude;
    }
    return columns;
}

/// True if the names contain the time, north (or latitude), east (or longitude) and altitude columns.
bool has_place(const TrackColumns& columns, std::span<const std::string_view> names) {
    return std::ranges::all_of(columns,
        [&](const TableColumn& column) { return !column.is_required || field_named(names, column.name).has_value(); });
}

/// True if the names contain the time and at least one other of the columns.
bool has_some(const TrackColumns& columns, std::span<const std::string_view> names) {
    return field_named(names, columns[Time].name) &&
           std::any_of(columns.begin() + 1, columns.end(), [&](const TableColumn& column) {
               return !column.name.empty() && field_named(names, column.name).has_value();
           });
}

constexpr double latest_s = 1e7;
/// A quaternion whose length differs more from 1 is no attitude.
constexpr double max_quaternion_error = 1e-6;
/// A smaller difference is rounding: the quaternion is not normalised, so that a state keeps its bits.
constexpr double quaternion_rounding = 1e-12;

using TrackRow = std::array<double, QuantityCount>;

/// Reads the rows of a track of Octant or JSBSim one by one.
class TrackReader {
public:
    /// The current row of `table` holds the names of the columns. Throws Error if a required column is missing, one
    /// occurs twice, or some but not all of the quaternion's are there.
    TrackReader(ColumnReader& table, bool is_jsbsim)
        : table_(table), is_jsbsim_(is_jsbsim),
          columns_(is_jsbsim ? jsbsim_columns_in(table.fields()) : octant_columns) {
        table.find(columns_);
        for (std::size_t i = QuaternionW; i <= QuaternionZ; ++i) { has_quaternion_ = has_quaternion_ || table.has(i); }
        for (std::size_t i = QuaternionW; i <= QuaternionZ; ++i) {
            if (has_quaternion_ && !table.has(i)) {
                table.refuse("all of the columns q_w, q_x, q_y, q_z", fmt::format("no {}", columns_[i].name));
            }
        }
    }

    RecordedTrack track(const std::filesystem::path& file) && {
        while (table_.next_row()) {
            const sim::AircraftState state = state_of(row());
            if (!samples_.empty()) { check_follows(state); }
            samples_.push_back(state);
        }
        if (samples_.size() < 2) {
            throw_error_in(file, fmt::format("expected at least 2 samples, got {}", samples_.size()));
        }
        if (!has({NorthSpeed, EastSpeed, UpSpeed})) { fill_velocities(samples_); }
        if (!has_quaternion_ && !has({Roll, Pitch, Yaw})) { fill_attitudes(samples_); }
        if (!has({LoadFactor})) { fill_load_factors(samples_); }
        return {sim::Trajectory(std::move(samples_)), frame_ ? std::optional(frame_->origin()) : std::nullopt, {}};
    }

private:
    bool has(std::initializer_list<TrackQuantity> quantities) const {
        return std::ranges::all_of(quantities, [&](TrackQuantity quantity) { return table_.has(quantity); });
    }

    /// The current row in the units and axes of Octant's columns; 0 where the table has no column.
    TrackRow row() {
        table_.check_field_count();
        TrackRow row{};
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (table_.has(i)) { row[i] = table_.number(i); }
        }
        if (is_jsbsim_) { convert_from_jsbsim(row); }
        return row;
    }

    void convert_from_jsbsim(TrackRow& row) {
        if (std::abs(row[North]) > 90.0 || std::abs(row[East]) > 360.0) {
            table_.refuse("a latitude within 90 deg and a longitude within 360 deg",
                fmt::format("{} and {}", row[North], row[East]));
        }
        if (columns_[North].name == geocentric_latitude) {
            row[North] = geodetic_from_geocentric_deg(row[North], m_from_ft(row[Altitude]));
        }
        const GeoPosition place{row[North], row[East]};
        if (!frame_) { frame_.emplace(place); }
        const FramePosition local = frame_->place_of(place);
        const glm::dvec2 speed_mps =
            rotated_clockwise({m_from_ft(row[EastSpeed]), m_from_ft(row[NorthSpeed])}, local.north_bearing_rad);
        row[North] = local.east_north_m.y;
        row[East] = local.east_north_m.x;
        row[Altitude] = m_from_ft(row[Altitude]);
        row[Yaw] += deg_from_rad(local.north_bearing_rad);
        row[NorthSpeed] = speed_mps.y;
        row[EastSpeed] = speed_mps.x;
        row[UpSpeed] = -m_from_ft(row[UpSpeed]);
    }

    sim::AircraftState state_of(const TrackRow& row) const {
        sim::AircraftState state;
        state.time_s = row[Time];
        if (std::abs(state.time_s) > latest_s) {
            table_.refuse(
                fmt::format("a time from -{0:.0f} s to {0:.0f} s", latest_s), fmt::format("{:.10g} s", state.time_s));
        }
        state.position_m = {row[East], row[North], row[Altitude]};
        if (!(glm::length(state.position_m) <= max_track_distance_m)) {
            table_.refuse(fmt::format("a place within {:.0f} km of the origin", max_track_distance_m / 1000.0),
                fmt::format("{:.0f} km", glm::length(state.position_m) / 1000.0));
        }
        state.velocity_mps = {row[EastSpeed], row[NorthSpeed], row[UpSpeed]};
        state.body_to_world = attitude_of(row);
        state.load_factor = row[LoadFactor];
        return state;
    }

    glm::dquat attitude_of(const TrackRow& row) const {
        if (!has_quaternion_) {
            return body_to_world_from_euler(
                {rad_from_deg(row[Yaw]), rad_from_deg(row[Pitch]), rad_from_deg(row[Roll])});
        }
        const glm::dquat attitude(row[QuaternionW], row[QuaternionX], row[QuaternionY], row[QuaternionZ]);
        const double error = std::abs(glm::length(attitude) - 1.0);
        if (!(error <= max_quaternion_error)) {
            table_.refuse(
                "a unit quaternion q_w, q_x, q_y, q_z", fmt::format("one of length {:.7g}", glm::length(attitude)));
        }
        return error <= quaternion_rounding ? attitude : glm::normalize(attitude);
    }

    void check_follows(const sim::AircraftState& next) const {
        const sim::AircraftState& last = samples_.back();
        if (!(next.time_s > last.time_s)) {
            table_.refuse(fmt::format("a time after {:.3f} s", last.time_s), fmt::format("{:.3f} s", next.time_s));
        }
        if (!(next.time_s - samples_.front().time_s <= max_track_duration_s)) {
            table_.refuse(fmt::format("a time within {:.0f} s of the first", max_track_duration_s),
                fmt::format("{:.3f} s", next.time_s));
        }
        const double speed_mps = std::max(glm::length(next.velocity_mps),
            glm::length(next.position_m - last.position_m) / (next.time_s - last.time_s));
        if (!(speed_mps <= max_track_speed_mps)) {
            table_.refuse(fmt::format("a speed of at most {:.0f} m/s", max_track_speed_mps),
                fmt::format("{:.1f} m/s", speed_mps));
        }
    }

    ColumnReader& table_;
    bool is_jsbsim_;
    TrackColumns columns_;
    bool has_quaternion_ = false;
    std::optional<TransverseMercator> frame_; ///< of JSBSim
    std::vector<sim::AircraftState> samples_;
};

/// True if the row below the names of columns gives units: it has text, but no number or time.
bool are_units(std::span<const std::string_view> fields) {
    return !std::ranges::all_of(fields, &std::string_view::empty) &&
           std::ranges::none_of(fields, [](std::string_view field) { return log_time(field).has_value(); });
}

/// A log of another program, whose column names are the current row of `table`; its units are in a comment before the
/// names or in the row below.
RecordedTrack log_track(const std::filesystem::path& file, ColumnReader& table) {
    const std::vector<std::string_view> names = table.fields();
    std::vector<std::string_view> units = table_fields(table.comment(), separator_of(table.row()));
    bool has_row = table.next_row();
    if (has_row && are_units(table.fields())) {
        units = table.fields();
        has_row = table.next_row();
    }
    const auto columns = log_columns(names, units);
    LogReader reader(file, *columns);
    for (; has_row; has_row = table.next_row()) { reader.read_row(table.line_number(), table.fields()); }
    return std::move(reader).track();
}

} // namespace

RecordedTrack read_recorded_track(const std::filesystem::path& file) {
    const std::string text = read_text_file(file);
    if (is_gpx(text)) { return gpx_track(file, text); }
    if (const auto lines = split_lines(text); is_igc(lines)) { return igc_track(file, lines); }
    ColumnReader table(TextScanner(file, text));
    if (!table.next_row()) { throw_error_at(file, 1, "expected a line of column names, got an empty one"); }
    const std::vector<std::string_view>& names = table.fields();
    const bool is_log = !has_place(octant_columns, names) && !has_place(jsbsim_columns_in(names), names) &&
                        log_columns(names, {}).has_value();
    if (is_log) { return log_track(file, table); }
    const bool is_octant = has_some(octant_columns, names);
    if (!is_octant && !has_some(jsbsim_columns_in(names), names)) {
        table.refuse(
            "column names with a time, a place and an altitude among them (t_s, north_m, east_m, alt_m or Time, "
            "Latitude, Longitude, Altitude)",
            printable(std::string(table.row())));
    }
    return TrackReader(table, !is_octant).track(file);
}

} // namespace octant::flightpaths
