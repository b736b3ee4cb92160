#pragma once

#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace octant::sim::links {

/// Position and motion of one vehicle as its sender reports them, on the WGS 84 ellipsoid. All numbers are finite and
/// within the bounds of error_of_fix().
struct Fix {
    std::uint64_t vehicle = 0;  ///< number of the vehicle at its sender
    double latitude_deg = 0.0;  ///< geodetic, -90 .. 90
    double longitude_deg = 0.0; ///< -360 .. 360
    double altitude_m = 0.0;    ///< above mean sea level
    /// East and north of the flight's origin, metres; replaces latitude and longitude.
    std::optional<glm::dvec2> local_m;
    /// Height above the sender's own ground, if it reports one.
    std::optional<double> above_ground_m;
    /// Height above the place where the vehicle started, if the sender reports one.
    std::optional<double> above_home_m;
    EulerAngles attitude;
    /// North, east, down over the ground, if the protocol has it. Some senders leave it zero.
    std::optional<glm::dvec3> velocity_ned_mps;
    /// True if the motion shall continue with this velocity even if it is zero.
    bool velocity_is_commanded = false;
    /// How long the protocol lets the motion continue without another packet; 0 = not specified.
    double extrapolation_limit_s = 0.0;
    /// North, east, down; zero if the protocol has none.
    glm::dvec3 acceleration_ned_mps2{0.0};
    /// About the body axes, if the protocol has them.
    std::optional<glm::dvec3> body_rates_radps;
    /// The sender's clock in a unit that the protocol does not specify; wraps around.
    std::optional<std::uint32_t> ticks;
    double tick_s = 0.0; ///< unit of the ticks, 0 if the protocol does not specify it
    /// The sender's clock in seconds.
    std::optional<double> sent_s;
};

/// The fix in axes in which true north is `north_bearing_rad` clockwise from the y axis.
Fix with_rotated_axes(Fix fix, double north_bearing_rad);

/// Why a packet was not taken.
enum class PacketError {
    None,
    WrongSize,    ///< DecodeResult::got bytes
    WrongVersion, ///< DecodeResult::got
    NotFinite,    ///< a number is NaN or infinite
    OutOfRange,   ///< a number is impossible for an aircraft
    NotOurs,      ///< the packet begins like one of another protocol
    OtherKind,    ///< not read at this port: DecodeResult::got is its PacketKind
    Unused,       ///< correct, but nothing of it is shown
};

/// What a decoder made of one packet.
struct DecodeResult {
    PacketError fault = PacketError::None;
    std::uint32_t got = 0;  ///< size, version or kind, see PacketError
    std::uint32_t size = 0; ///< bytes of the packet

    bool operator==(const DecodeResult&) const = default;
};

/// NotFinite or OutOfRange for what no aircraft near the earth can have: heights beyond 1,000 km, speeds beyond 20
/// km/s, more than 100 rad/s.
PacketError error_of_fix(const Fix& fix);

/// A place on or above the WGS 84 ellipsoid.
struct Geodetic {
    double latitude_rad = 0.0;
    double longitude_rad = 0.0;
    double height_m = 0.0;
};

/// Earth-centred, earth-fixed metres of a place, and back: to 1e-6 m between the centre's neighbourhood (1,000 km of it
/// are left out: there latitude has no sense) and any height.
glm::dvec3 ecef_from_geodetic(const Geodetic& place);
Geodetic geodetic_from_ecef(const glm::dvec3& ecef_m);

/// The position a small distance north, east and down of another one on an ellipsoid.
Geodetic offset_by(const Geodetic& place, const glm::dvec3& ned_m, const Ellipsoid& ellipsoid);

/// Rotation that takes earth-fixed vectors to north, east, down at a place.
glm::dmat3 ned_from_ecef(const Geodetic& place);

/// Rotation of an aircraft with these angles: body to north, east, down.
glm::dmat3 ned_from_body(const EulerAngles& angles);

/// The angles of such a rotation.
EulerAngles euler_from_ned_from_body(const glm::dmat3& ned_from_body);

/// value + slope t + bend t^2.
template <class Value>
struct Parabola {
    Value value{};
    Value slope{};
    Value bend{};
};

/// The weighted least squares of points by a line or a parabola, from sums: points are added, not kept. Value: double
/// or glm::dvec3.
template <class Value>
class ParabolaFit {
public:
    void add(double t, const Value& value, double weight = 1.0) {
        double power = weight;
        for (std::size_t k = 0; k < t_.size(); ++k) {
            t_[k] += power;
            if (k < v_.size()) { v_[k] += power * value; }
            power *= t;
        }
    }

    /// Nothing if the points do not determine it.
    std::optional<Parabola<Value>> line() const {
        const double determinant = t_[0] * t_[2] - t_[1] * t_[1];
        if (!(determinant > min_share * t_[0] * t_[2])) { return std::nullopt; }
        return Parabola<Value>{
            (t_[2] * v_[0] - t_[1] * v_[1]) / determinant, (t_[0] * v_[1] - t_[1] * v_[0]) / determinant, Value(0.0)};
    }

    /// Nothing if the points do not determine it.
    std::optional<Parabola<Value>> parabola() const {
        const auto& [s0, s1, s2, s3, s4] = t_;
        // Cofactors of the symmetric matrix of the normal equations.
        const double a = s2 * s4 - s3 * s3;
        const double b = s2 * s3 - s1 * s4;
        const double c = s1 * s3 - s2 * s2;
        const double d = s0 * s4 - s2 * s2;
        const double e = s1 * s2 - s0 * s3;
        const double f = s0 * s2 - s1 * s1;
        const double determinant = s0 * a + s1 * b + s2 * c;
        if (!(determinant > min_share * s0 * s2 * s4)) { return std::nullopt; }
        return Parabola<Value>{(a * v_[0] + b * v_[1] + c * v_[2]) / determinant,
            (b * v_[0] + d * v_[1] + e * v_[2]) / determinant, (c * v_[0] + e * v_[1] + f * v_[2]) / determinant};
    }

private:
    static constexpr double min_share = 1e-9; ///< of what the determinant is without cancellation

    std::array<double, 5> t_{}; ///< sums of weight t^k
    std::array<Value, 3> v_{};  ///< sums of weight t^k value
};

} // namespace octant::sim::links
