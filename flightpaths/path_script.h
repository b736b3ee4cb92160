#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::flightpaths {

/// What a leg flies; the words in a path file. The head of flightpaths/f15-pop-up.toml describes
/// each with its keys.
enum class LegKind { Straight, Hold, Climb, Dive, Turn, Jink, Pull, Push };

/// The word that names a kind of leg in a path file.
std::string_view word_of(LegKind kind);

/// One manoeuvre. Which members count depends on the kind; the reader has checked that those it
/// needs are there.
struct Leg {
    LegKind kind = LegKind::Straight;
    int line = 0; ///< where the leg begins in its file
    std::string label;
    std::optional<double> duration_s;
    std::optional<double> load_factor;        ///< lift over weight, in g
    std::optional<double> bank_rad;           ///< right wing down
    std::optional<double> climb_rad;          ///< path angle to hold or to reach, up
    std::optional<double> to_height_m;        ///< leg ends when this height is passed
    std::optional<double> heading_change_rad; ///< leg ends after this turn, above zero
    bool to_the_left = false;                 ///< side of a turn
    double lateral_g = 0.0;                   ///< amplitude of a weave from side to side
    double period_s = 1.0;                    ///< of that weave
    double vertical_g = 0.0;                  ///< amplitude of a weave up and down
    double vertical_period_s = 1.0;
    double acceleration_mps2 = 0.0;
    std::optional<double> to_speed_mps; ///< where the acceleration ends
    std::optional<double> roll_rate_radps;
};

/// A path as its file tells it. The origin is the observer (or site) that the path is flown at.
struct PathScript {
    std::filesystem::path file;
    std::string aircraft;
    int aircraft_line = 1; ///< where the file names it
    std::string title;
    int rate_hz = 20; ///< samples a second; divides sim::steps_per_second
    int samples = 0;  ///< at least 2
    /// Lowest clearance over the ground that the path is meant for; at least 1.
    double min_clearance_m = 1.0;
    double angle_of_attack_rad_per_g = 0.0;
    int start_line = 1; ///< where [start] begins in the file
    /// Where the path starts, from its origin and as high over it, and on which course.
    double north_m = 0.0;
    double east_m = 0.0;
    double height_m = 0.0;
    double heading_rad = 0.0;
    double speed_mps = 0.0;
    std::vector<Leg> legs; ///< at least one
};

/// Reads a path file (TOML). Throws Error "file:line: expected ..., got ..." for a file that is
/// missing, not TOML, lacks a key, has an unknown or doubled key, a wrong type, a number that is
/// not finite or out of its bounds, or no legs.
PathScript read_path_script(const std::filesystem::path& file);

} // namespace octant::flightpaths
