#include "flightpaths/track_steps.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace octant::flightpaths {

namespace {

constexpr double horizontal_memory_s = 20.0;
constexpr double vertical_memory_s = 8.0;
/// Samples further apart have times between them, no more than 2 s apart, but at most so many.
constexpr double longest_step_s = 2.5;
constexpr double filled_step_s = 2.0;
constexpr double most_filled = 500.0;
constexpr double infinite = std::numeric_limits<double>::infinity();

double squared(double value) { return value * value; }

double median_of(std::vector<double> values) {
    if (values.empty()) { return 0.0; }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

} // namespace

glm::dvec3 SmoothedPlaces::position_m(std::size_t at) const {
    return {axes[0][at].position_m, axes[1][at].position_m, axes[2][at].position_m};
}

glm::dvec3 SmoothedPlaces::velocity_mps(std::size_t at) const {
    return {axes[0][at].velocity_mps, axes[1][at].velocity_mps, axes[2][at].velocity_mps};
}

glm::dvec3 SmoothedPlaces::acceleration_mps2(std::size_t at) const {
    return {axes[0][at].acceleration_mps2, axes[1][at].acceleration_mps2, axes[2][at].acceleration_mps2};
}

double height_step_m(std::span<const double> heights_m) {
    constexpr double smallest_m = 0.5;
    std::vector<double> levels(heights_m.begin(), heights_m.end());
    std::ranges::sort(levels);
    double step_m = infinite;
    for (std::size_t i = 1; i < levels.size(); ++i) {
        const double apart_m = levels[i] - levels[i - 1];
        if (apart_m > 1e-3) { step_m = std::min(step_m, apart_m); }
    }
    constexpr double largest_m = 40.0; // a hundred feet and a little more
    constexpr std::ptrdiff_t least_levels = 3;
    const auto distinct = std::unique(levels.begin(), levels.end()) - levels.begin();
    if (!(step_m >= smallest_m && step_m <= largest_m) || distinct < least_levels) { return 0.0; }
    std::size_t repeats = 0;
    for (std::size_t i = 1; i < heights_m.size(); ++i) {
        const double apart_m = std::abs(heights_m[i] - heights_m[i - 1]);
        const double steps = std::round(apart_m / step_m);
        // Feet that a file rounds to whole metres or hundredths are no exact multiples.
        if (std::abs(apart_m - steps * step_m) > 0.02 + 0.01 * step_m) { return 0.0; }
        repeats += steps == 0.0 ? 1 : 0;
    }
    return 20 * repeats >= heights_m.size() ? step_m : 0.0;
}

namespace {

/// The step of a clock of which these times are whole numbers; 0 for one of less than a hundredth of a second.
double clock_step_s(std::span<const TrackSample> samples) {
    for (const double step_s : {1.0, 0.1, 0.01}) {
        const bool is_step = std::ranges::all_of(samples, [&](const TrackSample& sample) {
            const double steps = (sample.time_s - samples.front().time_s) / step_s;
            return std::abs(steps - std::round(steps)) < 1e-4;
        });
        if (is_step) { return step_s; }
    }
    return 0.0;
}

/// Times of a recorder that samples evenly and rounds to its clock (0.11, 0.22, 0.33, 0.45 s) are made even within that
/// rounding: at 250 m/s a hundredth of a second is 2.5 m of error, and acceleration that was not there.
std::vector<double> evened_times_s(std::span<const TrackSample> samples) {
    std::vector<double> times_s;
    for (const TrackSample& sample : samples) { times_s.push_back(sample.time_s); }
    const double clock_s = clock_step_s(samples);
    if (clock_s == 0.0) { return times_s; }
    constexpr std::size_t reach = 12;
    constexpr double fewest_clock_steps = 4.0;
    const auto step_s = [&](std::size_t i) { return samples[i + 1].time_s - samples[i].time_s; };
    // Whether the steps before and after a sample are one number of clock steps or the next.
    const auto is_even = [&](double least_s, double most_s) {
        return least_s > (fewest_clock_steps - 0.5) * clock_s && most_s - least_s < 1.5 * clock_s;
    };
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
        double least_s = step_s(i);
        double most_s = least_s;
        std::size_t around = 0;
        while (around < reach && around < i && i + around + 1 < samples.size()) {
            const double before_s = step_s(i - around - 1);
            const double after_s = step_s(i + around);
            const double lower_s = std::min({least_s, before_s, after_s});
            const double upper_s = std::max({most_s, before_s, after_s});
            if (!is_even(lower_s, upper_s)) { break; }
            least_s = lower_s;
            most_s = upper_s;
            ++around;
        }
        if (around < 2 || most_s - least_s < 0.5 * clock_s) { continue; }
        double sum_s = 0.0;
        for (std::size_t k = i - around; k <= i + around; ++k) { sum_s += samples[k].time_s - samples[i].time_s; }
        const double mean_s = sum_s / static_cast<double>(2 * around + 1);
        times_s[i] += std::clamp(mean_s, -0.5 * clock_s, 0.5 * clock_s);
    }
    return times_s;
}

} // namespace

