#include "flightpaths/motion_smoother.h"

#include "sim/base/units.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace octant::flightpaths {

// Filter: R. E. Kalman 1960. Smoother: modified Bryson-Frazier form (G. J. Bierman 1973), which needs no inverse
// matrix: each scalar measurement leaves its innovation, the variance of that, and its gain.

namespace {

constexpr double first_position_variance = 1000.0 * 1000.0;
constexpr double first_velocity_variance = 300.0 * 300.0;
constexpr double first_acceleration_variance = 10.0 * 10.0;

/// How a state and its covariance change in a time without measurements. Position, velocity and acceleration later are
/// p + dt v + of_position a, v + of_velocity a and of_acceleration a; white jerk of density 1 adds the covariances.
struct Onward {
    double dt_s = 0.0;
    double of_position = 0.0;
    double of_velocity = 0.0;
    double of_acceleration = 1.0;
    double pp = 0.0, pv = 0.0, pa = 0.0, vv = 0.0, va = 0.0;

    Onward() = default;

    Onward(double time_s, double memory_s) : dt_s(time_s) {
        of_acceleration = std::exp(-dt_s / memory_s);
        of_velocity = memory_s * -std::expm1(-dt_s / memory_s);
        of_position = memory_s * (dt_s - of_velocity);
        const double dt2 = dt_s * dt_s;
        pp = dt2 * dt2 * dt_s / 20.0;
        pv = dt2 * dt2 / 8.0;
        pa = dt2 * dt_s / 6.0;
        vv = dt2 * dt_s / 3.0;
        va = dt2 / 2.0;
    }

    /// Columns as in glm.
    glm::dmat3 matrix() const { return {1.0, 0.0, 0.0, dt_s, 1.0, 0.0, of_position, of_velocity, of_acceleration}; }
};

/// Before each time of a series; times that are equally far apart share the work.
std::vector<Onward> steps_of(const AxisSeries& series) {
    std::vector<Onward> steps(series.times_s.size());
    for (std::size_t i = 1; i < steps.size(); ++i) {
        const double dt_s = series.times_s[i] - series.times_s[i - 1];
        steps[i] = dt_s == steps[i - 1].dt_s ? steps[i - 1] : Onward(dt_s, series.memory_s);
    }
    return steps;
}

/// What one scalar measurement did to the filter.
struct Innovation {
    double difference = 0.0;
    double variance = 0.0;
    glm::dvec3 gain{0.0};
};

/// A state and its covariance, of which one half is kept.
struct Filter {
    glm::dvec3 state{0.0};
    double pp = 0.0, pv = 0.0, pa = 0.0, vv = 0.0, va = 0.0, aa = 0.0;

    glm::dmat3 covariance() const { return {pp, pv, pa, pv, vv, va, pa, va, aa}; }

    void predict(const Onward& on, double jerk) {
        state.x += on.dt_s * state.y + on.of_position * state.z;
        state.y += on.of_velocity * state.z;
        state.z *= on.of_acceleration;
        // The transition times the covariance, then times the transition's transpose.
        const double first_p = pp + on.dt_s * pv + on.of_position * pa;
        const double first_v = pv + on.dt_s * vv + on.of_position * va;
        const double first_a = pa + on.dt_s * va + on.of_position * aa;
        const double second_v = vv + on.of_velocity * va;
        const double second_a = va + on.of_velocity * aa;
        pp = first_p + on.dt_s * first_v + on.of_position * first_a + jerk * on.pp;
        pv = first_v + on.of_velocity * first_a + jerk * on.pv;
        pa = first_a * on.of_acceleration + jerk * on.pa;
        vv = second_v + on.of_velocity * second_a + jerk * on.vv;
        va = second_a * on.of_acceleration + jerk * on.va;
        aa = aa * on.of_acceleration * on.of_acceleration + jerk * on.dt_s;
    }

    /// What a measurement of component `which` (0 position, 1 velocity) would do.
    Innovation innovation(int which, double value, double variance) const {
        const glm::dvec3 column = which == 0 ? glm::dvec3(pp, pv, pa) : glm::dvec3(pv, vv, va);
        const double sum = column[which] + variance;
        return {value - state[which], sum, column / sum};
    }

