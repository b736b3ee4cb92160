// G. Dantzig's way to solve a game by the simplex method: with all payoffs positive the other
// player's programme, to maximise the sum of y with y >= 0 and at most 1 for each choice, begins at
// y = 0, and its dual variables are proportional to the shares.
#include "visuals/separation/matrix_game.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace octant::visuals::separation {

namespace {

constexpr double rounding = 1e-13;

/// A row for each choice and one for the aim, a column for each case and one for the bounds.
class Tableau {
public:
    explicit Tableau(const Payoffs& payoffs)
        : choices_(payoffs.choices)
        , cases_(payoffs.cases())
        , wide_(cases_ + 1)
        , cells_((choices_ + 1) * wide_, 0.0)
        , of_row_(choices_)
        , of_column_(cases_) {
        const double shift = 1.0 - *std::ranges::min_element(payoffs.values);
        for (std::size_t i = 0; i < choices_; ++i) {
            for (std::size_t k = 0; k < cases_; ++k) {
                at(i, k) = payoffs.values[k * choices_ + i] + shift;
            }
            at(i, cases_) = 1.0;
        }
        for (std::size_t k = 0; k < cases_; ++k) {
            at(choices_, k) = -1.0;
        }
        std::iota(of_row_.begin(), of_row_.end(), std::size_t{0});
        std::iota(of_column_.begin(), of_column_.end(), choices_);
    }

    std::vector<double> shares() {
        // Far more steps than are ever needed: a circle would end here.
        const std::size_t max_steps = 8 * (choices_ + cases_) + 32;
        for (std::size_t step = 0; step < max_steps; ++step) {
            const std::size_t column = entering();
            if (column == cases_) {
                break;
            }
            exchange(leaving(column), column);
        }
        std::vector<double> shares(choices_, 0.0);
        double sum = 0.0;
        for (std::size_t k = 0; k < cases_; ++k) {
            if (of_column_[k] < choices_) {
                sum += shares[of_column_[k]] = std::max(at(choices_, k), 0.0);
            }
        }
        for (double& share : shares) {
            share = sum > 0.0 ? share / sum : 1.0 / static_cast<double>(choices_);
        }
        return shares;
    }

private:
    double& at(std::size_t row, std::size_t column) { return cells_[row * wide_ + column]; }

    /// The column that improves the aim most; none at the optimum.
    std::size_t entering() {
        const auto row = cells_.begin() + static_cast<std::ptrdiff_t>(choices_ * wide_);
        const auto least = std::min_element(row, row + static_cast<std::ptrdiff_t>(cases_));
        return *least < -rounding ? static_cast<std::size_t>(least - row) : cases_;
    }

    /// The row whose bound is met first. There is one: all payoffs are positive.
    std::size_t leaving(std::size_t column) {
        std::size_t first = choices_;
        double least = 0.0;
        for (std::size_t i = 0; i < choices_; ++i) {
            if (at(i, column) <= rounding) {
                continue;
            }
            const double ratio = at(i, cases_) / at(i, column);
            if (first == choices_ || ratio < least) {
                first = i;
                least = ratio;
            }
        }
        return std::min(first, choices_ - 1);
    }

    void exchange(std::size_t row, std::size_t column) {
        const double pivot = at(row, column);
        for (std::size_t k = 0; k < wide_; ++k) {
            at(row, k) = k == column ? 1.0 / pivot : at(row, k) / pivot;
        }
        for (std::size_t i = 0; i <= choices_; ++i) {
            if (i == row) {
                continue;
            }
            const double factor = at(i, column);
            for (std::size_t k = 0; k < wide_ && factor != 0.0; ++k) {
                at(i, k) = k == column ? -factor / pivot : at(i, k) - factor * at(row, k);
            }
        }
        std::swap(of_row_[row], of_column_[column]);
    }

    std::size_t choices_;
    std::size_t cases_;
    std::size_t wide_;
    std::vector<double> cells_;
    std::vector<std::size_t> of_row_; ///< What stands there: choices, then cases.
    std::vector<std::size_t> of_column_;
};

} // namespace

std::vector<double> best_shares(const Payoffs& payoffs) {
    assert(payoffs.cases() > 0);
    return Tableau(payoffs).shares();
}

} // namespace octant::visuals::separation
