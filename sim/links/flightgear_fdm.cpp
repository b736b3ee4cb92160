// Field offsets: FlightGear, src/Network/net_fdm.hxx (public domain). Version 25 puts 144 bytes of tanks behind
// fuel_quantity, at 304; all later fields are so much further on.

#include "sim/links/flightgear_fdm.h"

#include "sim/base/units.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::sim::links {

namespace {

constexpr std::size_t version_at = 0;
constexpr std::size_t longitude_at = 8;
constexpr std::size_t latitude_at = 16;
constexpr std::size_t altitude_at = 24;
constexpr std::size_t agl_at = 32;
constexpr std::size_t fdm_angles_at = 36;   ///< phi, theta, psi
constexpr std::size_t angle_rates_at = 56;  ///< of phi, theta, psi
constexpr std::size_t fdm_velocity_at = 76; ///< north, east, down, ft/s
constexpr std::size_t time_at = 356;        ///< of version 24
constexpr std::size_t longer_in_25 = fdm_25_bytes - fdm_24_bytes;
constexpr float no_agl_below_m = -9000.0F;

/// Rates about the body's axes from the rates of roll, pitch and heading, and back: any text on flight dynamics, e.g.
/// Stevens and Lewis, Aircraft Control and Simulation, eq. 1.4-4.
glm::dvec3 body_from_angle_rates(const EulerAngles& at, const glm::dvec3& rates) {
    const double sr = std::sin(at.roll_rad);
    const double cr = std::cos(at.roll_rad);
    const double sp = std::sin(at.pitch_rad);
    const double cp = std::cos(at.pitch_rad);
    return {rates.x - rates.z * sp, rates.y * cr + rates.z * cp * sr, rates.z * cp * cr - rates.y * sr};
}

glm::dvec3 angle_from_body_rates(const EulerAngles& at, const glm::dvec3& body) {
    const double sr = std::sin(at.roll_rad);
    const double cr = std::cos(at.roll_rad);
    constexpr double steepest = 1e-3;
    const double cp = std::max(std::cos(at.pitch_rad), steepest);
    const double heading = (body.y * sr + body.z * cr) / cp;
    return {body.x + heading * std::sin(at.pitch_rad), body.y * cr - body.z * sr, heading};
}

DecodeResult check_fdm_head(const WireReader& reader) {
    const auto size = static_cast<std::uint32_t>(reader.size());
    const auto version = reader.at<std::uint32_t>(version_at);
    if (size < sizeof(version)) { return {PacketError::WrongSize, size, size}; }
    if (version != 24 && version != 25) { return {PacketError::WrongVersion, version, size}; }
    const std::size_t expected = version == 24 ? fdm_24_bytes : fdm_25_bytes;
    return {size == expected ? PacketError::None : PacketError::WrongSize, version, size};
}

} // namespace

DecodeResult decode_fdm(Bytes datagram, Fix& fix) {
    const WireReader reader(datagram, ByteOrder::Big);
    DecodeResult result = check_fdm_head(reader);
    if (result.fault != PacketError::None) { return result; }
    fix = {};
    fix.latitude_deg = deg_from_rad(reader.at<double>(latitude_at));
    fix.longitude_deg = deg_from_rad(reader.at<double>(longitude_at));
    fix.altitude_m = reader.at<double>(altitude_at);
    const auto agl_m = reader.at<float>(agl_at);
    if (!(agl_m < no_agl_below_m)) { fix.above_ground_m = static_cast<double>(agl_m); }
    const glm::dvec3 angles = reader.floats(fdm_angles_at);
    fix.attitude = {angles.z, angles.y, angles.x};
    fix.body_rates_radps = body_from_angle_rates(fix.attitude, reader.floats(angle_rates_at));
    const glm::dvec3 velocity_ftps = reader.floats(fdm_velocity_at);
    fix.velocity_ned_mps =
        glm::dvec3(m_from_ft(velocity_ftps.x), m_from_ft(velocity_ftps.y), m_from_ft(velocity_ftps.z));
    fix.ticks = reader.at<std::uint32_t>(result.got == 24 ? time_at : time_at + longer_in_25);
    result.fault = error_of_fix(fix);
    return result;
}

std::string fdm_text(const DecodeResult& result) {
    const auto [fault, got, size] = result;
    switch (fault) {
    case PacketError::None:
        return fmt::format("FDM version {} of {} bytes: fine", got, size);
    case PacketError::WrongSize:
        if (size < sizeof(got)) { return fmt::format("expected an FDM packet, got {} bytes", size); }
        return fmt::format(
            "FDM version {}: expected {} bytes, got {}", got, got == 25 ? fdm_25_bytes : fdm_24_bytes, size);
    case PacketError::NotFinite:
        return fmt::format("FDM version {}: expected numbers, got one that is none", got);
    case PacketError::OutOfRange:
        return fmt::format("FDM version {}: expected an aircraft near the earth, got none", got);
    default:
        return fmt::format("expected FDM version 24 or 25, got {} in {} bytes", got, size);
    }
}

std::array<std::byte, fdm_24_bytes> encode_fdm(const Fix& fix) {
    WireWriter writer(ByteOrder::Big);
    writer.add_zeros(fdm_24_bytes);
    const auto floats = [&writer](std::size_t offset, const glm::dvec3& values) {
        writer.set(offset, static_cast<float>(values.x));
        writer.set(offset + 4, static_cast<float>(values.y));
        writer.set(offset + 8, static_cast<float>(values.z));
    };
    constexpr double unknown_agl_m = -9999.0;
    writer.set(version_at, std::uint32_t{24});
    writer.set(longitude_at, rad_from_deg(fix.longitude_deg));
    writer.set(latitude_at, rad_from_deg(fix.latitude_deg));
    writer.set(altitude_at, fix.altitude_m);
    writer.set(agl_at, static_cast<float>(fix.above_ground_m.value_or(unknown_agl_m)));
    floats(fdm_angles_at, {fix.attitude.roll_rad, fix.attitude.pitch_rad, fix.attitude.heading_rad});
    if (fix.body_rates_radps) { floats(angle_rates_at, angle_from_body_rates(fix.attitude, *fix.body_rates_radps)); }
    if (fix.velocity_ned_mps) {
        const glm::dvec3& v = *fix.velocity_ned_mps;
        floats(fdm_velocity_at, {ft_from_m(v.x), ft_from_m(v.y), ft_from_m(v.z)});
    }
    writer.set(time_at, fix.ticks.value_or(0));
    std::array<std::byte, fdm_24_bytes> datagram{};
    std::copy(writer.bytes().begin(), writer.bytes().end(), datagram.begin());
    return datagram;
}

} // namespace octant::sim::links
