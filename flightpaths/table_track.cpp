#include "flightpaths/fix_table.h"
#include "flightpaths/log_columns.h"
#include "flightpaths/track_readers.h"
#include "sim/base/axes.h"
#include "sim/base/column_reader.h"
#include "sim/base/earth_frame.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

/// What no track of Octant or JSBSim goes beyond: a speed, a distance from its origin, a time from its first sample.
constexpr double max_track_speed_mps = 3000.0;
constexpr double max_track_distance_m = 1e7;
constexpr double max_track_duration_s = 86400.0;

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

/// Octant's columns; heading_deg takes the place of a missing yaw_deg.
TrackColumns octant_columns_in(std::span<const std::string_view> names) {
    TrackColumns columns = octant_columns;
    if (!field_named(names, columns[Yaw].name) && field_named(names, "heading_deg")) {
        columns[Yaw].name = "heading_deg";
    }
    return columns;
}

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

/// Reads the rows of a track of Octant or JSBSim one by one. A column "aircraft" tells the rows of several apart.
class TrackReader {
public:
    /// The current row of `table` holds the names of the columns. Throws Error if a required column is missing, one
    /// occurs twice, or some but not all of the quaternion's are there.
    TrackReader(ColumnReader& table, bool is_jsbsim)
        : table_(table), is_jsbsim_(is_jsbsim),
          columns_(is_jsbsim ? jsbsim_columns_in(table.fields()) : octant_columns_in(table.fields())) {
        table.find(columns_);
        name_field_ = field_named(table.fields(), "aircraft");
        for (std::size_t i = QuaternionW; i <= QuaternionZ; ++i) { has_quaternion_ = has_quaternion_ || table.has(i); }
        for (std::size_t i = QuaternionW; i <= QuaternionZ; ++i) {
            if (has_quaternion_ && !table.has(i)) {
                table.refuse("all of the columns q_w, q_x, q_y, q_z", fmt::format("no {}", columns_[i].name));
            }
        }
    }

    TrackRecording recording(const TrackSource& source) && {
        while (table_.next_row()) {
            const TrackSample sample = sample_of(row());
            TrackedAircraft& aircraft = this->aircraft();
            if (!aircraft.samples.empty()) { check_follows(aircraft.samples.back(), aircraft.samples.front(), sample); }
            aircraft.samples.push_back(sample);
        }
        const auto too_short = std::ranges::find_if(
            aircraft_, [](const TrackedAircraft& aircraft) { return aircraft.samples.size() < 2; });
        if (aircraft_.empty() || too_short != aircraft_.end()) {
            throw_error_in(source.file,
                fmt::format("expected at least 2 samples{}, got {}", aircraft_.size() > 1 ? " of each aircraft" : "",
                    aircraft_.empty() ? 0 : too_short->samples.size()));
        }
        if (!source.follow.empty()) {
            std::vector<std::vector<std::string>> names;
            for (const TrackedAircraft& aircraft : aircraft_) { names.push_back({aircraft.call_sign}); }
            const auto first = static_cast<std::ptrdiff_t>(followed_index(names, source.follow));
            std::rotate(aircraft_.begin(), aircraft_.begin() + first, aircraft_.begin() + first + 1);
        }
        TrackRecording recording;
        recording.format = is_jsbsim_ ? "JSBSim CSV" : "Octant CSV";
        if (frame_) { recording.origin = frame_->origin(); }
        recording.aircraft = std::move(aircraft_);
        return recording;
    }

private:
    /// The aircraft that the current row tells of.
    TrackedAircraft& aircraft() {
        const auto& fields = table_.fields();
        const std::string_view name =
            name_field_ && *name_field_ < fields.size() ? fields[*name_field_] : std::string_view();
        const auto known = std::ranges::find(aircraft_, name, &TrackedAircraft::call_sign);
        if (known != aircraft_.end()) { return *known; }
        if (aircraft_.size() == max_recorded_aircraft) {
            table_.refuse(fmt::format("at most {} aircraft", max_recorded_aircraft), "more");
        }
        TrackedAircraft& added = aircraft_.emplace_back();
        added.call_sign = name;
        added.heights = HeightKind::Sea;
        return added;
    }

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

