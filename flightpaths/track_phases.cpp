#include "flightpaths/track_steps.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace octant::flightpaths {

namespace {

/// Indices from `begin` to before `end`.
struct Run {
    std::size_t begin = 0;
    std::size_t end = 0;
};

template <class Test>
std::vector<Run> runs_where(std::size_t count, Test&& test) {
    std::vector<Run> runs;
    for (std::size_t i = 0; i < count; ++i) {
        if (!test(i)) { continue; }
        if (runs.empty() || runs.back().end != i) { runs.push_back({i, i}); }
        runs.back().end = i + 1;
    }
    return runs;
}

class PhaseFinder {
public:
    explicit PhaseFinder(const PathKinematics& path) : path_(path), phases_(path.times_s.size(), TrackPhase::Flight) {
        for (const glm::dvec3& velocity : path.velocities_mps) {
            speeds_mps_.push_back(glm::length(glm::dvec2(velocity)));
        }
    }

    PathPhases found(std::string_view type) {
        // Gliders climb on one spot against the wind.
        const bool is_glider = type.find("Glider") != type.npos;
        const bool hovers = hovers_by_type(type) || (!is_glider && leaves_or_lands_on_the_spot() && !runs_to_fly());
        std::vector<bool> on_ground = hovers ? ground_of_rotorcraft() : ground_of_fixed_wing();
        for (std::size_t i = 0; i < on_ground.size(); ++i) {
            if (path_.contacts[i] == GroundContact::OnGround) { on_ground[i] = true; }
            if (path_.contacts[i] == GroundContact::InAir) { on_ground[i] = false; }
        }
        name_phases(on_ground, hovers);
        return {std::move(phases_), hovers};
    }

private:
    static bool hovers_by_type(std::string_view type) {
        constexpr std::array<std::string_view, 6> words{
            "Rotorcraft", "otorcraft", "elicopter", "ulticopter", "uadrotor", "COPTER"};
        return std::ranges::any_of(words, [&](std::string_view word) { return type.find(word) != type.npos; });
    }

    double span_s(const Run& run) const { return path_.times_s[run.end - 1] - path_.times_s[run.begin]; }

    double height_m(std::size_t at) const { return path_.positions_m[at].z; }

    /// A mean over the run, for what noise hides in one sample.
    double mean_height_m(const Run& run) const {
        double sum = 0.0;
        for (std::size_t i = run.begin; i < run.end; ++i) { sum += height_m(i) - height_m(run.begin); }
        return height_m(run.begin) + sum / static_cast<double>(run.end - run.begin);
    }

    bool is_recorded(std::size_t at) const { return path_.filled.empty() || !path_.filled[at]; }

    /// Whether it climbs or sinks at less than a fast run by more than it moves over the ground; what it does in a gap
    /// nobody knows.
    bool leaves_or_lands_on_the_spot() const {
        constexpr double slow_mps = 5.0;
        constexpr double look_s = 30.0;
        const double least_m = std::max(8.0, 6.0 * path_.vertical_error_m);
        double next_s = path_.times_s.front();
        for (std::size_t i = 0; i < speeds_mps_.size(); ++i) {
            if (path_.times_s[i] < next_s || !is_recorded(i)) { continue; }
            next_s = path_.times_s[i] + 1.0;
            double way_m = 0.0;
            for (std::size_t k = i + 1; k < speeds_mps_.size() && is_recorded(k) && speeds_mps_[k] < slow_mps &&
                                        path_.times_s[k] < path_.times_s[i] + look_s;
                 ++k) {
                way_m += glm::distance(glm::dvec2(path_.positions_m[k]), glm::dvec2(path_.positions_m[k - 1]));
                const double climb_m = std::abs(height_m(k) - height_m(i));
                if (climb_m > least_m && climb_m > 0.7 * way_m) { return true; }
            }
        }
        return false;
    }

    /// Whether it gains the speed of flight, or loses it, along runs at the height at which it stands: then it has
    /// wheels and a wing, and what seemed to be a climb on one spot were errors of the heights of a parked aircraft.
    bool runs_to_fly() const {
        constexpr double rolling_mps = 6.0;
        constexpr double fast_mps = 24.0;
        const double tolerance_m = std::max(1.0, 2.0 * path_.vertical_error_m);
        // Of ten heights near a time at which it rolls or stands, one is lower.
        const auto low_m = [&](double time_s) {
            constexpr double near_s = 300.0;
            std::vector<double> slow_m;
            for (std::size_t i = 0; i < speeds_mps_.size(); ++i) {
                if (speeds_mps_[i] < rolling_mps && std::abs(path_.times_s[i] - time_s) < near_s) {
                    slow_m.push_back(height_m(i));
                }
            }
            const auto low = slow_m.begin() + static_cast<std::ptrdiff_t>(slow_m.size() / 10);
            std::ranges::nth_element(slow_m, low);
            return *low;
        };
        int level = 0;
        int others = 0;
        std::optional<std::size_t> last;
        constexpr int enough = 64;
        for (std::size_t i = 0; i < speeds_mps_.size() && level + others < enough; ++i) {
            if (!is_recorded(i)) {
                last.reset();
                continue;
            }
            const bool slow = speeds_mps_[i] < rolling_mps;
            if (!slow && speeds_mps_[i] < fast_mps) { continue; }
            if (last && slow != (speeds_mps_[*last] < rolling_mps)) {
                const double way_m =
                    glm::distance(glm::dvec2(path_.positions_m[i]), glm::dvec2(path_.positions_m[*last]));
                const bool is_run =
                    std::abs(height_m(i) - height_m(*last)) < tolerance_m + runway_slope * way_m &&
                    height_m(slow ? i : *last) < low_m(path_.times_s[slow ? i : *last]) + 2.0 * tolerance_m + 2.0;
                ++(is_run ? level : others);
            }
            last = i;
        }
        return level > others;
    }

