// Selection of the greatest keys by counting: one pass fills a histogram over the keys' top 12 bits, a scan from the
// top finds the bucket in which the count is reached, and std::nth_element orders that bucket only.
#include "visuals/shading/largest_keys.h"

#include <algorithm>
#include <cassert>

namespace octant::visuals::shading {

void LargestKeySelector::choose(
    std::span<const std::uint32_t> keys, std::size_t count, std::span<std::uint8_t> chosen) {
    assert(count <= keys.size() && chosen.size() == keys.size());
    if (count == 0 || count == keys.size()) {
        std::ranges::fill(chosen, count == 0 ? std::uint8_t{0} : std::uint8_t{1});
        return;
    }
    counts_.fill(0);
    for (const std::uint32_t key : keys) { ++counts_[key >> bucket_shift]; }
    std::size_t bucket = counts_.size() - 1;
    std::size_t left = count; // How many of the chosen keys lie in this bucket and below.
    while (counts_[bucket] < left) { left -= counts_[bucket--]; }
    border_.clear();
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
        const std::size_t own = keys[i] >> bucket_shift;
        chosen[i] = own > bucket ? 1 : 0;
        if (own == bucket) { border_.push_back(i); }
    }
    const auto last = border_.begin() + static_cast<std::ptrdiff_t>(left);
    if (last != border_.end()) {
        std::ranges::nth_element(border_, last,
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] > keys[b] : a < b; });
    }
    std::for_each(border_.begin(), last, [&](std::uint32_t i) { chosen[i] = 1; });
}

} // namespace octant::visuals::shading
