// Field offsets: IEEE 1278.1-1995, 5.4.3.1, Entity State PDU. World axes are earth-centred; psi, theta and phi turn
// them into the body's in that order.

#include "sim/links/dis_entity.h"

#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/links/fix.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::sim::links {

namespace {

constexpr std::size_t dis_header_bytes = 12;
constexpr std::uint8_t entity_state_type = 1;
constexpr std::uint8_t entity_family = 1;
constexpr std::size_t articulation_bytes = 16;
constexpr std::size_t timestamp_at = 4;
constexpr std::size_t id_at = 12;
constexpr std::size_t force_at = 18;
constexpr std::size_t articulations_at = 19;
constexpr std::size_t type_at = 20;
constexpr std::size_t velocity_at = 36;
constexpr std::size_t position_at = 48;
constexpr std::size_t dis_angles_at = 72;
constexpr std::size_t reckoning_at = 88;
constexpr std::size_t acceleration_at = 104;
constexpr std::size_t rates_at = 116;
constexpr std::size_t marking_at = 128;
/// Timestamps count an hour in 2^31 - 1 parts, shifted by one bit; the last bit says whether the clock is absolute.
constexpr double parts_an_hour = 2147483648.0;
constexpr double hour_s = 3600.0;
constexpr double heartbeat_timeout_s = 12.0; ///< 2.4 heartbeats of 5 s, the standard's default

DecodeResult check_dis_head(const WireReader& reader) {
    const auto size = static_cast<std::uint32_t>(reader.size());
    if (size < dis_header_bytes) { return {PacketError::WrongSize, size, size}; }
    const auto version = reader.at<std::uint8_t>(0);
    const auto type = reader.at<std::uint8_t>(2);
    constexpr std::uint8_t last_version = 7;
    if (version == 0 || version > last_version) { return {PacketError::WrongVersion, version, size}; }
    if (type != entity_state_type || reader.at<std::uint8_t>(3) != entity_family) {
        return {PacketError::Unused, type, size};
    }
    const std::size_t expected = dis_entity_bytes + articulation_bytes * reader.at<std::uint8_t>(articulations_at);
    return {size == expected ? PacketError::None : PacketError::WrongSize, version, size};
}

void read_motion(const WireReader& reader, DisEntity& entity) {
    const glm::dvec3 ecef_m(
        reader.at<double>(position_at), reader.at<double>(position_at + 8), reader.at<double>(position_at + 16));
    const Geodetic place = geodetic_from_ecef(ecef_m);
    const glm::dmat3 to_ned = ned_from_ecef(place);
    Fix& fix = entity.fix;
    fix.latitude_deg = deg_from_rad(place.latitude_rad);
    fix.longitude_deg = deg_from_rad(place.longitude_rad);
    fix.altitude_m = place.height_m;
    const glm::dvec3 angles = reader.floats(dis_angles_at);
    fix.attitude = euler_from_ned_from_body(to_ned * ned_from_body({angles.x, angles.y, angles.z}));
    const bool moves = entity.reckoning != DeadReckoning::Static;
    const bool turns = entity.reckoning == DeadReckoning::Rpw || entity.reckoning == DeadReckoning::Rvw;
    const bool speeds_up = entity.reckoning == DeadReckoning::Rvw || entity.reckoning == DeadReckoning::Fvw;
    fix.velocity_ned_mps = moves ? to_ned * reader.floats(velocity_at) : glm::dvec3(0.0);
    fix.body_rates_radps = turns ? reader.floats(rates_at) : glm::dvec3(0.0);
    fix.acceleration_ned_mps2 = speeds_up ? to_ned * reader.floats(acceleration_at) : glm::dvec3(0.0);
}

} // namespace

DecodeResult decode_dis(Bytes datagram, DisEntity& entity) {
    const WireReader reader(datagram, ByteOrder::Big);
    DecodeResult result = check_dis_head(reader);
    if (result.fault != PacketError::None) { return result; }
    entity = {};
    entity.site = reader.at<std::uint16_t>(id_at);
    entity.application = reader.at<std::uint16_t>(id_at + 2);
    entity.entity = reader.at<std::uint16_t>(id_at + 4);
    entity.force = reader.at<std::uint8_t>(force_at);
    for (std::size_t i = 0; i < entity.type.size(); ++i) { entity.type[i] = reader.at<std::uint8_t>(type_at + i); }
    for (std::size_t i = 0; i < entity.marking.size(); ++i) { entity.marking[i] = reader.at<char>(marking_at + 1 + i); }
    const auto reckoning = reader.at<std::uint8_t>(reckoning_at);
    entity.reckoning = reckoning >= 1 && reckoning <= 5 ? DeadReckoning{reckoning} : DeadReckoning::Static;
    const double x = reader.at<double>(position_at);
    if (!std::isfinite(x) || !std::isfinite(reader.at<double>(position_at + 8)) ||
        !std::isfinite(reader.at<double>(position_at + 16))) {
        result.fault = PacketError::NotFinite;
        return result;
    }
    read_motion(reader, entity);
    entity.fix.ticks = reader.at<std::uint32_t>(timestamp_at);
    entity.fix.tick_s = hour_s / (2.0 * parts_an_hour);
    entity.fix.velocity_is_commanded = true;
    entity.fix.extrapolation_limit_s = heartbeat_timeout_s;
    entity.fix.vehicle = static_cast<std::uint64_t>(entity.site) << 32U |
                         static_cast<std::uint64_t>(entity.application) << 16U | entity.entity;
    result.fault = error_of_fix(entity.fix);
    return result;
}

