#pragma once

#include "sim/base/axes.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace octant::sim::links {

/// Where a vehicle is and how it moves, as its sender says it, on the WGS 84 ellipsoid. All numbers
/// are finite and within the bounds of is_plausible().
struct Fix {
    std::uint64_t vehicle = 0;  ///< which of the sender's vehicles
    double latitude_deg = 0.0;  ///< geodetic, -90 .. 90
    double longitude_deg = 0.0; ///< -360 .. 360
    double altitude_m = 0.0;    ///< above mean sea level
    /// Above the sender's own ground, where it says so.
    std::optional<double> above_ground_m;
    EulerAngles attitude;
    /// North, east, down over the ground, where the protocol has it. Some senders leave it zero.
    std::optional<glm::dvec3> velocity_ned_mps;
    /// About the body's axes, where the protocol has it.
    std::optional<glm::dvec3> body_rates_radps;
    /// The sender's clock in a unit that the protocol does not tell; it wraps around.
    std::optional<std::uint32_t> ticks;
    /// The sender's clock in seconds.
    std::optional<double> sent_s;
};

/// Why a packet was not taken.
enum class Fault {
    None,
    WrongSize,    ///< Verdict::got bytes
    WrongVersion, ///< Verdict::got
    SwappedBytes, ///< it would be right with its bytes the other way round
    NotFinite,    ///< a number that is none
    OutOfRange,   ///< a number that no aircraft has
    NotOurs,      ///< the beginning is that of another protocol
    Unused,       ///< right, but nothing is to be shown of it
};

/// What a decoder made of one packet.
struct Verdict {
    Fault fault = Fault::None;
    std::uint32_t got = 0;  ///< size or version, as the fault says
    std::uint32_t size = 0; ///< bytes of the packet

    bool operator==(const Verdict&) const = default;
};

/// NotFinite or OutOfRange for what no aircraft near the earth can have: heights beyond 1,000 km,
/// speeds beyond 20 km/s, more than 100 rad/s.
Fault fault_of(const Fix& fix);

} // namespace octant::sim::links