    void update(const Innovation& by) {
        state += by.gain * by.difference;
        const glm::dvec3 taken = by.gain * by.variance;
        constexpr double least = 1e-18; // rounding must not make a variance negative
        pp = std::max(pp - by.gain.x * taken.x, least);
        pv -= by.gain.x * taken.y;
        pa -= by.gain.x * taken.z;
        vv = std::max(vv - by.gain.y * taken.y, least);
        va -= by.gain.y * taken.z;
        aa = std::max(aa - by.gain.z * taken.z, least);
    }
};

/// Before the first measurement: there, at the velocity to the second one.
Filter first_filter(const AxisSeries& series) {
    std::optional<std::size_t> first;
    std::optional<std::size_t> second;
    for (std::size_t i = 0; i < series.measured.size() && !second; ++i) {
        if (!std::isfinite(series.measured[i].position_variance)) { continue; }
        (first ? second : first) = i;
    }
    assert(first);
    Filter filter;
    filter.state.x = series.measured[*first].position_m;
    if (second) {
        filter.state.y =
            (series.measured[*second].position_m - filter.state.x) / (series.times_s[*second] - series.times_s[*first]);
    }
    filter.state.x -= filter.state.y * (series.times_s[*first] - series.times_s[0]);
    filter.pp = first_position_variance;
    filter.vv = first_velocity_variance;
    filter.aa = first_acceleration_variance;
    return filter;
}

struct Step {
    Filter after;
    std::array<Innovation, 2> innovations;
    std::array<bool, 2> has{};
};

/// Runs the filter forward.
std::vector<Step> filtered(const AxisSeries& series, const std::vector<Onward>& onward, std::span<const double> jerk) {
    std::vector<Step> steps(series.times_s.size());
    Filter filter = first_filter(series);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (i > 0) { filter.predict(onward[i], jerk[i]); }
        const AxisMeasurement& now = series.measured[i];
        const std::array values{now.position_m, now.velocity_mps};
        const std::array variances{now.position_variance, now.velocity_variance};
        for (int which = 0; which < 2; ++which) {
            const auto at = static_cast<std::size_t>(which);
            steps[i].has[at] = std::isfinite(variances[at]);
            if (!steps[i].has[at]) { continue; }
            steps[i].innovations[at] = filter.innovation(which, values[at], variances[at]);
            filter.update(steps[i].innovations[at]);
        }
        steps[i].after = filter;
    }
    return steps;
}

/// What later measurements say about a state: the adjoint of the filter.
struct Adjoint {
    glm::dvec3 vector{0.0};
    glm::dmat3 matrix{0.0};

    void before_measurement(int which, const Innovation& by) {
        // I - K H, H the row that picks the component.
        glm::dmat3 kept(1.0);
        kept[which] -= by.gain;
        vector = glm::transpose(kept) * vector;
        vector[which] -= by.difference / by.variance;
        matrix = glm::transpose(kept) * matrix * kept;
        matrix[which][which] += 1.0 / by.variance;
    }

    void before_step(const glm::dmat3& step) {
        vector = glm::transpose(step) * vector;
        matrix = glm::transpose(step) * matrix * step;
    }
};

} // namespace

std::vector<AxisMotion> smoothed(const AxisSeries& series, std::span<const double> jerk) {
    const std::vector<Onward> onward = steps_of(series);
    const std::vector<Step> steps = filtered(series, onward, jerk);
    std::vector<AxisMotion> motion(steps.size());
    Adjoint later;
    for (std::size_t i = steps.size(); i-- > 0;) {
        const glm::dmat3 covariance = steps[i].after.covariance();
        const glm::dvec3 state = steps[i].after.state - covariance * later.vector;
        const glm::dmat3 left = covariance - covariance * later.matrix * covariance;
        motion[i] = {state.x, state.y, state.z, std::max(0.0, left[0][0]), std::max(0.0, left[1][1])};
        for (int which = 1; which >= 0; --which) {
            const auto at = static_cast<std::size_t>(which);
            if (steps[i].has[at]) { later.before_measurement(which, steps[i].innovations[at]); }
        }
        if (i > 0) { later.before_step(onward[i].matrix()); }
    }
    return motion;
}

