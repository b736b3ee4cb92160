#include "flightpaths/track_columns.h"

#include "flightpaths/track_fields.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <span>
#include <vector>

namespace octant::flightpaths {

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

// The geodetic latitude stands first: it is taken where both are there.
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

/// Whether a column of each quantity up to the altitude is among the names.
bool has_place(std::span<const Known> columns, const std::vector<std::string_view>& names) {
    std::array<bool, QuantityCount> has{};
    for (const Known& known : columns) { has[known.quantity] = has[known.quantity] || is_among(known.name, names); }
    return has[Time] && has[North] && has[East] && has[Altitude];
}

/// Whether names are of these columns, as far as they go: the time and one more.
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

} // namespace octant::flightpaths
