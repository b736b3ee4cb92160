#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// What a leg flies; the words in a path file. The head of flightpaths/f15-pop-up.toml describes each with its keys.
enum class LegKind { Straight, Hold, Climb, Dive, Turn, Jink, Pull, Push };

/// The word that names a kind of leg in a path file.
std::string_view word_of(LegKind kind);

/// One manoeuvre. Which members count depends on the kind; the reader has checked that those it needs are there.
struct Leg {
    LegKind kind = LegKind::Straight;
    /// Where the leg begins in its file.
    int line = 0;
    std::string label;
    std::optional<double> duration_s;
    /// Lift over weight, in g.
    std::optional<double> load_factor;
    /// Positive with the right wing down.
    std::optional<double> bank_rad;
    /// The path angle to hold or to reach, upwards.
    std::optional<double> climb_rad;
    /// The leg ends when this height is passed.
    std::optional<double> to_height_m;
    /// The leg ends after this turn, which is above zero.
    std::optional<double> heading_change_rad;
    /// The side of a turn.
    bool to_the_left = false;
    /// The amplitude of a weave from side to side.
    double lateral_g = 0.0;
    /// The period of that weave.
    double period_s = 1.0;
    /// The amplitude of a weave up and down.
    double vertical_g = 0.0;
    double vertical_period_s = 1.0;
    double acceleration_mps2 = 0.0;
    /// The speed at which the acceleration ends.
    std::optional<double> to_speed_mps;
    std::optional<double> roll_rate_radps;
};

/// A path as its file tells it. The origin is the observer (or site) that the path is flown at.
struct PathScript {
    std::filesystem::path file;
    std::string aircraft;
    /// The line in which the file names it.
    int aircraft_line = 1;
    std::string title;
    /// Samples a second; divides sim::steps_per_second.
    int rate_hz = 20;
    /// At least 2.
    int samples = 0;
    /// Lowest clearance over the ground that the path is meant for; at least 1.
    double min_clearance_m = 1.0;
    double angle_of_attack_rad_per_g = 0.0;
    /// Where [start] begins in the file.
    int start_line = 1;
    /// Where the path starts, from its origin and as high over it, and on which course.
    double north_m = 0.0;
    double east_m = 0.0;
    double height_m = 0.0;
    double heading_rad = 0.0;
    double speed_mps = 0.0;
    /// At least one.
    std::vector<Leg> legs;
};

/// Reads a path file (TOML). Throws Error "file:line: expected ..., got ..." for a file that is missing, not TOML,
/// lacks a key, has an unknown or doubled key, a wrong type, a number that is not finite or out of its bounds, or no
/// legs.
PathScript read_path_script(const std::filesystem::path& file);

} // namespace octant::flightpaths