PlaceSmoother::PlaceSmoother(std::span<const TrackSample> samples) : samples_(samples) {
    fill_gaps();
    for (auto& axis : measured_) { axis.resize(places_.times_s.size()); }
    measure_places();
    leave_out_jumps();
    leave_out_repeats();
    fit_horizontally();
    measure_heights();
    fit_vertically();
    measure_velocities();
    smooth();
}

void PlaceSmoother::fill_gaps() {
    const std::vector<double> even_s = evened_times_s(samples_);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const double gap_s = i > 0 ? even_s[i] - even_s[i - 1] : 0.0;
        if (gap_s > longest_step_s) {
            const double pieces = std::min(std::ceil(gap_s / filled_step_s), most_filled);
            for (double piece = 1.0; piece < pieces; piece += 1.0) {
                places_.times_s.push_back(even_s[i - 1] + gap_s * piece / pieces);
                places_.samples.push_back(SmoothedPlaces::no_sample);
            }
        }
        places_.times_s.push_back(even_s[i]);
        places_.samples.push_back(i);
    }
}

namespace {

/// How the errors that a recorder states differ from the usual one: their squares, 1 where it states none.
class StatedErrors {
public:
    StatedErrors(std::span<const TrackSample> samples, double TrackSample::*error_m) : error_m_(error_m) {
        std::vector<double> stated_m;
        for (const TrackSample& sample : samples) {
            if (sample.*error_m > 0.0) { stated_m.push_back(sample.*error_m); }
        }
        usual_m_ = median_of(std::move(stated_m));
    }

    double variance(const TrackSample& sample) const {
        constexpr double most = 30.0;
        const double ratio = sample.*error_m_ / usual_m_;
        return ratio > 0.0 ? squared(std::clamp(ratio, 1.0 / most, most)) : 1.0;
    }

private:
    double TrackSample::*error_m_;
    double usual_m_ = 0.0;
};

} // namespace

void PlaceSmoother::measure_places() {
    const StatedErrors horizontal(samples_, &TrackSample::horizontal_error_m);
    const StatedErrors vertical(samples_, &TrackSample::vertical_error_m);
    for (std::size_t i = 0; i < places_.samples.size(); ++i) {
        if (places_.samples[i] == SmoothedPlaces::no_sample) { continue; }
        const TrackSample& sample = samples_[places_.samples[i]];
        for (int axis = 0; axis < 3; ++axis) {
            AxisMeasurement& measured = measured_[static_cast<std::size_t>(axis)][i];
            measured.position_m = sample.position_m[axis];
            measured.position_variance = axis == 2 ? vertical.variance(sample) : horizontal.variance(sample);
        }
    }
}

/// Places that only a speed far beyond the others of the track leads to and from.
void PlaceSmoother::leave_out_jumps() {
    std::vector<double> speeds_mps;
    const auto speed_mps = [&](std::size_t from, std::size_t to) {
        const glm::dvec2 way_m(samples_[to].position_m - samples_[from].position_m);
        return glm::length(way_m) / (samples_[to].time_s - samples_[from].time_s);
    };
    for (std::size_t i = 1; i < samples_.size(); ++i) { speeds_mps.push_back(speed_mps(i - 1, i)); }
    const auto fast = speeds_mps.begin() + static_cast<std::ptrdiff_t>(speeds_mps.size() * 8 / 10);
    std::ranges::nth_element(speeds_mps, fast);
    constexpr double beyond_mps = 50.0;
    const double limit_mps = 1.5 * *fast + beyond_mps;
    constexpr int most_in_a_row = 5; // more of them are where it is
    std::size_t last = 0;
    int in_a_row = 0;
    for (std::size_t at = 0; at < places_.samples.size(); ++at) {
        const std::size_t i = places_.samples[at];
        if (i == SmoothedPlaces::no_sample || i == 0) { continue; }
        if (speed_mps(last, i) <= limit_mps || in_a_row == most_in_a_row) {
            last = i;
            in_a_row = 0;
            continue;
        }
        ++in_a_row;
        ++places_.rejected;
        measured_[0][at].position_variance = infinite;
        measured_[1][at].position_variance = infinite;
    }
}

