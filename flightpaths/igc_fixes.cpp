#include "flightpaths/igc_fixes.h"

#include "flightpaths/track_fields.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

namespace octant::flightpaths {

namespace {

/// A whole number that fills its columns; pressure altitudes below the datum begin with a minus.
std::optional<int> number_radius(std::string_view record, std::size_t at, std::size_t count) {
    const std::string_view text = record.substr(at, count);
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    if (!std::all_of(text.begin() + static_cast<std::ptrdiff_t>(sign), text.end(), is_digit)) {
        return std::nullopt;
    }
    int value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    return fault == std::errc() && end == text.data() + text.size() ? std::optional(value)
                                                                    : std::nullopt;
}

/// Degrees of an angle that is written as whole degrees and thousandths of minutes.
std::optional<double>
angle_deg(std::string_view record, std::size_t at, std::size_t degrees, std::string_view signs) {
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
    if (!record.starts_with('B') || record.size() < fix_length) {
        return fix;
    }
    const auto latitude_deg = angle_deg(record, 7, 2, "NS");
    const auto longitude_deg = angle_deg(record, 15, 3, "EW");
    if (!latitude_deg || !longitude_deg || !number_radius(record, 1, 6)) {
        return fix;
    }
    fix.clock = record.substr(1, 6);
    fix.latitude_deg = *latitude_deg;
    fix.longitude_deg = *longitude_deg;
    fix.pressure_m = number_radius(record, 25, 5);
    const auto receiver_m = number_radius(record, 30, 5);
    if (record[24] == 'A' && receiver_m && *receiver_m != 0) {
        fix.receiver_m = receiver_m;
    }
    return fix;
}

std::string row_of(const Fix& fix, const std::optional<int>& height_m) {
    if (fix.clock.empty()) {
        return ",,,";
    }
    return fmt::format(
        "{}:{}:{},{:.8f},{:.8f},{}",
        fix.clock.substr(0, 2),
        fix.clock.substr(2, 2),
        fix.clock.substr(4, 2),
        fix.latitude_deg,
        fix.longitude_deg,
        height_m ? fmt::format("{}", *height_m) : "");
}

} // namespace

bool is_igc(std::span<const std::string_view> lines) {
    const auto first = std::ranges::find_if(
        lines, [](std::string_view line) { return !split_words(line).empty(); });
    const bool has_head = first != lines.end() &&
                          (first->front() == 'A' || first->front() == 'H') &&
                          first->find(',') == first->npos;
    return has_head && std::ranges::any_of(lines, [](std::string_view line) {
               return !fix_of(line, 0).clock.empty();
           });
}

LogTable igc_fixes(std::span<const std::string_view> lines) {
    std::vector<Fix> fixes;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].starts_with('B')) {
            fixes.push_back(fix_of(lines[i], static_cast<int>(i) + 1));
        }
    }
    const auto with_receiver =
        std::ranges::count_if(fixes, [](const Fix& fix) { return fix.receiver_m.has_value(); });
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

} // namespace octant::flightpaths
