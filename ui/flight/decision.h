#pragma once

namespace octant::ui::flight {

/// What the clock decided for a frame, or the settings.
struct Decision {
    int triangle_target = 0;
    int smooth_target = -1; ///< negative: by the settings' share
};

} // namespace octant::ui::flight
