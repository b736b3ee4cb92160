#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::terrain {

/// A whole number N that changes in steps along a line of values at or above zero: N(x) is the sum of all changes at
/// places below x. It knows single steps only between two bounds and sums up those below, so that many steps cost
/// little.
class StepFunction {
public:
    /// Forgets all steps and sets the bounds, 0 <= low <= high (asserted).
    void start(float low, float high);

    /// Adds a step at a place below high.
    void add(float place, int change) {
        total_ += change;
        if (place < low_) {
            below_ += change;
            decrease_below_ += change < 0 ? -change : 0;
            return;
        }
        steps_.push_back({place, change});
    }

    /// N(high).
    int at_high() const { return total_; }

    /// N(low).
    int at_low() const { return below_; }

    /// An upper bound of N(x) for all x <= low.
    int max_below_low() const { return below_ + decrease_below_; }

    /// The largest x from low to high such that N(y) <= limit for all y from low to x; nothing if that holds up to
    /// high. N(low) must be within the limit (asserted).
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
    int decrease_below_ = 0;
    std::vector<Step> steps_;
    std::vector<Step> steps_of_bin_;
    std::array<int, bins> change_{};
    std::array<int, bins> rise_{}; ///< The sum of the changes above zero.
};

} // namespace octant::visuals::terrain
