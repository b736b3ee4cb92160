#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::scene {

/// The fine pattern of ground: a square tile of texels that repeats each way without a seam. A
/// texel of 128 leaves a colour as it is, 0 and 256 would change it by `most_share` of itself.
struct GrainPattern {
    static constexpr int texels_a_side = 1024;
    static constexpr float texels_per_m = 8.0F;
    static constexpr float most_share = 0.32F;
    /// How far a place moves east and north in the pattern for each metre that it lies higher, so
    /// that steep ground has the pattern, too.
    static constexpr glm::vec2 lean{0.6F, -0.8F};

    int size = texels_a_side;
    /// Texels row by row from the south.
    std::vector<std::uint8_t> texels;
};

/// Noise of features between a quarter of a metre and sixteen metres, none of them stronger than
/// the others. The same bytes on every machine. Made when it is first asked for.
const GrainPattern& grain_pattern();

/// The pattern with half as many texels a side, each the mean of four.
GrainPattern half_of(const GrainPattern& pattern);

} // namespace octant::visuals::scene
