#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::terrain {

/// A whole number N that changes in steps along a line of values at or above zero: N(x) is the sum
/// of all changes at places below x. Knows single steps only between two bounds and takes those
/// below as one, so that many steps cost little.
class StepCount {
public:
    /// Forgets all steps. 0 <= low <= high (asserted).
    void start(float low, float high);

    /// A step at `place` below high.
    void add(float place, int change) {
        total_ += change;
        if (place < low_) {
            below_ += change;
            fallen_below_ += change < 0 ? -change : 0;
            return;
        }
        steps_.push_back({place, change});
    }

    int at_high() const { return total_; } ///< N(high)

    int at_low() const { return below_; } ///< N(low)

    /// At or above every N(x), x <= low.
    int most_below_low() const { return below_ + fallen_below_; }

    /// The largest x from low to high so that N(y) <= limit for all y from low to x; nothing where
    /// that holds up to high. N(low) is within the limit (asserted).
    std::optional<float> first_above(int limit);

private:
    struct Step {
        float place;
        int change;
    };

    static constexpr std::size_t bins = 4096;

    std::size_t bin_of(float place) const;
    std::optional<float> first_above_in(std::size_t bin, int count, int limit);

    float low_ = 0.0F;
    float high_ = 0.0F;
    unsigned bin_shift_ = 0;
    int total_ = 0;
    int below_ = 0;
    int fallen_below_ = 0;
    std::vector<Step> steps_;
    std::vector<Step> steps_of_bin_;
    std::array<int, bins> change_{};
    std::array<int, bins> rise_{}; ///< sum of the changes above zero
};

} // namespace octant::visuals::terrain
