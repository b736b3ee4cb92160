#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>

namespace octant::visuals::scene {

/// How a step uses the depth buffer. Depth is reversed: greater is nearer.
enum class DepthUse {
    /// Drawn over whatever is there; depth is neither tested nor written.
    None,
    /// Drawn where it is nearer than what is there; depth is written.
    Nearest,
    /// As Nearest, but depth alone is written: colours stay as they are.
    DepthOnly,
    /// Drawn where there is nothing but what lies well behind it; depth is written.
    EdgeOn,
    /// Drawn where it lies on what is there, a little towards the eye; depth is written.
    OnGround,
    /// Drawn where nothing is; depth is not written.
    InfinitelyFar
};

/// Pixels of the picture from its upper left corner: columns least.x to most.x - 1, rows alike.
struct PixelBox {
    glm::ivec2 least{0};
    glm::ivec2 most{0};
};

/// Planes that a draw is cut by: what lies in front of all of them is drawn. World axes with the eye subtracted; xyz =
/// normal, w = offset.
struct Clip {
    static constexpr int max_planes = 8;
    std::array<glm::vec4, max_planes> planes{};
    int count = 0;
};

/// One step of painting: a range of one of the plan's lists, and how it is drawn.
struct PaintStep {
    enum class Content {
        /// Depth becomes infinitely far in a box of FramePlan::depth_boxes.
        ClearDepth,
        /// Indices of FramePlan::sky are drawn without haze.
        Sky,
        /// Indices of FramePlan::ground are drawn.
        Ground,
        /// Indices of FramePlan::repaint_indices are drawn.
        GroundRepaint,
        /// Aircraft of FramePlan::aircraft are drawn without their back faces.
        Aircraft,
        /// Meshes of FramePlan::refined are drawn without their back faces.
        Refined,
        /// Indices of FramePlan::overlay are drawn as Overlay draws them; what comes later is drawn over it.
        Transparent,
        /// Indices of FramePlan::overlay are blended by their alpha, after all others.
        Overlay
    };
    static constexpr std::uint32_t no_clip = ~std::uint32_t{0};
    Content content = Content::Aircraft;
    /// A place in the list that `content` names.
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    /// Index into FramePlan::clips; `no_clip` = what is drawn is not cut.
    std::uint32_t clip = no_clip;
    DepthUse depth = DepthUse::None;
    /// Aircraft alone: how much of what is there they hide. Below 1 they are blended over it where their depth, which
    /// is Nearest, says so, and depth is not written: clear surfaces, drawn after all that they may be seen before.
    float opacity = 1.0F;
};

} // namespace octant::visuals::scene