std::string marking_of(const DisEntity& entity) {
    const auto end = std::ranges::find(entity.marking, '\0');
    std::string text(entity.marking.begin(), end);
    text.erase(text.find_last_not_of(' ') + 1);
    return printable(text);
}

std::string dis_text(const DecodeResult& result) {
    switch (result.fault) {
    case PacketError::None:
        return fmt::format("DIS version {} entity state of {} bytes: fine", result.got, result.size);
    case PacketError::Unused:
        return fmt::format("DIS PDU of type {}: passed over", result.got);
    case PacketError::WrongVersion:
        return fmt::format("expected a DIS PDU of version 1 to 7, got {}", result.got);
    case PacketError::WrongSize:
        return fmt::format("expected a DIS entity state of {} bytes and 16 for each articulation, got {}",
            dis_entity_bytes, result.size);
    case PacketError::NotFinite:
        return "DIS entity state: expected numbers, got one that is none";
    default:
        return "DIS entity state: expected an aircraft near the earth, got none";
    }
}

std::array<std::byte, dis_entity_bytes> encode_dis(const DisEntity& entity, double time_s) {
    WireWriter writer(ByteOrder::Big);
    writer.add_zeros(dis_entity_bytes);
    const Fix& fix = entity.fix;
    const Geodetic place{rad_from_deg(fix.latitude_deg), rad_from_deg(fix.longitude_deg), fix.altitude_m};
    const glm::dmat3 to_ecef = glm::transpose(ned_from_ecef(place));
    const auto floats_at = [&writer](std::size_t at, const glm::dvec3& values) {
        writer.set(at, static_cast<float>(values.x));
        writer.set(at + 4, static_cast<float>(values.y));
        writer.set(at + 8, static_cast<float>(values.z));
    };
    constexpr std::uint8_t version_1998 = 6;
    writer.set(0, version_1998);
    writer.set(1, std::uint8_t{1}); // exercise
    writer.set(2, entity_state_type);
    writer.set(3, entity_family);
    const double share = std::fmod(std::max(time_s, 0.0), hour_s) / hour_s;
    writer.set(timestamp_at, static_cast<std::uint32_t>(share * parts_an_hour) << 1U);
    writer.set(8, static_cast<std::uint16_t>(dis_entity_bytes));
    writer.set(id_at, entity.site);
    writer.set(id_at + 2, entity.application);
    writer.set(id_at + 4, entity.entity);
    writer.set(force_at, entity.force);
    for (std::size_t i = 0; i < entity.type.size(); ++i) {
        writer.set(type_at + i, entity.type[i]);
        writer.set(type_at + 8 + i, entity.type[i]);
    }
    floats_at(velocity_at, to_ecef * fix.velocity_ned_mps.value_or(glm::dvec3(0.0)));
    const glm::dvec3 ecef_m = ecef_from_geodetic(place);
    writer.set(position_at, ecef_m.x);
    writer.set(position_at + 8, ecef_m.y);
    writer.set(position_at + 16, ecef_m.z);
    const EulerAngles angles = euler_from_ned_from_body(to_ecef * ned_from_body(fix.attitude));
    floats_at(dis_angles_at, {wrapped_to_pi(angles.heading_rad), angles.pitch_rad, angles.roll_rad});
    writer.set(reckoning_at, static_cast<std::uint8_t>(entity.reckoning));
    floats_at(acceleration_at, to_ecef * fix.acceleration_ned_mps2);
    floats_at(rates_at, fix.body_rates_radps.value_or(glm::dvec3(0.0)));
    writer.set(marking_at, std::uint8_t{1}); // ASCII
    for (std::size_t i = 0; i < entity.marking.size(); ++i) { writer.set(marking_at + 1 + i, entity.marking[i]); }
    std::array<std::byte, dis_entity_bytes> datagram{};
    std::copy(writer.bytes().begin(), writer.bytes().end(), datagram.begin());
    return datagram;
}

} // namespace octant::sim::links
