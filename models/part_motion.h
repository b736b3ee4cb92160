#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace octant::models {

/// What sets parts of an aircraft in flight. All positions are 0 at rest: nothing deflected, flaps and gear up.
enum class FlightControl : std::uint8_t {
    Roll,       ///< -1 to 1, positive for the right wing down
    Pitch,      ///< -1 to 1, positive for the nose up
    Yaw,        ///< -1 to 1, positive for the nose to the right
    Flaps,      ///< 0 to 1
    SpeedBrake, ///< 0 to 1
    Gear        ///< 0 up, 1 down
};

inline constexpr std::size_t flight_control_count = 6;

/// The position of each FlightControl.
using ControlPositions = std::array<double, flight_control_count>;

/// The least position of a control: -1 or 0.
double least_position(FlightControl control);

/// How one control moves a part, or shows and hides it.
struct PartMove {
    enum class Kind : std::uint8_t { Turn, Shift, Show };

    Kind kind = Kind::Turn;
    FlightControl control = FlightControl::Roll;
    glm::dvec3 point_m{0.0};             ///< of the axis of a turn
    glm::dvec3 direction{1.0, 0.0, 0.0}; ///< unit; a turn follows the right-hand rule about it, a shift leads along it
    /// Positions of the control, ascending, and what belongs to each: radians, metres, or 1 for shown and 0 for hidden.
    /// Straight lines between them; the end values beyond them. Turns and shifts are 0 at rest.
    std::vector<glm::dvec2> amounts;

    bool operator==(const PartMove&) const = default;
};

/// The moves of a part. The first one moves what the others have moved.
using PartMoves = std::vector<PartMove>;

/// A move whose amount at each position of the control is `amount_at(position)` less that at rest (of Show itself);
/// nothing where that is 0 everywhere, or 1 of Show. It is taken at 21 positions from 0 to each end.
std::optional<PartMove> sampled_move(
    PartMove::Kind kind, FlightControl control, const std::function<double(double)>& amount_at);

/// Where the moves put a part whose places are those at rest. What is hidden shrinks to a point.
glm::dmat4 placement_by(std::span<const PartMove> moves, const ControlPositions& positions);

bool is_shown_at_rest(std::span<const PartMove> moves);

} // namespace octant::models