    /// So slow no aircraft of this recording flies without hovering: a fifth of its usual speed. Jets land at less than
    /// a third of the speed at which they cruise.
    double surely_rolling_mps() const {
        constexpr double least_mps = 5.0;
        const double fastest_mps = *std::ranges::max_element(speeds_mps_);
        std::vector<double> flown_mps;
        for (const double speed_mps : speeds_mps_) {
            if (speed_mps > 0.5 * fastest_mps) { flown_mps.push_back(speed_mps); }
        }
        if (flown_mps.empty()) { return least_mps; }
        const auto middle = flown_mps.begin() + static_cast<std::ptrdiff_t>(flown_mps.size() / 2);
        std::ranges::nth_element(flown_mps, middle);
        // What never gets faster than a car only rolls.
        constexpr double car_mps = 9.0;
        return fastest_mps < car_mps ? 2.0 * car_mps : std::max(least_mps, 0.2 * *middle);
    }

    std::vector<bool> ground_of_fixed_wing() const {
        const double rolling_mps = surely_rolling_mps();
        std::vector<bool> on_ground(phases_.size(), false);
        for (const Run& run : runs_where(phases_.size(), [&](std::size_t i) { return speeds_mps_[i] < rolling_mps; })) {
            if (is_landing(run)) {
                const Run whole{first_of_run(run), last_of_run(run) + 1};
                std::fill(on_ground.begin() + static_cast<std::ptrdiff_t>(whole.begin),
                    on_ground.begin() + static_cast<std::ptrdiff_t>(whole.end), true);
            }
        }
        return on_ground;
    }

    /// Whether a slow stretch is on the ground: long enough, and without climb or descent. A glider that flies against
    /// the wind is slow too.
    bool is_landing(const Run& run) const {
        constexpr double least_s = 6.0;
        constexpr double steepest_mps = 0.6;
        const bool at_an_end = run.begin == 0 || run.end == phases_.size();
        if (span_s(run) < least_s) { return at_an_end && std::abs(path_.velocities_mps[run.begin].z) < steepest_mps; }
        const double climb_mps = std::abs(height_m(run.end - 1) - height_m(run.begin)) / span_s(run);
        double slowest_mps = speeds_mps_[run.begin];
        for (std::size_t i = run.begin; i < run.end; ++i) { slowest_mps = std::min(slowest_mps, speeds_mps_[i]); }
        constexpr double rolling_mps = 5.0;
        return climb_mps < steepest_mps && (at_an_end || slowest_mps < rolling_mps);
    }

    /// Most that heights of a ground run leave those of its slow part.
    double run_tolerance_m() const { return std::max(1.5, 1.5 * path_.vertical_error_m); }

    /// How steep a runway may be.
    static constexpr double runway_slope = 0.02;

    /// Whether the aircraft still rolls at `at`, as it did at `from`.
    bool still_rolls(std::size_t at, std::size_t from) const {
        const double way_m = glm::distance(glm::dvec2(path_.positions_m[at]), glm::dvec2(path_.positions_m[from]));
        const double climb_mps = std::abs(path_.velocities_mps[at].z);
        return std::abs(height_m(at) - height_m(from)) < run_tolerance_m() + runway_slope * way_m &&
               climb_mps < std::max(0.8, 0.02 * speeds_mps_[at]);
    }

    std::size_t last_of_run(const Run& slow) const {
        std::size_t at = slow.end - 1;
        while (at + 1 < phases_.size() && still_rolls(at + 1, slow.end - 1) && gains(at + 1, slow.end - 1)) { ++at; }
        return at;
    }

    std::size_t first_of_run(const Run& slow) const {
        std::size_t at = slow.begin;
        while (at > 0 && still_rolls(at - 1, slow.begin) && gains(at - 1, slow.begin)) { --at; }
        return at;
    }

