#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// What ground is covered with, for its fine pattern.
struct LandCover {
    /// Own colour, display values.
    glm::vec3 colour{0.5F};
    /// Standard deviation of its brightness in the pattern, as a share of itself.
    float mottling = 0.1F;
};

/// How a pixel of ground differs from the mean around it. A mean says by a number from 0 to 255 which two covers it is
/// mixed of and by how much: 0 = none, then one cover at every 64, mixed in between, the last one at 255. The fine
/// pattern chooses one of the two, so that borders are sharp and irregular however far apart the means are known; over
/// the pattern the mean stays.
class LandCoverContrast {
public:
    static constexpr int covers = 4;
    static constexpr int mixture_count = 128;     ///< the number halved
    static constexpr int pattern_step_count = 64; ///< from the pattern's -1 to 1

    explicit LandCoverContrast(const std::array<LandCover, covers>& of);

    /// By what share of itself each part of a colour changes: for each kind and pattern, pattern by pattern; 1/512, ten
    /// bits each with a sign, red in the highest bits, two bits below blue.
    const std::vector<std::uint32_t>& table() const { return table_; }

private:
    std::vector<std::uint32_t> table_;
};

} // namespace octant::visuals::scene
