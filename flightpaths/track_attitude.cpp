#include "flightpaths/track_attitude.h"

#include "flightpaths/height_envelope.h"
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

/// How the nose lies to the motion through the air: at the usual equivalent airspeed of a flight and 1 g by usual_rad,
/// and by of_lift_rad more where the wing must lift twice as much. Flaps lift most of what slow flight asks for:
/// recordings of light aircraft and of airliners show little more.
struct AngleOfAttack {
    static constexpr double usual_rad = rad_from_deg(1.5);
    static constexpr double of_lift_rad = rad_from_deg(0.8);
    static constexpr double most_rad = rad_from_deg(12.0);
    double usual_airspeed_mps = 0.0;

    double rad(double load_factor, double airspeed_mps) const {
        const double ratio = usual_airspeed_mps / std::max(airspeed_mps, 0.3 * usual_airspeed_mps);
        const double lift = std::clamp(load_factor, -1.0, 6.0) * ratio * ratio;
        return std::clamp(usual_rad + of_lift_rad * (lift - 1.0), -most_rad, most_rad);
    }
};

class AttitudeFinder {
public:
    AttitudeFinder(const PathKinematics& path, const PathPhases& phases, const WindEstimate& wind)
        : path_(path), phases_(phases), attitudes_(path.times_s.size()), lift_(0.0, 0.0, 1.0) {
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
            wing_.usual_airspeed_mps = *fast;
        }
    }

    std::vector<EulerAngles> found() && {
        find_headings();
        for (std::size_t i = 0; i < attitudes_.size(); ++i) {
            attitudes_[i] = EulerAngles{.heading_rad = headings_rad_[i]};
            if (on_ground(i)) { continue; }
            attitudes_[i] = phases_.hovers ? of_rotor(i) : of_wing(i);
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
    }

    struct Range {
        std::size_t begin = 0;
        std::size_t end = 0;
    };

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

    glm::dvec3 felt_mps2(std::size_t at) const {
        return path_.accelerations_mps2[at] + glm::dvec3(0.0, 0.0, gravity_mps2);
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
        if (airspeed_mps < heading_known_mps) { return {.heading_rad = headings_rad_[at]}; }
        const glm::dvec3 ahead = motion_mps / airspeed_mps;
        const glm::dvec3 felt = felt_mps2(at);
        const glm::dvec3 across = felt - glm::dot(felt, ahead) * ahead;
        const glm::dvec3 kept = lift_ - glm::dot(lift_, ahead) * ahead;
        const double load_factor = take_lift(across, kept, ahead, path_.times_s[at]);
        const double attack_rad = wing_.rad(load_factor, equivalent_airspeed_mps(at));
        const glm::dvec3 nose = std::cos(attack_rad) * ahead + std::sin(attack_rad) * lift_;
        return euler_from_body_to_world(from_axes(nose, std::cos(attack_rad) * lift_ - std::sin(attack_rad) * ahead));
    }

    /// A rotor is tilted so that its thrust accelerates and carries the aircraft and overcomes its drag.
    EulerAngles of_rotor(std::size_t at) const {
        constexpr double heavy_mps = 25.0; // usual airspeed, above which it is a helicopter
        constexpr double drag_of_drone_per_s = 0.2;
        constexpr double drag_of_helicopter_per_s = 0.014;
        const double drag_per_s = wing_.usual_airspeed_mps > heavy_mps ? drag_of_helicopter_per_s : drag_of_drone_per_s;
        const glm::dvec3 motion_mps = through_air_mps_[at];
        glm::dvec3 thrust = felt_mps2(at) + drag_per_s * glm::dvec3(motion_mps.x, motion_mps.y, 0.0);
        thrust.z = std::max(thrust.z, 0.5 * gravity_mps2);
        const glm::dvec3 up = glm::normalize(thrust);
        const glm::dvec3 ahead = direction_from_heading(headings_rad_[at]);
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
    std::vector<EulerAngles> attitudes_;
    std::vector<glm::dvec3> through_air_mps_;
    std::vector<double> headings_rad_;
    glm::dvec3 lift_;
    /// When the load factor was positive last, and when the direction of lift was found last.
    double last_pulled_s_ = -1e9;
    double last_lift_s_ = -1e9;
    AngleOfAttack wing_;
};

} // namespace

std::vector<EulerAngles> inferred_attitudes(
    const PathKinematics& path, const PathPhases& phases, const WindEstimate& wind) {
    return AttitudeFinder(path, phases, wind).found();
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
