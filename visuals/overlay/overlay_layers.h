#pragma once

#include "visuals/scene/frame_plan.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::overlay {

/// Draws that lie over one another, as one. Keeps its memory.
class OverlayLayers {
public:
    void clear();

    /// Lays a draw over those before it; it is copied.
    void add(const scene::OverlayDraw& draw);

    /// Valid until the next call of another member.
    scene::OverlayDraw all() const { return {vertices_, indices_}; }

private:
    std::vector<scene::OverlayVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

} // namespace octant::visuals::overlay
