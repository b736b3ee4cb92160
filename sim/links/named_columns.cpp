#include "sim/links/named_columns.h"

#include "sim/base/column_reader.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace octant::sim::links {

namespace {

enum Quantity : std::size_t {
    Time,
    Latitude,
    Longitude,
    North,
    East,
    Altitude,
    AboveGround,
    Roll,
    Pitch,
    Yaw,
    NorthSpeed,
    EastSpeed,
    UpSpeed,
    Id
};

constexpr std::array<std::string_view, 14> quantity_names{"t_s", "lat_deg", "lon_deg", "north_m", "east_m", "alt_m",
    "agl_m", "roll_deg", "pitch_deg", "yaw_deg", "v_north_mps", "v_east_mps", "v_up_mps", "id"};

} // namespace

DecodeResult NamedColumns::take_names(std::string_view line) {
    const auto size = static_cast<std::uint32_t>(line.size());
    separator_ = separator_of(line);
    const std::vector<std::string_view> names = table_fields(line, separator_);
    for (std::size_t i = 0; i < quantities; ++i) { fields_[i] = field_named(names, quantity_names[i]); }
    count_ = names.size();
    const bool placed = (has(Latitude) && has(Longitude)) || (has(North) && has(East));
    named_ = placed && has(Altitude);
    return {named_ ? PacketError::Unused : PacketError::NotOurs, static_cast<std::uint32_t>(count_), size};
}

Fix NamedColumns::fix_of(const std::array<double, quantities>& values) const {
    Fix fix;
    fix.altitude_m = values[Altitude];
    if (has(Latitude) && has(Longitude)) {
        fix.latitude_deg = values[Latitude];
        fix.longitude_deg = values[Longitude];
    } else {
        fix.local_m = glm::dvec2(values[East], values[North]);
    }
    fix.attitude = {rad_from_deg(values[Yaw]), rad_from_deg(values[Pitch]), rad_from_deg(values[Roll])};
    if (has(Time)) { fix.sent_s = values[Time]; }
    if (has(AboveGround)) { fix.above_ground_m = values[AboveGround]; }
    if (has(NorthSpeed) && has(EastSpeed) && has(UpSpeed)) {
        fix.velocity_ned_mps = glm::dvec3(values[NorthSpeed], values[EastSpeed], -values[UpSpeed]);
    }
    constexpr double max_id = 1e9;
    fix.vehicle = static_cast<std::uint64_t>(std::clamp(values[Id], 0.0, max_id));
    return fix;
}

DecodeResult NamedColumns::take(Bytes line, Fix& fix) {
    const auto size = static_cast<std::uint32_t>(line.size());
    if (line.size() > longest_line) { return {PacketError::WrongSize, size, size}; }
    const std::string text(reinterpret_cast<const char*>(line.data()), line.size()); // NOLINT
    const auto fields = table_fields(text, separator_);
    if (!named_ || fields.empty() || !finite_number(fields.front())) { return take_names(text); }
    if (fields.size() != count_) {
        return {PacketError::WrongVersion, static_cast<std::uint32_t>(fields.size()), size};
    }
    std::array<double, quantities> values{};
    for (std::size_t quantity = 0; quantity < quantities; ++quantity) {
        if (!has(quantity)) { continue; }
        const auto value = finite_number(fields[*fields_[quantity]]);
        if (!value) { return {PacketError::NotFinite, static_cast<std::uint32_t>(*fields_[quantity] + 1), size}; }
        values[quantity] = *value;
    }
    fix = fix_of(values);
    return {error_of_fix(fix), 0, size};
}

std::string NamedColumns::text_of(const DecodeResult& result) {
    switch (result.fault) {
    case PacketError::None:
        return "lines of named columns: fine";
    case PacketError::Unused:
        return fmt::format("{} named columns", result.got);
    case PacketError::NotOurs:
        return "expected a line of names with alt_m and lat_deg,lon_deg or north_m,east_m, got "
               "another line";
    case PacketError::WrongSize:
        return fmt::format("expected a line of at most {} bytes, got more", longest_line);
    case PacketError::WrongVersion:
        return fmt::format("expected as many fields as there are names, got {} fields", result.got);
    case PacketError::NotFinite:
        return fmt::format("expected a number in field {}, got none", result.got);
    default:
        return "expected an aircraft near the earth, got none";
    }
}

} // namespace octant::sim::links
