#pragma once

#include "sim/aircraft_state.h"
#include "visuals/planning/articulated_part.h"
#include "visuals/scene/camera.h"

#include <cstdint>
#include <vector>

namespace octant::ui::flight {

/// A time of a run: where the aircraft are then, and from where they are seen.
struct FrameState {
    double time_s = 0.0;
    std::vector<sim::AircraftState> states;
    /// Parts that do not turn by themselves.
    std::vector<visuals::planning::ArticulatedPart> articulated_parts;
    visuals::scene::Camera camera;
    visuals::scene::Camera inset_camera;
    /// Triangles of ground that the picture aims at.
    int triangle_target = 0;
    /// Simulation::state_hash then.
    std::uint64_t state_hash = 0;
};

} // namespace octant::ui::flight
