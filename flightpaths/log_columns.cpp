#include "flightpaths/log_columns.h"

#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

namespace octant::flightpaths {

std::string in_small_letters(std::string_view text) {
    std::string small(text);
    std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return small;
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

/// Takes "AM" or "PM" off the front of a text and returns the seconds since midnight of a clock of twelve hours.
double taken_half_of_day(std::string_view& text, int hour, double clock_s) {
    constexpr double half_day_s = 0.5 * day_s;
    const std::string half = in_small_letters(text.substr(0, std::string_view(" AM").size()));
    const std::string_view letters = std::string_view(half).substr(half.starts_with(' ') ? 1 : 0).substr(0, 2);
    if ((letters != "am" && letters != "pm") || hour < 1 || hour > 12) { return clock_s; }
    text.remove_prefix(half.starts_with(' ') ? 3 : 2);
    return clock_s + (letters == "pm" ? half_day_s : 0.0) - (hour == 12 ? half_day_s : 0.0);
}

/// Takes "hh:mm:ss", its fraction and "AM" or "PM" off the front of a text; returns seconds. Some loggers write the
/// fraction after the zone letter Z.
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
    return taken_half_of_day(text, parts[0], 3600.0 * parts[0] + 60.0 * parts[1] + parts[2] + fraction);
}

/// Takes a date and one separator off the front of a text: "yyyy-mm-dd", "mm/dd/yyyy", "dd/mm/yyyy" or "dd.mm.yyyy".
std::optional<LogTime> taken_date(std::string_view& text) {
    constexpr int first_year = 1900;
    constexpr int months = 12;
    std::array<int, 3> parts{};
    char separator = 0;
    for (int& part : parts) {
        const auto number = taken_number(text);
        if (!number || text.empty()) { return std::nullopt; }
        if (separator == 0) { separator = text.front(); }
        part = *number;
        text.remove_prefix(1);
    }
    auto [year_number, month_number, day_number] = parts;
    bool day_is_guessed = false;
    if (year_number < first_year && (separator == '/' || separator == '.' || day_number >= first_year)) {
        std::tie(month_number, day_number, year_number) = std::tuple(parts[0], parts[1], parts[2]);
        if (separator == '.' || month_number > months) { std::swap(month_number, day_number); }
        day_is_guessed = separator != '.' && parts[0] <= months && parts[1] <= months && parts[0] != parts[1];
        if (year_number < 100) { year_number += 2000; }
    }
    using namespace std::chrono;
    const year_month_day date{
        year{year_number}, month{static_cast<unsigned>(month_number)}, day{static_cast<unsigned>(day_number)}};
    if (!date.ok() || year_number < first_year) { return std::nullopt; }
    return LogTime{.seconds = day_s * static_cast<double>(sys_days{date}.time_since_epoch().count()),
        .is_date = true,
        .day_is_guessed = day_is_guessed};
}

/// A text without the rest that was not taken.
std::string_view without(std::string_view text, std::string_view rest) {
    return text.substr(0, text.size() - rest.size());
}

/// True if a clock's text has a second 60.
bool is_second_60(double clock_s, std::string_view text) {
    constexpr double minute_s = 60.0;
    const std::size_t last = text.rfind(':');
    return last != text.npos && text.substr(last + 1).starts_with("60") && std::fmod(clock_s, minute_s) < 1.0;
}

} // namespace

std::optional<double> zone_offset_s(std::string_view text) {
    while (text.starts_with(' ')) { text.remove_prefix(1); }
    if (text.empty() || text == "Z" || text == "UTC" || text == "GMT") { return 0.0; }
    if (text.front() != '+' && text.front() != '-') { return std::nullopt; }
    std::string digits(text.substr(1));
    std::erase(digits, ':');
    const auto number = whole_number(digits);
    constexpr std::size_t hours_only = 2;
    constexpr std::size_t with_minutes = 4;
    if (!number || *number < 0 || (digits.size() != hours_only && digits.size() != with_minutes)) {
        return std::nullopt;
    }
    constexpr long in_an_hour = 100;
    const long hours = digits.size() == with_minutes ? *number / in_an_hour : *number;
    const long minutes = digits.size() == with_minutes ? *number % in_an_hour : 0;
    const double size_s = 3600.0 * static_cast<double>(hours) + 60.0 * static_cast<double>(minutes);
    return text.front() == '-' ? -size_s : size_s;
}

