#pragma once

#include "visuals/terrain/detail_settings.h"

#include <array>

namespace octant::visuals::terrain {

/// What the control of the resolution C carries from one frame to the next: a value, so that a
/// run can be replayed.
struct DetailState {
    double resolution = 16.0;    ///< C for the next mesh
    double last_triangles = 0.0; ///< N of the last mesh; 0 before the first
    /// Results of equation (4), newest first; the first remembered_frames count.
    std::array<double, max_remembered_frames> earlier{};
};

/// State before the first mesh: C_0 = `resolution` within the settings' limits, as if it had been
/// held for ever.
DetailState starting_at(double resolution, const ControlSettings& settings);

/// State after a mesh made with `state.resolution` had `triangles` triangles (at least 0).
/// Settings are as their comments demand (asserted).
DetailState next_state(const DetailState& state, const ControlSettings& settings, double triangles);

} // namespace octant::visuals::terrain
