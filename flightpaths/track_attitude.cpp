#include "flightpaths/height_envelope.h"
#include "flightpaths/track_steps.h"
#include "sim/atmosphere.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace octant::flightpaths {

namespace {

/// Above it the direction of a motion on the ground, or of a hovering one, is that of the nose.
constexpr double heading_known_mps = 1.5;
constexpr double hover_heading_mps = 2.5;

glm::dquat from_axes(const glm::dvec3& forward, const glm::dvec3& up) {
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    const glm::dvec3 above = glm::cross(right, forward);
    return glm::normalize(glm::quat_cast(glm::dmat3(forward, right, -above)));
}

/// How the nose lies to the motion through the air: linear in the lift that is asked for, n / v^2. Where a take-off or
/// a landing shows how slow it flies, the angle there is that of its class: large for heavy aircraft and jets, small
/// for light ones with their flaps. Otherwise its usual speed stands for it.
struct AngleOfAttack {
    static constexpr double most_rad = rad_from_deg(14.0);
    /// Without lift, and by how much more at 1 g and this airspeed.
    double base_rad = rad_from_deg(0.7);
    double of_lift_rad = rad_from_deg(0.8);
    double airspeed_mps = 0.0;

    /// By the equivalent airspeed that most of the flight does not exceed.
    static AngleOfAttack of_usual(double usual_mps) { return {.airspeed_mps = usual_mps}; }

    /// By the slowest at which it left the ground or came to it.
    static AngleOfAttack of_slowest(double slowest_mps) {
        constexpr double light_mps = 45.0;
        constexpr double heavy_mps = 62.0;
        const double heavy = std::clamp((slowest_mps - light_mps) / (heavy_mps - light_mps), 0.0, 1.0);
        return {.base_rad = rad_from_deg(-1.0 + 1.5 * heavy),
            .of_lift_rad = rad_from_deg(4.0 + 4.0 * heavy),
            .airspeed_mps = slowest_mps};
    }

    double rad(double load_factor, double equivalent_mps) const {
        const double ratio = airspeed_mps / std::max(equivalent_mps, 0.3 * airspeed_mps);
        const double lift = std::clamp(load_factor, -1.0, 6.0) * ratio * ratio;
        return std::clamp(base_rad + of_lift_rad * lift, -most_rad, most_rad);
    }
};

class AttitudeFinder {
public:
    AttitudeFinder(const PathKinematics& path, const PathPhases& phases, const WindEstimate& wind,
        const MeasuredAngle& headings_rad)
        : path_(path), phases_(phases), measured_headings_rad_(headings_rad), attitudes_(path.times_s.size()),
          lift_(0.0, 0.0, 1.0) {
        std::vector<double> airspeeds_mps;
        for (std::size_t i = 0; i < path.times_s.size(); ++i) {
            const glm::dvec2 drift_mps = on_ground(i) ? glm::dvec2(0.0) : wind.wind_mps(path.times_s[i]);
            through_air_mps_.push_back(path.velocities_mps[i] - glm::dvec3(drift_mps, 0.0));
            if (phases.phases[i] == TrackPhase::Flight) { airspeeds_mps.push_back(equivalent_airspeed_mps(i)); }
        }
        if (!airspeeds_mps.empty()) {
            // Of ten samples one is faster.
            const auto fast = airspeeds_mps.begin() + static_cast<std::ptrdiff_t>(airspeeds_mps.size() * 9 / 10);
            std::ranges::nth_element(airspeeds_mps, fast);
            usual_airspeed_mps_ = *fast;
        }
        const auto slowest_mps = slowest_flown_mps();
        wing_ = slowest_mps ? AngleOfAttack::of_slowest(*slowest_mps) : AngleOfAttack::of_usual(usual_airspeed_mps_);
    }

    std::vector<EulerAngles> found() && {
        find_felt();
        find_headings();
        for (std::size_t i = 0; i < attitudes_.size(); ++i) {
            if (!on_ground(i)) { attitudes_[i] = phases_.hovers ? of_rotor(i) : of_wing(i); }
        }
        blend_on_ground();
        return std::move(attitudes_);
    }

private:
    /// The airspeed at sea level that makes the same lift.
    double equivalent_airspeed_mps(std::size_t at) const {
        const double density =
            sim::standard_air(path_.positions_m[at].z).density_kgpm3 / sim::standard_air(0.0).density_kgpm3;
        return glm::length(through_air_mps_[at]) * std::sqrt(density);
    }

