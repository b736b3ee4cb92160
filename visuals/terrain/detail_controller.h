#pragma once

#include "visuals/terrain/detail_settings.h"

#include <array>

namespace octant::visuals::terrain {

/// A measured point of the curve N(C).
struct CountAt {
    double resolution = 0.0; ///< C; 0: none yet
    double triangles = 0.0;  ///< N
};

/// What the control of the resolution C carries from one frame to the next: a value, so that a
/// run can be replayed.
struct DetailState {
    double resolution = 16.0;    ///< C for the next mesh
    double last_triangles = 0.0; ///< N of the last mesh; 0 before the first
    int standing_frames = 0;     ///< meshes since the view last changed
    CountAt below;               ///< of those: the largest C with fewer triangles than the target
    CountAt above;               ///< of those: the smallest C with more
    /// Results of equation (4), newest first; the first remembered_frames count.
    std::array<double, max_remembered_frames> earlier{};
};

/// State before the first mesh: C_0 = `resolution` within the settings' limits, as if it had been
/// held for ever.
DetailState starting_at(double resolution, const ControlSettings& settings);

/// State after a mesh made with `state.resolution` had `triangles` triangles (at least 0).
/// `same_view`: this mesh was made for the view of the one before it. Settings are as their
/// comments demand (asserted).
DetailState next_state(
    const DetailState& state,
    const ControlSettings& settings,
    double triangles,
    bool same_view = false);

} // namespace octant::visuals::terrain
