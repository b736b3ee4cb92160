#pragma once

#include "sim/base/axes.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace octant::sim::links {

/// Where a vehicle is and how it moves, as its sender says it, on the WGS 84 ellipsoid. All numbers are finite and
/// within the bounds of is_plausible().
struct Fix {
    std::uint64_t vehicle = 0;  ///< which of the sender's vehicles
    double latitude_deg = 0.0;  ///< geodetic, -90 .. 90
    double longitude_deg = 0.0; ///< -360 .. 360
    double altitude_m = 0.0;    ///< above mean sea level
    /// East and north of the flight's place, in metres, in place of latitude and longitude.
    std::optional<glm::dvec2> local_m;
    /// Above the sender's own ground, where it says so.
    std::optional<double> above_ground_m;
    /// Above the place where it started, where the sender says so.
    std::optional<double> above_home_m;
    EulerAngles attitude;
    /// North, east, down over the ground, where the protocol has it. Some senders leave it zero.
    std::optional<glm::dvec3> velocity_ned_mps;
    /// The velocity is how it is to go on, zero too.
    bool velocity_is_commanded = false;
    /// How long the protocol has the motion go on without a further packet; 0 = it does not say.
    double extrapolation_limit_s = 0.0;
    /// North, east, down; zero where the protocol has none.
    glm::dvec3 acceleration_ned_mps2{0.0};
    /// About the body's axes, where the protocol has it.
    std::optional<glm::dvec3> body_rates_radps;
    /// The sender's clock in a unit that the protocol does not tell; it wraps around.
    std::optional<std::uint32_t> ticks;
    double tick_s = 0.0; ///< the unit of the ticks where the protocol does tell it, else 0
    /// The sender's clock in seconds.
    std::optional<double> sent_s;
};

/// The fix as it is from axes whose y axis true north lies so far clockwise of.
Fix with_rotated_axes(Fix fix, double north_bearing_rad);

/// Why a packet was not taken.
enum class PacketError {
    None,
    WrongSize,    ///< Verdict::got bytes
    WrongVersion, ///< Verdict::got
    NotFinite,    ///< a number that is none
    OutOfRange,   ///< a number that no aircraft has
    NotOurs,      ///< the beginning is that of another protocol
    OtherKind,    ///< of a kind that is not read at this port: Verdict::got is its PacketKind
    Unused,       ///< right, but nothing is to be shown of it
};

/// What a decoder made of one packet.
struct DecodeResult {
    PacketError fault = PacketError::None;
    std::uint32_t got = 0;  ///< size or version, as the fault says
    std::uint32_t size = 0; ///< bytes of the packet

    bool operator==(const DecodeResult&) const = default;
};

/// NotFinite or OutOfRange for what no aircraft near the earth can have: heights beyond 1,000 km, speeds beyond 20
/// km/s, more than 100 rad/s.
PacketError error_of_fix(const Fix& fix);

} // namespace octant::sim::links