void PlaceSmoother::leave_out_repeats() {
    constexpr double half_window_s = 5.0;
    constexpr double moving_mps = 3.0;
    std::size_t first = 0;
    std::size_t last = 0;
    std::size_t kept_at = 0;
    for (std::size_t i = 1; i < samples_.size(); ++i) {
        while (samples_[first].time_s < samples_[i].time_s - half_window_s) { ++first; }
        while (last + 1 < samples_.size() && samples_[last].time_s < samples_[i].time_s + half_window_s) { ++last; }
        const bool same = glm::dvec2(samples_[i].position_m) == glm::dvec2(samples_[kept_at].position_m);
        const double way_m =
            glm::distance(glm::dvec2(samples_[first].position_m), glm::dvec2(samples_[last].position_m));
        if (!same || way_m < moving_mps * (samples_[last].time_s - samples_[first].time_s)) {
            kept_at = i;
            continue;
        }
        ++places_.repeated;
        const auto at = static_cast<std::size_t>(std::ranges::find(places_.samples, i) - places_.samples.begin());
        measured_[0][at].position_variance = infinite;
        measured_[1][at].position_variance = infinite;
    }
}

AxisSeries PlaceSmoother::series(std::size_t axis) const {
    return {places_.times_s, measured_[axis], axis == 2 ? vertical_memory_s : horizontal_memory_s};
}

namespace {

void scale_variances(std::vector<AxisMeasurement>& measured, double factor) {
    for (AxisMeasurement& one : measured) { one.position_variance *= factor; }
}

/// Begin and length of the stretches of a series on which its errors are found.
std::vector<std::array<std::size_t, 2>> stretches_of(std::size_t count) {
    constexpr std::size_t stretch = 400;
    if (count <= 3 * stretch) { return {{0, count}}; }
    return {{0, stretch}, {(count - stretch) / 2, stretch}, {count - stretch, stretch}};
}

/// How likely the axes are where the variances of their places are so many times as large.
double likelihood_of(std::vector<AxisSeries> axes, double factor) {
    double sum = 0.0;
    std::array<std::vector<AxisMeasurement>, 2> scaled;
    for (const auto& [begin, count] : stretches_of(axes.front().times_s.size())) {
        std::vector<AxisSeries> stretch;
        std::size_t measured = 0;
        for (std::size_t axis = 0; axis < axes.size(); ++axis) {
            const auto part = axes[axis].measured.subspan(begin, count);
            scaled[axis].assign(part.begin(), part.end());
            scale_variances(scaled[axis], factor);
            measured = static_cast<std::size_t>(std::ranges::count_if(
                part, [](const AxisMeasurement& one) { return std::isfinite(one.position_variance); }));
            stretch.push_back({axes[axis].times_s.subspan(begin, count), scaled[axis], axes[axis].memory_s});
        }
        if (measured >= 2) { sum += fitted_jerk(stretch).log_likelihood; }
    }
    return sum;
}

/// The standard deviation of measured places, whose variances are 1 where they are as usual, under which they are most
/// likely. Where they cannot tell, that of a usual satellite receiver.
double most_likely_error_m(const std::vector<AxisSeries>& axes, double least_m) {
    constexpr double usual_m = 0.7;
    constexpr double spread = 1.5; // of the logarithm
    constexpr double most_m = 40.0;
    double best_m = least_m;
    double best = -infinite;
    const auto try_error = [&](double error_m) {
        const double likelihood =
            likelihood_of(axes, squared(error_m)) - 0.5 * squared(std::log(error_m / usual_m) / spread);
        if (likelihood > best) {
            best = likelihood;
            best_m = error_m;
        }
    };
    constexpr double coarse = 4.0;
    for (double error_m = least_m; error_m <= most_m; error_m *= coarse) { try_error(error_m); }
    for (double factor = std::sqrt(coarse); factor > 1.2; factor = std::sqrt(factor)) {
        const double middle_m = best_m;
        try_error(std::max(least_m, middle_m / factor));
        try_error(middle_m * factor);
    }
    return best_m;
}

/// Measurements that lie too far from where all others put the aircraft are left out, and those at some distance count
/// less, as if errors had a t distribution. Returns whether any of them changed much.
class Doubts {
public:
    explicit Doubts(const std::vector<AxisMeasurement>& measured) {
        for (const AxisMeasurement& one : measured) { variances_.push_back(one.position_variance); }
    }

