#include "flightpaths/limits_check.h"

#include "flightpaths/manoeuvre.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace octant::flightpaths {

namespace {

/// Slack for limits that a leg asks for exactly, relative.
constexpr double slack = 1e-9;

/// The number with one or two decimals.
std::string short_number(double value) {
    std::string text = fmt::format("{:.2f}", value);
    return text.back() == '0' ? text.substr(0, text.size() - 1) : text;
}

struct Peaks {
    double bank_rad = 0.0;
    double roll_rate_radps = 0.0;
    double max_load_factor = 1.0;
    double min_load_factor = 1.0;
    double load_factor_rate_gps = 0.0;
};

Peaks peaks_of(const Leg& weave) {
    Peaks peaks;
    const long steps = sim::step_at(weave.duration_s.value_or(0.0));
    for (long step = 0; step <= steps; ++step) {
        const ManoeuvreTarget aim = weave_target(weave, sim::time_of_step(step), 0.0);
        peaks.bank_rad = std::max(peaks.bank_rad, std::abs(aim.bank_rad));
        peaks.roll_rate_radps = std::max(peaks.roll_rate_radps, std::abs(aim.bank_rate_radps));
        peaks.max_load_factor = std::max(peaks.max_load_factor, aim.load_factor);
        peaks.min_load_factor = std::min(peaks.min_load_factor, aim.load_factor);
        peaks.load_factor_rate_gps = std::max(peaks.load_factor_rate_gps, std::abs(aim.load_factor_rate_gps));
    }
    return peaks;
}

} // namespace

LimitsCheck::LimitsCheck(
    const PathScript& script, const sim::AircraftKind& kind, bool lenient, std::vector<std::string>& notes)
    : script_(script), kind_(kind), limits_(kind.limits), lenient_(lenient), notes_(notes) {}

double LimitsCheck::at_most(double value, double limit, const Subject& subject) const {
    const bool within = value <= limit + slack * std::abs(limit);
    return within ? value : clipped(value, limit, "most", subject);
}

double LimitsCheck::at_least(double value, double limit, const Subject& subject) const {
    const bool within = value >= limit - slack * std::abs(limit);
    return within ? value : clipped(value, limit, "least", subject);
}

double LimitsCheck::clipped(double value, double limit, const char* which, const Subject& subject) const {
    if (!lenient_) {
        throw_error_at(script_.file, subject.line,
            fmt::format("expected a {} of at {} {}{} for {}, got {}", subject.what, which, short_number(limit),
                subject.unit, kind_.name, short_number(value)));
    }
    notes_.push_back(fmt::format("{}:{}: {} of {}{} clipped to {}, the {} for {}", script_.file.string(), subject.line,
        subject.what, short_number(value), subject.unit, short_number(limit), which, kind_.name));
    return limit;
}

Leg LimitsCheck::checked(const Leg& leg) const {
    Leg flown = leg;
    if (flown.roll_rate_radps) {
        const double limit = deg_from_rad(limits_.roll_rate_radps);
        flown.roll_rate_radps =
            rad_from_deg(at_most(deg_from_rad(*flown.roll_rate_radps), limit, {leg.line, "roll rate", " deg/s"}));
    }
    const double acceleration =
        at_most(std::abs(leg.acceleration_mps2), limits_.acceleration_mps2, {leg.line, "change of speed", " m/s2"});
    flown.acceleration_mps2 = std::copysign(acceleration, leg.acceleration_mps2);
    if (flown.to_speed_mps) {
        const LimitsCheck::Subject speed{leg.line, "speed", " m/s"};
        flown.to_speed_mps =
            at_least(at_most(*flown.to_speed_mps, limits_.max_speed_mps, speed), min_flown_speed_mps(limits_), speed);
    }
    if (flown.load_factor) {
        const LimitsCheck::Subject load{leg.line, "load factor", ""};
        flown.load_factor =
            at_least(at_most(*flown.load_factor, limits_.max_load_factor, load), limits_.min_load_factor, load);
    }
    check_turn(flown);
    if (flown.kind == LegKind::Jink) { check_weave(flown); }
    return flown;
}

void LimitsCheck::check_turn(Leg& leg) const {
    // A level turn at a load factor n banks acos(1/n), so either of the two may be the tighter one.
    const bool turn = leg.kind == LegKind::Turn;
    const double level = turn ? std::cos(leg.climb_rad.value_or(0.0)) : 1.0;
    const Subject bank{leg.line, "bank", " deg"};
    double limit = deg_from_rad(limits_.bank_rad);
    if (turn && leg.load_factor) {
        const double asked = deg_from_rad(std::acos(std::min(1.0, level / *leg.load_factor)));
        const double got = at_most(asked, limit, bank);
        if (got < asked) { leg.load_factor = level / std::cos(rad_from_deg(got)); }
        return;
    }
    if (turn) {
        const double by_load = deg_from_rad(std::acos(std::min(1.0, level / limits_.max_load_factor)));
        limit = std::min(limit, by_load);
    }
    if (leg.bank_rad) {
        const double got = at_most(deg_from_rad(std::abs(*leg.bank_rad)), limit, bank);
        leg.bank_rad = std::copysign(rad_from_deg(got), *leg.bank_rad);
    }
}

