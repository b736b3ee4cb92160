#include "flightpaths/ground_contact.h"

#include "flightpaths/height_envelope.h"
#include "sim/atmosphere.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <utility>

namespace octant::flightpaths {

double qnh_hpa(double pressure_height_m, double height_m) {
    constexpr double standard_hpa = 1013.25;
    return standard_hpa * sim::standard_air(pressure_height_m).pressure_ratio /
           sim::standard_air(height_m).pressure_ratio;
}

namespace {

/// Differences of heights beyond these are no errors: of the air's pressure, of other heights.
constexpr double largest_pressure_error_m = 450.0;
constexpr double largest_error_m = 150.0;
/// A flight deeper in the ground than this is not lifted.
constexpr double deepest_pressure_m = 60.0;
constexpr double deepest_m = 40.0;
/// Steps in which the ground is looked at, and in which the path is written near it.
constexpr double look_s = 0.05;
constexpr double write_s = 0.25;
/// Half of the means of the ground's heights.
constexpr std::size_t half_mean = 10;
/// Within this time before and after contact the path takes the ground's slope.
constexpr double flare_s = 3.0;
constexpr double tilt_fades_s = 1.5;

/// Heights along a time on the ground, in equal steps.
struct Contact {
    double from_s = 0.0;
    double to_s = 0.0;
    double step_s = look_s;
    /// Of the reference point.
    std::vector<double> heights_m;
    /// Ground tilt in the directions of the nose, up, and of the right wing, down.
    std::vector<double> pitches_rad;
    std::vector<double> rolls_rad;
    /// Recorded heights are so much lower.
    std::vector<double> added_m;

    double at(const std::vector<double>& values, double time_s) const {
        const double place = std::clamp((time_s - from_s) / step_s, 0.0, static_cast<double>(values.size() - 1));
        const auto i = std::min(static_cast<std::size_t>(place), values.size() - 1);
        const std::size_t next = std::min(i + 1, values.size() - 1);
        const double share = place - static_cast<double>(i);
        return (1.0 - share) * values[i] + share * values[next];
    }

    /// Change of values a second at its begin and end.
    double first_slope(const std::vector<double>& values) const {
        return values.size() < 2 ? 0.0 : (values[1] - values[0]) / step_s;
    }

    double last_slope(const std::vector<double>& values) const {
        return values.size() < 2 ? 0.0 : (values.back() - values[values.size() - 2]) / step_s;
    }
};

std::vector<double> smoothed_tilt(const std::vector<double>& values) {
    return running_mean(running_mean(padded(values, 2 * half_mean), half_mean), half_mean);
}

class GroundLayer {
public:
    GroundLayer(const sim::Trajectory& track, const TrackInference& inference, const GroundHeight& ground,
        const GroundContactOptions& options)
        : track_(track), inference_(inference), ground_(ground), options_(options) {}

    LaidTrack laid() {
        find_contacts();
        leave_out_errors();
        LaidTrack laid{track_, {}, std::move(notes_)};
        std::vector<sim::AircraftState> states = with_contacts();
        lift_out_of_ground(states);
        if (contacts_.empty() && lifted_m_ == 0.0) { return laid; }
        laid.trajectory = sim::Trajectory(std::move(states));
        laid.report = report();
        tell(laid);
        return laid;
    }

private:
    double flown_from_s() const { return std::max(track_.start_s(), options_.from_s); }

    double flown_to_s() const { return std::min(track_.end_s(), options_.to_s); }

    double largest_m() const { return options_.by_pressure ? largest_pressure_error_m : largest_error_m; }

    void find_contacts() {
        const std::vector<PhaseSpan>& phases = inference_.phases;
        for (std::size_t i = 0; i < phases.size();) {
            if (!is_on_ground(phases[i].phase)) {
                ++i;
                continue;
            }
            std::size_t end = i;
            while (end < phases.size() && is_on_ground(phases[end].phase)) { ++end; }
            // A span ends where the next begins: the aircraft is in the air from there on.
            add_contact(phases[i].from_s, phases[end - 1].to_s);
            i = end;
        }
    }

