#pragma once

#include "sim/trajectory.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

// Tracks whose truth is known: flights of simple models of aircraft, and what a logger writes of them. The models share
// no code with what reads tracks.

namespace octant::tests {

struct TrueState {
    double time_s = 0.0;
    glm::dvec3 position_m{0.0};
    glm::dvec3 velocity_mps{0.0};
    double heading_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
    bool on_ground = false;
};

/// Errors of a logger.
struct Logger {
    double step_s = 1.0;
    /// Standard deviations of places.
    double noise_m = 1.0;
    double vertical_noise_m = 1.0;
    double height_step_m = 0.0;
    /// Shares of samples that are lost, that come twice, and that lie 100 m and more aside.
    double lost = 0.0;
    double doubled = 0.0;
    double wild = 0.0;
    /// Times without samples.
    int gaps = 0;
    double gap_s = 0.0;
};

struct GeneratedTrack {
    std::string_view kind;
    int seed = 0;
    Logger logger;
    glm::dvec2 wind_mps{0.0};
    /// Whether the path shows the wind: it has whole circles.
    bool circles = false;
    /// 50 a second.
    std::vector<TrueState> truth;
    /// From and to.
    std::vector<std::array<double, 2>> gaps_s;
    /// A log with a line of column names: time, lat, lon, alt_m. The truth's axes are those of the TransverseMercator
    /// frame at 47 N, 8 E, but the first sample has errors: `origin_m` is where it lies.
    std::string log;
    glm::dvec2 origin_m{0.0};
};

inline constexpr std::array<std::string_view, 10> generated_kinds{
    "parked", "taxi", "circuit", "cruise", "circling", "steep turns", "helicopter", "drone", "25 ft, 5 s", "gaps"};

/// How far a flown trajectory is from the truth of a track, at 60 frames a second outside of its gaps.
struct TrackFigures {
    double frames = 0.0;
    double horizontal_rms_m = 0.0;
    double horizontal_most_m = 0.0;
    double vertical_rms_m = 0.0;
    double vertical_most_m = 0.0;
    double pitch_rms_deg = 0.0;
    double pitch_most_deg = 0.0;
    double roll_rms_deg = 0.0;
    double roll_most_deg = 0.0;
    /// While it moves by more than 3 m/s.
    double heading_rms_deg = 0.0;
    /// The most by which a frame lies behind the one before along the true way, gaps too; 0 where none does.
    double backwards_m = 0.0;
};

TrackFigures figures_of(const GeneratedTrack& track, const sim::Trajectory& flown);

/// The mean squares and the largest values of all.
TrackFigures figures_of_all(const std::vector<TrackFigures>& figures);

/// The same track for the same kind and seed, on any machine.
GeneratedTrack generated_track(std::string_view kind, int seed);

} // namespace octant::tests
