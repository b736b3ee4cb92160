#include "visuals/draworder/search_budget.h"

#include <fmt/format.h>

namespace octant::visuals::draworder {

void SearchBudget::spend(std::uint64_t units) {
    spent_s_ += static_cast<double>(units) * 1e-9;
    if (spent_s_ > seconds_) {
        throw SearchGivenUp{fmt::format("the search for cells took more than {:g} s", seconds_)};
    }
    if (progress_) { progress_(spent_s_ / seconds_); }
}

} // namespace octant::visuals::draworder
