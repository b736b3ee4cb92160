#pragma once

namespace octant::ui::flight {

/// What the clock decided for a frame, or the settings.
struct QualityTargets {
    int triangle_target = 0;
    /// Negative = by the settings' share.
    int smooth_target = -1;
};

} // namespace octant::ui::flight