    void add_contact(double from_s, double to_s) {
        Contact contact;
        contact.from_s = from_s;
        contact.to_s = to_s;
        constexpr double most_looks = 200'000.0;
        const double looks = std::clamp(std::ceil((to_s - from_s) / look_s), 1.0, most_looks);
        contact.step_s = std::max((to_s - from_s) / looks, 1e-9);
        for (double look = 0.0; look <= looks; look += 1.0) {
            const sim::AircraftState state = track_.state_at(from_s + look * contact.step_s);
            if (!look_at(state, contact)) { return; }
        }
        contact.heights_m = smooth_above(contact.heights_m, half_mean);
        contact.pitches_rad = smoothed_tilt(contact.pitches_rad);
        contact.rolls_rad = smoothed_tilt(contact.rolls_rad);
        for (std::size_t i = 0; i < contact.heights_m.size(); ++i) {
            const double tilt = std::cos(contact.pitches_rad[i]) * std::cos(contact.rolls_rad[i]);
            contact.heights_m[i] += options_.reach_below_m / std::max(0.5, tilt);
            const double recorded_m = track_.state_at(from_s + static_cast<double>(i) * contact.step_s).position_m.z;
            contact.added_m.push_back(contact.heights_m[i] - recorded_m);
        }
        contacts_.push_back(std::move(contact));
    }

    /// Adds the ground at a state; false where there is none.
    bool look_at(const sim::AircraftState& state, Contact& contact) const {
        constexpr double reach_m = 8.0;
        const glm::dvec2 place_m(state.position_m);
        const double heading_rad = euler_from_body_to_world(state.body_to_world).heading_rad;
        const glm::dvec2 ahead(direction_from_heading(heading_rad));
        const glm::dvec2 right(ahead.y, -ahead.x);
        const auto height = [&](const glm::dvec2& at_m) { return ground_(at_m.x, at_m.y); };
        const auto here = height(place_m);
        if (!here || !std::isfinite(*here)) { return false; }
        const auto slope = [&](const glm::dvec2& along) {
            const double up_m = height(place_m + reach_m * along).value_or(*here);
            const double down_m = height(place_m - reach_m * along).value_or(*here);
            return std::atan((up_m - down_m) / (2.0 * reach_m));
        };
        contact.heights_m.push_back(*here);
        contact.pitches_rad.push_back(slope(ahead));
        contact.rolls_rad.push_back(-slope(right));
        return true;
    }

    /// What differs too much is not on the ground.
    void leave_out_errors() {
        const auto differs = [&](const Contact& contact) {
            return std::max(std::abs(contact.added_m.front()), std::abs(contact.added_m.back())) > largest_m();
        };
        const auto wrong = std::ranges::find_if(contacts_, differs);
        if (wrong == contacts_.end()) { return; }
        notes_.push_back(
            fmt::format("from {:.0f} s to {:.0f} s the track seems to be on the ground, but its heights are {:.0f} m "
                        "{} this ground: it is flown as recorded there",
                wrong->from_s, wrong->to_s, std::abs(wrong->added_m.front()),
                wrong->added_m.front() < 0.0 ? "above" : "below"));
        std::erase_if(contacts_, differs);
    }

    /// What is added to heights in the air between two contacts (either may be missing), and its change a second.
    struct Added {
        double height_m = 0.0;
        double rate_mps = 0.0;
    };

    static Added added_between(const Contact* before, const Contact* after, double time_s) {
        if (before == nullptr && after == nullptr) { return {}; }
        const double first_m = before != nullptr ? before->added_m.back() : after->added_m.front();
        const double last_m = after != nullptr ? after->added_m.front() : before->added_m.back();
        const double span_s = before != nullptr && after != nullptr ? after->from_s - before->to_s : 1.0;
        const double slope_mps = (last_m - first_m) / std::max(span_s, 1e-9);
        const double since_s = before != nullptr ? time_s - before->to_s : 0.0;
        Added added{first_m + slope_mps * since_s, slope_mps};
        const double decay_s = before != nullptr && after != nullptr ? std::min(flare_s, span_s / 8.0) : flare_s;
        const auto bend = [&](double mismatch_mps, double from_contact_s) {
            const double left = std::exp(-std::abs(from_contact_s) / decay_s);
            added.height_m += mismatch_mps * from_contact_s * left;
            added.rate_mps += mismatch_mps * left * (1.0 - std::abs(from_contact_s) / decay_s);
        };
        if (before != nullptr) { bend(before->last_slope(before->added_m) - slope_mps, since_s); }
        if (after != nullptr) { bend(after->first_slope(after->added_m) - slope_mps, time_s - after->from_s); }
        return added;
    }

    /// The times of the track, and close ones where it rolls and near contact.
    std::vector<double> times_s() const {
        std::vector<double> times_s;
        for (const sim::AircraftState& state : track_.samples()) { times_s.push_back(state.time_s); }
        constexpr double near_s = 20.0;
        for (const PhaseSpan& span : inference_.phases) {
            const bool rolls = is_on_ground(span.phase) && span.phase != TrackPhase::Parked;
            if (rolls) { add_times(span.from_s, span.to_s, times_s); }
        }
        for (const Contact& contact : contacts_) {
            add_times(contact.from_s - near_s, contact.from_s + near_s, times_s);
            add_times(contact.to_s - near_s, contact.to_s + near_s, times_s);
        }
        std::ranges::sort(times_s);
        std::vector<double> kept_s;
        constexpr double same_s = 1e-3;
        for (const double time_s : times_s) {
            if (kept_s.empty() || time_s > kept_s.back() + same_s) { kept_s.push_back(time_s); }
        }
        kept_s.back() = track_.end_s();
        return kept_s;
    }