    /// Whether the run away from its slow end goes on: for no more than a minute.
    bool gains(std::size_t at, std::size_t from) const {
        constexpr double longest_run_s = 60.0;
        return std::abs(path_.times_s[at] - path_.times_s[from]) < longest_run_s;
    }

    /// A rotorcraft is on the ground where it stands and nothing of its path near there is lower, or at the height at
    /// which it began or ended.
    std::vector<bool> ground_of_rotorcraft() const {
        constexpr double least_s = 4.0;
        constexpr double drift_mps = 1.0;
        std::vector<bool> on_ground(phases_.size(), false);
        const auto stands = [&](std::size_t i) {
            return speeds_mps_[i] < drift_mps && std::abs(path_.velocities_mps[i].z) < 0.5;
        };
        for (const Run& run : runs_where(phases_.size(), stands)) {
            if (span_s(run) >= least_s && is_lowest_near(run)) {
                std::fill(on_ground.begin() + static_cast<std::ptrdiff_t>(run.begin),
                    on_ground.begin() + static_cast<std::ptrdiff_t>(run.end), true);
            }
        }
        return on_ground;
    }

    bool is_lowest_near(const Run& run) const {
        constexpr double near_m = 150.0;
        constexpr double near_s = 300.0;
        const double tolerance_m = std::max(2.0, 3.0 * path_.vertical_error_m);
        const double here_m = mean_height_m(run);
        const glm::dvec2 place_m(path_.positions_m[run.begin]);
        for (std::size_t i = 0; i < phases_.size(); ++i) {
            const double apart_s =
                std::max(path_.times_s[run.begin] - path_.times_s[i], path_.times_s[i] - path_.times_s[run.end - 1]);
            const double apart_m = glm::distance(glm::dvec2(path_.positions_m[i]), place_m);
            if (apart_m < near_m && (apart_s < near_s || i == 0 || i + 1 == phases_.size()) &&
                height_m(i) < here_m - tolerance_m - 0.1 * apart_m) {
                return false;
            }
        }
        return rises_after_or_before(run, here_m);
    }

    /// Something of the path must be higher: what stands at one height all the time may as well hover.
    bool rises_after_or_before(const Run& run, double here_m) const {
        const bool whole = run.begin == 0 && run.end == phases_.size();
        const bool at_an_end = run.begin == 0 || run.end == phases_.size();
        if (whole || at_an_end) { return true; }
        const double least_m = here_m + std::max(2.0, 3.0 * path_.vertical_error_m);
        constexpr double near_s = 120.0;
        bool before = false;
        bool after = false;
        for (std::size_t i = 0; i < phases_.size(); ++i) {
            if (height_m(i) < least_m) { continue; }
            before = before || (i < run.begin && path_.times_s[run.begin] - path_.times_s[i] < near_s);
            after = after || (i >= run.end && path_.times_s[i] - path_.times_s[run.end - 1] < near_s);
        }
        return before && after;
    }

    void name_phases(const std::vector<bool>& on_ground, bool hovers) {
        constexpr double hovering_mps = 5.0;
        for (std::size_t i = 0; i < phases_.size(); ++i) {
            if (on_ground[i]) {
                phases_[i] = speeds_mps_[i] < walking_pace_mps ? TrackPhase::Parked : TrackPhase::Taxi;
            } else if (hovers && speeds_mps_[i] < hovering_mps) {
                phases_[i] = TrackPhase::Hover;
            }
        }
        name_runs(on_ground);
    }

    /// What is fast on the ground is a take-off run where flight follows, a landing run where flight was before.
    void name_runs(const std::vector<bool>& on_ground) {
        constexpr double fast_mps = 12.0;
        for (const Run& run : runs_where(phases_.size(), [&](std::size_t i) { return on_ground[i]; })) {
            if (run.begin > 0) {
                for (std::size_t i = run.begin; i < run.end && speeds_mps_[i] > fast_mps; ++i) {
                    phases_[i] = TrackPhase::LandingRun;
                }
            }
            if (run.end < phases_.size()) {
                for (std::size_t i = run.end; i-- > run.begin && speeds_mps_[i] > fast_mps;) {
                    phases_[i] = TrackPhase::TakeOffRun;
                }
            }
        }
    }

    const PathKinematics& path_;
    std::vector<double> speeds_mps_;
    std::vector<TrackPhase> phases_;
};

} // namespace

PathPhases phases_of(const PathKinematics& path, std::string_view type) { return PhaseFinder(path).found(type); }

std::vector<PhaseSpan> spans_of(const std::vector<TrackPhase>& phases, std::span<const double> times_s) {
    std::vector<PhaseSpan> spans;
    for (std::size_t i = 0; i < phases.size(); ++i) {
        if (spans.empty() || spans.back().phase != phases[i]) {
            if (!spans.empty()) { spans.back().to_s = times_s[i]; }
            spans.push_back({times_s[i], times_s[i], phases[i]});
        }
        spans.back().to_s = times_s[i];
    }
    return spans;
}

} // namespace octant::flightpaths
