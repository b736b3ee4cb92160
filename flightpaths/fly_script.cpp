#include "flightpaths/fly_script.h"

#include "flightpaths/limits_check.h"
#include "flightpaths/manoeuvre.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace octant::flightpaths {

namespace {

/// How long the last leg may go on beyond its end.
constexpr double held_on_s = 1.0;
/// A pull that has not reached its angle by then never will.
constexpr double longest_pull_s = 60.0;
/// By how much a climb may pass the sustained rate before it is refused: rounding.
constexpr double climb_slack_mps = 0.05;

/// Flies the legs of a script one after the other in fixed steps and takes samples at the script's rate.
class ScriptFlyer {
public:
    ScriptFlyer(const PathScript& script, const sim::AircraftKind& kind, bool lenient)
        : script_(script), limits_(kind.limits), lenient_(lenient), check_(script, kind, lenient, notes_),
          mass_(start()) {
        for (const Leg& leg : script.legs) { legs_.push_back(check_.checked(leg)); }
    }

    FlownPath flown() {
        const long steps_a_sample = sim::steps_per_second / script_.rate_hz;
        const long last_step = (script_.samples - 1) * steps_a_sample;
        begin_leg(0, 0);
        for (long step = 0; step <= last_step; ++step) {
            if (step % steps_a_sample == 0) { samples_.push_back(sample(step)); }
            change_legs(step, last_step);
            take_step(step);
        }
        for (std::size_t leg = leg_ + 1; leg < legs_.size(); ++leg) {
            notes_.push_back(
                fmt::format("{}:{}: the last sample comes before this leg", script_.file.string(), legs_[leg].line));
        }
        return {sim::Trajectory(std::move(samples_)), std::move(notes_), std::move(begins_)};
    }

private:
    PointMass start() {
        const LimitsCheck::Subject speed{script_.start_line, "starting speed", " m/s"};
        const double speed_mps = check_.at_least(
            check_.at_most(script_.speed_mps, limits_.max_speed_mps, speed), min_flown_speed_mps(limits_), speed);
        return point_mass_at({script_.east_m, script_.north_m, script_.height_m}, speed_mps, script_.heading_rad, 0.0);
    }

    sim::AircraftState sample(long step) const {
        return {sim::time_of_step(step), mass_.position_m, velocity_mps(mass_),
            body_to_world(mass_, script_.angle_of_attack_rad_per_g * mass_.load_factor), mass_.load_factor};
    }

    double since_s(long step) const { return sim::time_of_step(step - leg_step_); }

    void begin_leg(std::size_t leg, long step) {
        leg_ = leg;
        leg_step_ = step;
        const Leg& now = legs_[leg_];
        check_height(now);
        pilot_.emplace(now, mass_, limits_);
        clipped_climb_ = false;
        clipped_speed_ = false;
        begins_.push_back({sim::time_of_step(step), now.label.empty() ? std::string(word_of(now.kind)) : now.label});
    }

    void check_height(const Leg& leg) const {
        if (!leg.to_height_m) { return; }
        const bool up = leg.kind == LegKind::Climb;
        const double here_m = mass_.position_m.z;
        if (up ? *leg.to_height_m < here_m : *leg.to_height_m > here_m) {
            throw_error_at(script_.file, leg.line,
                fmt::format("expected to_height {} the {:.1f} m where the {} begins, got {:.1f} m",
                    up ? "above" : "below", here_m, word_of(leg.kind), *leg.to_height_m));
        }
    }

    void change_legs(long step, long last_step) {
        while (pilot_->done(mass_, since_s(step))) {
            if (leg_ + 1 < legs_.size()) {
                begin_leg(leg_ + 1, step);
                continue;
            }
            if (!ended_step_) {
                ended_step_ = step;
                const double rest_s = sim::time_of_step(last_step - step);
                if (rest_s > held_on_s) {
                    throw_error_at(script_.file, legs_[leg_].line,
                        fmt::format("expected legs for {:.2f} s ({} samples), got {:.2f} s",
                            sim::time_of_step(last_step), script_.samples, sim::time_of_step(step)));
                }
            }
            return;
        }
        const Leg& leg = legs_[leg_];
        const bool pulls = leg.kind == LegKind::Pull || leg.kind == LegKind::Push;
        if (pulls && since_s(step) > longest_pull_s) {
            throw_error_at(script_.file, leg.line,
                fmt::format("expected a {} that reaches {:.1f} deg within {:.0f} s, got {:.1f} deg", word_of(leg.kind),
                    deg_from_rad(*leg.climb_rad), longest_pull_s,
                    deg_from_rad(euler_from_body_to_world(mass_.flight_to_world).pitch_rad)));
        }
    }

    void take_step(long step) {
        PointMassControls controls = pilot_->controls(mass_, since_s(step));
        controls.acceleration_mps2 = within_energy(controls.acceleration_mps2);
        controls.acceleration_mps2 = within_speeds(controls.acceleration_mps2);
        mass_ = stepped(mass_, controls, sim::step_s);
        pilot_->count_turn(mass_);
    }

    double within_energy(double acceleration_mps2) {
        const double climb_mps = velocity_mps(mass_).z;
        const double sustained_mps = climb_mps + mass_.speed_mps * acceleration_mps2 / gravity_mps2;
        const double max_mps = limits_.climb_rate_mps;
        if (sustained_mps <= max_mps + climb_slack_mps) { return acceleration_mps2; }
        if (!lenient_ || !clipped_climb_) {
            // What the leg is heading for says more than the moment that passes the limit.
            const Leg& leg = legs_[leg_];
            const double aimed_mps =
                sustained_mps - climb_mps + mass_.speed_mps * std::sin(leg.climb_rad.value_or(0.0));
            check_.at_most(std::max(sustained_mps, aimed_mps), max_mps, {leg.line, "sustained climb rate", " m/s"});
            clipped_climb_ = true;
        }
        return (max_mps - climb_mps) * gravity_mps2 / mass_.speed_mps;
    }

    double within_speeds(double acceleration_mps2) {
        const double next_mps = mass_.speed_mps + sim::step_s * acceleration_mps2;
        const double max_mps = limits_.max_speed_mps;
        const double min_mps = min_flown_speed_mps(limits_);
        const double allowed_mps = std::clamp(next_mps, min_mps, max_mps);
        if (std::abs(next_mps - allowed_mps) <= 1e-6) { return acceleration_mps2; }
        if (!lenient_ || !clipped_speed_) {
            const LimitsCheck::Subject speed{legs_[leg_].line, "speed", " m/s"};
            check_.at_least(check_.at_most(next_mps, max_mps, speed), min_mps, speed);
            clipped_speed_ = true;
        }
        return (allowed_mps - mass_.speed_mps) / sim::step_s;
    }

    const PathScript& script_;
    const sim::AircraftLimits& limits_;
    bool lenient_;
    std::vector<std::string> notes_;
    LimitsCheck check_;
    PointMass mass_;
    std::vector<Leg> legs_;
    std::size_t leg_ = 0;
    long leg_step_ = 0;
    std::optional<long> ended_step_;
    std::optional<LegPilot> pilot_;
    bool clipped_climb_ = false;
    bool clipped_speed_ = false;
    std::vector<sim::AircraftState> samples_;
    std::vector<LegStart> begins_;
};

} // namespace

FlownPath fly(const PathScript& script, const sim::AircraftKind& kind, bool lenient) {
    return ScriptFlyer(script, kind, lenient).flown();
}

} // namespace octant::flightpaths
