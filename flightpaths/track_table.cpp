#include "flightpaths/track_table.h"

#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <fmt/format.h>
#include <utility>

namespace octant::flightpaths {

char separator_of(std::string_view column_names) {
    const auto has = [&](char c) { return column_names.find(c) != std::string_view::npos; };
    if (has('\t')) { return '\t'; }
    return has(';') && !has(',') ? ';' : ',';
}

std::vector<std::string_view> unquoted_fields(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    while (true) {
        const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
        std::size_t end = line.find(separator);
        if (begin < line.size() && line[begin] == '"') {
            const std::size_t quote = line.find('"', begin + 1);
            end = quote == std::string_view::npos ? end : line.find(separator, quote + 1);
        }
        std::string_view field = split_fields(line.substr(0, end), '\0').front();
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
            field = field.substr(1, field.size() - 2);
        }
        fields.push_back(field);
        if (end == std::string_view::npos) { return fields; }
        line.remove_prefix(end + 1);
    }
}

bool are_empty(std::span<const std::string_view> fields) {
    return std::ranges::all_of(fields, &std::string_view::empty);
}

namespace {

constexpr double day_s = 86400.0;

/// Takes a number of digits off the front of a text.
std::optional<int> taken_number(std::string_view& text) {
    std::size_t length = 0;
    while (length < text.size() && is_digit(text[length])) { ++length; }
    const auto number = whole_number(text.substr(0, length));
    text.remove_prefix(length);
    if (length == 0 || length > 4 || !number) { return std::nullopt; }
    return static_cast<int>(*number);
}

/// Takes "hh:mm:ss" and its fraction off the front of a text; returns seconds. Some loggers write the fraction after
/// the zone letter Z.
std::optional<double> taken_clock(std::string_view& text) {
    std::array<int, 3> parts{};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i > 0 && !text.starts_with(':')) { return std::nullopt; }
        text.remove_prefix(i > 0 ? 1 : 0);
        const auto number = taken_number(text);
        if (!number) { return std::nullopt; }
        parts[i] = *number;
    }
    if (parts[0] > 24 || parts[1] > 59 || parts[2] > 60) { return std::nullopt; }
    if (text.starts_with("Z.")) { text.remove_prefix(1); }
    double fraction = 0.0;
    if (text.starts_with('.')) {
        std::size_t length = 1;
        while (length < text.size() && is_digit(text[length])) { ++length; }
        fraction = finite_number("0" + std::string(text.substr(0, length))).value_or(0.0);
        text.remove_prefix(length);
    }
    return 3600.0 * parts[0] + 60.0 * parts[1] + parts[2] + fraction;
}

/// Takes "yyyy-mm-dd" and one separator off the front of a text; returns the date in seconds since 1970.
std::optional<double> taken_date(std::string_view& text) {
    std::array<int, 3> parts{};
    for (int& part : parts) {
        const auto number = taken_number(text);
        if (!number || text.empty()) { return std::nullopt; }
        part = *number;
        text.remove_prefix(1);
    }
    using namespace std::chrono;
    const year_month_day date{
        year{parts[0]}, month{static_cast<unsigned>(parts[1])}, day{static_cast<unsigned>(parts[2])}};
    if (!date.ok() || parts[0] < 1900) { return std::nullopt; }
    return day_s * static_cast<double>(sys_days{date}.time_since_epoch().count());
}

/// True if the text is empty or begins like a time zone: Z, UTC, GMT, +01:00.
bool is_zone(std::string_view text) {
    return text.empty() || text == "Z" || text == " UTC" || text == " GMT" || text.front() == '+' ||
           text.front() == '-';
}

} // namespace

std::optional<LogTime> log_time(std::string_view text) {
    if (const auto number = finite_number(text)) { return LogTime{.seconds = *number}; }
    std::string_view rest = text;
    if (const auto clock_s = taken_clock(rest); clock_s && is_zone(rest)) {
        return LogTime{.seconds = *clock_s, .is_time_of_day = true};
    }
    rest = text;
    const auto date_s = taken_date(rest);
    if (!date_s) { return std::nullopt; }
    const auto clock_s = taken_clock(rest);
    if (!clock_s || !is_zone(rest)) { return std::nullopt; }
    return LogTime{.seconds = *date_s + *clock_s};
}