    /// The least equivalent airspeed of its take-offs, else of its landings; nothing where it has neither.
    std::optional<double> slowest_flown_mps() const {
        std::optional<double> lifting_mps;
        std::optional<double> landing_mps;
        constexpr double least_mps = 15.0;
        for (std::size_t i = 1; i < phases_.phases.size(); ++i) {
            const bool lifts = on_ground(i - 1) && !on_ground(i);
            if (!lifts && !(!on_ground(i - 1) && on_ground(i))) { continue; }
            const double airspeed_mps = equivalent_airspeed_mps(lifts ? i : i - 1);
            std::optional<double>& least = lifts ? lifting_mps : landing_mps;
            if (airspeed_mps > least_mps) { least = std::min(least.value_or(airspeed_mps), airspeed_mps); }
        }
        return lifting_mps ? lifting_mps : landing_mps;
    }

    bool on_ground(std::size_t at) const { return is_on_ground(phases_.phases[at]); }

    /// Of the nose, by the motion alone; nothing where it tells none.
    std::optional<double> heading_of_motion(std::size_t at) const {
        const glm::dvec2 motion_mps(through_air_mps_[at]);
        const double least_mps = on_ground(at) ? heading_known_mps : phases_.hovers ? hover_heading_mps : 0.3;
        if (phases_.phases[at] == TrackPhase::Parked || glm::length(motion_mps) < least_mps) { return std::nullopt; }
        return std::atan2(motion_mps.x, motion_mps.y);
    }

    /// Headings of the motion, held where it tells none: the last one, and towards the end of such a stretch it turns
    /// to the next.
    void find_headings() {
        std::vector<std::optional<double>> known;
        for (std::size_t i = 0; i < attitudes_.size(); ++i) { known.push_back(heading_of_motion(i)); }
        turn_pushed_back(known);
        headings_rad_.assign(attitudes_.size(), 0.0);
        std::optional<double> last_rad;
        for (std::size_t i = 0; i < known.size(); ++i) {
            if (known[i]) {
                last_rad = headings_rad_[i] = *known[i];
                continue;
            }
            std::size_t end = i;
            while (end < known.size() && !known[end]) { ++end; }
            const std::optional<double> next_rad = end < known.size() ? known[end] : last_rad;
            hold_heading({i, end}, last_rad.value_or(next_rad.value_or(0.0)), next_rad);
            i = end - 1;
        }
        for (std::size_t i = 0; i < attitudes_.size(); ++i) { attitudes_[i].heading_rad = headings_rad_[i]; }
        take_measured(path_.times_s, measured_headings_rad_, &EulerAngles::heading_rad, attitudes_);
    }

    struct Range {
        std::size_t begin = 0;
        std::size_t end = 0;
    };

    /// Where a slow short way on the ground is followed by one the other way, the aircraft was pushed back: its nose
    /// points the other way.
    void turn_pushed_back(std::vector<std::optional<double>>& headings_rad) const {
        constexpr double fastest_mps = 4.0;
        constexpr double furthest_m = 200.0;
        constexpr double least_turn_rad = rad_from_deg(100.0);
        std::optional<Range> last;
        for (std::size_t i = 0; i < headings_rad.size(); ++i) {
            if (!headings_rad[i]) { continue; }
            Range way{i, i};
            double most_mps = 0.0;
            double way_m = 0.0;
            for (; way.end < headings_rad.size() && headings_rad[way.end] && on_ground(way.end); ++way.end) {
                most_mps = std::max(most_mps, glm::length(path_.velocities_mps[way.end]));
                if (way.end > i) { way_m += glm::distance(path_.positions_m[way.end], path_.positions_m[way.end - 1]); }
            }
            if (way.end == i) { // in the air
                last.reset();
                continue;
            }
            if (last && std::abs(wrapped_to_pi(*headings_rad[i] - *headings_rad[last->end - 1])) > least_turn_rad) {
                for (std::size_t k = last->begin; k < last->end; ++k) { *headings_rad[k] += pi; }
            }
            last = most_mps < fastest_mps && way_m < furthest_m ? std::optional(way) : std::nullopt;
            i = way.end - 1;
        }
    }

    void hold_heading(const Range& range, double held_rad, const std::optional<double>& next_rad) {
        constexpr double turning_s = 4.0;
        const double turn_rad = next_rad ? wrapped_to_pi(*next_rad - held_rad) : 0.0;
        const double end_s = path_.times_s[std::min(range.end, path_.times_s.size() - 1)];
        const double begin_s = path_.times_s[range.begin > 0 ? range.begin - 1 : 0];
        const double over_s = std::max(1e-3, std::min(turning_s, end_s - begin_s));
        for (std::size_t i = range.begin; i < range.end; ++i) {
            headings_rad_[i] = held_rad + turn_rad * smooth_step(1.0 - (end_s - path_.times_s[i]) / over_s);
        }
    }

