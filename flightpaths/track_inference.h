#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace octant::flightpaths {

enum class TrackPhase : std::uint8_t { Parked, Taxi, TakeOffRun, Flight, Hover, LandingRun };

/// "parked", "taxi", "take-off run", ...
const char* name_of(TrackPhase phase);

constexpr bool is_on_ground(TrackPhase phase) { return phase != TrackPhase::Flight && phase != TrackPhase::Hover; }

struct PhaseSpan {
    double from_s = 0.0;
    double to_s = 0.0;
    TrackPhase phase = TrackPhase::Flight;
};

/// Where a quantity of a motion comes from. Measured: every sample has it; if all attitudes are measured, it is flown
/// to the last bit, and otherwise velocities are measurements that have errors.
enum class Origin : std::uint8_t { Measured, Partly, Inferred };

/// Figures about a motion that was made from a recorded aircraft.
struct TrackInference {
    Origin velocity = Origin::Inferred;
    Origin heading = Origin::Inferred;
    Origin pitch_roll = Origin::Inferred;
    /// One standard deviation that was found in the recorded places; 0: they are flown as recorded.
    double horizontal_error_m = 0.0;
    double vertical_error_m = 0.0;
    /// Heights come in steps of this; 0: no steps were found.
    double height_step_m = 0.0;
    /// Samples whose place or height contradicts their neighbours: the path does not go there.
    long rejected = 0;
    /// Samples that repeat the last place while the aircraft moves.
    long repeated = 0;
    /// Times without samples of more than 10 s and more than four usual steps.
    long gaps = 0;
    double longest_gap_s = 0.0;
    /// In order; they cover the motion. Empty where none were sought.
    std::vector<PhaseSpan> phases;

    struct Wind {
        double from_s = 0.0;
        double to_s = 0.0;
        /// Where the air moves to: x east, y north.
        glm::dvec2 wind_mps{0.0};
        bool from_circling = false;
    };

    std::vector<Wind> winds;
    /// Flown as a rotorcraft or a drone.
    bool hovers = false;
};

} // namespace octant::flightpaths