    TrackSample sample_of(const TrackRow& row) const {
        TrackSample sample;
        sample.time_s = row[Time];
        if (std::abs(sample.time_s) > latest_s) {
            table_.refuse(
                fmt::format("a time from -{0:.0f} s to {0:.0f} s", latest_s), fmt::format("{:.10g} s", sample.time_s));
        }
        sample.position_m = {row[East], row[North], row[Altitude]};
        if (!(glm::length(sample.position_m) <= max_track_distance_m)) {
            table_.refuse(fmt::format("a place within {:.0f} km of the origin", max_track_distance_m / 1000.0),
                fmt::format("{:.0f} km", glm::length(sample.position_m) / 1000.0));
        }
        if (has({NorthSpeed, EastSpeed, UpSpeed})) {
            sample.velocity_mps = {row[EastSpeed], row[NorthSpeed], row[UpSpeed]};
        }
        if (has_quaternion_) {
            sample.body_to_world = attitude_of(row);
        } else {
            if (has({Yaw})) { sample.heading_rad = rad_from_deg(row[Yaw]); }
            if (has({Pitch})) { sample.pitch_rad = rad_from_deg(row[Pitch]); }
            if (has({Roll})) { sample.roll_rad = rad_from_deg(row[Roll]); }
        }
        if (has({LoadFactor})) { sample.load_factor = row[LoadFactor]; }
        return sample;
    }

    glm::dquat attitude_of(const TrackRow& row) const {
        const glm::dquat attitude(row[QuaternionW], row[QuaternionX], row[QuaternionY], row[QuaternionZ]);
        const double error = std::abs(glm::length(attitude) - 1.0);
        if (!(error <= max_quaternion_error)) {
            table_.refuse(
                "a unit quaternion q_w, q_x, q_y, q_z", fmt::format("one of length {:.7g}", glm::length(attitude)));
        }
        return error <= quaternion_rounding ? attitude : glm::normalize(attitude);
    }

    void check_follows(const TrackSample& last, const TrackSample& first, const TrackSample& next) const {
        if (!(next.time_s > last.time_s)) {
            table_.refuse(fmt::format("a time after {:.3f} s", last.time_s), fmt::format("{:.3f} s", next.time_s));
        }
        if (!(next.time_s - first.time_s <= max_track_duration_s)) {
            table_.refuse(fmt::format("a time within {:.0f} s of the first", max_track_duration_s),
                fmt::format("{:.3f} s", next.time_s));
        }
        const double way_mps = glm::length(next.position_m - last.position_m) / (next.time_s - last.time_s);
        const double stated_mps = glm::length(next.velocity_mps);
        const double speed_mps = std::isnan(stated_mps) ? way_mps : std::max(stated_mps, way_mps);
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
    std::optional<std::size_t> name_field_;
    std::vector<TrackedAircraft> aircraft_;
};

/// True for a row whose fields are all numbers or times: the first one of a table without names.
bool is_table_of_numbers(std::span<const std::string_view> fields) {
    constexpr std::size_t fewest = 4;
    return fields.size() >= fewest &&
           std::ranges::all_of(fields, [](std::string_view field) { return log_time(field).has_value(); });
}

/// A table of numbers without names, such as FlightGear's generic protocol writes: rows of equal length, times in
/// seconds or clocks.
using NumberTable = std::vector<std::vector<double>>;

NumberTable read_numbers(const TrackSource& source, std::string_view text, char separator) {
    constexpr std::size_t max_numbers = 50000000;
    NumberTable rows;
    std::size_t numbers = 0;
    ColumnReader table(TextScanner(source.file, text), separator);
    while (table.next_row()) {
        const auto& fields = table.fields();
        if (!rows.empty() && table.is_truncated() && fields.size() < rows.front().size()) { continue; }
        if (!rows.empty() && fields.size() != rows.front().size()) {
            table.refuse(fmt::format("{} numbers as in the first row", rows.front().size()),
                fmt::format("{} fields", fields.size()));
        }
        std::vector<double> row;
        for (const std::string_view field : fields) {
            const auto number = log_time(field);
            if (!number) { table.refuse("a finite number or a time", in_quotes(field)); }
            row.push_back(number->seconds);
        }
        numbers += row.size();
        if (numbers > max_numbers) { table.refuse(fmt::format("at most {} numbers", max_numbers), "more"); }
        rows.push_back(std::move(row));
    }
    return rows;
}

bool increases(const NumberTable& rows, std::size_t column) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (!(rows[i][column] >= rows[i - 1][column])) { return false; }
    }
    return rows.back()[column] > rows.front()[column];
}

