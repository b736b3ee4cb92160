#include "ui/flight/simulation.h"

#include "sim/base/axes.h"
#include "sim/flight_models.h"
#include "sim/flight_steps.h"
#include "visuals/planning/aircraft_model.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cassert>

namespace octant::ui::flight {

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

/// An absent aircraft counts as 100 km below datum, as in the recordings of earlier versions.
void add_state(Hash& hash, const sim::AircraftState& state) {
    const glm::dvec3 position_m = state.is_present ? state.position_m : glm::dvec3(glm::dvec2(state.position_m), -1e5);
    hash.add(std::as_bytes(std::span(glm::value_ptr(position_m), 3)));
    hash.add(std::as_bytes(std::span(glm::value_ptr(state.velocity_mps), 3)));
    hash.add(std::as_bytes(std::span(glm::value_ptr(state.body_to_world), 4)));
}

sim::AircraftState between(const sim::AircraftState& a, const sim::AircraftState& b, double share) {
    return {.time_s = glm::mix(a.time_s, b.time_s, share),
        .position_m = glm::mix(a.position_m, b.position_m, share),
        .velocity_mps = glm::mix(a.velocity_mps, b.velocity_mps, share),
        .body_to_world = glm::slerp(a.body_to_world, b.body_to_world, share),
        .load_factor = glm::mix(a.load_factor, b.load_factor, share),
        .speed_rate_mps2 = glm::mix(a.speed_rate_mps2, b.speed_rate_mps2, share),
        .turn_rate_radps = glm::mix(a.turn_rate_radps, b.turn_rate_radps, share)};
}

/// The highest ground below the next quarter of a minute of a straight flight.
double highest_ground_ahead_m(const visuals::landscape::Ground& ground, const sim::AircraftState& state) {
    constexpr double seconds_ahead = 15.0;
    constexpr double tried_every_s = 0.1;
    double highest_m = state.position_m.z;
    for (double ahead_s = 0.0; ahead_s < seconds_ahead; ahead_s += tried_every_s) {
        const glm::dvec3 at_m = state.position_m + ahead_s * state.velocity_mps;
        highest_m = std::max(highest_m, ground.height_at(at_m.x, at_m.y).value_or(highest_m));
    }
    return highest_m;
}

} // namespace

Simulation::Simulation(const world::World& world)
    : world_(world), formation_(world::formation_of(world.scene, world.flight)), states_(world.scene.aircraft.size()) {
    for (std::size_t i = 0; i < world.scene.aircraft.size(); ++i) {
        depth_below_origin_m_.push_back(planning::reach_below_m(world.scene.model_of(i)));
    }
    begin_at(world.flight.trajectory.start_s());
}

void Simulation::begin_at(double time_s) {
    pilot_.reset();
    levelling_.reset();
    end_.reset();
    hash_ = {};
    log_.clear();
    time_s_ = time_s;
    next_step_ = sim::step_at(time_s);
    update_states(world_.flight.trajectory.state_at(time_s), time_s);
    rig_ = scene::next_rig_state({}, states_.front());
}

long Simulation::step() const { return next_step_ - 1; }

void Simulation::update_states(const sim::AircraftState& leader, double time_s) {
    world::formation_states(world_.flight, formation_, leader, time_s, states_);
}

void Simulation::add_to_hash() {
    for (const sim::AircraftState& state : states_) { add_state(hash_, state); }
}

void Simulation::take_step() {
    const double time_s = sim::time_of_step(next_step_);
    update_states(world_.flight.trajectory.state_at(time_s), time_s);
    finish_step();
}

/// A step into the ground or off the map is not taken: the flight ends before it.
void Simulation::take_step_by_hand() {
    if (levelling_) {
        controls_ = levelling_->controls(last_two_.back());
        if (levelling_->is_done()) { levelling_.reset(); }
    }
    pilot_->step(controls_);
    sim::AircraftState state = pilot_->state();
    state.time_s = sim::time_of_step(next_step_);
    state.turn_rate_radps = sim::turn_rate_radps(last_two_.back(), state);
    update_states(state, state.time_s);
    end_ = flight_end_of(states_);
    if (end_) {
        levelling_.reset();
        update_states(last_two_.back(), sim::time_of_step(step()));
        return;
    }
    last_two_ = {last_two_.back(), state};
    finish_step();
}