namespace {

struct Known {
    TrackQuantity quantity;
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

// The geodetic latitude comes first because it is used if a track has both latitudes.
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

std::span<const Known> columns_of(const TrackHeader& header) {
    return header.is_jsbsim ? std::span<const Known>(jsbsim_columns) : own_columns;
}

bool is_same_name(std::string_view a, std::string_view b) {
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool is_among(std::string_view name, const std::vector<std::string_view>& names) {
    return std::ranges::any_of(names, [&](std::string_view other) { return is_same_name(name, other); });
}

/// True if the names contain a column of every quantity from Time to Altitude.
bool has_place(std::span<const Known> columns, const std::vector<std::string_view>& names) {
    std::array<bool, QuantityCount> has{};
    for (const Known& known : columns) { has[known.quantity] = has[known.quantity] || is_among(known.name, names); }
    return has[Time] && has[North] && has[East] && has[Altitude];
}

/// True if the names contain the time and at least one other of these columns.
bool are_of(std::span<const Known> columns, const std::vector<std::string_view>& names) {
    const auto known =
        std::ranges::count_if(columns, [&](const Known& column) { return is_among(column.name, names); });
    return known >= 2 && is_among(columns.front().name, names);
}

int field_of(const std::vector<std::string_view>& names, std::string_view name, const TrackLineLocation& at) {
    int found = -1;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!is_same_name(names[i], name)) { continue; }
        if (found >= 0) { at.refuse(fmt::format("expected one column {}, got two", name)); }
        found = static_cast<int>(i);
    }
    return found;
}

void need_columns(const TrackHeader& header, const TrackLineLocation& at) {
    for (const Known& known : columns_of(header)) {
        if (known.quantity <= Altitude && !header.has({known.quantity})) {
            at.refuse(fmt::format("expected a column {}, got none", known.name));
        }
    }
}

/// Refuses a header that names some but not all four columns of the quaternion.
void need_whole_quaternion(const TrackHeader& header, const TrackLineLocation& at) {
    const bool any = header.has({QuaternionW}) || header.has({QuaternionX}) || header.has({QuaternionY}) ||
                     header.has({QuaternionZ});
    for (const Known& known : own_columns) {
        if (any && known.quantity >= QuaternionW && !header.has({known.quantity})) {
            at.refuse(fmt::format("expected all of the columns q_w, q_x, q_y, q_z, got no {}", known.name));
        }
    }
}

} // namespace

bool are_track_columns(const std::vector<std::string_view>& names) {
    return has_place(own_columns, names) || has_place(jsbsim_columns, names);
}

TrackHeader track_header(std::string_view line, const TrackLineLocation& at) {
    TrackHeader header;
    header.separator = separator_of(line);
    const auto names = unquoted_fields(line, header.separator);
    header.fields = names.size();
    const bool own = are_of(own_columns, names);
    header.is_jsbsim = !own && are_of(jsbsim_columns, names);
    if (!own && !header.is_jsbsim) {
        at.refuse(fmt::format("expected column names with a time, a place and an altitude among them (t_s, north_m, "
                              "east_m, alt_m or Time, Latitude, Longitude, Altitude), got {}",
            printable(std::string(line))));
    }
    for (const Known& known : columns_of(header)) {
        TrackColumn& column = header.columns[known.quantity];
        if (column.field < 0) { column = {field_of(names, known.name, at), known.name}; }
    }
    need_columns(header, at);
    need_whole_quaternion(header, at);
    return header;
}