/// True where column and the next one are latitudes and longitudes of something that moves at less than 3,000 m/s.
bool are_places(const NumberTable& rows, std::size_t column, std::size_t time) {
    constexpr double m_per_deg = 111e3;
    bool moves = false;
    long faults = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double latitude_deg = rows[i][column];
        const double longitude_deg = rows[i][column + 1];
        if (!(std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 360.0)) { return false; }
        if (i == 0) { continue; }
        const double way_deg = std::hypot(latitude_deg - rows[i - 1][column], longitude_deg - rows[i - 1][column + 1]);
        const double most_deg = max_track_speed_mps * (rows[i][time] - rows[i - 1][time]) / m_per_deg;
        moves = moves || way_deg > 0.0;
        faults += way_deg > most_deg + 1e-9 && way_deg > 0.0 ? 1 : 0;
    }
    // Numbers without digits behind the point, such as switches, are no places.
    const double first = rows.front()[column] * 100.0;
    const double second = rows.front()[column + 1] * 100.0;
    const bool is_fine = std::abs(first - std::round(first)) > 1e-6 || std::abs(second - std::round(second)) > 1e-6 ||
                         std::ranges::any_of(rows, [&](const auto& row) {
                             return std::abs(row[column] * 100.0 - std::round(row[column] * 100.0)) > 1e-6 ||
                                    std::abs(row[column + 1] * 100.0 - std::round(row[column + 1] * 100.0)) > 1e-6;
                         });
    return moves && is_fine && 20 * faults <= static_cast<long>(rows.size());
}

/// True where these columns hold roll, pitch and a heading that follows the way over the ground within 45 degrees.
bool are_angles(const NumberTable& rows, std::size_t place, std::size_t roll) {
    double off_sum_deg = 0.0;
    long count = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& row = rows[i];
        if (!(std::abs(row[roll]) <= 180.0 && std::abs(row[roll + 1]) <= 90.0 && std::abs(row[roll + 2]) <= 360.0)) {
            return false;
        }
        if (i == 0) { continue; }
        const double north_deg = row[place] - rows[i - 1][place];
        const double east_deg = (row[place + 1] - rows[i - 1][place + 1]) * std::cos(rad_from_deg(row[place]));
        if (north_deg == 0.0 && east_deg == 0.0) { continue; }
        off_sum_deg += std::abs(std::remainder(deg_from_rad(std::atan2(east_deg, north_deg)) - row[roll + 2], 360.0));
        ++count;
    }
    constexpr double most_deg = 45.0;
    return count > 0 && off_sum_deg / static_cast<double>(count) <= most_deg;
}

