#pragma once

#include "visuals/terrain/quadtree.h"

#include <array>

namespace octant::visuals::terrain {

/// A measured point of the curve N(C), the number of triangles over the resolution.
struct CountSample {
    double resolution = 0.0; ///< C; 0 when there is none yet.
    double triangles = 0.0;  ///< N
};

/// The state of the control of C from one frame to the next. A plain value, so that a run can be repeated.
struct ControlState {
    double resolution = 16.0;    ///< C for the next mesh.
    double last_triangles = 0.0; ///< N of the last mesh; 0 before the first.
    int still_frames = 0;        ///< The number of meshes made since the view last changed.
    /// Of those meshes: the largest C with fewer triangles than the target.
    CountSample below;
    /// Of those meshes: the smallest C with more triangles than the target.
    CountSample above;
    CountSample last; ///< The last mesh, of whatever view.
    /// For Tuned: the p of N ~ C^p around the last meshes, that is N'(C) C / N.
    double exponent = 1.5;
    /// The results of equation (4), newest first. Only the first averaged_frames of them count.
    std::array<double, max_averaged_frames> earlier_results{};
};

/// The state before the first mesh: C_0 = `resolution`, within the settings' limits, as if it had been held for ever.
ControlState initial_state(double resolution, const ControlSettings& settings);

/// The state after the mesh made with `state.resolution` had `triangles` triangles (at least 0). `same_view` tells that
/// it was made for the same view as the mesh before. The settings must be as their comments demand (asserted).
ControlState next_state(
    const ControlState& state, const ControlSettings& settings, double triangles, bool same_view = false);

/// For Tuned: whether the frame's mesh is to be made again with `state.resolution`, `meshes` having been made of it.
bool needs_another_mesh(const ControlState& state, const ControlSettings& settings, int meshes);

/// Makes a frame's mesh, or counts it: calls make(C), which returns a mesh with its counters, once, or up to
/// max_tuned_meshes times for Tuned, and takes `state` on to the next frame. `same_view` tells that the frame before
/// had the same view. Returns the last mesh.
template <typename Make>
auto controlled_mesh(ControlState& state, const ControlSettings& settings, bool same_view, const Make& make) {
    auto mesh = make(state.resolution);
    state = next_state(state, settings, mesh.counters.triangles, same_view);
    for (int meshes = 1; needs_another_mesh(state, settings, meshes); ++meshes) {
        mesh = make(state.resolution);
        state = next_state(state, settings, mesh.counters.triangles, true);
    }
    return mesh;
}

} // namespace octant::visuals::terrain
