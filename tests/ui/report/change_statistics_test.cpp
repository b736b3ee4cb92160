#include "sim/base/random_generator.h"
#include "ui/report/change_statistics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::report;

namespace {

std::vector<double> drawn(RandomGenerator& dice, std::size_t count, double middle = 0.0) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) { values.push_back(middle + dice.normal_deviate()); }
    return values;
}

/// Sum of the ranks of the differences above `shift`, by counting.
double rank_sum_above(const std::vector<double>& differences, double shift, unsigned flipped) {
    double sum = 0.0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
        const double size = std::abs(differences[i] - shift);
        const auto rank = std::ranges::count_if(differences, [&](double d) { return std::abs(d - shift) <= size; });
        const bool is_above = (differences[i] > shift) != ((flipped >> i & 1U) != 0);
        sum += is_above ? static_cast<double>(rank) : 0.0;
    }
    return sum;
}

/// P that the centre is `shift`, by trying all signs.
double p_by_all_signs(const std::vector<double>& differences, double shift) {
    const auto count = static_cast<double>(differences.size());
    const double middle = count * (count + 1.0) / 4.0;
    const double far = std::abs(rank_sum_above(differences, shift, 0) - middle);
    unsigned as_far = 0;
    const unsigned choices = 1U << differences.size();
    for (unsigned flipped = 0; flipped < choices; ++flipped) {
        if (std::abs(rank_sum_above(differences, shift, flipped) - middle) >= far - 1e-9) { ++as_far; }
    }
    return static_cast<double>(as_far) / choices;
}

std::vector<Trial> trials_of(const std::string& order, const std::vector<double>& values) {
    std::vector<Trial> trials;
    for (std::size_t i = 0; i < order.size(); ++i) {
        trials.push_back({order[i] == 'o' ? Side::Old : Side::New, values[i]});
    }
    return trials;
}

} // namespace

TEST_CASE("quantiles of Student's t are those of the tables") {
    CHECK(student_t_quantile(1, 0.025) == Approx(12.7062).margin(5e-4));
    CHECK(student_t_quantile(2, 0.025) == Approx(4.30265).margin(5e-5));
    CHECK(student_t_quantile(4, 0.025) == Approx(2.77645).margin(5e-5));
    CHECK(student_t_quantile(9, 0.05) == Approx(1.83311).margin(5e-5));
    CHECK(student_t_quantile(30, 0.005) == Approx(2.74999).margin(5e-5));
    CHECK(student_t_p(7, 2.36462) == Approx(0.05).margin(1e-5));
    CHECK(student_t_p(3, 0.0) == 1.0);
}

TEST_CASE("the interval of a centre holds what a permutation of all signs does not refuse") {
    RandomGenerator dice(52);
    for (const std::size_t count : {6U, 7U, 8U, 9U, 10U}) {
        for (int trial = 0; trial < 4; ++trial) {
            const std::vector<double> differences = drawn(dice, count, 0.4);
            const Change change = *centre_of(differences);
            CHECK(change.p == Approx(p_by_all_signs(differences, 0.0)));
            constexpr double step = 1e-7;
            CHECK(p_by_all_signs(differences, change.low - step) <= 0.05);
            CHECK(p_by_all_signs(differences, change.low + step) > 0.05);
            CHECK(p_by_all_signs(differences, change.high + step) <= 0.05);
            CHECK(p_by_all_signs(differences, change.high - step) > 0.05);
            CHECK(change.low < change.estimate);
            CHECK(change.estimate < change.high);
        }
    }
}

TEST_CASE("three to five differences have Student's interval, two have none") {
    const std::vector<double> differences{0.02, 0.03, 0.04};
    const Change change = *centre_of(differences);
    CHECK(change.estimate == Approx(0.03));
    CHECK(change.low == Approx(0.03 - 4.30265 * 0.01 / std::sqrt(3.0)).epsilon(1e-5));
    CHECK(change.p == Approx(student_t_p(2, 0.03 / (0.01 / std::sqrt(3.0)))));
    CHECK_FALSE(centre_of(std::span(differences).first(2)));
}

TEST_CASE("differences that are all the same or zero have the answer that follows") {
    CHECK(centre_of(std::vector(8, 0.0))->p == 1.0);
    CHECK_FALSE(centre_of(std::vector(8, 0.0))->excludes_zero());
    const Change same = *centre_of(std::vector(8, 0.5));
    CHECK(same.low == 0.5);
    CHECK(same.high == 0.5);
    CHECK(same.p == Approx(2.0 / 256.0));
    CHECK(centre_of(std::vector(3, 0.5))->p == 0.0);
}