/// A table without names: its columns are known by their values. The height follows the place, in feet as FlightGear
/// has it; then may come roll, pitch and heading.
TrackRecording nameless_recording(const TrackSource& source, std::string_view text, char separator) {
    const NumberTable rows = read_numbers(source, text, separator);
    const std::size_t columns = rows.front().size();
    std::size_t time = 0;
    while (time < columns && !increases(rows, time)) { ++time; }
    std::size_t place = 0;
    const auto is_here = [&](std::size_t at) { return at != time && at + 1 != time && are_places(rows, at, time); };
    while (time < columns && place + 2 < columns && !is_here(place)) { ++place; }
    if (time == columns || place + 2 >= columns) {
        throw_error_at(source.file, 1,
            "expected column names, or columns of times that increase, of latitudes, longitudes and heights in this "
            "order, got other numbers");
    }
    const std::size_t roll = place + 3;
    const bool has_angles = roll + 2 < columns && are_angles(rows, place, roll);
    FixTable fixes("table without column names", source.file);
    fixes.heights = HeightKind::Sea;
    fixes.add_note(
        fmt::format("no column names: column {} is taken as seconds, {} and {} as latitude and longitude, {} "
                    "as height in feet (FlightGear){}",
            time + 1, place + 1, place + 2, place + 3,
            has_angles ? fmt::format(", {} to {} as roll, pitch and heading", roll + 1, roll + 3) : ""));
    for (const std::vector<double>& row : rows) {
        if (row[place] == 0.0 && row[place + 1] == 0.0) {
            fixes.skip_row();
            continue;
        }
        Fix fix;
        fix.time_s = row[time];
        fix.latitude_deg = row[place];
        fix.longitude_deg = row[place + 1];
        fix.altitude_m = m_from_ft(row[place + 2]);
        if (has_angles) {
            fix.roll_deg = row[roll];
            fix.pitch_deg = row[roll + 1];
            fix.heading_deg = row[roll + 2];
        }
        fixes.add(fixes.series(""), fix);
    }
    return std::move(fixes).recording(source.follow);
}

/// Reads the rows of a log of another program. Rows without time, position or height are left out and counted. Throws
/// Error with file and line for a field that is neither empty nor a number where there must be one.
class LogReader {
public:
    LogReader(const TrackSource& source, const LogColumns& columns)
        : source_(source), columns_(columns), fixes_("CSV log", source.file) {
        fixes_.heights = columns.heights;
        fixes_.headings = columns[LogQuantity::Heading]           ? HeadingKind::Unknown
                          : columns[LogQuantity::MagneticHeading] ? HeadingKind::Magnetic
                                                                  : HeadingKind::True;
        const auto& speed = columns[LogQuantity::GroundSpeed];
        fixes_.ground_speeds_have_unit = !speed || speed->has_unit;
    }

    void read_row(int line, std::span<const std::string_view> fields) {
        fields_ = fields;
        line_ = line;
        const auto place = this->place();
        const auto time_s = time();
        if (!time_s || !place) {
            fixes_.skip_row();
            return;
        }
        Fix fix;
        fix.line = line;
        fix.time_s = time_s->seconds;
        fix.is_leap_second = time_s->is_leap_second;
        fix.latitude_deg = place->latitude_deg;
        fix.longitude_deg = place->longitude_deg;
        if (field(LogQuantity::Altitude) == "ground") {
            fix.contact = GroundContact::OnGround;
        } else {
            fix.altitude_m = value(LogQuantity::Altitude).value_or(not_measured);
        }
        take_motion(fix);
        take_angles(fix);
        fixes_.add(series(), fix);
    }

    TrackRecording recording() && {
        const auto& altitude = columns_[LogQuantity::Altitude];
        if (altitude && !altitude->has_unit) {
            fixes_.add_note(
                fmt::format("column {} names no unit: its heights are taken as metres (name it {}_ft for feet)",
                    printable(altitude->name), printable(altitude->name)));
        }
        for (const auto& [name, count] : no_numbers_) {
            fixes_.add_note(fmt::format("left out {} values of column {} that are no numbers", count, printable(name)));
        }
        if (wrong_dates_ > 0) {
            fixes_.add_note(fmt::format("left out {} values of column {} that are no dates", wrong_dates_,
                printable(columns_[LogQuantity::Date]->name)));
        }
        fixes_.begin_utc_s = clock_of_begin_s_;
        return std::move(fixes_).recording(source_.follow);
    }

private:
    /// What a field holds; empty for none, and for what programs write where nothing is known.
    std::string_view field(LogQuantity what) const {
        const auto& column = columns_[what];
        if (!column || column->field >= fields_.size()) { return {}; }
        const std::string_view text = fields_[column->field];
        const bool nothing = text == "nan" || text == "NaN" || text == "null" || text == "None" || text == "NULL" ||
                             text == "-" || text == "N/A" || text == "NA";
        return nothing ? std::string_view() : text;
    }

