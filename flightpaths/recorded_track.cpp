#include "flightpaths/recorded_track.h"

#include "flightpaths/derived_motion.h"
#include "flightpaths/track_table.h"
#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
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
#include <optional>
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

/// The text of a log, cut into lines.
struct LogText {
    const std::filesystem::path& file;
    std::span<const std::string_view> lines;
    /// The last line before the samples, from 0: that of the columns' names or their units.
    std::size_t header_line = 0;
    char separator = ',';
    /// Which line of the file each of these is, from 1; empty: they are all of its lines.
    std::span<const int> numbers = {};
};

struct LoggedTrack {
    /// At least 2, in the axes of a TransverseMercator frame at `origin`, heights above datum.
    std::vector<sim::AircraftState> samples;
    GeoPosition origin;
    /// What a person should be told of it.
    std::vector<std::string> notes;
};

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

/// How much was left out, behind `before`; empty when nothing was.
std::string said_of(const LeftOut& left_out, std::string_view before = "") {
    if (left_out.without_place + left_out.not_later + left_out.jumps == 0) { return {}; }
    return fmt::format("{}left out of the log: {} without time, place or height, {} of a moment that had been, "
                       "{} that only a jump leads to",
        before, left_out.without_place, left_out.not_later, left_out.jumps);
}

/// Reads the lines one by one and keeps those that fit.
class LogReader {
public:
    LogReader(const LogText& log, const LogColumns& columns) : log_(log), columns_(columns) {}