std::optional<LogTime> log_date(std::string_view text) {
    constexpr std::size_t compact = 8;
    std::string whole(text);
    if (whole.size() == compact && std::ranges::all_of(whole, is_digit)) {
        whole = whole.substr(0, 4) + "-" + whole.substr(4, 2) + "-" + whole.substr(6, 2);
    }
    whole += 'T';
    std::string_view rest = whole;
    const auto date = taken_date(rest);
    return rest.empty() ? date : std::nullopt;
}

std::optional<LogTime> log_time(std::string_view text) {
    if (const auto number = finite_number(text)) { return LogTime{.seconds = *number}; }
    std::string_view rest = text;
    if (const auto clock_s = taken_clock(rest); clock_s && zone_offset_s(rest)) {
        return LogTime{
            .seconds = *clock_s, .is_time_of_day = true, .is_leap_second = is_second_60(*clock_s, without(text, rest))};
    }
    rest = text;
    auto moment = taken_date(rest);
    if (!moment) { return std::nullopt; }
    const auto clock_s = taken_clock(rest);
    const auto zone_s = zone_offset_s(rest);
    if (!clock_s || !zone_s) { return std::nullopt; }
    moment->seconds += *clock_s - *zone_s;
    moment->is_leap_second = is_second_60(*clock_s, without(text, rest));
    return moment;
}

