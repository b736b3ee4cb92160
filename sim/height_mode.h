#pragma once

namespace octant::sim {

/// How the heights of a path are laid over ground.
enum class HeightMode {
    /// The whole path is lifted (or lowered) by one height, so that its lowest clearance over the ground is the wanted
    /// one.
    Clear,
    /// Heights are heights over a smoothed ground; where the aircraft cannot follow any, the whole path is lifted by
    /// one height, and a note says so.
    Follow,
    /// Heights stay as they are; with place 0, 0 and heading 0 all of the path is as it was, to the last bit.
    Datum
};

} // namespace octant::sim