namespace {

struct KnownLog {
    LogQuantity what;
    std::string_view name;
};

/// Names in lower case without blanks and underscores. If a log has several names of one quantity, the first in this
/// table is used. Compass headings (HDG of the G1000) are not in the table because they are magnetic.
constexpr std::array known_names{
    KnownLog{LogQuantity::Time, "timestamp"},
    KnownLog{LogQuantity::Time, "time"},
    KnownLog{LogQuantity::Time, "t"},
    KnownLog{LogQuantity::Time, "unixtime"},
    KnownLog{LogQuantity::Time, "epochtime"},
    KnownLog{LogQuantity::Time, "datetime"},
    KnownLog{LogQuantity::Time, "utc"},
    KnownLog{LogQuantity::Time, "timeutc"},
    KnownLog{LogQuantity::Time, "utctime"},
    KnownLog{LogQuantity::Time, "networktime"},
    KnownLog{LogQuantity::Time, "lcltime"},
    KnownLog{LogQuantity::Time, "elapsedtime"},
    KnownLog{LogQuantity::Time, "seconds"},
    KnownLog{LogQuantity::Latitude, "latitude"},
    KnownLog{LogQuantity::Latitude, "lat"},
    KnownLog{LogQuantity::Latitude, "gpslatitude"},
    KnownLog{LogQuantity::Longitude, "longitude"},
    KnownLog{LogQuantity::Longitude, "lon"},
    KnownLog{LogQuantity::Longitude, "lng"},
    KnownLog{LogQuantity::Longitude, "long"},
    KnownLog{LogQuantity::Longitude, "gpslongitude"},
    KnownLog{LogQuantity::Position, "position"},
    KnownLog{LogQuantity::Altitude, "altitudeabovesealevel"},
    KnownLog{LogQuantity::Altitude, "altitudemsl"},
    KnownLog{LogQuantity::Altitude, "altmsl"},
    KnownLog{LogQuantity::Altitude, "msl"},
    KnownLog{LogQuantity::Altitude, "hmsl"},
    KnownLog{LogQuantity::Altitude, "altitudeasl"},
    KnownLog{LogQuantity::Altitude, "geoaltitude"},
    KnownLog{LogQuantity::Altitude, "gpsaltitude"},
    KnownLog{LogQuantity::Altitude, "altitude"},
    KnownLog{LogQuantity::Altitude, "alt"},
    KnownLog{LogQuantity::Altitude, "baroaltitude"},
    KnownLog{LogQuantity::Altitude, "elevation"},
    KnownLog{LogQuantity::Altitude, "ele"},
    KnownLog{LogQuantity::Altitude, "height"},
    KnownLog{LogQuantity::Roll, "roll"},
    KnownLog{LogQuantity::Roll, "bank"},
    KnownLog{LogQuantity::Pitch, "pitch"},
    KnownLog{LogQuantity::Heading, "trueheading"},
    KnownLog{LogQuantity::Heading, "headingtrue"},
    KnownLog{LogQuantity::Heading, "heading"},
    KnownLog{LogQuantity::Heading, "yaw"},
    KnownLog{LogQuantity::NorthSpeed, "veln"},
    KnownLog{LogQuantity::EastSpeed, "vele"},
    KnownLog{LogQuantity::DownSpeed, "veld"},
};

struct LogUnit {
    std::string_view name;
    double factor;
};

const std::array known_units{
    LogUnit{"ft", m_from_ft(1.0)},
    LogUnit{"feet", m_from_ft(1.0)},
    LogUnit{"m", 1.0},
    LogUnit{"meters", 1.0},
    LogUnit{"metres", 1.0},
    LogUnit{"meter", 1.0},
    LogUnit{"metre", 1.0},
    LogUnit{"km", 1000.0},
    LogUnit{"m/s", 1.0},
    LogUnit{"mps", 1.0},
    LogUnit{"deg", 1.0},
    LogUnit{"degrees", 1.0},
    LogUnit{"rad", deg_from_rad(1.0)},
    LogUnit{"radians", deg_from_rad(1.0)},
    LogUnit{"s", 1.0},
    LogUnit{"sec", 1.0},
    LogUnit{"seconds", 1.0},
    LogUnit{"ms", 1e-3},
    LogUnit{"millisecond", 1e-3},
    LogUnit{"milliseconds", 1e-3},
    LogUnit{"us", 1e-6},
};

std::string in_small_letters(std::string_view text) {
    std::string small(text);
    std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return small;
}

/// The factor of the first word of a unit such as "ft msl" or "(m/s)".
std::optional<double> factor_of(std::string_view text) {
    std::string word = in_small_letters(text);
    std::erase_if(word, [](char c) { return c == '(' || c == ')' || c == '[' || c == ']'; });
    word = word.substr(0, word.find(' '));
    const auto found = std::ranges::find(known_units, word, &LogUnit::name);
    return found == known_units.end() ? std::nullopt : std::optional(found->factor);
}

struct LogName {
    std::string plain;
    std::optional<double> factor;
};

LogName name_of(std::string_view text) {
    std::string small = in_small_letters(text);
    LogName name;
    if (const std::size_t bracket = small.find_first_of("(["); bracket != std::string::npos) {
        name.factor = factor_of(std::string_view(small).substr(bracket));
        small.erase(bracket);
    } else if (const std::size_t last = small.rfind('_'); last != std::string::npos) {
        name.factor = factor_of(std::string_view(small).substr(last + 1));
        small.erase(name.factor ? last : small.size());
    }
    std::erase_if(small, [](char c) { return c == ' ' || c == '_' || c == '-' || c == '.'; });
    name.plain = std::move(small);
    return name;
}

bool is_of_flightradar(const std::vector<LogName>& names) {
    return std::ranges::any_of(
        names, [](const LogName& name) { return name.plain == "position" || name.plain == "networktime"; });
}

} // namespace

std::optional<LogColumns> log_columns(
    const std::vector<std::string_view>& names, const std::vector<std::string_view>& units) {
    std::vector<LogName> plain;
    std::ranges::transform(names, std::back_inserter(plain), name_of);
    LogColumns columns;
    for (const KnownLog& known : known_names) {
        auto& column = columns.of[static_cast<std::size_t>(known.what)];
        const auto found = std::ranges::find(plain, known.name, &LogName::plain);
        if (column || found == plain.end()) { continue; }
        const auto field = static_cast<std::size_t>(found - plain.begin());
        std::optional<double> factor = found->factor;
        if (!factor && field < units.size()) { factor = factor_of(units[field]); }
        column = {field, std::string(names[field]), factor.value_or(1.0), factor.has_value()};
    }
    const bool has_place =
        columns[LogQuantity::Position] || (columns[LogQuantity::Latitude] && columns[LogQuantity::Longitude]);
    auto& altitude = columns.of[static_cast<std::size_t>(LogQuantity::Altitude)];
    if (!columns[LogQuantity::Time] || !has_place || !altitude) { return std::nullopt; }
    if (!altitude->has_unit && is_of_flightradar(plain)) {
        altitude->factor = m_from_ft(1.0);
        altitude->has_unit = true;
    }
    return columns;
}

} // namespace octant::flightpaths