    void read_line(std::size_t index) {
        line_ = log_.numbers.empty() ? static_cast<int>(index) + 1 : log_.numbers[index];
        fields_ = unquoted_fields(log_.lines[index], log_.separator);
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
            throw_error_at(log_.file, line_,
                fmt::format("expected a place within {:.0f} km of the first", max_track_distance_m / 1000.0));
        }
        if (!is_next(state)) { return; }
        take_velocity(state, local.north_bearing_rad);
        take_angles(deg_from_rad(local.north_bearing_rad));
        samples_.push_back(state);
    }

    LoggedTrack track() && {
        if (samples_.size() < 2) {
            throw_error_in(log_.file, fmt::format("expected at least 2 samples with a place, got {}{}", samples_.size(),
                                          said_of(left_out_, "; ")));
        }
        if (!has_velocities_) { fill_velocities(samples_); }
        fill_attitudes(samples_);
        if (angles_.size() == samples_.size()) { take_logged_angles(); }
        fill_load_factors(samples_);
        return {std::move(samples_), frame_->origin(), notes()};
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
            throw_error_at(log_.file, line_,
                fmt::format("expected a finite number in column {}, got \"{}\"", printable(columns_[what]->name),
                    printable(std::string(text))));
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
            throw_error_at(log_.file, line_,
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
            throw_error_at(log_.file, line_,
                fmt::format("expected a time such as 12.5, 07:41:03 or 2024-01-02T07:41:03Z in column {}, "
                            "got \"{}\"",
                    printable(columns_[LogQuantity::Time]->name), printable(std::string(text))));
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
            throw_error_at(log_.file, line_,
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

    std::vector<std::string> notes() const {
        const LogColumn& altitude = *columns_[LogQuantity::Altitude];
        std::vector<std::string> notes;
        if (!altitude.has_unit) {
            notes.push_back(
                fmt::format("column {} names no unit: its heights are taken as metres (name it {}_ft for feet)",
                    printable(altitude.name), printable(altitude.name)));
        }
        if (std::string left_out = said_of(left_out_); !left_out.empty()) { notes.push_back(std::move(left_out)); }
        return notes;
    }

    static constexpr double day_s = 86400.0;

    const LogText& log_;
    const LogColumns& columns_;
    int line_ = 0;
    std::vector<std::string_view> fields_;
    std::optional<TransverseMercator> frame_;
    std::optional<double> first_time_s_;
    double time_factor_ = 1.0;
    std::vector<sim::AircraftState> samples_;
    std::vector<LoggedAngles> angles_;
    bool has_velocities_ = true;
    LeftOut left_out_;
};

/// Reads a log of another program (see log_columns()). Lines without time, position or altitude, lines whose time does
/// not increase, and lines that imply a speed above 3000 m/s are left out and counted in the notes. Times begin at 0.
/// Attitudes are the log's if every line has roll and pitch, with its true heading or else the heading of the motion;
/// otherwise they are derived from the motion. Throws Error with file and line for what is neither empty nor a number
/// where there must be one, a place that is on no earth, more than a day, and fewer than 2 samples.
LoggedTrack logged_track(const LogText& log, const LogColumns& columns) {
    LogReader reader(log, columns);
    for (std::size_t i = log.header_line + 1; i < log.lines.size(); ++i) {
        const bool is_empty = split_words(log.lines[i]).empty();
        if (!is_empty && !log.lines[i].starts_with('#')) { reader.read_line(i); }
    }
    return std::move(reader).track();
}

/// A log of another kind of file as rows of text, which logged_track() reads.
struct LogTable {
    /// Names of the columns first, then a row a fix: "07:41:03,47.1,8.2,512". What a fix does not tell is empty.
    std::vector<std::string> rows;
    /// The line of the file that each row comes from, counted from 1.
    std::vector<int> line_numbers;
    /// What a person should be told of it.
    std::vector<std::string> notes;
};

/// The columns of a LogTable.
constexpr std::string_view log_table_columns = "time,latitude,longitude,altitude_m";

/// A whole number that fills its columns; pressure altitudes below the datum begin with a minus.
std::optional<int> number_radius(std::string_view record, std::size_t at, std::size_t count) {
    const std::string_view text = record.substr(at, count);
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    if (!std::all_of(text.begin() + static_cast<std::ptrdiff_t>(sign), text.end(), is_digit)) { return std::nullopt; }
    int value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    return fault == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Degrees of an angle that is written as whole degrees and thousandths of minutes.
std::optional<double> angle_deg(std::string_view record, std::size_t at, std::size_t degrees, std::string_view signs) {
    const auto whole = number_radius(record, at, degrees);
    const auto thousandths = number_radius(record, at + degrees, 5);
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
    if (!latitude_deg || !longitude_deg || !number_radius(record, 1, 6)) { return fix; }
    fix.clock = record.substr(1, 6);
    fix.latitude_deg = *latitude_deg;
    fix.longitude_deg = *longitude_deg;
    fix.pressure_m = number_radius(record, 25, 5);
    const auto receiver_m = number_radius(record, 30, 5);
    if (record[24] == 'A' && receiver_m && *receiver_m != 0) { fix.receiver_m = receiver_m; }
    return fix;
}

std::string row_of(const Fix& fix, const std::optional<int>& height_m) {
    if (fix.clock.empty()) { return ",,,"; }
    return fmt::format("{}:{}:{},{:.8f},{:.8f},{}", fix.clock.substr(0, 2), fix.clock.substr(2, 2),
        fix.clock.substr(4, 2), fix.latitude_deg, fix.longitude_deg, height_m ? fmt::format("{}", *height_m) : "");
}

/// True for the lines of a glider's flight recorder: the first that holds anything is the record of its maker (A) or of
/// its head (H), and one is a fix.
bool is_igc(std::span<const std::string_view> lines) {
    const auto first = std::ranges::find_if(lines, [](std::string_view line) { return !split_words(line).empty(); });
    const bool has_head =
        first != lines.end() && (first->front() == 'A' || first->front() == 'H') && first->find(',') == first->npos;
    return has_head && std::ranges::any_of(lines, [](std::string_view line) { return !fix_of(line, 0).clock.empty(); });
}

/// The fixes (B records) of a flight recorder's file, as the FAI's "Technical Specification for GNSS Flight Recorders",
/// appendix A, lays them out. Heights are those of the receiver where most fixes have one, else pressure altitudes; a
/// fix without it has none. B records that are damaged are rows without a place.
LogTable igc_fixes(std::span<const std::string_view> lines) {
    std::vector<Fix> fixes;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].starts_with('B')) { fixes.push_back(fix_of(lines[i], static_cast<int>(i) + 1)); }
    }
    const auto with_receiver = std::ranges::count_if(fixes, [](const Fix& fix) { return fix.receiver_m.has_value(); });
    const bool by_receiver = 2 * static_cast<std::size_t>(with_receiver) > fixes.size();
    LogTable table;
    table.rows.emplace_back(log_table_columns);
    table.line_numbers.push_back(1);
    for (const Fix& fix : fixes) {
        table.rows.push_back(row_of(fix, by_receiver ? fix.receiver_m : fix.pressure_m));
        table.line_numbers.push_back(fix.line);
    }
    if (!by_receiver) {
        table.notes.emplace_back("heights are pressure altitudes: few fixes have one of the "
                                 "receiver");
    }
    return table;
}