    std::optional<double> number(std::string_view text, LogQuantity what) const {
        if (text.empty()) { return std::nullopt; }
        const auto value = finite_number(text);
        if (!value) {
            throw_error_at(source_.file, line_,
                fmt::format(
                    "expected a finite number in column {}, got {}", printable(columns_[what]->name), in_quotes(text)));
        }
        return value;
    }

    std::optional<double> value(LogQuantity what) const {
        const auto found = number(field(what), what);
        return found ? std::optional(*found * columns_[what]->factor) : std::nullopt;
    }

    /// A quantity that a flight can do without.
    double optional_value(LogQuantity what) {
        const std::string_view text = field(what);
        if (text.empty()) { return not_measured; }
        const auto found = finite_number(text);
        if (!found) {
            ++no_numbers_[columns_[what]->name];
            return not_measured;
        }
        return *found * columns_[what]->factor;
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
            // Numbers without a sign, beside a letter.
            if (latitude_deg && field(LogQuantity::NorthSouth) == "S") { latitude_deg = -std::abs(*latitude_deg); }
            if (longitude_deg && field(LogQuantity::EastWest) == "W") { longitude_deg = -std::abs(*longitude_deg); }
        }
        // Receivers without a fix write zeros.
        if (!latitude_deg || !longitude_deg || (*latitude_deg == 0.0 && *longitude_deg == 0.0)) { return std::nullopt; }
        return GeoPosition{*latitude_deg, *longitude_deg};
    }

    std::optional<LogTime> time() {
        const std::string_view text = field(LogQuantity::Time);
        if (text.empty()) { return std::nullopt; }
        auto read = log_time(text);
        if (!read) {
            throw_error_at(source_.file, line_,
                fmt::format("expected a time such as 12.5, 07:41:03 or 2024-01-02T07:41:03Z in column {}, "
                            "got {}",
                    printable(columns_[LogQuantity::Time]->name), in_quotes(text)));
        }
        if (!time_factor_) { time_factor_ = factor_of_times(read->seconds); }
        read->seconds *= *time_factor_;
        if (read->is_time_of_day) { read = with_date(*read); }
        constexpr double since_2001_s = 978307200.0;
        const bool is_unix = !read->is_time_of_day && !read->is_date && read->seconds >= since_2001_s;
        if (!first_time_s_) {
            first_time_s_ = read->seconds;
            if (read->day_is_guessed) {
                const std::string_view date = field(LogQuantity::Date);
                fixes_.add_note(fmt::format("dates are taken as month/day/year: line {} has {}", line_,
                    printable(std::string(date.empty() ? text : date))));
            }
            fixes_.time_scale = read->is_date || is_unix ? TimeScale::Utc
                                : read->is_time_of_day   ? TimeScale::TimeOfDay
                                                         : TimeScale::Own;
            take_clock(*read);
        }
        return read;
    }

    /// Local dates and clocks with their offset from UTC.
    LogTime with_date(LogTime time) {
        const std::string_view text = field(LogQuantity::Date);
        auto date = log_date(text);
        if (!date) {
            wrong_dates_ += text.empty() ? 0 : 1;
            return time;
        }
        date->seconds += time.seconds - zone_offset_s(field(LogQuantity::UtcOffset)).value_or(0.0);
        date->is_leap_second = time.is_leap_second;
        return *date;
    }

    /// A second column of times says when times of their own begin.
    void take_clock(const LogTime& time) {
        if (time.is_date || time.is_time_of_day || !columns_[LogQuantity::Clock]) { return; }
        const auto clock = log_time(field(LogQuantity::Clock));
        if (clock && clock->is_date && fixes_.time_scale == TimeScale::Own) {
            clock_of_begin_s_ = clock->seconds - time.seconds;
        }
    }

    /// Times since 1970 in thousandths or millionths of a second are known by their size.
    double factor_of_times(double first) const {
        const LogColumn& column = *columns_[LogQuantity::Time];
        if (column.has_unit) { return column.factor; }
        return std::abs(first) > 1e14 ? 1e-6 : std::abs(first) > 1e11 ? 1e-3 : 1.0;
    }

    void take_motion(Fix& fix) {
        const auto taken = [&](LogQuantity what) { return static_cast<float>(optional_value(what)); };
        fix.north_mps = taken(LogQuantity::NorthSpeed);
        fix.east_mps = taken(LogQuantity::EastSpeed);
        fix.up_mps = columns_[LogQuantity::DownSpeed] ? -taken(LogQuantity::DownSpeed) : taken(LogQuantity::Climb);
        fix.ground_speed_mps = taken(LogQuantity::GroundSpeed);
        fix.track_deg = taken(LogQuantity::Track);
        fix.true_airspeed_mps = taken(LogQuantity::TrueAirspeed);
        fix.load_factor = taken(LogQuantity::LoadFactor);
        fix.pressure_height_m = taken(LogQuantity::PressureAltitude);
        fix.horizontal_error_m = taken(LogQuantity::HorizontalError);
        fix.vertical_error_m = taken(LogQuantity::VerticalError);
        const std::string_view contact = field(LogQuantity::OnGround);
        if (contact == "True" || contact == "true" || contact == "1" || contact == "TRUE" || contact == "G") {
            fix.contact = GroundContact::OnGround;
        } else if (!contact.empty() && fix.contact == GroundContact::Unknown) {
            fix.contact = GroundContact::InAir;
        }
    }

    void take_angles(Fix& fix) {
        fix.roll_deg = optional_value(LogQuantity::Roll);
        fix.pitch_deg = optional_value(LogQuantity::Pitch);
        fix.heading_deg =
            optional_value(columns_[LogQuantity::Heading] ? LogQuantity::Heading : LogQuantity::MagneticHeading);
    }

    FixSeries& series() {
        const std::string_view call_sign = field(LogQuantity::CallSign);
        std::string_view id = field(LogQuantity::Id);
        if (!columns_[LogQuantity::Id]) {
            // A row without a call sign goes on with the last one.
            if (!call_sign.empty()) { last_call_sign_ = call_sign; }
            id = last_call_sign_;
        }
        FixSeries& series = fixes_.series(id);
        if (series.call_sign.empty()) { series.call_sign = call_sign; }
        return series;
    }

    const TrackSource& source_;
    const LogColumns& columns_;
    FixTable fixes_;
    int line_ = 0;
    std::span<const std::string_view> fields_;
    std::optional<double> first_time_s_;
    long wrong_dates_ = 0;
    std::optional<double> time_factor_;
    std::optional<double> clock_of_begin_s_;
    std::string last_call_sign_;
    std::map<std::string, long> no_numbers_;
};

