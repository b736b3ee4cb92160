#pragma once

#include "ui/flight/id_comparison.h"
#include "ui/settings/settings.h"
#include "ui/studies/draw_order/renderer_comparer.h"

#include <array>
#include <functional>
#include <string>

namespace octant::ui::studies::draw_order {

/// Sums over the frames of a run.
struct RayComparison {
    struct OfRenderer {
        long differing = 0;
        long wrong = 0;          ///< that no rounding explains
        std::string first_wrong; ///< frame and pixel; empty: none
    };

    int frames = 0;
    long pixels = 0; ///< of one renderer
    std::array<OfRenderer, compared_renderers.size()> renderers;

    long wrong() const;
    void add(const RayComparison& other);
};

/// Draws every `every`th frame of a run as polygon numbers, painted as the settings say with one
/// sample a pixel by each renderer, and compares each pixel with what a ray through its middle
/// finds. Shadows are left out. `worlds` are those of the settings, but for the view's. `on_frame` is
/// told of each frame that was compared and of how many there are. Throws Error.
RayComparison compare_with_rays(
    const settings::RunSettings& settings,
    const flight::ComparisonWorlds& worlds,
    int every,
    const std::function<void(int compared, int frames)>& on_frame);

} // namespace octant::ui::studies::draw_order