namespace {

struct KnownLog {
    LogQuantity what;
    std::string_view name;
};

/// Names in lower case without blanks and underscores. If a log has several names of one quantity, the first in this
/// table is used.
constexpr std::array known_names{
    KnownLog{LogQuantity::Time, "lastposupdate"},
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
    KnownLog{LogQuantity::Time, "timeposition"},
    KnownLog{LogQuantity::Time, "gpstime"},
    KnownLog{LogQuantity::Time, "secs"},
    KnownLog{LogQuantity::Time, "simtime"},
    KnownLog{LogQuantity::Clock, "datetime"},
    KnownLog{LogQuantity::Clock, "utc"},
    KnownLog{LogQuantity::Clock, "timeutc"},
    KnownLog{LogQuantity::Clock, "utctime"},
    KnownLog{LogQuantity::Date, "lcldate"},
    KnownLog{LogQuantity::Date, "date"},
    KnownLog{LogQuantity::Date, "utcdate"},
    KnownLog{LogQuantity::Date, "gpsdate"},
    KnownLog{LogQuantity::UtcOffset, "utcofst"},
    KnownLog{LogQuantity::UtcOffset, "utcoffset"},
    KnownLog{LogQuantity::Latitude, "latitude"},
    KnownLog{LogQuantity::Latitude, "lat"},
    KnownLog{LogQuantity::Latitude, "gpslatitude"},
    KnownLog{LogQuantity::Longitude, "longitude"},
    KnownLog{LogQuantity::Longitude, "lon"},
    KnownLog{LogQuantity::Longitude, "lng"},
    KnownLog{LogQuantity::Longitude, "long"},
    KnownLog{LogQuantity::Longitude, "gpslongitude"},
    KnownLog{LogQuantity::NorthSouth, "n/s"},
    KnownLog{LogQuantity::EastWest, "e/w"},
    KnownLog{LogQuantity::Position, "position"},
    KnownLog{LogQuantity::Latitude, "latitudedeg"},
    KnownLog{LogQuantity::Longitude, "longitudedeg"},
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
    KnownLog{LogQuantity::Altitude, "elevation"},
    KnownLog{LogQuantity::Altitude, "ele"},
    KnownLog{LogQuantity::Altitude, "height"},
    KnownLog{LogQuantity::Altitude, "altitudegps"},
    KnownLog{LogQuantity::Altitude, "altgps"},
    KnownLog{LogQuantity::Altitude, "altgeom"},
    KnownLog{LogQuantity::PressureAltitude, "baroaltitude"},
    KnownLog{LogQuantity::PressureAltitude, "altbaro"},
    KnownLog{LogQuantity::PressureAltitude, "pressurealtitude"},
    KnownLog{LogQuantity::PressureAltitude, "pressalt"},
    KnownLog{LogQuantity::Roll, "roll"},
    KnownLog{LogQuantity::Roll, "bank"},
    KnownLog{LogQuantity::Roll, "rollangle"},
    KnownLog{LogQuantity::Pitch, "pitch"},
    KnownLog{LogQuantity::Pitch, "pitchangle"},
    KnownLog{LogQuantity::Heading, "trueheading"},
    KnownLog{LogQuantity::Heading, "headingtrue"},
    KnownLog{LogQuantity::Heading, "hdingtrue"},
    KnownLog{LogQuantity::Heading, "heading"},
    KnownLog{LogQuantity::Heading, "yaw"},
    KnownLog{LogQuantity::MagneticHeading, "hdg"},
    KnownLog{LogQuantity::MagneticHeading, "magneticheading"},
    KnownLog{LogQuantity::MagneticHeading, "headingmagnetic"},
    KnownLog{LogQuantity::MagneticHeading, "magheading"},
    KnownLog{LogQuantity::Track, "track"},
    KnownLog{LogQuantity::Track, "truetrack"},
    KnownLog{LogQuantity::Track, "direction"},
    KnownLog{LogQuantity::Track, "course"},
    KnownLog{LogQuantity::Track, "groundtrack"},
    KnownLog{LogQuantity::Track, "gpsgroundtrack"},
    KnownLog{LogQuantity::GroundSpeed, "groundspeed"},
    KnownLog{LogQuantity::GroundSpeed, "gndspd"},
    KnownLog{LogQuantity::GroundSpeed, "gpsgroundspeed"},
    KnownLog{LogQuantity::GroundSpeed, "gs"},
    KnownLog{LogQuantity::GroundSpeed, "velocity"},
    KnownLog{LogQuantity::GroundSpeed, "speed"},
    KnownLog{LogQuantity::GroundSpeed, "gpsspeed"},
    KnownLog{LogQuantity::Climb, "vertrate"},
    KnownLog{LogQuantity::Climb, "verticalrate"},
    KnownLog{LogQuantity::Climb, "verticalspeed"},
    KnownLog{LogQuantity::Climb, "vspd"},
    KnownLog{LogQuantity::Climb, "baroverticalspeed"},
    KnownLog{LogQuantity::TrueAirspeed, "tas"},
    KnownLog{LogQuantity::TrueAirspeed, "trueairspeed"},
    KnownLog{LogQuantity::NorthSpeed, "veln"},
    KnownLog{LogQuantity::EastSpeed, "vele"},
    KnownLog{LogQuantity::DownSpeed, "veld"},
    KnownLog{LogQuantity::LoadFactor, "normg"},
    KnownLog{LogQuantity::LoadFactor, "loadfactor"},
    KnownLog{LogQuantity::HorizontalError, "hacc"},
    KnownLog{LogQuantity::VerticalError, "vacc"},
    KnownLog{LogQuantity::OnGround, "onground"},
    KnownLog{LogQuantity::OnGround, "isonground"},
    KnownLog{LogQuantity::Id, "icao24"},
    KnownLog{LogQuantity::Id, "icao"},
    KnownLog{LogQuantity::Id, "icaoaddress"},
    KnownLog{LogQuantity::Id, "hexident"},
    KnownLog{LogQuantity::Id, "hex"},
    KnownLog{LogQuantity::Id, "modes"},
    KnownLog{LogQuantity::Id, "flightid"},
    KnownLog{LogQuantity::Id, "aircraftid"},
    KnownLog{LogQuantity::Id, "objectid"},
    KnownLog{LogQuantity::Id, "trackid"},
    KnownLog{LogQuantity::CallSign, "callsign"},
    KnownLog{LogQuantity::CallSign, "flight"},
    KnownLog{LogQuantity::CallSign, "flightnumber"},
};

struct LogUnit {
    std::string_view name;
    double factor;
};

const std::array known_units{
    LogUnit{"ft", m_from_ft(1.0)},
    LogUnit{"feet", m_from_ft(1.0)},
    LogUnit{"ftmsl", m_from_ft(1.0)},
    LogUnit{"m", 1.0},
    LogUnit{"meters", 1.0},
    LogUnit{"metres", 1.0},
    LogUnit{"meter", 1.0},
    LogUnit{"metre", 1.0},
    LogUnit{"km", 1000.0},
    LogUnit{"m/s", 1.0},
    LogUnit{"mps", 1.0},
    LogUnit{"ms", 1e-3},
    LogUnit{"kt", mps_from_kt(1.0)},
    LogUnit{"kts", mps_from_kt(1.0)},
    LogUnit{"knots", mps_from_kt(1.0)},
    LogUnit{"km/h", 1.0 / 3.6},
    LogUnit{"kmh", 1.0 / 3.6},
    LogUnit{"kph", 1.0 / 3.6},
    LogUnit{"mph", 0.44704},
    LogUnit{"ft/min", m_from_ft(1.0) / 60.0},
    LogUnit{"fpm", m_from_ft(1.0) / 60.0},
    LogUnit{"ft/s", m_from_ft(1.0)},
    LogUnit{"fps", m_from_ft(1.0)},
    LogUnit{"g", 1.0},
    LogUnit{"deg", 1.0},
    LogUnit{"degrees", 1.0},
    LogUnit{"rad", deg_from_rad(1.0)},
    LogUnit{"radians", deg_from_rad(1.0)},
    LogUnit{"s", 1.0},
    LogUnit{"sec", 1.0},
    LogUnit{"seconds", 1.0},
    LogUnit{"millisecond", 1e-3},
    LogUnit{"milliseconds", 1e-3},
    LogUnit{"us", 1e-6},
};

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

LogName log_name(std::string_view text) {
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

bool is_flightradar(const std::vector<LogName>& names) {
    return std::ranges::any_of(
        names, [](const LogName& name) { return name.plain == "position" || name.plain == "networktime"; });
}

HeightKind kind_of(const std::string& name) {
    if (name == "geoaltitude" || name == "altgeom") { return HeightKind::Ellipsoid; }
    for (const char* sea : {"sea", "msl", "asl", "gps"}) {
        if (name.find(sea) != name.npos) { return HeightKind::Sea; }
    }
    return HeightKind::Unknown;
}

} // namespace

std::optional<LogColumns> log_columns(
    const std::vector<std::string_view>& names, const std::vector<std::string_view>& units) {
    std::vector<LogName> plain;
    std::ranges::transform(names, std::back_inserter(plain), log_name);
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
    if (!columns[LogQuantity::Time] || !has_place) { return std::nullopt; }
    const bool is_of_flightradar = is_flightradar(plain);
    auto& altitude = columns.of[static_cast<std::size_t>(LogQuantity::Altitude)];
    if (altitude && !altitude->has_unit && is_of_flightradar) {
        altitude->factor = m_from_ft(1.0);
        altitude->has_unit = true;
    }
    auto& climb = columns.of[static_cast<std::size_t>(LogQuantity::Climb)];
    if (climb && !climb->has_unit && plain[climb->field].plain != "vertrate") { climb.reset(); }
    // What Flightradar24 calls direction, and OpenSky heading, is the way over the ground.
    if (columns[LogQuantity::Id] && !columns[LogQuantity::Roll] && columns[LogQuantity::Heading]) {
        std::swap(columns.of[static_cast<std::size_t>(LogQuantity::Heading)],
            columns.of[static_cast<std::size_t>(LogQuantity::Track)]);
    }
    if (altitude) {
        columns.heights = is_of_flightradar ? HeightKind::Pressure : kind_of(plain[altitude->field].plain);
    }
    return columns;
}

} // namespace octant::flightpaths