std::string LimitsCheck::weave_error(const Leg& leg) const {
    const Peaks peaks = peaks_of(leg);
    const auto fault = [&](const char* what, const char* side, double limit, double got) {
        return fmt::format("expected a weave with a {} of at {} {} for {}, got {}", what, side, short_number(limit),
            kind_.name, short_number(got));
    };
    constexpr double most = 1.0 + slack;
    if (peaks.max_load_factor > limits_.max_load_factor * most) {
        return fault("load factor", "most", limits_.max_load_factor, peaks.max_load_factor);
    }
    if (peaks.min_load_factor < limits_.min_load_factor - slack) {
        return fault("load factor", "least", limits_.min_load_factor, peaks.min_load_factor);
    }
    if (peaks.bank_rad > limits_.bank_rad * most) {
        return fault("bank in deg", "most", deg_from_rad(limits_.bank_rad), deg_from_rad(peaks.bank_rad));
    }
    const double roll_rate_radps =
        std::min(limits_.roll_rate_radps, leg.roll_rate_radps.value_or(limits_.roll_rate_radps));
    if (peaks.roll_rate_radps > roll_rate_radps * most) {
        return fault("roll rate in deg/s", "most", deg_from_rad(roll_rate_radps), deg_from_rad(peaks.roll_rate_radps));
    }
    if (peaks.load_factor_rate_gps > limits_.load_factor_rate_gps * most) {
        return fault("load factor onset in g/s", "most", limits_.load_factor_rate_gps, peaks.load_factor_rate_gps);
    }
    return {};
}

void LimitsCheck::check_weave(Leg& leg) const {
    const std::string fault = weave_error(leg);
    if (fault.empty()) { return; }
    if (!lenient_) { throw_error_at(script_.file, leg.line, fault); }
    // Both amplitudes shrink alike, to the largest whole percentage that fits.
    const auto shrunk = [&](int percent) {
        Leg smaller = leg;
        smaller.lateral_g = leg.lateral_g * percent / 100.0;
        smaller.vertical_g = leg.vertical_g * percent / 100.0;
        return smaller;
    };
    int fits = 0;
    int too_much = 100;
    while (too_much - fits > 1) {
        const int percent = (fits + too_much) / 2;
        (weave_error(shrunk(percent)).empty() ? fits : too_much) = percent;
    }
    notes_.push_back(fmt::format("{}:{}: weave clipped to {} %: {}", script_.file.string(), leg.line, fits, fault));
    leg = shrunk(fits);
}

double min_flown_speed_mps(const sim::AircraftLimits& limits) { return std::max(limits.min_speed_mps, 5.0); }

std::string limits_violation(const sim::AircraftLimits& limits, const sim::Trajectory& path, bool is_smooth) {
    constexpr double margin = 0.05; // of the limit, or of 1 where that is less
    std::vector<std::string> beyond;
    const auto check = [&](const char* what, double limit, auto value_of, double shown, bool most) {
        const double sign = most ? 1.0 : -1.0;
        double farthest = limit;
        for (const sim::AircraftState& state : path.samples()) {
            const double value = value_of(state);
            farthest = sign * (value - farthest) > 0.0 ? value : farthest;
        }
        if (sign * (farthest - limit) > margin * std::max(std::abs(limit), 1.0)) {
            beyond.push_back(fmt::format("{} {} to {:.3g} (at {} {:.3g})", what, most ? "up" : "down", shown * farthest,
                most ? "most" : "least", shown * limit));
        }
    };
    const auto speed_mps = [](const sim::AircraftState& state) { return glm::length(state.velocity_mps); };
    const auto load = [](const sim::AircraftState& state) { return state.load_factor; };
    const auto bank_rad = [](const sim::AircraftState& state) {
        return std::abs(euler_from_body_to_world(state.body_to_world).roll_rad);
    };
    const double kt = kt_from_mps(1.0);
    check("speed in kt", limits.max_speed_mps, speed_mps, kt, true);
    if (is_smooth) {
        check("speed in kt", limits.min_speed_mps, speed_mps, kt, false);
        check("load factor", limits.max_load_factor, load, 1.0, true);
        check("load factor", limits.min_load_factor, load, 1.0, false);
        check("bank in degrees", limits.bank_rad, bank_rad, deg_from_rad(1.0), true);
    }
    return fmt::format("{}", fmt::join(beyond, ", "));
}

} // namespace octant::flightpaths
