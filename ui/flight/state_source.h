#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/earth_frame.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/scene/camera.h"

#include <cstddef>
#include <span>

namespace octant::ui::flight {

/// Who flies the aircraft in place of their path, and may say from where they are seen: what a simulation and a session
/// know of a live flight.
class StateSource {
public:
    StateSource() = default;
    virtual ~StateSource() = default;
    StateSource(const StateSource&) = delete;
    StateSource& operator=(const StateSource&) = delete;
    StateSource(StateSource&&) = delete;
    StateSource& operator=(StateSource&&) = delete;

    /// The states at a time, not before that of the last call. `states` hold those of the last call, or where the
    /// aircraft stand at the beginning.
    virtual void states_at(double time_s, std::span<sim::AircraftState> states) = 0;

    /// Whether somebody flies this aircraft as of the last states_at(): the first one stands and waits until somebody
    /// does.
    virtual bool is_flown(std::size_t aircraft) const = 0;

    /// The camera of a view, whose pictures have this width over height, for aircraft in these states;
    /// `default_camera` is what the settings say. View 0 fills the picture, view 1 is the inset.
    virtual visuals::scene::Camera camera(std::size_t view, std::span<const sim::AircraftState> states,
        const visuals::scene::Camera& default_camera, double aspect) const = 0;

    /// Parts that the source turns, as of the last states_at().
    virtual std::span<const visuals::planning::ArticulatedPart> turned_parts() const = 0;

    /// How the world lies on the earth; null until that is known.
    virtual const EarthFrame* frame() const = 0;
};

} // namespace octant::ui::flight
