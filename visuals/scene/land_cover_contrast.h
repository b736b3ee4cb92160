#pragma once

#include "visuals/scene/detail_pattern.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// A land cover, for the detail pattern.
struct LandCover {
    /// Own colour, display values.
    glm::vec3 colour{0.5F};
    /// Standard deviation of its brightness in the pattern, as a share of itself.
    float mottling = 0.1F;
};

/// The deviation of a ground pixel's colour from the mean colour of its vertices. A vertex has a number from 0 to 255
/// for its mixture of two land covers: 0 = none, then one pure cover at every 64 (the last at 255), mixtures in
/// between. The detail pattern shares each pixel among the two covers, so that borders are irregular however far apart
/// vertices are, and some pixels wide; the mean over the pattern does not change.
class LandCoverContrast {
public:
    static constexpr int covers = 4;
    static constexpr int mixture_count = 128;     ///< The numbers of mixtures, halved.
    static constexpr int pattern_step_count = 64; ///< From the pattern's -1 to 1.

    /// Mixtures from this one on show DetailPattern::Kind::Open, those before it Crowns.
    static constexpr int first_open_mixture = mixture_count / 2;
    /// From this one to first_open_mixture Crowns give way to the inverse of Open, so that no edge is seen there.
    static constexpr int first_mixed_pattern = first_open_mixture - 4;

    /// The pattern outlives it.
    LandCoverContrast(const std::array<LandCover, covers>& of, const DetailPattern& pattern);

    const DetailPattern& pattern() const { return *pattern_; }

    /// The relative change of red, green and blue, by pattern step and then by mixture: three signed numbers of ten
    /// bits in units of 1/512, red in the highest bits, two unused bits below blue.
    const std::vector<std::uint32_t>& table() const { return table_; }

private:
    const DetailPattern* pattern_;
    std::vector<std::uint32_t> table_;
};

} // namespace octant::visuals::scene