    void weigh(
        std::vector<std::vector<AxisMeasurement>*> axes, const std::vector<const std::vector<AxisMotion>*>& motion) {
        constexpr double left_out_sd = 6.0;
        constexpr double left_out_m = 2.0;
        constexpr double freedom = 5.0;
        std::vector<double> squares(variances_.size(), 0.0); // of distances, in variances
        std::vector<std::size_t> far;
        std::size_t measured = 0;
        for (std::size_t i = 0; i < variances_.size(); ++i) {
            if (!std::isfinite(variances_[i])) { continue; }
            ++measured;
            double square = 0.0;
            for (std::size_t axis = 0; axis < axes.size(); ++axis) {
                square = std::max(square, squared((*axes[axis])[i].position_m - (*motion[axis])[i].position_m));
            }
            constexpr double most = 1e12;
            squares[i] = std::min(square / variances_[i], most);
            if (square > squared(left_out_m) && squares[i] > squared(left_out_sd)) { far.push_back(i); }
        }
        // Where most contradict the motion, the motion is wrong, not they.
        if (2 * far.size() > measured) { far.clear(); }
        for (std::size_t i = 0; i < variances_.size(); ++i) {
            if (!std::isfinite(variances_[i])) { continue; }
            for (auto* axis : axes) {
                (*axis)[i].position_variance = variances_[i] * (freedom + squares[i]) / (freedom + 1.0);
            }
        }
        for (const std::size_t i : far) {
            for (auto* axis : axes) { (*axis)[i].position_variance = infinite; }
        }
        rejected_ = static_cast<long>(far.size());
    }

    long rejected() const { return rejected_; }

private:
    std::vector<double> variances_;
    long rejected_ = 0;
};

constexpr int rounds_of_doubt = 3;
/// A track of so few samples shows no errors.
constexpr std::size_t too_few = 8;
constexpr double exact_m = 0.003;

} // namespace

void PlaceSmoother::fit_horizontally() {
    const std::vector<AxisSeries> axes{series(0), series(1)};
    places_.horizontal_error_m = samples_.size() < too_few ? exact_m : most_likely_error_m(axes, exact_m);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        scale_variances(measured_[axis], squared(places_.horizontal_error_m));
    }
    Doubts doubts(measured_[0]);
    horizontal_jerk_ = fitted_jerk(axes).jerk;
    for (int round = 0; round < rounds_of_doubt; ++round) {
        for (std::size_t axis = 0; axis < 2; ++axis) { places_.axes[axis] = smoothed(series(axis), horizontal_jerk_); }
        const long before = doubts.rejected();
        doubts.weigh({&measured_[0], &measured_[1]}, {&places_.axes[0], &places_.axes[1]});
        if (doubts.rejected() != before) { horizontal_jerk_ = fitted_jerk(axes).jerk; }
    }
    places_.rejected += doubts.rejected();
}

/// Rounded heights: a row of equal ones says no more than a few of them, and where one step follows another the height
/// is half-way between, at a time half-way between.
void PlaceSmoother::measure_heights() {
    std::vector<double> heights_m;
    for (const TrackSample& sample : samples_) { heights_m.push_back(sample.position_m.z); }
    places_.height_step_m = height_step_m(heights_m);
    const double step_m = places_.height_step_m;
    if (step_m == 0.0) { return; }
    constexpr double independent_after_s = 20.0;
    std::vector<AxisMeasurement>& measured = measured_[2];
    for (std::size_t begin = 0; begin < measured.size();) {
        std::size_t end = begin;
        double count = 0.0;
        const double level_m = measured[begin].position_m;
        while (end < measured.size() &&
               (places_.samples[end] == SmoothedPlaces::no_sample || measured[end].position_m == level_m)) {
            count += places_.samples[end] == SmoothedPlaces::no_sample ? 0.0 : 1.0;
            ++end;
        }
        const double span_s = places_.times_s[end - 1] - places_.times_s[begin];
        const double independent = std::min(count, 1.0 + span_s / independent_after_s);
        for (std::size_t i = begin; i < end; ++i) {
            measured[i].position_variance *= count / std::max(1.0, independent);
        }
        begin = end;
    }
}