    void add_times(double from_s, double to_s, std::vector<double>& times_s) const {
        const double begin_s = std::ceil(std::max(from_s, track_.start_s()) / write_s) * write_s;
        for (double time_s = begin_s; time_s < std::min(to_s, track_.end_s()); time_s += write_s) {
            times_s.push_back(time_s);
        }
        for (const double time_s : {from_s, to_s}) {
            if (time_s >= track_.start_s() && time_s <= track_.end_s()) { times_s.push_back(time_s); }
        }
    }

    std::vector<sim::AircraftState> with_contacts() const {
        std::vector<sim::AircraftState> states;
        if (contacts_.empty()) { return {track_.samples().begin(), track_.samples().end()}; }
        std::size_t next = 0;
        for (const double time_s : times_s()) {
            while (next < contacts_.size() && contacts_[next].to_s < time_s) { ++next; }
            const Contact* after = next < contacts_.size() ? &contacts_[next] : nullptr;
            const Contact* before = next > 0 ? &contacts_[next - 1] : nullptr;
            sim::AircraftState state = track_.state_at(time_s);
            if (after != nullptr && time_s >= after->from_s) {
                states.push_back(on_ground(state, *after));
            } else {
                states.push_back(in_air(state, before, after));
            }
        }
        return states;
    }

    sim::AircraftState on_ground(sim::AircraftState state, const Contact& contact) const {
        state.position_m.z = contact.at(contact.heights_m, state.time_s);
        const double later_m = contact.at(contact.heights_m, state.time_s + 0.5 * contact.step_s);
        const double earlier_m = contact.at(contact.heights_m, state.time_s - 0.5 * contact.step_s);
        state.velocity_mps.z = (later_m - earlier_m) / contact.step_s;
        state.load_factor = 1.0;
        tilt(state, contact, 1.0);
        return state;
    }

    sim::AircraftState in_air(sim::AircraftState state, const Contact* before, const Contact* after) const {
        const Added added = added_between(before, after, state.time_s);
        const glm::dvec3 was_mps = state.velocity_mps;
        state.position_m.z += added.height_m;
        state.velocity_mps.z += added.rate_mps;
        if (inference_.pitch_roll == Origin::Measured) { return state; }
        const double speed_mps = glm::length(glm::dvec2(was_mps));
        if (speed_mps > 5.0 && !inference_.hovers) {
            EulerAngles angles = euler_from_body_to_world(state.body_to_world);
            angles.pitch_rad += std::atan2(state.velocity_mps.z, speed_mps) - std::atan2(was_mps.z, speed_mps);
            state.body_to_world = body_to_world_from_euler(angles);
        }
        if (before != nullptr) {
            tilt(state, *before, smooth_step(1.0 - (state.time_s - before->to_s) / tilt_fades_s));
        }
        if (after != nullptr) { tilt(state, *after, smooth_step(1.0 - (after->from_s - state.time_s) / tilt_fades_s)); }
        return state;
    }

    void tilt(sim::AircraftState& state, const Contact& contact, double share) const {
        if (share == 0.0 || inference_.pitch_roll == Origin::Measured) { return; }
        EulerAngles angles = euler_from_body_to_world(state.body_to_world);
        angles.pitch_rad += share * contact.at(contact.pitches_rad, state.time_s);
        angles.roll_rad += share * contact.at(contact.rolls_rad, state.time_s);
        state.body_to_world = body_to_world_from_euler(angles);
    }

    /// Where the path is in the ground by no more than its errors, it is lifted: within seconds, and between close
    /// states.
    void lift_out_of_ground(std::vector<sim::AircraftState>& states) {
        const sim::Trajectory path(states);
        const double from_s = flown_from_s();
        const auto steps = static_cast<std::size_t>(std::max(0.0, (flown_to_s() - from_s) / look_s)) + 1;
        std::vector<double> needed_m(steps, 0.0);
        double most_m = 0.0;
        for (std::size_t i = 0; i < steps; ++i) {
            const glm::dvec3 place_m = path.state_at(from_s + static_cast<double>(i) * look_s).position_m;
            const auto ground_m = ground_(place_m.x, place_m.y);
            if (!ground_m) { continue; }
            const double missing_m = *ground_m + 0.5 * options_.reach_below_m + least_m - place_m.z;
            needed_m[i] = std::max(0.0, missing_m);
            most_m = std::max(most_m, missing_m);
        }
        if (most_m <= 0.0 || most_m > (options_.by_pressure ? deepest_pressure_m : deepest_m)) { return; }
        constexpr std::size_t half = 30;
        lifted_m_ = most_m;
        lift(smooth_above(needed_m, half), from_s, path, states);
    }

