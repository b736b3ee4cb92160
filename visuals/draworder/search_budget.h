#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <string>
#include <utility>

namespace octant::visuals::draworder {

/// Thrown where a search for cells ends without a result: its budget is spent, or the model has no cells that could be
/// held. ordered() catches it and takes another way.
struct SearchGivenUp {
    std::string reason; ///< Such as "the search took longer than 20 s".
    /// Whether only because another order is known that costs less.
    bool is_worse_than_best = false;
};

/// What a search may cost. Work is counted, not timed, so that the same model gives the same order on every machine: a
/// unit is what takes about a nanosecond of one core of 2020.
class SearchBudget {
public:
    /// Told how much of the budget is spent, 0 to 1.
    using Progress = std::function<void(double)>;

    explicit SearchBudget(double seconds, Progress progress = {}) : seconds_(seconds), progress_(std::move(progress)) {}

    /// Counts work, before it is done or after. Throws SearchGivenUp when the budget is spent.
    void spend(std::uint64_t units) {
        spent_s_ += static_cast<double>(units) * 1e-9;
        if (spent_s_ > seconds_) {
            throw SearchGivenUp{fmt::format("the search for cells took more than {:g} s", seconds_)};
        }
        if (progress_) { progress_(spent_s_ / seconds_); }
    }

private:
    double seconds_;
    Progress progress_;
    double spent_s_ = 0.0;
};

} // namespace octant::visuals::draworder
