#include "flightpaths/log_columns.h"

#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <iterator>
#include <utility>

namespace octant::flightpaths {

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