    void lift(const std::vector<double>& by_m, double from_s, const sim::Trajectory& path,
        std::vector<sim::AircraftState>& states) const {
        const auto by = [&](double time_s) {
            const double place = std::clamp((time_s - from_s) / look_s, 0.0, static_cast<double>(by_m.size() - 1));
            const auto i = static_cast<std::size_t>(place);
            const double share = place - static_cast<double>(i);
            return (1.0 - share) * by_m[i] + share * by_m[std::min(i + 1, by_m.size() - 1)];
        };
        std::vector<double> times_s;
        for (const sim::AircraftState& state : states) { times_s.push_back(state.time_s); }
        for (std::size_t i = 0; i < by_m.size(); i += static_cast<std::size_t>(write_s / look_s)) {
            if (by_m[i] > 0.0) { times_s.push_back(from_s + static_cast<double>(i) * look_s); }
        }
        std::ranges::sort(times_s);
        std::vector<sim::AircraftState> lifted;
        for (const double time_s : times_s) {
            if (!lifted.empty() && !(time_s > lifted.back().time_s + 1e-3)) { continue; }
            sim::AircraftState state = path.state_at(time_s);
            state.position_m.z += by(time_s);
            state.velocity_mps.z += (by(time_s + look_s) - by(time_s - look_s)) / (2.0 * look_s);
            lifted.push_back(state);
        }
        states = std::move(lifted);
    }

    GroundContactReport report() const {
        GroundContactReport report;
        report.lifted_m = lifted_m_;
        for (const Contact& contact : contacts_) {
            report.contacts.push_back({contact.from_s, contact.to_s, contact.added_m.front(), contact.added_m.back()});
        }
        if (!options_.by_pressure || contacts_.empty()) { return report; }
        const auto qnh = [&](double height_m, double added_m) { return qnh_hpa(height_m - added_m, height_m); };
        if (contacts_.front().to_s < track_.end_s()) {
            report.qnh_take_off_hpa = qnh(contacts_.front().heights_m.back(), contacts_.front().added_m.back());
        }
        if (contacts_.back().from_s > track_.start_s()) {
            report.qnh_landing_hpa = qnh(contacts_.back().heights_m.front(), contacts_.back().added_m.front());
        }
        return report;
    }

    void tell(LaidTrack& laid) const {
        std::string text;
        const auto say = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
        for (const GroundContactSpan& span : laid.report.contacts) {
            if (span.from_s > track_.start_s()) {
                say(fmt::format("{:+.1f} m where it lands at {:.0f} s", span.added_from_m, span.from_s));
            }
            if (span.to_s < track_.end_s()) {
                say(fmt::format("{:+.1f} m where it takes off at {:.0f} s", span.added_to_m, span.to_s));
            }
            if (span.from_s <= track_.start_s() && span.to_s >= track_.end_s()) {
                say(fmt::format("{:+.1f} m", span.added_from_m));
            }
        }
        if (!text.empty()) { laid.notes.push_back("laid onto the ground: heights are changed by " + text); }
        if (laid.report.qnh_take_off_hpa) {
            laid.notes.push_back(
                fmt::format("altimeter setting by the ground at take-off: {:.0f} hPa", *laid.report.qnh_take_off_hpa));
        }
        if (laid.report.qnh_landing_hpa) {
            laid.notes.push_back(
                fmt::format("altimeter setting by the ground at landing: {:.0f} hPa", *laid.report.qnh_landing_hpa));
        }
        if (lifted_m_ > 0.5) {
            laid.notes.push_back(fmt::format("in flight it is lifted out of the ground by up to {:.1f} m", lifted_m_));
        }
    }

    /// A path that touches the ground is not above it.
    static constexpr double least_m = 0.01;

    const sim::Trajectory& track_;
    const TrackInference& inference_;
    const GroundHeight& ground_;
    const GroundContactOptions& options_;
    std::vector<Contact> contacts_;
    std::vector<std::string> notes_;
    double lifted_m_ = 0.0;
};

} // namespace

LaidTrack laid_on_ground(const sim::Trajectory& track, const TrackInference& inference, const GroundHeight& ground,
    const GroundContactOptions& options) {
    return GroundLayer(track, inference, ground, options).laid();
}

} // namespace octant::flightpaths
