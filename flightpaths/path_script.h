#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <vector>

namespace octant::flightpaths {

/// Smallest and largest number that a key may have.
struct NumberRange {
    double least = 0.0;
    double most = 0.0;
};

/// The keys of one TOML table, taken one by one; what is left over at the end is refused. The unit of a number is the
/// end of its key: speed_mps and speed_kt are two ways to say one thing. All numbers come back in SI units and radians.
/// Every fault throws Error with the file and the line.
class TomlFields {
public:
    TomlFields(const std::filesystem::path& file, const toml::table& table);

    int line() const { return line_; }

    /// `name` + "_" + one of the units that belong to `base_unit` ("m", "mps", "rad", "s", "g", "mps2", "radps"), or
    /// `name` alone when `base_unit` is empty. Bounds are in the base unit.
    std::optional<double> number(std::string_view name, std::string_view base_unit, NumberRange bounds);
    double required_number(std::string_view name, std::string_view base_unit, NumberRange bounds);
    int required_integer(std::string_view name, int least, int most);
    std::optional<std::string> text(std::string_view name);
    std::string required_text(std::string_view name);
    /// One of the words; their order is the order in which a message lists them.
    std::string required_word(std::string_view name, std::initializer_list<std::string_view> words);
    /// The table under `name`, which must be there.
    const toml::table& required_table(std::string_view name);
    /// The array of tables under `name`, which must be there with at least one table.
    const toml::array& required_tables(std::string_view name);
    /// Throws Error for a key that nothing has asked for.
    void finish() const;

    [[noreturn]] void refuse(int line, const std::string& what) const;

private:
    const toml::node* take(std::string_view key);
    double number_of(const toml::node& node, std::string_view key) const;
    [[noreturn]] void refuse_missing(std::string_view key) const;

    const std::filesystem::path& file_;
    const toml::table& table_;
    int line_ = 1;
    std::set<std::string, std::less<>> requested_keys_;
};

/// The root of a file's TOML `text`. Throws Error with the file and the line for a fault.
toml::table parse_toml(const std::filesystem::path& file, std::string_view text);

/// Line of a node in its file, from 1.
int line_of(const toml::node& node);

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
