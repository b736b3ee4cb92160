#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace octant::visuals::terrain {

/// The number of triangles N(x) of a mesh as a function of the limit x >= 0: the sum of all changes at places below x.
/// Single steps are stored only between two bounds; those below are summed, so that many steps cost little.
class StepFunction {
public:
    /// Forgets all steps and sets the bounds, 0 <= low <= high (asserted).
    void start(float low, float high);

    /// Adds a step at a place below high.
    void add(float place, int change) {
        total_ += change;
        rise_ += std::max(change, 0);
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

    static constexpr std::size_t bins = 1024;

    std::size_t bin_of(float place) const;
    std::optional<float> first_above_in(std::size_t bin, int count, int limit);

    float low_ = 0.0F;
    float high_ = 0.0F;
    unsigned bin_shift_ = 0;
    int total_ = 0;
    int rise_ = 0; ///< The sum of all changes above zero.
    int below_ = 0;
    int decrease_below_ = 0;
    std::vector<Step> steps_;
    std::vector<Step> steps_of_bin_;
    std::array<int, bins> change_of_bin_{};
    std::array<int, bins> rise_of_bin_{}; ///< The sum of the changes above zero.
};

/// A search for the limit at which a mesh has a given number of triangles N.
struct CountSearch {
    int triangles = 0;      ///< The budget.
    float min_limit = 0.0F; ///< Above zero.
    float max_limit = 0.0F;
    float last_limit = 0.0F;  ///< The result for the previous frame; 0 = none.
    float first_limit = 0.0F; ///< The upper end of the first walk when there is no last_limit.
};

/// The largest limit up to which no mesh has more triangles than the budget; min_limit if even that has more. The
/// result does not depend on last_limit, which only shortens the search.
///
/// `walk(low, high, max_triangles)` must start `steps` with (low, high) and add all steps of N below high; it may stop
/// once there are more than `max_triangles`. It returns whether there are steps above.
template <typename Walk>
float find_limit(const CountSearch& search, StepFunction& steps, const Walk& walk) {
    // The range of a walk, as factors of the last limit. They influence the time only. Single steps are stored from
    // here on.
    constexpr float look_below = 0.7F;
    constexpr float look_above = 1.08F; // The walk ends here.
    constexpr float step_back = 0.1F;   // After far too many triangles.
    constexpr float min_growth = 1.25F; // After too few triangles.
    constexpr float max_growth = 8.0F;

    const float min_limit = search.min_limit;
    const float max_limit = std::max(search.max_limit, min_limit);
    const bool first = search.last_limit <= 0.0F;
    float low = std::clamp(search.last_limit * look_below, min_limit, max_limit);
    float high = std::clamp(first ? search.first_limit : search.last_limit * look_above, min_limit, max_limit);
    float too_high = std::numeric_limits<float>::infinity();
    int max_triangles = 2 * search.triangles + 1000;
    while (true) {
        const int stop = high > min_limit ? max_triangles : std::numeric_limits<int>::max();
        const bool more_above = walk(low, high, stop);
        if (steps.at_high() > stop) {
            too_high = high;
            high = std::max(high * step_back, min_limit);
            low = min_limit;
            max_triangles += max_triangles / 4;
        } else if (low > min_limit && steps.max_below_low() > search.triangles) {
            low = min_limit;
        } else if (steps.at_low() > search.triangles) {
            return min_limit;
        } else if (const auto place = steps.first_above(search.triangles)) {
            return *place;
        } else if (high >= max_limit || !more_above) {
            return max_limit;
        } else {
            const float missing =
                static_cast<float>(search.triangles) / static_cast<float>(std::max(steps.at_high(), 1));
            const float grown = high * std::clamp(1.1F * missing, min_growth, max_growth);
            high = std::min({grown, std::sqrt(high) * std::sqrt(too_high), max_limit});
        }
    }
}

} // namespace octant::visuals::terrain