    glm::dvec3 felt_mps2(std::size_t at) const { return felt_mps2_[at]; }

    /// What is felt, each time the mean of the times around it: no aircraft tilts faster than it can, but errors of a
    /// recorder's clock and places look like it.
    void find_felt() {
        constexpr double of_wing_s = 0.3;
        constexpr double of_drone_s = 0.5;
        constexpr double of_helicopter_s = 1.0;
        const double around_s = !phases_.hovers ? of_wing_s : is_heavy_rotorcraft() ? of_helicopter_s : of_drone_s;
        const std::vector<double>& times_s = path_.times_s;
        std::size_t begin = 0;
        std::size_t end = 0;
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < times_s.size(); ++i) {
            while (end < times_s.size() && times_s[end] <= times_s[i] + around_s) {
                sum += path_.accelerations_mps2[end++];
            }
            while (times_s[begin] < times_s[i] - around_s) { sum -= path_.accelerations_mps2[begin++]; }
            felt_mps2_.push_back(sum / static_cast<double>(end - begin) + glm::dvec3(0.0, 0.0, gravity_mps2));
        }
    }

    /// Sets the direction of lift by the part of the felt acceleration that is across the motion, and returns the load
    /// factor. `kept` is the last direction, across the motion too: it stays where the wing hardly lifts, and where the
    /// aircraft is pushed over for a moment, which it is rather than rolled onto its back.
    double take_lift(const glm::dvec3& across, const glm::dvec3& kept, const glm::dvec3& ahead, double time_s) {
        constexpr double least_g = 0.05;
        constexpr double pushed_g = 1.5;
        constexpr double pushed_for_s = 4.0;
        const double felt_g = glm::length(across) / gravity_mps2;
        const bool against = glm::dot(across, kept) < 0.0;
        if (!against) { last_pulled_s_ = time_s; }
        const bool pushed = against && felt_g < pushed_g && time_s - last_pulled_s_ < pushed_for_s;
        const double load_factor = pushed ? -felt_g : felt_g;
        const double since_s = std::max(0.0, time_s - last_lift_s_);
        last_lift_s_ = time_s;
        const bool has_kept = glm::length(kept) > 1e-6;
        if (felt_g > least_g) {
            const glm::dvec3 wanted = (pushed ? -1.0 : 1.0) * glm::normalize(across);
            // Errors turn a small lift about: it is believed slowly.
            constexpr double sure_g = 0.5;
            const double ratio = felt_g / sure_g;
            const double share = ratio >= 1.0 || !has_kept ? 1.0 : std::min(1.0, 4.0 * ratio * ratio * since_s);
            const glm::dvec3 mixed = has_kept ? (1.0 - share) * glm::normalize(kept) + share * wanted : wanted;
            lift_ = glm::length(mixed) > 1e-3 ? glm::normalize(mixed) : wanted;
            return load_factor;
        }
        if (has_kept) {
            lift_ = glm::normalize(kept);
            return glm::dot(across, lift_) / gravity_mps2;
        }
        const glm::dvec3 any = glm::cross(ahead, glm::dvec3(1.0, 0.0, 0.0));
        lift_ = glm::normalize(glm::length(any) > 1e-6 ? any : glm::cross(ahead, glm::dvec3(0.0, 1.0, 0.0)));
        return load_factor;
    }

    /// A wing lifts across the motion through the air.
    EulerAngles of_wing(std::size_t at) {
        const glm::dvec3 motion_mps = through_air_mps_[at];
        const double airspeed_mps = glm::length(motion_mps);
        if (airspeed_mps < heading_known_mps) { return attitudes_[at]; }
        const glm::dvec3 ahead = motion_mps / airspeed_mps;
        const glm::dvec3 felt = felt_mps2(at);
        const glm::dvec3 across = felt - glm::dot(felt, ahead) * ahead;
        const glm::dvec3 kept = lift_ - glm::dot(lift_, ahead) * ahead;
        const double load_factor = take_lift(across, kept, ahead, path_.times_s[at]);
        const double attack_rad = wing_.rad(load_factor, equivalent_airspeed_mps(at));
        const glm::dvec3 nose = std::cos(attack_rad) * ahead + std::sin(attack_rad) * lift_;
        return euler_from_body_to_world(from_axes(nose, std::cos(attack_rad) * lift_ - std::sin(attack_rad) * ahead));
    }

    bool is_heavy_rotorcraft() const {
        constexpr double helicopter_mps = 25.0; // drones are slower
        return usual_airspeed_mps_ > helicopter_mps;
    }