namespace {

/// An innovation of more than so many standard deviations is a contradiction, unless two follow each other.
constexpr double contradiction_sd = 5.0;

/// Adds to `sums` the log likelihood of each measurement of an axis under one density of jerk.
void add_likelihoods(
    const AxisSeries& series, const std::vector<Onward>& onward, double jerk, std::vector<double>& sums) {
    Filter filter = first_filter(series);
    int skipped = 0;
    for (std::size_t i = 0; i < series.times_s.size(); ++i) {
        if (i > 0) { filter.predict(onward[i], jerk); }
        const AxisMeasurement& now = series.measured[i];
        if (std::isfinite(now.position_variance)) {
            const Innovation by = filter.innovation(0, now.position_m, now.position_variance);
            const double square = by.difference * by.difference / by.variance;
            sums[i] -= 0.5 * (std::min(square, contradiction_sd * contradiction_sd) + std::log(by.variance));
            skipped = square > contradiction_sd * contradiction_sd ? skipped + 1 : 0;
            if (skipped == 1 || skipped == 2) { continue; }
            skipped = 0;
            filter.update(by);
        }
        if (std::isfinite(now.velocity_variance)) {
            filter.update(filter.innovation(1, now.velocity_mps, now.velocity_variance));
        }
    }
}

/// Means of values near each time, the nearer the more they count; none where none is measured.
class NearbyMeans {
public:
    NearbyMeans(std::span<const double> times_s, const std::vector<bool>& counts) : times_s_(times_s), counts_(counts) {
        constexpr double least_s = 5.0;
        constexpr double samples = 5.0;
        const auto measured = static_cast<double>(std::ranges::count(counts, true));
        reach_s_ = std::max(least_s, samples * (times_s.back() - times_s.front()) / std::max(1.0, measured - 1.0));
    }

    std::vector<double> of(const std::vector<double>& values) const {
        std::vector<double> means(values.size());
        std::size_t first = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            while (times_s_[first] < times_s_[i] - reach_s_) { ++first; }
            // At most so many, for logs of hundreds of samples a second.
            const std::size_t stride = 1 + (i - first) / 32;
            double sum = 0.0;
            double weights = 0.0;
            const auto add = [&](std::size_t at) {
                if (!counts_[at]) { return; }
                const double weight = 1.0 - std::abs(times_s_[at] - times_s_[i]) / reach_s_;
                sum += weight * values[at];
                weights += weight;
            };
            for (std::size_t at = i; at < values.size() && times_s_[at] < times_s_[i] + reach_s_; at += stride) {
                add(at);
            }
            for (std::size_t back = stride; back + first <= i; back += stride) { add(i - back); }
            means[i] = weights > 0.0 ? sum / weights : 0.0;
        }
        return means;
    }

    /// About how many values a mean has.
    static constexpr double values_a_mean = 6.0;

private:
    std::span<const double> times_s_;
    const std::vector<bool>& counts_;
    double reach_s_ = 0.0;
};

} // namespace

JerkFit fitted_jerk(std::span<const AxisSeries> axes) {
    const std::span<const double> times_s = axes.front().times_s;
    std::vector<bool> counts(times_s.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
        counts[i] = std::isfinite(axes.front().measured[i].position_variance);
    }
    const NearbyMeans nearby(times_s, counts);
    const std::vector<Onward> onward = steps_of(axes.front());
    std::array<std::vector<double>, jerk_densities.size()> likelihoods;
    for (std::size_t k = 0; k < jerk_densities.size(); ++k) {
        std::vector<double> sums(times_s.size(), 0.0);
        for (const AxisSeries& axis : axes) { add_likelihoods(axis, onward, jerk_densities[k], sums); }
        likelihoods[k] = nearby.of(sums);
    }
    JerkFit fit;
    fit.jerk.resize(times_s.size());
    for (std::size_t i = 0; i < times_s.size(); ++i) {
        double best = likelihoods[0][i];
        for (const auto& of_density : likelihoods) { best = std::max(best, of_density[i]); }
        double weights = 0.0;
        double logs = 0.0;
        for (std::size_t k = 0; k < jerk_densities.size(); ++k) {
            const double weight = std::exp(NearbyMeans::values_a_mean * (likelihoods[k][i] - best));
            weights += weight;
            logs += weight * std::log(jerk_densities[k]);
        }
        fit.jerk[i] = std::exp(logs / weights);
        if (counts[i]) { fit.log_likelihood += best; }
    }
    return fit;
}

} // namespace octant::flightpaths