constexpr std::string_view point_start = "<trkpt";
constexpr std::string_view point_end = "</trkpt>";
constexpr std::string_view comment_start = "<!--";
constexpr std::string_view comment_end = "-->";

/// Fields of a row hold no comma and no quote.
std::string_view as_field(std::string_view text) {
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
            return end == tag.npos ? std::string_view() : as_field(tag.substr(quote + 1, end - quote - 1));
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
    return as_field(behind.substr(0, behind.find('<')));
}

/// True for a text whose root element is GPX's.
bool is_gpx(std::string_view text) {
    constexpr std::size_t head = 4096;
    const std::string_view start = text.substr(0, head);
    const std::size_t first = start.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    return first != start.npos && start[first] == '<' && start.find("<gpx") != start.npos;
}

/// The track points of a GPX file (topografix.com/GPX/1/1), of all its tracks and segments in their order; waypoints
/// and routes have no times and are passed over. Throws Error with file and line for a comment or a track point without
/// an end, and with the file where there is no track point.
LogTable gpx_points(const std::filesystem::path& file, std::string_view text) {
    LogTable table;
    table.rows.emplace_back(log_table_columns);
    table.line_numbers.push_back(1);
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
            table.rows.push_back(fmt::format("{},{},{},{}", element(within, "time"), attribute(tag, "lat"),
                attribute(tag, "lon"), element(within, "ele")));
            table.line_numbers.push_back(line_at(at));
            at = end;
        }
    }
    if (table.rows.size() == 1) {
        throw_error_in(file, "expected track points (trkpt), got none: waypoints and routes have no times");
    }
    return table;
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
        if (column.field < 0) { continue; }
        const std::string_view text = fields[static_cast<std::size_t>(column.field)];
        const auto value = finite_number(text);
        if (!value) {
            at.refuse(fmt::format(
                "expected a finite number in column {}, got \"{}\"", column.name, printable(std::string(text))));
        }
        row[i] = *value;
    }
    return row;
}

/// A JSBSim row in the units and axes of our own columns.
Row own_from_jsbsim(
    Row row, const TrackHeader& header, std::optional<TransverseMercator>& frame, const TrackLineLocation& at) {
    if (std::abs(row[North]) > 90.0 || std::abs(row[East]) > 360.0) {
        at.refuse(fmt::format(
            "expected a latitude within 90 deg and a longitude within 360 deg, got {} and {}", row[North], row[East]));
    }
    if (header.columns[North].name == geocentric_latitude) {
        row[North] = geodetic_from_geocentric_deg(row[North], m_from_ft(row[Altitude]));
    }
    const GeoPosition place{row[North], row[East]};
    if (!frame) { frame.emplace(place); }
    const FramePosition local = frame->place_of(place);
    const glm::dvec2 speed_mps =
        rotated_clockwise({m_from_ft(row[EastSpeed]), m_from_ft(row[NorthSpeed])}, local.north_bearing_rad);
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
        return body_to_world_from_euler({rad_from_deg(row[Yaw]), rad_from_deg(row[Pitch]), rad_from_deg(row[Roll])});
    }
    const glm::dquat attitude(row[QuaternionW], row[QuaternionX], row[QuaternionY], row[QuaternionZ]);
    const double off = std::abs(glm::length(attitude) - 1.0);
    if (!(off <= off_unit)) {
        at.refuse(fmt::format(
            "expected a unit quaternion q_w, q_x, q_y, q_z, got one of length {:.7g}", glm::length(attitude)));
    }
    return off <= rounding ? attitude : glm::normalize(attitude);
}