    /// A rotor is tilted so that its thrust accelerates and carries the aircraft and overcomes its drag.
    EulerAngles of_rotor(std::size_t at) const {
        constexpr double drag_of_drone_per_s = 0.2;
        constexpr double drag_of_helicopter_per_s = 0.014;
        const double drag_per_s = is_heavy_rotorcraft() ? drag_of_helicopter_per_s : drag_of_drone_per_s;
        const glm::dvec3 motion_mps = through_air_mps_[at];
        glm::dvec3 thrust = felt_mps2(at) + drag_per_s * glm::dvec3(motion_mps.x, motion_mps.y, 0.0);
        thrust.z = std::max(thrust.z, 0.5 * gravity_mps2);
        const glm::dvec3 up = glm::normalize(thrust);
        const glm::dvec3 ahead = direction_from_heading(attitudes_[at].heading_rad);
        return euler_from_body_to_world(from_axes(glm::normalize(ahead - glm::dot(ahead, up) * up), up));
    }

    /// Near flight, attitudes on the ground go to those of the nearest flight within seconds.
    void blend_on_ground() {
        constexpr double over_s = 3.0;
        std::vector<EulerAngles> blended = attitudes_;
        const auto blend = [&](std::size_t at, std::size_t flown) {
            const double share = smooth_step(1.0 - std::abs(path_.times_s[at] - path_.times_s[flown]) / over_s);
            blended[at].pitch_rad += share * attitudes_[flown].pitch_rad;
            blended[at].roll_rad += share * attitudes_[flown].roll_rad;
        };
        constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
        std::size_t flown = none;
        for (std::size_t i = 0; i < attitudes_.size(); ++i) {
            if (!on_ground(i)) { flown = i; }
            if (on_ground(i) && flown != none) { blend(i, flown); }
        }
        flown = none;
        for (std::size_t i = attitudes_.size(); i-- > 0;) {
            if (!on_ground(i)) { flown = i; }
            if (on_ground(i) && flown != none) { blend(i, flown); }
        }
        attitudes_ = std::move(blended);
    }

    const PathKinematics& path_;
    const PathPhases& phases_;
    const MeasuredAngle& measured_headings_rad_;
    std::vector<EulerAngles> attitudes_;
    std::vector<glm::dvec3> through_air_mps_;
    std::vector<double> headings_rad_;
    std::vector<glm::dvec3> felt_mps2_;
    glm::dvec3 lift_;
    /// When the load factor was positive last, and when the direction of lift was found last.
    double last_pulled_s_ = -1e9;
    double last_lift_s_ = -1e9;
    double usual_airspeed_mps_ = 0.0;
    AngleOfAttack wing_;
};

} // namespace

std::vector<EulerAngles> inferred_attitudes(
    const PathKinematics& path, const PathPhases& phases, const WindEstimate& wind, const MeasuredAngle& headings_rad) {
    std::vector<EulerAngles> attitudes = AttitudeFinder(path, phases, wind, headings_rad).found();
    take_measured(path.times_s, headings_rad, &EulerAngles::heading_rad, attitudes);
    return attitudes;
}

void take_measured(std::span<const double> times_s, const MeasuredAngle& measured, double EulerAngles::*angle,
    std::vector<EulerAngles>& attitudes) {
    constexpr double trusted_s = 15.0;
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (std::isfinite(measured[i])) { at.push_back(i); }
    }
    if (at.empty()) { return; }
    const auto difference = [&](std::size_t i) { return wrapped_to_pi(measured[i] - attitudes[i].*angle); };
    std::vector<double> corrections(measured.size(), 0.0);
    std::size_t next = 0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        while (next < at.size() && at[next] < i) { ++next; }
        if (next < at.size() && at[next] == i) {
            corrections[i] = difference(i);
            continue;
        }
        const double before_s = next > 0 ? times_s[i] - times_s[at[next - 1]] : 1e9;
        const double after_s = next < at.size() ? times_s[at[next]] - times_s[i] : 1e9;
        const double before = next > 0 ? difference(at[next - 1]) : 0.0;
        const double after = next < at.size() ? before + wrapped_to_pi(difference(at[next]) - before) : before;
        const double share = next == 0 ? 1.0 : next == at.size() ? 0.0 : before_s / (before_s + after_s);
        const double nearest_s = std::min(before_s, after_s);
        corrections[i] = ((1.0 - share) * before + share * after) * smooth_step(2.0 - nearest_s / trusted_s);
    }
    for (std::size_t i = 0; i < measured.size(); ++i) { attitudes[i].*angle += corrections[i]; }
}

} // namespace octant::flightpaths
