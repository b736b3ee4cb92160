#include "flightpaths/path_script.h"

#include "flightpaths/toml_fields.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <sstream>
#include <utility>

namespace octant::flightpaths {

namespace {

/// By LegKind.
constexpr std::array<std::string_view, 8> kind_words{
    "straight", "hold", "climb", "dive", "turn", "jink", "pull", "push"};
constexpr std::array<std::string_view, 2> side_words{"left", "right"};

// Bounds keep numbers sane; what an aircraft can fly is judged later, against its limits.
constexpr NumberRange distance_m{-1e6, 1e6};
constexpr NumberRange height_m{-1000.0, 40000.0};
constexpr NumberRange speed_mps{1.0, 1500.0};
constexpr NumberRange load_factor_g{-20.0, 20.0};
constexpr NumberRange period_s{0.5, 600.0};
constexpr NumberRange weave_range_g{0.0, 20.0};
constexpr double steepest_rad = rad_from_deg(80.0);
constexpr NumberRange climb_rad{-steepest_rad, steepest_rad};
constexpr NumberRange slope_rad{0.0, steepest_rad};
constexpr double max_script_s = 7200.0;
constexpr NumberRange duration_s{0.05, max_script_s};

void need_one_end(const TomlFields& fields, bool first, bool second, std::string_view both) {
    if (first == second) {
        fields.refuse(fields.line(), fmt::format("expected either {}, got {}", both, first ? "both" : "neither"));
    }
}

void read_slope(TomlFields& fields, Leg& leg) {
    const bool down = leg.kind == LegKind::Dive;
    const double angle = fields.required_number(word_of(leg.kind), "rad", slope_rad);
    leg.climb_rad = down ? -angle : angle;
    leg.duration_s = fields.number("duration", "s", duration_s);
    leg.to_height_m = fields.number("to_height", "m", height_m);
    need_one_end(fields, leg.duration_s.has_value(), leg.to_height_m.has_value(), "duration_s or to_height_m (or _ft)");
}

void read_turn(TomlFields& fields, Leg& leg) {
    leg.to_the_left = fields.required_word("side", side_words) == 0;
    leg.bank_rad = fields.number("bank", "rad", {rad_from_deg(1.0), rad_from_deg(85.0)});
    leg.load_factor = fields.number("load_factor", "g", {1.001, load_factor_g.max});
    need_one_end(fields, leg.bank_rad.has_value(), leg.load_factor.has_value(), "bank_deg or load_factor_g");
    leg.climb_rad = fields.number("climb", "rad", climb_rad).value_or(0.0);
    leg.duration_s = fields.number("duration", "s", duration_s);
    leg.heading_change_rad = fields.number("heading_change", "rad", {rad_from_deg(1.0), rad_from_deg(3600.0)});
    need_one_end(
        fields, leg.duration_s.has_value(), leg.heading_change_rad.has_value(), "duration_s or heading_change_deg");
}

void read_jink(TomlFields& fields, Leg& leg) {
    leg.lateral_g = fields.required_number("lateral", "g", weave_range_g);
    leg.period_s = fields.required_number("period", "s", period_s);
    leg.duration_s = fields.required_number("duration", "s", duration_s);
    const auto vertical_g = fields.number("vertical", "g", weave_range_g);
    const auto vertical_period_s = fields.number("vertical_period", "s", period_s);
    if (vertical_g.has_value() != vertical_period_s.has_value()) {
        fields.refuse(fields.line(), "expected vertical_g and vertical_period_s together, got one of them");
    }
    leg.vertical_g = vertical_g.value_or(0.0);
    leg.vertical_period_s = vertical_period_s.value_or(1.0);
}

void read_pull(TomlFields& fields, Leg& leg) {
    const bool pull = leg.kind == LegKind::Pull;
    const NumberRange bounds = pull ? NumberRange{1.01, load_factor_g.max} : NumberRange{load_factor_g.min, 0.99};
    leg.load_factor = fields.required_number("load_factor", "g", bounds);
    leg.climb_rad = fields.required_number("to_climb", "rad", climb_rad);
    leg.bank_rad = fields.number("bank", "rad", {-pi, pi}).value_or(0.0);
}

Leg read_leg(const std::filesystem::path& file, const toml::table& table) {
    TomlFields fields(file, table);
    Leg leg;
    leg.line = fields.line();
    leg.kind = static_cast<LegKind>(fields.required_word("fly", kind_words));
    leg.label = fields.text("label").value_or("");
    leg.acceleration_mps2 = fields.number("acceleration", "mps2", {-50.0, 50.0}).value_or(0.0);
    leg.to_speed_mps = fields.number("to_speed", "mps", speed_mps);
    leg.roll_rate_radps = fields.number("roll_rate", "radps", {rad_from_deg(1.0), rad_from_deg(720.0)});
    if (leg.to_speed_mps && leg.acceleration_mps2 == 0.0) {
        fields.refuse(fields.line(), "expected acceleration_mps2 beside to_speed_mps, got none");
    }
    switch (leg.kind) {
    case LegKind::Straight:
    case LegKind::Hold:
        leg.duration_s = fields.required_number("duration", "s", duration_s);
        break;
    case LegKind::Climb:
    case LegKind::Dive:
        read_slope(fields, leg);
        break;
    case LegKind::Turn:
        read_turn(fields, leg);
        break;
    case LegKind::Jink:
        read_jink(fields, leg);
        break;
    case LegKind::Pull:
    case LegKind::Push:
        read_pull(fields, leg);
        break;
    }
    fields.finish();
    return leg;
}

void read_start(const std::filesystem::path& file, const toml::table& table, PathScript& script) {
    TomlFields fields(file, table);
    script.start_line = fields.line();
    script.north_m = fields.required_number("north", "m", distance_m);
    script.east_m = fields.required_number("east", "m", distance_m);
    script.height_m = fields.required_number("height", "m", height_m);
    script.heading_rad = fields.required_number("heading", "rad", {-2.0 * pi, 2.0 * pi});
    script.speed_mps = fields.required_number("speed", "mps", speed_mps);
    fields.finish();
}

toml::table parsed(const std::filesystem::path& file) {
    const std::string text = read_text_file(file, std::size_t{1} << 20);
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
        throw_error_at(file, 1, "expected a flight path, got an empty file");
    }
    return parse_toml(file, text);
}

} // namespace

