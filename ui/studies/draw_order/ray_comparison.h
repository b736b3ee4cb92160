#pragma once

#include "ui/settings/settings.h"

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace octant::ui::studies::draw_order {

/// The renderers whose pictures are held against rays, in this order everywhere.
inline constexpr std::array rayed_renderers = {
    settings::RendererKind::Raster, settings::RendererKind::Gl};

/// How far a pixel's middle may lie from what it shows, pixels. Corners are rounded to 1/256 pixel
/// and what is painted again is cut 1/100 pixel too wide where only that rounding could tell.
inline constexpr double rounding_reach_px = 1.0 / 256.0 + 0.01;

/// Sums over the frames of a run.
struct RayComparison {
    struct OfRenderer {
        long differing = 0;
        long wrong = 0;          ///< that no rounding explains
        std::string first_wrong; ///< frame and pixel; empty: none
    };

    int frames = 0;
    long pixels = 0; ///< of one renderer
    std::array<OfRenderer, rayed_renderers.size()> renderers;

    long wrong() const;
    void add(const RayComparison& other);
};

/// Draws every `every`th frame of a run as polygon numbers, painted as the settings say with one
/// sample a pixel by each renderer, and compares each pixel with what a ray through its middle
/// finds. Shadows are left out. `seen` is told of each frame that was compared and of how many
/// there are. Throws Error.
RayComparison compare_with_rays(
    const settings::RunSettings& settings,
    int every,
    const std::function<void(int compared, int frames)>& seen);

} // namespace octant::ui::studies::draw_order
