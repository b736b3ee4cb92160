#include "flightpaths/log_columns.h"

#include "sim/base/units.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace octant::flightpaths {

namespace {

struct KnownLog {
    LogQuantity what;
    std::string_view name;
};

/// Names in small letters without blanks and underscores. Of several that a log has, the first one here is taken.
/// Headings by a compass (G1000's HDG) are left out: they are not true ones.
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
