#include "models/polygons/obj_pivots.h"

#include "models/polygons/obj_line_reader.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace octant::models::polygons {

namespace {

constexpr double seconds_per_minute = 60.0;

/// The number of turns a minute that becomes exactly this rate when it is read again, if there is one.
double rpm_of(double turns_per_s) {
    const double rpm = turns_per_s * seconds_per_minute;
    for (const double towards : {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}) {
        const double beside = std::nextafter(rpm, towards);
        if (rpm / seconds_per_minute != turns_per_s && beside / seconds_per_minute == turns_per_s) { return beside; }
    }
    return rpm;
}

} // namespace

std::optional<PivotLine> pivot_line(
    std::string_view comment, const FileAxes& axes, const std::filesystem::path& path, int line) {
    const auto words = split_words(comment);
    const bool pivot =
        words.size() > 2 && words[0] == "#" && words[1] == "pivot" && std::ranges::find(words, "axis") != words.end();
    if (!pivot) { return std::nullopt; }
    const auto refuse = [&](std::string_view expected) {
        throw_error_at(path, line, fmt::format("expected {}, got '{}'", expected, printable(std::string(comment))));
    };
    const bool has_rate = words.size() == 12 && words[10] == "rpm";
    if ((words.size() != 10 && !has_rate) || words[6] != "axis") { refuse("# pivot NAME X Y Z axis AX AY AZ [rpm N]"); }
    const auto number = [&](std::size_t word) { return obj_number(words[word], path, line); };
    PivotLine read{.part = std::string(words[2]), .pivot = {}, .line = line};
    read.pivot.point_m = axes.body_from_file({number(3), number(4), number(5)});
    const glm::dvec3 axis = axes.body_from_file({number(7), number(8), number(9)});
    const double length = glm::length(axis);
    if (length < 1e-6) { refuse("an axis with a length"); }
    // A unit vector stays as written, bit for bit.
    read.pivot.axis = std::abs(length - 1.0) < 1e-14 ? axis : axis / length;
    read.pivot.turns_per_s = has_rate ? number(11) / seconds_per_minute : 0.0;
    return read;
}

std::string pivot_text(const Pivot& pivot, std::string_view part, const FileAxes& axes) {
    const glm::dvec3 point = axes.file_from_body(pivot.point_m);
    const glm::dvec3 axis = axes.file_from_body(pivot.axis);
    std::string text =
        fmt::format("# pivot {} {} {} {} axis {} {} {}", part, point.x, point.y, point.z, axis.x, axis.y, axis.z);
    if (pivot.turns_per_s != 0.0) { text += fmt::format(" rpm {}", rpm_of(pivot.turns_per_s)); }
    return text + '\n';
}

} // namespace octant::models::polygons