sim::AircraftState state_from(const Row& row, bool as_quaternion, const TrackLineLocation& at) {
    sim::AircraftState state;
    state.time_s = row[Time];
    if (std::abs(state.time_s) > latest_s) {
        at.refuse(
            fmt::format("expected a time from -{:.0f} s to {:.0f} s, got {:.10g} s", latest_s, latest_s, state.time_s));
    }
    state.position_m = {row[East], row[North], row[Altitude]};
    if (!(glm::length(state.position_m) <= max_track_distance_m)) {
        at.refuse(fmt::format("expected a place within {:.0f} km of the origin, got {:.0f} km",
            max_track_distance_m / 1000.0, glm::length(state.position_m) / 1000.0));
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
        at.refuse(
            fmt::format("expected a time within {:.0f} s of the first, got {:.3f} s", max_track_duration_s, now_s));
    }
}

void check_speed(const sim::AircraftState& before, const sim::AircraftState& now, const TrackLineLocation& at) {
    const double speed_mps = std::max(
        glm::length(now.velocity_mps), glm::length(now.position_m - before.position_m) / (now.time_s - before.time_s));
    if (!(speed_mps <= max_track_speed_mps)) {
        at.refuse(
            fmt::format("expected a speed of at most {:.0f} m/s, got {:.1f} m/s", max_track_speed_mps, speed_mps));
    }
}

/// Whether a line holds nothing but, at most, a comment.
bool is_empty(std::string_view line) { return line.starts_with('#') || split_words(line).empty(); }

std::size_t line_of_names(std::span<const std::string_view> lines) {
    return static_cast<std::size_t>(std::ranges::find_if_not(lines, is_empty) - lines.begin());
}

/// Whether a line names units below the names of columns: it holds something, and no number or time.
bool are_units(const std::vector<std::string_view>& fields) {
    return !are_empty(fields) &&
           std::ranges::none_of(fields, [](std::string_view field) { return log_time(field).has_value(); });
}

/// The track that another program has logged, its units in a comment before the names or in a line behind them; nothing
/// where the columns are ours or JSBSim's, or no flight's.
std::optional<RecordedTrack> track_of_others(
    const std::filesystem::path& file, std::span<const std::string_view> lines, std::size_t names_line) {
    const char separator = separator_of(lines[names_line]);
    const auto names = unquoted_fields(lines[names_line], separator);
    if (are_track_columns(names)) { return std::nullopt; }
    std::vector<std::string_view> units;
    if (names_line > 0) { units = unquoted_fields(lines[names_line - 1], separator); }
    std::size_t header_line = names_line;
    if (names_line + 1 < lines.size()) {
        const auto below = unquoted_fields(lines[names_line + 1], separator);
        if (are_units(below)) {
            units = below;
            ++header_line;
        }
    }
    const auto columns = log_columns(names, units);
    if (!columns) { return std::nullopt; }
    LoggedTrack track = logged_track({file, lines, header_line, separator}, *columns);
    return RecordedTrack{sim::Trajectory(std::move(track.samples)), track.origin, std::move(track.notes)};
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
    if (is_gpx(text)) { return track_of_table(file, gpx_points(file, text)); }
    auto lines = split_lines(text);
    if (is_igc(lines)) { return track_of_table(file, igc_fixes(lines)); }
    if (!lines.empty() && lines.front().starts_with("\xef\xbb\xbf")) { lines.front().remove_prefix(3); }
    const std::size_t names = line_of_names(lines);
    if (names == lines.size()) { throw_error_at(file, 1, "expected a line of column names, got an empty one"); }
    if (auto track = track_of_others(file, lines, names)) { return std::move(*track); }
    const TrackHeader header = track_header(lines[names], {file, static_cast<int>(names) + 1});
    const bool as_quaternion = header.has({QuaternionW});
    std::optional<TransverseMercator> frame;
    std::vector<sim::AircraftState> samples;
    for (std::size_t i = names + 1; i < lines.size(); ++i) {
        if (is_empty(lines[i])) { continue; }
        const TrackLineLocation at{file, static_cast<int>(i) + 1};
        Row row = row_from(lines[i], header, at);
        if (header.is_jsbsim) { row = own_from_jsbsim(row, header, frame, at); }
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
    if (!header.has({NorthSpeed, EastSpeed, UpSpeed})) { fill_velocities(samples); }
    if (!as_quaternion && !header.has({Roll, Pitch, Yaw})) { fill_attitudes(samples); }
    if (!header.has({LoadFactor})) { fill_load_factors(samples); }
    return {sim::Trajectory(std::move(samples)), frame ? std::optional(frame->origin()) : std::nullopt, {}};
}

} // namespace octant::flightpaths
