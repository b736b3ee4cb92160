#include "flightpaths/track_time.h"

#include "flightpaths/track_fields.h"
#include "sim/base/text_file.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

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

/// Takes "hh:mm:ss" and a fraction, which some write behind the zone's Z, off the front of a text.
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

/// Takes "yyyy-mm-dd" and what separates it from a clock off the front; its seconds since 1970.
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

/// Whether nothing but a time zone is left: Z, UTC or +01:00.
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

} // namespace octant::flightpaths
