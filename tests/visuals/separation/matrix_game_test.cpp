#include "sim/base/random_generator.h"
#include "visuals/separation/separating_plane_proof.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

using namespace octant;
using visuals::separation::best_shares;
using visuals::separation::Payoffs;

namespace {

double worst(const Payoffs& payoffs, const std::vector<double>& shares) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < payoffs.cases(); ++k) {
        double sum = 0.0;
        for (std::size_t i = 0; i < payoffs.choices; ++i) {
            sum += payoffs.values[k * payoffs.choices + i] * shares[i];
        }
        least = std::min(least, sum);
    }
    return least;
}

Payoffs random_payoffs(RandomGenerator& dice, std::size_t choices, std::size_t cases) {
    Payoffs payoffs{choices, {}};
    for (std::size_t i = 0; i < choices * cases; ++i) { payoffs.values.push_back(dice.between(-1.0, 1.0)); }
    return payoffs;
}

} // namespace

TEST_CASE("paper, scissors and stone are played alike") {
    const auto shares = best_shares({3, {0, -1, 1, 1, 0, -1, -1, 1, 0}});
    for (const double share : shares) { CHECK(share == Approx(1.0 / 3.0)); }
}

TEST_CASE("a choice that always gives most is taken alone, also where all lose") {
    CHECK(best_shares({3, {1, 2, 0, 3, 4, 1}}) == std::vector<double>{0.0, 1.0, 0.0});
    CHECK(best_shares({2, {-3, -2, -9, -8}}) == std::vector<double>{0.0, 1.0});
    CHECK(best_shares({1, {0.0}}) == std::vector<double>{1.0});
}

// By the minimax theorem shares are best exactly if the other side, who sees them and has shares over the cases, can
// hold every choice down to the same value.
TEST_CASE("no shares are better than those found, by the other side's shares") {
    RandomGenerator dice(11);
    for (int round = 0; round < 300; ++round) {
        const auto choices = static_cast<std::size_t>(dice.between(1, 20));
        const auto cases = static_cast<std::size_t>(dice.between(1, 14));
        const Payoffs payoffs = random_payoffs(dice, choices, cases);
        Payoffs turned{cases, {}};
        for (std::size_t i = 0; i < choices; ++i) {
            for (std::size_t k = 0; k < cases; ++k) { turned.values.push_back(-payoffs.values[k * choices + i]); }
        }
        const auto shares = best_shares(payoffs);
        CHECK(*std::ranges::min_element(shares) >= 0.0);
        CHECK(std::accumulate(shares.begin(), shares.end(), 0.0) == Approx(1.0));
        CHECK(worst(payoffs, shares) == Approx(-worst(turned, best_shares(turned))).margin(1e-11));
        CHECK(shares == best_shares(payoffs));
    }
}