void PlaceSmoother::fit_vertically() {
    const double least_m = std::max(exact_m, places_.height_step_m / std::sqrt(12.0)); // of rounding
    places_.vertical_error_m = samples_.size() < too_few ? least_m : most_likely_error_m({series(2)}, least_m);
    scale_variances(measured_[2], squared(places_.vertical_error_m));
    Doubts doubts(measured_[2]);
    const std::vector<AxisSeries> axes{series(2)};
    vertical_jerk_ = fitted_jerk(axes).jerk;
    for (int round = 0; round < rounds_of_doubt; ++round) {
        places_.axes[2] = smoothed(series(2), vertical_jerk_);
        const long before = doubts.rejected();
        doubts.weigh({&measured_[2]}, {&places_.axes[2]});
        if (doubts.rejected() != before) { vertical_jerk_ = fitted_jerk(axes).jerk; }
    }
    places_.rejected += doubts.rejected();
}

namespace {

/// The velocity of a sample over the ground as far as it was measured, NaN otherwise.
glm::dvec3 measured_velocity_mps(const TrackSample& sample) {
    glm::dvec3 velocity_mps = sample.velocity_mps;
    if (std::isnan(velocity_mps.x) || std::isnan(velocity_mps.y)) {
        velocity_mps.x = sample.ground_speed_mps * std::sin(sample.track_rad);
        velocity_mps.y = sample.ground_speed_mps * std::cos(sample.track_rad);
    }
    return velocity_mps;
}

} // namespace

/// Measured velocities count by how well they agree with those of the places; where they contradict them, not at all.
void PlaceSmoother::measure_velocities() {
    constexpr double least_mps = 0.03;
    constexpr double contradiction_mps = 4.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double> differences;
        double known = 0.0;
        for (std::size_t i = 0; i < places_.samples.size(); ++i) {
            if (places_.samples[i] == SmoothedPlaces::no_sample) { continue; }
            const double value = measured_velocity_mps(samples_[places_.samples[i]])[static_cast<int>(axis)];
            if (std::isnan(value)) { continue; }
            measured_[axis][i].velocity_mps = value;
            measured_[axis][i].velocity_variance = 0.0; // for now: measured
            differences.push_back(std::abs(value - places_.axes[axis][i].velocity_mps));
            known += places_.axes[axis][i].velocity_variance;
        }
        constexpr double sd_of_median = 1.4826;
        const double difference_mps = sd_of_median * median_of(differences);
        const double error_mps = std::sqrt(std::max(squared(least_mps),
            squared(difference_mps) - known / std::max<double>(1.0, static_cast<double>(differences.size()))));
        for (std::size_t i = 0; i < measured_[axis].size(); ++i) {
            AxisMeasurement& one = measured_[axis][i];
            if (one.velocity_variance != 0.0) { continue; }
            const bool contradicts =
                difference_mps > contradiction_mps || std::abs(one.velocity_mps - places_.axes[axis][i].velocity_mps) >
                                                          std::max(contradiction_mps, 6.0 * error_mps);
            // Their errors last: two of three say nothing new.
            one.velocity_variance = contradicts ? infinite : 3.0 * squared(error_mps);
        }
    }
}

void PlaceSmoother::smooth() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        places_.axes[axis] = smoothed(series(axis), axis == 2 ? vertical_jerk_ : horizontal_jerk_);
    }
}

void PlaceSmoother::hold_at_rest(const std::vector<bool>& at_rest) {
    constexpr double rest_mps = 0.005;
    constexpr double margin_s = 3.0; // it may have begun to move, or not have stopped
    const std::size_t count = at_rest.size();
    std::vector<double> last_moving_s(count, -infinite);
    std::vector<double> next_moving_s(count, infinite);
    for (std::size_t i = 0; i < count; ++i) {
        const bool moves = !at_rest[i];
        last_moving_s[i] = moves ? places_.times_s[i] : i > 0 ? last_moving_s[i - 1] : -infinite;
    }
    for (std::size_t i = count; i-- > 0;) {
        next_moving_s[i] = !at_rest[i] ? places_.times_s[i] : i + 1 < count ? next_moving_s[i + 1] : infinite;
    }
    for (auto& axis : measured_) {
        for (std::size_t i = 0; i < count; ++i) {
            const double time_s = places_.times_s[i];
            if (time_s - last_moving_s[i] < margin_s || next_moving_s[i] - time_s < margin_s) { continue; }
            axis[i].velocity_mps = 0.0;
            axis[i].velocity_variance = squared(rest_mps);
        }
    }
    smooth();
}

} // namespace octant::flightpaths
