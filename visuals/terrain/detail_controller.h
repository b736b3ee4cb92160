#pragma once

#include "visuals/terrain/detail_settings.h"

#include <array>

namespace octant::visuals::terrain {

/// A measured point of the curve N(C), the number of triangles over the resolution.
struct CountAt {
    double resolution = 0.0; ///< C; 0 when there is none yet.
    double triangles = 0.0;  ///< N
};

/// All that the control of the resolution C carries from one frame to the next. A plain value, so
/// that a run can be replayed.
struct DetailState {
    double resolution = 16.0;    ///< C for the next mesh.
    double last_triangles = 0.0; ///< N of the last mesh; 0 before the first.
    int standing_frames = 0;     ///< The number of meshes made since the view last changed.
    /// Of those meshes: the largest C with fewer triangles than the target.
    CountAt below;
    /// Of those meshes: the smallest C with more triangles than the target.
    CountAt above;
    /// The results of equation (4), newest first. Only the first remembered_frames of them count.
    std::array<double, max_remembered_frames> earlier{};
};

/// The state before the first mesh: C_0 = `resolution`, within the settings' limits, as if it had
/// been held for ever.
DetailState starting_at(double resolution, const ControlSettings& settings);

/// The state after the mesh made with `state.resolution` had `triangles` triangles (at least 0).
/// `same_view` tells that it was made for the same view as the mesh before. The settings must be as
/// their comments demand (asserted).
DetailState next_state(
    const DetailState& state,
    const ControlSettings& settings,
    double triangles,
    bool same_view = false);

} // namespace octant::visuals::terrain