TEST_CASE("Mann and Whitney's p is that of all choices") {
    RandomGenerator dice(5);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<double> all;
        for (int i = 0; i < 9; ++i) { all.push_back(std::floor(6.0 * dice.next())); } // with ties
        const auto difference = [&](unsigned chosen) {                                // of wins of the chosen four
            double wins = 0.0;
            for (std::size_t i = 0; i < 9; ++i) {
                for (std::size_t j = 0; j < 9; ++j) {
                    if ((chosen >> i & 1U) == 0 || (chosen >> j & 1U) != 0) { continue; }
                    wins += all[i] > all[j] ? 1.0 : (all[i] < all[j] ? -1.0 : 0.0);
                }
            }
            return std::abs(wins);
        };
        int as_far = 0;
        int choices = 0;
        for (unsigned chosen = 0; chosen < 512; ++chosen) {
            if (std::popcount(chosen) != 4) { continue; }
            ++choices;
            as_far += difference(chosen) >= difference(15) - 1e-9 ? 1 : 0;
        }
        const std::span values(all);
        CHECK(mann_whitney_p(values.first(4), values.subspan(4)) == Approx(static_cast<double>(as_far) / choices));
    }
    RandomGenerator many(6);
    const double p = mann_whitney_p(drawn(many, 60), drawn(many, 60, 0.5));
    CHECK(p < 0.05);
    CHECK(mann_whitney_p({}, std::vector{1.0}) == 1.0);
}

TEST_CASE("p values are adjusted for their number as Holm does") {
    const std::vector<double> p{0.01, 0.04, 0.03, 0.005};
    const std::vector<double> adjusted = holm_adjusted(p);
    const std::vector<double> expected{0.03, 0.06, 0.06, 0.02};
    for (std::size_t i = 0; i < p.size(); ++i) { CHECK(adjusted[i] == Approx(expected[i])); }
    CHECK(holm_adjusted({}).empty());
}

TEST_CASE("among many comparisons p is Student's where ranks of so few rounds are never certain") {
    const std::vector<double> differences{0.10, 0.11, 0.09, 0.10, 0.12, 0.08, 0.10};
    const Change change = *centre_of(differences);
    CHECK(change.p == Approx(2.0 / 128.0));
    CHECK(change.p_among(1) == change.p);
    CHECK(change.p_among(3) == change.p); // 3 * 2 / 128 is below 5 %
    CHECK(change.p_among(4) == mean_of(differences)->p);
    CHECK(change.p_among(4) < 1e-5);
    const Change few = *centre_of(std::span(differences).first(4));
    CHECK(few.p_among(100) == few.p); // is Student's already
}

TEST_CASE("flights are in rounds where both sides alternate and not always in the same order") {
    const std::vector<double> values(8, 1.0);
    CHECK(is_in_rounds(trials_of("onnoonno", values)));
    CHECK_FALSE(is_in_rounds(trials_of("onononon", values)));
    CHECK_FALSE(is_in_rounds(trials_of("oooonnnn", values)));
    CHECK_FALSE(is_in_rounds(trials_of("onnoo", values)));
    CHECK_FALSE(is_in_rounds({}));
    CHECK(round_differences(trials_of("onno", {1.0, 3.0, 7.0, 4.0})) == std::vector{2.0, 3.0});
}

TEST_CASE("drift of the machine between two sides flown one after the other is no change") {
    const std::vector<double> drifting{0.00, 0.05, 0.10, 0.15, 0.20, 0.25};
    CHECK_FALSE(change_of(trials_of("ooonnn", drifting))->excludes_zero());
    const std::vector<double> jump{0.000, 0.010, 0.005, 0.300, 0.310, 0.305};
    CHECK(change_of(trials_of("ooonnn", jump))->excludes_zero());
    CHECK(change_of(trials_of("ooonnn", jump))->estimate == Approx(0.3));
    CHECK_FALSE(change_of(trials_of("oonn", {0.0, 0.0, 1.0, 1.0})));
}

TEST_CASE("of comparisons of the same thing on a machine that drifts about 5 in 100 show a change, in any order") {
    struct Case {
        std::string order;
        double walk;
        double own;
    };

    for (const Case& each : {Case{"ooonnn", 0.03, 0.005}, Case{"ononononon", 0.0, 0.01}, Case{"onnoonon", 0.03, 0.01},
             Case{"onnononoonno", 0.02, 0.02}, Case{"oooonnnn", 0.0, 0.01}}) {
        RandomGenerator dice(1947);
        int changed = 0;
        constexpr int trials = 1000;
        for (int trial = 0; trial < trials; ++trial) {
            double drift = 0.0;
            std::vector<double> values;
            for (std::size_t i = 0; i < each.order.size(); ++i) {
                drift += each.walk * dice.normal_deviate();
                values.push_back(drift + each.own * dice.normal_deviate());
            }
            changed += change_of(trials_of(each.order, values))->excludes_zero() ? 1 : 0;
        }
        INFO(each.order);
        CHECK(changed <= 70); // 5 % of 1000, and three standard deviations
    }
}