void Simulation::finish_step() {
    rig_ = scene::next_rig_state(rig_, states_.front());
    add_to_hash();
    if (is_logging_) { log_.push_back(states_.front()); }
    ++next_step_;
}

std::optional<Simulation::End> Simulation::flight_end_of(std::span<const sim::AircraftState> states) const {
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (world_.flight.other_trajectories.contains(i)) { continue; }
        const glm::dvec3& at_m = states[i].position_m;
        const auto ground_m = world_.scene.ground->height_at(at_m.x, at_m.y);
        if (!ground_m) { return End::OffTheMap; }
        if (at_m.z - *ground_m < depth_below_origin_m_[i]) { return End::OnTheGround; }
    }
    return std::nullopt;
}

void Simulation::advance_live(double time_s) {
    time_s_ = time_s;
    source_->states_at(time_s, states_);
    for (; next_step_ <= sim::step_at(time_s); ++next_step_) { rig_ = scene::next_rig_state(rig_, states_.front()); }
    add_to_hash();
}

void Simulation::advance_to(double time_s) {
    assert(time_s >= time_s_);
    if (is_live()) {
        advance_live(time_s);
        return;
    }
    time_s_ = time_s;
    while (next_step_ <= sim::step_at(time_s) && !end_) {
        if (by_hand()) {
            take_step_by_hand();
        } else {
            take_step();
        }
    }
    if (!by_hand()) {
        update_states(world_.flight.trajectory.state_at(time_s), time_s);
        return;
    }
    const double since_step_s = time_s - sim::time_of_step(step());
    update_states(
        between(last_two_.front(), last_two_.back(), std::clamp(since_step_s / sim::step_s, 0.0, 1.0)), time_s);
}

void Simulation::start_log() {
    assert(!is_live());
    assert(next_step_ > sim::step_at(time_s_));
    const std::vector<sim::AircraftState> shown = states_;
    const sim::AircraftState leader = at_last_step();
    update_states(leader, sim::time_of_step(step()));
    hash_ = {};
    add_to_hash();
    states_ = shown;
    is_logging_ = true;
    log_ = {leader};
}

void Simulation::take_over(const sim::AircraftKind& kind) {
    sim::AircraftState start = at_last_step();
    start.time_s = sim::time_of_step(step());
    hand_to_pilot(kind, start);
}

void Simulation::level_off() {
    assert(by_hand());
    if (end_) {
        start_level();
    } else {
        levelling_.emplace(*kind_, last_two_.back());
    }
}

void Simulation::start_level() {
    assert(by_hand());
    const sim::AircraftKind& kind = *kind_;
    sim::AircraftState start = sim::trimmed_state(kind, last_two_.back().position_m,
        euler_from_body_to_world(last_two_.back().body_to_world).heading_rad,
        std::max(glm::length(last_two_.back().velocity_mps), kind.min_handover_speed_mps));
    start.time_s = sim::time_of_step(step());
    if (end_ == End::OnTheGround) {
        constexpr double off_the_ground_m = 200.0;
        start.position_m.z = highest_ground_ahead_m(*world_.scene.ground, start) + off_the_ground_m;
    }
    hand_to_pilot(kind, start);
}

void Simulation::hand_to_pilot(const sim::AircraftKind& kind, const sim::AircraftState& start) {
    pilot_ = sim::make_piloted_flight(kind, start);
    kind_ = &kind;
    levelling_.reset();
    controls_ = {.throttle = pilot_->trim_throttle()};
    last_two_ = {start, start};
    end_.reset();
}

sim::AircraftState Simulation::at_last_step() const {
    return by_hand() ? last_two_.back() : world_.flight.trajectory.state_at(sim::time_of_step(step()));
}

void Simulation::set_controls(const sim::PilotControls& controls) {
    assert(by_hand());
    levelling_.reset();
    controls_ = controls;
}

} // namespace octant::ui::flight
