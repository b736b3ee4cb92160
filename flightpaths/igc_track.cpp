#include "flightpaths/fix_table.h"
#include "flightpaths/log_columns.h"
#include "flightpaths/track_readers.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

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

struct IgcFix {
    bool is_sound = false;
    double clock_s = 0.0;
    bool is_leap_second = false;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    std::optional<int> receiver_m;
    std::optional<int> pressure_m;
};

IgcFix igc_fix_of(std::string_view record) {
    IgcFix fix;
    if (!record.starts_with('B') || record.size() < fix_length) { return fix; }
    const auto latitude_deg = angle_deg(record, 7, 2, "NS");
    const auto longitude_deg = angle_deg(record, 15, 3, "EW");
    if (!latitude_deg || !longitude_deg || !integer_at(record, 1, 6)) { return fix; }
    const auto clock = log_time(fmt::format("{}:{}:{}", record.substr(1, 2), record.substr(3, 2), record.substr(5, 2)));
    if (!clock) { return fix; }
    fix.is_sound = true;
    fix.clock_s = clock->seconds;
    fix.is_leap_second = clock->is_leap_second;
    fix.latitude_deg = *latitude_deg;
    fix.longitude_deg = *longitude_deg;
    fix.pressure_m = integer_at(record, 25, 5);
    const auto receiver_m = integer_at(record, 30, 5);
    if (record[24] == 'A' && receiver_m && *receiver_m != 0) { fix.receiver_m = receiver_m; }
    return fix;
}

/// The day of a date record (HFDTE150619, HFDTEDATE:150619,01) in seconds since 1970.
std::optional<double> day_of(std::string_view record) {
    if (!record.starts_with("HFDTE") && !record.starts_with("HODTE") && !record.starts_with("HPDTE")) {
        return std::nullopt;
    }
    const std::size_t at = record.find_first_of("0123456789");
    if (at == record.npos || record.size() < at + 6) { return std::nullopt; }
    const auto day =
        log_date(fmt::format("20{}-{}-{}", record.substr(at + 4, 2), record.substr(at + 2, 2), record.substr(at, 2)));
    return day ? std::optional(day->seconds) : std::nullopt;
}

} // namespace

bool is_igc(std::string_view text) {
    bool has_head = false;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = rest.find('\n');
        std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
        if (line.ends_with('\r')) { line.remove_suffix(1); }
        if (split_words(line).empty()) { continue; }
        if (!has_head) {
            has_head = (line.front() == 'A' || line.front() == 'H') && line.find(',') == line.npos;
            if (!has_head) { return false; }
        }
        if (igc_fix_of(line).is_sound) { return true; }
    }
    return false;
}

TrackRecording igc_recording(const TrackSource& source) {
    const auto lines = split_lines(source.bytes);
    std::vector<std::pair<int, IgcFix>> records;
    std::optional<double> day_s;
    FixTable fixes("IGC", source.file);
    FixSeries& series = fixes.series("");
    series.type = "Air+Glider"; // or a paraglider; powered aircraft have such recorders seldom, rotorcraft do not
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].starts_with('B')) { records.emplace_back(static_cast<int>(i) + 1, igc_fix_of(lines[i])); }
        if (!day_s) { day_s = day_of(lines[i]); }
        constexpr std::string_view glider = "HFGTYGLIDERTYPE:";
        if (lines[i].starts_with(glider)) { series.name = split_fields(lines[i].substr(glider.size()), '\n').front(); }
        constexpr std::string_view competition = "HFCIDCOMPETITIONID:";
        if (lines[i].starts_with(competition)) {
            series.call_sign = split_fields(lines[i].substr(competition.size()), '\n').front();
        }
    }
    const auto with_receiver =
        std::ranges::count_if(records, [](const auto& record) { return record.second.receiver_m.has_value(); });
    const bool by_receiver = 2 * static_cast<std::size_t>(with_receiver) > records.size();
    fixes.time_scale = TimeScale::TimeOfDay;
    fixes.first_day_s = day_s;
    fixes.heights = by_receiver ? HeightKind::Ellipsoid : HeightKind::Pressure;
    if (!by_receiver) { fixes.add_note("heights are pressure altitudes: few fixes have one of the receiver"); }
    for (const auto& [line, record] : records) {
        const std::optional<int>& height_m = by_receiver ? record.receiver_m : record.pressure_m;
        if (!record.is_sound || !height_m) {
            fixes.skip_row();
            continue;
        }
        Fix fix;
        fix.line = line;
        fix.time_s = record.clock_s;
        fix.is_leap_second = record.is_leap_second;
        fix.latitude_deg = record.latitude_deg;
        fix.longitude_deg = record.longitude_deg;
        fix.altitude_m = *height_m;
        if (by_receiver && record.pressure_m) { fix.pressure_height_m = static_cast<float>(*record.pressure_m); }
        fixes.add(series, fix);
    }
    return std::move(fixes).recording(source.follow);
}

} // namespace octant::flightpaths
