// Finds where a staircase first exceeds a limit without sorting all of its steps: a histogram tells the bin in which it
// may happen, and only the steps of that bin are sorted.
#include "visuals/terrain/budget_search.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace octant::visuals::terrain {

void StepFunction::start(float low, float high) {
    assert(low >= 0.0F && low <= high);
    low_ = low;
    high_ = high;
    total_ = 0;
    rise_ = 0;
    below_ = 0;
    decrease_below_ = 0;
    steps_.clear();
    const std::uint32_t width = std::bit_cast<std::uint32_t>(high) - std::bit_cast<std::uint32_t>(low);
    bin_shift_ = 0;
    while ((width >> bin_shift_) >= bins) { ++bin_shift_; }
}

/// The bin of a place. Bins are evenly spaced over the bits of floating-point numbers, which is roughly over their
/// logarithm.
std::size_t StepFunction::bin_of(float place) const {
    return (std::bit_cast<std::uint32_t>(place) - std::bit_cast<std::uint32_t>(low_)) >> bin_shift_;
}

std::optional<float> StepFunction::first_above(int limit) {
    assert(below_ <= limit);
    if (rise_ <= limit) { return std::nullopt; }
    change_of_bin_.fill(0);
    rise_of_bin_.fill(0);
    for (const Step& step : steps_) {
        const std::size_t bin = bin_of(step.place);
        change_of_bin_[bin] += step.change;
        rise_of_bin_[bin] += std::max(step.change, 0);
    }
    int count = below_;
    for (std::size_t bin = 0; bin < bins; ++bin) {
        if (count + rise_of_bin_[bin] > limit) {
            if (const auto place = first_above_in(bin, count, limit)) { return place; }
        }
        count += change_of_bin_[bin];
    }
    return std::nullopt;
}

/// first_above among the steps of one bin; `count` is N before it.
std::optional<float> StepFunction::first_above_in(std::size_t bin, int count, int limit) {
    steps_of_bin_.clear();
    for (const Step& step : steps_) {
        if (bin_of(step.place) == bin) { steps_of_bin_.push_back(step); }
    }
    std::sort(
        steps_of_bin_.begin(), steps_of_bin_.end(), [](const Step& a, const Step& b) { return a.place < b.place; });
    for (std::size_t k = 0; k < steps_of_bin_.size(); ++k) {
        count += steps_of_bin_[k].change;
        const float place = steps_of_bin_[k].place;
        const bool last_there = k + 1 == steps_of_bin_.size() || steps_of_bin_[k + 1].place != place;
        if (last_there && count > limit) { return place; }
    }
    return std::nullopt;
}

} // namespace octant::visuals::terrain