std::string_view word_of(LegKind kind) { return kind_words[static_cast<std::size_t>(kind)]; }

PathScript read_path_script(const std::filesystem::path& file) {
    const toml::table root = parsed(file);
    TomlFields fields(file, root);
    PathScript script;
    script.file = file;
    script.aircraft = fields.required_text("aircraft");
    script.aircraft_line = line_of(*root.get("aircraft"));
    script.title = fields.required_text("title");
    script.rate_hz = fields.required_integer("rate_hz", 1, sim::steps_per_second);
    if (sim::steps_per_second % script.rate_hz != 0) {
        fields.refuse(line_of(*root.get("rate_hz")),
            fmt::format("expected a rate_hz that divides {}, got {}", sim::steps_per_second, script.rate_hz));
    }
    script.samples = fields.required_integer("samples", 2, 200000);
    const double flown_s = static_cast<double>(script.samples - 1) / script.rate_hz;
    if (flown_s > max_script_s) {
        fields.refuse(line_of(*root.get("samples")),
            fmt::format("expected samples for at most {:.0f} s, got {:.0f} s", max_script_s, flown_s));
    }
    script.min_clearance_m = fields.required_number("min_clearance", "m", {1.0, 40000.0});
    script.angle_of_attack_rad_per_g =
        fields.number("angle_of_attack", "rad_per_g", {0.0, rad_from_deg(5.0)}).value_or(0.0);
    read_start(file, fields.required_table("start"), script);
    for (const toml::node& leg : fields.required_tables("leg")) {
        script.legs.push_back(read_leg(file, *leg.as_table()));
    }
    fields.finish();
    return script;
}

} // namespace octant::flightpaths
