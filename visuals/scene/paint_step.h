#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>

namespace octant::visuals::scene {

/// How a step uses the depth buffer. Depth is reversed: greater is nearer.
enum class DepthUse {
    None,         ///< drawn over whatever is there; depth is neither tested nor written
    Nearest,      ///< drawn where it is nearer than what is there; written
    DepthOnly,    ///< as Nearest, but writes depth alone: colours stay as they are
    EdgeOn,       ///< drawn where there is nothing but what lies well behind it; written
    OnGround,     ///< drawn where it lies on what is there, a little towards the eye; written
    InfinitelyFar ///< drawn where nothing is; not written
};

/// Pixels of the picture from its upper left corner: columns least.x to most.x - 1, rows alike.
struct PixelBox {
    glm::ivec2 least{0};
    glm::ivec2 most{0};
};

/// Planes that a draw is cut by: what lies in front of all of them is drawn. World axes with the
/// eye subtracted; xyz = normal, w = offset.
struct Clip {
    static constexpr int most_planes = 8;
    std::array<glm::vec4, most_planes> planes{};
    int count = 0;
};

/// One step of painting: a range of one of the plan's lists, and how it is drawn.
struct PaintStep {
    enum class What {
        ClearDepth,  ///< depth becomes infinitely far in FramePlan::depth_boxes first
        Sky,         ///< indices of FramePlan::sky, without haze
        Ground,      ///< indices of FramePlan::ground
        GroundAgain, ///< FramePlan::repaint_indices
        Aircraft,    ///< FramePlan::aircraft; back faces are not drawn
        Refined,     ///< FramePlan::refined; back faces are not drawn
        Veil,   ///< indices of FramePlan::overlay, as Overlay; what comes later is drawn over it
        Overlay ///< indices of FramePlan::overlay, blended by their alpha, after all others
    };
    static constexpr std::uint32_t whole = ~std::uint32_t{0};
    What what = What::Aircraft;
    std::uint32_t first = 0; ///< place in the list that `what` names
    std::uint32_t count = 0;
    std::uint32_t clip = whole; ///< index into FramePlan::clips; whole = not cut
    DepthUse depth = DepthUse::None;
    /// Aircraft alone: how much of what is there they hide. Below 1 they are blended over it where
    /// their depth, which is Nearest, says so, and depth is not written: clear surfaces, drawn
    /// after all that they may be seen before.
    float opacity = 1.0F;
};

} // namespace octant::visuals::scene
