#include "ui/report/change_statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

namespace octant::ui::report {

namespace {

constexpr std::size_t min_differences = 3;
constexpr std::size_t min_ranked_differences = 6; ///< five signs alone cannot reach 5 %

/// Twice the rank of each value among all, from 2 upwards; equal values share the mean of their ranks, so that twice it
/// is whole.
std::vector<std::size_t> doubled_ranks(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<std::size_t> ranks(values.size());
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin;
        while (end < order.size() && values[order[end]] == values[order[begin]]) { ++end; }
        for (std::size_t i = begin; i < end; ++i) { ranks[order[i]] = begin + end + 1; }
        begin = end;
    }
    return ranks;
}

/// Shares of all 2^n choices of signs by the sum of the ranks with a plus: element s is that of the sum s.
std::vector<double> sum_shares(std::span<const std::size_t> ranks) {
    std::vector<double> shares(std::accumulate(ranks.begin(), ranks.end(), std::size_t{1}), 0.0);
    shares[0] = 1.0;
    for (const std::size_t rank : ranks) {
        for (std::size_t sum = shares.size(); sum-- > 0;) {
            shares[sum] = 0.5 * (shares[sum] + (sum >= rank ? shares[sum - rank] : 0.0));
        }
    }
    return shares;
}

/// Share of the sums that are as far from their middle as `sum`, or further.
double two_sided_p(const std::vector<double>& shares, std::size_t sum) {
    const std::size_t lower = std::min(sum, shares.size() - 1 - sum);
    double below = 0.0;
    for (std::size_t s = 0; s <= lower; ++s) { below += shares[s]; }
    return std::min(1.0, 2.0 * below);
}

double signed_rank_p(std::span<const double> differences) {
    std::vector<double> sizes;
    for (const double difference : differences) { sizes.push_back(std::abs(difference)); }
    const std::vector<std::size_t> ranks = doubled_ranks(sizes);
    std::vector<std::size_t> counted;
    std::size_t above = 0;
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        if (differences[i] == 0.0) { continue; } // speaks for neither side
        counted.push_back(ranks[i]);
        above += differences[i] > 0.0 ? ranks[i] : 0;
    }
    return counted.empty() ? 1.0 : two_sided_p(sum_shares(counted), above);
}

Change by_signed_ranks(std::span<const double> differences) {
    std::vector<double> means; // of all pairs, each value paired with itself, too
    for (std::size_t i = 0; i < differences.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) { means.push_back(0.5 * (differences[i] + differences[j])); }
    }
    std::ranges::sort(means);
    std::vector<std::size_t> ranks(differences.size());
    std::iota(ranks.begin(), ranks.end(), std::size_t{1});
    const std::vector<double> shares = sum_shares(ranks);
    std::size_t outside = 0; // means on each side that the interval leaves out
    for (double below = shares[0]; 2.0 * below <= significance_level; below += shares[outside]) { ++outside; }
    assert(outside > 0);
    const double least_p = std::min(1.0, 2.0 * shares[0]);
    return {median_of(means), means[outside - 1], means[means.size() - outside], signed_rank_p(differences), least_p,
        mean_of(differences)->p};
}

double sum_of_squares(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0, [](double sum, double v) { return sum + v * v; });
}

Change by_student(double estimate, double error, int degrees) {
    const double reach = student_t_quantile(degrees, 0.5 * significance_level) * error;
    const double p = error > 0.0 ? student_t_p(degrees, estimate / error) : (estimate == 0.0 ? 1.0 : 0.0);
    return {estimate, estimate - reach, estimate + reach, p};
}

double mean_of_side(std::span<const Trial> trials, Side side) {
    double sum = 0.0;
    int count = 0;
    for (const Trial& trial : trials) {
        if (trial.side == side) {
            sum += trial.value;
            ++count;
        }
    }
    return sum / count;
}

/// Variance of the difference of the means when the machine's speed is a random walk whose steps from flight to flight
/// have a variance of 1.
double variance_of_walk(std::span<const Trial> trials, double old_count, double new_count) {
    double variance = 0.0;
    double weight = 0.0; // of the step before this flight in the difference of the means
    for (const Trial& trial : trials) {
        variance += weight * weight;
        weight += trial.side == Side::Old ? 1.0 / old_count : -1.0 / new_count;
    }
    return variance;
}

std::optional<Change> change_out_of_rounds(std::span<const Trial> trials) {
    const auto old_count = static_cast<std::size_t>(std::ranges::count(trials, Side::Old, &Trial::side));
    const std::size_t new_count = trials.size() - old_count;
    if (old_count < min_differences || new_count < min_differences) { return std::nullopt; }
    const double old_mean = mean_of_side(trials, Side::Old);
    const double new_mean = mean_of_side(trials, Side::New);
    std::vector<double> rests; // of the values without their side's mean, and the steps between them
    std::vector<double> steps;
    for (const Trial& trial : trials) {
        const double rest = trial.value - (trial.side == Side::Old ? old_mean : new_mean);
        if (!rests.empty()) { steps.push_back(rest - rests.back()); }
        rests.push_back(rest);
    }
    const auto m = static_cast<double>(old_count);
    const auto n = static_cast<double>(new_count);
    const auto degrees = static_cast<double>(trials.size() - 2);
    const double independent = sum_of_squares(rests) / degrees * (1.0 / m + 1.0 / n);
    const double walk = sum_of_squares(steps) / degrees * variance_of_walk(trials, m, n);
    return by_student(new_mean - old_mean, std::sqrt(std::max(independent, walk)), static_cast<int>(degrees));
}

} // namespace

