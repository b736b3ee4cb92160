#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::refine {

/// A half-open range [first, end) of indices into an array.
struct SlotRange {
    std::size_t first = 0;
    std::size_t end = 0;

    bool operator==(const SlotRange&) const = default;
};

/// Remembers which blocks of an array were written since take() was last called, so that only these
/// are uploaded to the graphics card.
class DirtyBlocks {
public:
    static constexpr std::size_t block_size = 64;

    void mark(std::size_t place) {
        const std::size_t block = place / block_size;
        if (block >= marks_.size()) {
            marks_.resize(block + 1, 0);
        }
        marks_[block] = 1;
    }

    /// Marks the block of a place when `written` is true, without a branch. The block must have
    /// been marked at some time before, so that its mark exists.
    void mark_if(std::size_t place, bool written) {
        marks_[place / block_size] |= static_cast<std::uint8_t>(written);
    }

    /// Puts the maximal runs of marked blocks into `ranges`, ascending and cut off at `size`
    /// places, and clears all marks.
    void take(std::size_t size, std::vector<SlotRange>& ranges) {
        ranges.clear();
        for (std::size_t block = 0; block < marks_.size(); ++block) {
            if (marks_[block] == 0) {
                continue;
            }
            marks_[block] = 0;
            const std::size_t first = block * block_size;
            const std::size_t end = first + block_size < size ? first + block_size : size;
            if (!ranges.empty() && ranges.back().end == first) {
                ranges.back().end = end;
            } else if (first < end) {
                ranges.push_back({first, end});
            }
        }
    }

    std::size_t bytes() const { return marks_.capacity(); }

private:
    std::vector<std::uint8_t> marks_;
};

} // namespace octant::visuals::refine