/// True if the row below the names of columns gives units: it has text, but no number or time.
bool are_units(std::span<const std::string_view> fields) {
    return !std::ranges::all_of(fields, &std::string_view::empty) &&
           std::ranges::none_of(fields, [](std::string_view field) { return log_time(field).has_value(); });
}

/// A log of another program, whose column names are the current row of `table`; its units are in a comment before the
/// names or in the row below.
TrackRecording log_recording(const TrackSource& source, ColumnReader& table, char separator) {
    const std::vector<std::string_view> names = table.fields();
    const std::string_view first_name = names.front();
    std::vector<std::string_view> units = table_fields(table.comment(), separator);
    bool has_row = table.next_row();
    if (has_row && are_units(table.fields())) {
        units = table.fields();
        has_row = table.next_row();
    }
    const auto columns = log_columns(names, units);
    LogReader reader(source, *columns);
    for (; has_row; has_row = table.next_row()) {
        // Logs that were continued repeat their names; those of a recorder that lost its power end in half a line.
        const bool is_cut = table.is_truncated() && table.fields().size() < names.size();
        if (table.fields().front() == first_name || is_cut) { continue; }
        reader.read_row(table.line_number(), table.fields());
    }
    return std::move(reader).recording();
}

/// A number of digits with one comma as decimal point.
bool has_decimal_comma(std::string_view field) {
    const std::size_t comma = field.find(',');
    if (comma == field.npos || comma == 0 || comma + 1 == field.size()) { return false; }
    std::string number(field);
    number[comma] = '.';
    return finite_number(number).has_value();
}