double median_of(std::vector<double> values) {
    assert(!values.empty());
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 != 0 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

bool is_in_rounds(std::span<const Trial> trials) {
    if (trials.empty() || trials.size() % 2 != 0) { return false; }
    std::size_t old_first = 0;
    for (std::size_t i = 0; i < trials.size(); i += 2) {
        if (trials[i].side == trials[i + 1].side) { return false; }
        if (trials[i].side == Side::Old) { ++old_first; }
    }
    return old_first > 0 && 2 * old_first < trials.size();
}

std::vector<double> round_differences(std::span<const Trial> trials) {
    std::vector<double> differences;
    for (std::size_t i = 0; i + 1 < trials.size(); i += 2) {
        const bool is_old_first = trials[i].side == Side::Old;
        const double later_less_first = trials[i + 1].value - trials[i].value;
        differences.push_back(is_old_first ? later_less_first : -later_less_first);
    }
    return differences;
}

std::optional<Change> mean_of(std::span<const double> differences) {
    const std::size_t count = differences.size();
    if (count < min_differences) { return std::nullopt; }
    const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) / static_cast<double>(count);
    std::vector<double> rests;
    for (const double difference : differences) { rests.push_back(difference - mean); }
    const double error = std::sqrt(sum_of_squares(rests) / static_cast<double>(count * (count - 1)));
    return by_student(mean, error, static_cast<int>(count) - 1);
}

std::optional<Change> centre_of(std::span<const double> differences) {
    if (differences.size() < min_ranked_differences) { return mean_of(differences); }
    return by_signed_ranks(differences);
}

std::optional<Change> change_of(std::span<const Trial> trials) {
    return is_in_rounds(trials) ? centre_of(round_differences(trials)) : change_out_of_rounds(trials);
}

double mann_whitney_p(std::span<const double> before, std::span<const double> after) {
    if (before.empty() || after.empty()) { return 1.0; }
    std::vector<double> all(before.begin(), before.end());
    all.insert(all.end(), after.begin(), after.end());
    const std::vector<std::size_t> ranks = doubled_ranks(all);
    const std::size_t sum = std::accumulate(ranks.begin(), ranks.begin() + std::ssize(before), std::size_t{0});
    const auto n = static_cast<double>(all.size());
    const auto m = static_cast<double>(before.size());
    if (all.size() > 60) {
        const double mean = m * (n + 1.0); // of twice the sum of ranks
        double variance = 0.0;
        for (const std::size_t rank : ranks) { variance += std::pow(static_cast<double>(rank) - (n + 1.0), 2); }
        variance *= m * (n - m) / (n * (n - 1.0));
        const double z = variance > 0.0 ? std::abs(static_cast<double>(sum) - mean) / std::sqrt(variance) : 0.0;
        return std::erfc(z / std::numbers::sqrt2);
    }
    // Shares of all choices of k of the values by the sum of their ranks.
    const std::size_t total = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
    std::vector<std::vector<double>> ways(before.size() + 1, std::vector<double>(total + 1, 0.0));
    ways[0][0] = 1.0;
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        for (std::size_t k = std::min(before.size(), i + 1); k > 0; --k) {
            for (std::size_t s = ranks[i]; s <= total; ++s) { ways[k][s] += ways[k - 1][s - ranks[i]]; }
        }
    }
    const std::vector<double>& sums = ways.back();
    const double mean = m * (n + 1.0);
    const double far = std::abs(static_cast<double>(sum) - mean);
    double as_far = 0.0;
    double of_all = 0.0;
    for (std::size_t s = 0; s <= total; ++s) {
        of_all += sums[s];
        as_far += std::abs(static_cast<double>(s) - mean) >= far ? sums[s] : 0.0;
    }
    return as_far / of_all;
}

std::vector<double> holm_adjusted(std::span<const double> p_values) {
    std::vector<std::size_t> order(p_values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p_values[i]; });
    std::vector<double> adjusted(p_values.size());
    double greatest = 0.0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        greatest = std::max(greatest, static_cast<double>(order.size() - k) * p_values[order[k]]);
        adjusted[order[k]] = std::min(1.0, greatest);
    }
    return adjusted;
}

double student_t_p(int degrees, double t) {
    // M. Abramowitz and I. A. Stegun, "Handbook of Mathematical Functions", 26.7.3 and 26.7.4.
    const double angle = std::atan(std::abs(t) / std::sqrt(degrees));
    const double cos_squared = std::cos(angle) * std::cos(angle);
    const bool is_odd = degrees % 2 != 0;
    double term = is_odd ? std::cos(angle) : 1.0;
    double sum = degrees == 1 ? 0.0 : term;
    for (int k = is_odd ? 3 : 2; k < degrees; k += 2) {
        term *= cos_squared * (k - 1) / k;
        sum += term;
    }
    const double within = is_odd ? 2.0 / std::numbers::pi * (angle + std::sin(angle) * sum) : std::sin(angle) * sum;
    return std::clamp(1.0 - within, 0.0, 1.0);
}

double student_t_quantile(int degrees, double probability) {
    double low = 0.0;
    double high = 1.0;
    while (student_t_p(degrees, high) > 2.0 * probability) { high *= 2.0; }
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (student_t_p(degrees, middle) > 2.0 * probability ? low : high) = middle;
    }
    return high;
}

} // namespace octant::ui::report
