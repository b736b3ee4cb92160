#pragma once

#include "visuals/terrain/ground_tiles.h"

#include <array>

namespace octant::visuals::terrain {

/// The vertical distance of the eye from the ground around a block, which is a node with height
/// bounds.
struct VerticalDistances {
    /// The least squared distance to the block and to some of its neighbours. The index is a sum: 1
    /// includes those beyond its west side, 2 east, 4 south, 8 north.
    std::array<float, 16> squared_m2{};
    /// The same for how far ahead of the eye the block's heights alone bring it, at least: their
    /// share of the depth in the picture.
    std::array<float, 16> ahead_m{};
    float lowest_m = 0.0F; ///< The lowest of the block's own samples.
    float highest_m = 0.0F;
};

/// A node by its place.
struct BlockIndex {
    int level = 0;
    int column = 0;
    int row = 0;
};

/// Where an eye is and looks, as far as heights are concerned.
struct EyeElevation {
    float z_m = 0.0F;
    float ahead_up = 0.0F; ///< What a metre up brings ahead; 0 for all around the eye.
};

/// The gaps of a block for an eye.
VerticalDistances vertical_distances(const GroundTiles& ground, const BlockIndex& block, const EyeElevation& eye);

} // namespace octant::visuals::terrain