/// The text with points in place of decimal commas, where its fields stand between semicolons or tabs.
std::string with_decimal_points(std::string_view text, char separator) {
    std::string out;
    out.reserve(text.size());
    for (const std::string_view line : split_lines(text)) {
        bool is_first = true;
        for (const std::string_view field : split_fields(line, separator)) {
            if (!std::exchange(is_first, false)) { out += separator; }
            const std::size_t at = out.size();
            out += field;
            if (has_decimal_comma(field)) { out[at + field.find(',')] = '.'; }
        }
        out += '\n';
    }
    return out;
}

/// The separator of a table: what separator_of says, but semicolons also where names or numbers have commas.
char table_separator(std::string_view text) {
    for (const std::string_view line : split_lines(text)) {
        if (split_words(line).empty() || line.starts_with('#')) { continue; }
        constexpr long fewest = 3;
        const auto semicolons = std::count(line.begin(), line.end(), ';');
        return semicolons >= fewest && line.find('\t') == line.npos ? ';' : separator_of(line);
    }
    return ',';
}

bool has_decimal_commas(std::string_view text, char separator) {
    constexpr std::size_t looked_at = 20;
    if (separator == ',') { return false; }
    const auto lines = split_lines(text.substr(0, std::min<std::size_t>(text.size(), std::size_t{1} << 16U)));
    for (std::size_t i = 0; i < std::min(looked_at, lines.size()); ++i) {
        const auto fields = split_fields(lines[i], separator);
        if (std::ranges::any_of(fields, has_decimal_comma)) { return true; }
    }
    return false;
}

/// FlySight 2's table as one with its names first: rows of a kind of sensor begin with its name ($GNSS), their names
/// follow $COL and their units $UNIT. Other lines become empty, so that lines keep their numbers.
std::string from_flysight(std::string_view text) {
    std::string out;
    for (std::string_view line : split_lines(text)) {
        for (const std::string_view head : {"$COL,GNSS,", "$UNIT,GNSS,", "$GNSS,"}) {
            if (line.starts_with(head)) { out += line.substr(head.size()); }
        }
        out += '\n';
    }
    return out;
}

} // namespace

TrackRecording table_recording(const TrackSource& source) {
    if (source.bytes.starts_with("$FLYS,")) {
        const std::string table = from_flysight(source.bytes);
        return table_recording({table, source.file, source.follow});
    }
    const char separator = table_separator(source.bytes);
    std::string converted;
    std::string_view text = source.bytes;
    if (has_decimal_commas(text, separator)) {
        converted = with_decimal_points(text, separator);
        text = converted;
    }
    ColumnReader table(TextScanner(source.file, text), separator);
    if (!table.next_row()) { throw_error_at(source.file, 1, "expected a line of column names, got an empty one"); }
    const std::vector<std::string_view>& names = table.fields();
    if (is_table_of_numbers(names)) { return nameless_recording(source, text, separator); }
    const bool is_log = !has_place(octant_columns, names) && !has_place(jsbsim_columns_in(names), names) &&
                        log_columns(names, {}).has_value();
    if (is_log) { return log_recording(source, table, separator); }
    const bool is_octant = has_some(octant_columns, names);
    if (!is_octant && !has_some(jsbsim_columns_in(names), names)) {
        table.refuse("column names with a time and a place among them (t_s, north_m, east_m, alt_m or Time, Latitude, "
                     "Longitude, Altitude), or a file of a known format",
            printable(std::string(table.row())));
    }
    return TrackReader(table, !is_octant).recording(source);
}

} // namespace octant::flightpaths
