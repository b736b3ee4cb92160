#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace octant::ui::report {

/// Changes whose probability without a cause is at most this are taken for changes; intervals leave out as much.
inline constexpr double significance_level = 0.05;

/// Which of two variants a flight is of: the one compared with, or the one in question.
enum class Side { Old, New };

/// One figure of one flight.
struct Trial {
    Side side = Side::Old;
    double value = 0.0; ///< for a change in percent: the natural logarithm of the figure
};

/// How much a figure of the new side is above that of the old side.
struct Change {
    double estimate = 0.0;
    double low = 0.0;       ///< 95 % interval
    double high = 0.0;      ///< 95 % interval
    double p = 1.0;         ///< probability of at least such a change, either way, where there is none
    double least_p = 0.0;   ///< that the test of p can give
    double student_p = 1.0; ///< the probability by Student's t, where the test of p is another

    /// P for so many comparisons: by Student's t where even the least p of its test is no change among them.
    double p_among(std::size_t comparisons) const {
        return least_p * static_cast<double>(comparisons) > significance_level ? student_p : p;
    }

    bool excludes_zero() const { return low > 0.0 || high < 0.0; }
};

/// The middle value, or the mean of the two in the middle. At least one value.
double median_of(std::vector<double> values);

/// Whether flights, in the order of time, alternate so that a slow drift of the machine hardly matters: they form
/// rounds of one flight of each side, and the order within the rounds is not always the same.
bool is_in_rounds(std::span<const Trial> trials);

/// The differences new - old of the rounds. `trials` are in rounds.
std::vector<double> round_differences(std::span<const Trial> trials);

/// The centre of differences that are independent and as likely above as below it. Six or more: the interval and the p
/// of Wilcoxon's signed ranks, exact for any distribution (J. L. Hodges and E. L. Lehmann, "Estimates of location based
/// on rank tests", 1963). Three to five: Student's t. Fewer: nothing.
std::optional<Change> centre_of(std::span<const double> differences);

/// The mean of differences by Student's t. Needs three differences or more.
std::optional<Change> mean_of(std::span<const double> differences);

/// The change between two sides, from flights in the order of time. In rounds: centre_of() their differences. Else the
/// difference of the means; its interval holds for independent flights as well as for a machine whose speed drifts
/// like a random walk, which makes it two to three times as wide. Needs three flights of each side.
std::optional<Change> change_of(std::span<const Trial> trials);

/// P of Mann and Whitney's U, two-sided and exact also with ties, of two samples with up to 60 values together;
/// by the normal distribution above that. 1 where a sample is empty.
double mann_whitney_p(std::span<const double> before, std::span<const double> after);

/// P values, each as it counts among all of them (S. Holm, "A simple sequentially rejective multiple test procedure",
/// 1979): where those up to 0.05 are taken for changes, the probability that any of them is none is below 0.05.
std::vector<double> holm_adjusted(std::span<const double> p_values);

/// The value that a variable of Student's t distribution with `degrees` (>= 1) of freedom exceeds with the given
/// probability in (0, 0.5).
double student_t_quantile(int degrees, double probability);

/// The probability that such a variable is further from zero than `t`.
double student_t_p(int degrees, double t);

} // namespace octant::ui::report
