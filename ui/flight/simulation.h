#pragma once

#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "sim/base/earth_frame.h"
#include "sim/base/hash.h"
#include "sim/levelling_autopilot.h"
#include "sim/piloted_flight.h"
#include "ui/world/world.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/camera_rig.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

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

    /// The camera of a view, whose pictures have this width over height, for aircraft in these states; `default_camera`
    /// is what the settings say. View 0 fills the picture, view 1 is the inset.
    virtual visuals::scene::Camera camera(std::size_t view, std::span<const sim::AircraftState> states,
        const visuals::scene::Camera& default_camera, double aspect) const = 0;

    /// Parts that the source turns, as of the last states_at().
    virtual std::span<const visuals::planning::ArticulatedPart> articulated_parts() const = 0;

    /// How the world lies on the earth; null until that is known.
    virtual const EarthFrame* frame() const = 0;
};

/// The aircraft of a run in fixed simulation steps, along its path or, from a takeover on, by a pilot's hands. States
/// depend only on the fixed steps, not on the times asked for.
class Simulation {
public:
    /// Begins at the path's start. The world must outlive the simulation.
    explicit Simulation(const world::World& world);

    /// Takes every step up to a time, not before the one it is at (asserted). Along a path states() are those of the
    /// very time; by hand they lie between the last two steps and so one step behind.
    void advance_to(double time_s);

    /// Begins anew at a time of the path, as if it started there. By hand no longer.
    void begin_at(double time_s);

    /// From now on the source flies all aircraft: states and their hash are those of the very times that are asked for.
    /// It must outlive the simulation.
    void set_state_source(StateSource& source) { source_ = &source; }

    bool is_live() const { return source_ != nullptr; }

    /// Who flies the aircraft; there must be a source.
    const StateSource& source() const { return *source_; }

    double time_s() const { return time_s_; }

    const world::Formation& formation() const { return formation_; }

    /// At time_s(), in the order of Scene::aircraft.
    std::span<const sim::AircraftState> states() const { return states_; }

    const visuals::scene::RigState& rig() const { return rig_; }

    /// Over the states of all aircraft at every step since the simulation began or since start_log(), the step that was
    /// the last one then among them.
    std::uint64_t state_hash() const { return hash_.value(); }

    /// Begins the hash anew and keeps the first aircraft's states from the last step on. Not where others fly it
    /// (asserted).
    void start_log();

    void stop_log() { is_logging_ = false; }

    /// States of the first aircraft at every step since start_log().
    std::span<const sim::AircraftState> log() const { return log_; }

    /// The last step at or before time_s().
    long step() const;

    /// From the last step on the first aircraft is flown by hand as sim::make_piloted_flight has it, from the state it
    /// is in.
    void take_over(const sim::AircraftKind& kind);

    /// By hand only (asserted): on from where it is, at once level and in trim, on the same course and at the same
    /// speed, unless that is too slow to fly; after its end on the ground 200 m above all ground of the next 15 s.
    void start_level();

    /// By hand only (asserted): flies on by sim::Levelling until the aircraft is level or its controls are set. After
    /// its end on the ground as start_level().
    void level_off();

    bool is_levelling() const { return levelling_.has_value(); }

    bool by_hand() const { return pilot_ != nullptr; }

    /// For the steps to come; ends levelling. By hand only (asserted).
    void set_controls(const sim::PilotControls& controls);

    const sim::PilotControls& controls() const { return controls_; }

    /// By hand only (asserted).
    const sim::PilotedFlight& pilot() const { return *pilot_; }

    /// Why a flight by hand goes no further: the next step of one of its aircraft would do this.
    enum class End { OnTheGround, OffTheMap };

    std::optional<End> end_of_flight() const { return end_; }

private:
    void take_step();
    void advance_live(double time_s);
    void take_step_by_hand();
    void finish_step();
    std::optional<End> flight_end_of(std::span<const sim::AircraftState> states) const;
    void update_states(const sim::AircraftState& leader, double time_s);
    void add_to_hash();
    sim::AircraftState at_last_step() const;
    void hand_to_pilot(const sim::AircraftKind& kind, const sim::AircraftState& start);

    const world::World& world_;
    world::Formation formation_;
    /// How far each aircraft reaches below its reference point.
    std::vector<double> depth_below_origin_m_;
    double time_s_ = 0.0;
    long next_step_ = 0;
    std::vector<sim::AircraftState> states_;
    visuals::scene::RigState rig_;
    Hash hash_;
    bool is_logging_ = false;
    std::vector<sim::AircraftState> log_;
    std::unique_ptr<sim::PilotedFlight> pilot_;
    /// What is flown by hand; else null.
    const sim::AircraftKind* kind_ = nullptr;
    std::optional<sim::LevellingAutopilot> levelling_;
    sim::PilotControls controls_;
    /// By hand: the first aircraft's states at the last two steps.
    std::array<sim::AircraftState, 2> last_two_;
    std::optional<End> end_;
    StateSource* source_ = nullptr;
};

} // namespace octant::ui::flight
