// Frames and messages: the public MAVLink definition (common.xml and the serialisation page of mavlink.io). Fields of a
// message stand by size, the largest first.

#include "sim/links/mavlink.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "sim/links/fix.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace octant::sim::links {

namespace {

constexpr auto magic_1 = std::byte{0xFE};
constexpr auto magic_2 = std::byte{0xFD};
constexpr std::size_t header_1 = 6;
constexpr std::size_t header_2 = 10;
constexpr std::size_t sum_bytes = 2;
constexpr std::size_t signature_bytes = 13;
constexpr double per_degree = 1e7;
constexpr double per_metre = 1e3;
constexpr double cm_per_m = 100.0;

struct Message {
    MavLinkKind kind;
    std::size_t length;
    std::uint8_t extra; ///< what the definition adds to the check sum
};

constexpr std::array<Message, 4> messages{{{MavLinkKind::Heartbeat, 9, 50}, {MavLinkKind::Attitude, 28, 39},
    {MavLinkKind::GlobalPositionInt, 28, 104}, {MavLinkKind::HilStateQuaternion, 64, 4}}};

const Message* message_of(std::uint32_t number) {
    const auto found = std::ranges::find_if(
        messages, [number](const Message& message) { return static_cast<std::uint32_t>(message.kind) == number; });
    return found == messages.end() ? nullptr : &*found;
}

/// CRC-16/MCRF4XX, byte by byte.
std::uint16_t summed(std::uint16_t sum, std::byte byte) {
    auto low = static_cast<std::uint8_t>(std::to_integer<unsigned>(byte) ^ (sum & 0xffU));
    low = static_cast<std::uint8_t>(low ^ (low << 4U));
    return static_cast<std::uint16_t>((sum >> 8U) ^ (low << 8U) ^ (low << 3U) ^ (low >> 4U));
}

std::uint16_t sum_of(Bytes bytes, std::uint8_t extra) {
    std::uint16_t sum = 0xffff;
    for (const std::byte byte : bytes) { sum = summed(sum, byte); }
    return summed(sum, std::byte{extra});
}

glm::dvec3 velocity_ned(const WireReader& reader, std::size_t at) {
    return glm::dvec3(reader.at<std::int16_t>(at), reader.at<std::int16_t>(at + 2), reader.at<std::int16_t>(at + 4)) /
           cm_per_m;
}

void set_place(const WireReader& reader, std::size_t at, Fix& fix) {
    fix.latitude_deg = reader.at<std::int32_t>(at) / per_degree;
    fix.longitude_deg = reader.at<std::int32_t>(at + 4) / per_degree;
    fix.altitude_m = reader.at<std::int32_t>(at + 8) / per_metre;
}

double boot_s(const WireReader& reader) {
    constexpr double ms_per_s = 1e3;
    return reader.at<std::uint32_t>(0) / ms_per_s;
}

/// Autopilots that do not know yet where they are say 0 N, 0 E.
std::optional<Fix> plausible(const Fix& fix) {
    const bool is_somewhere = fix.latitude_deg != 0.0 || fix.longitude_deg != 0.0;
    return is_somewhere && error_of_fix(fix) == PacketError::None ? std::optional(fix) : std::nullopt;
}

} // namespace

MavLinkParse parse_mavlink(Bytes bytes) {
    const auto size = static_cast<std::uint32_t>(bytes.size());
    if (bytes.empty() || (bytes.front() != magic_1 && bytes.front() != magic_2)) {
        const auto next =
            std::find_if(bytes.begin(), bytes.end(), [](std::byte byte) { return byte == magic_1 || byte == magic_2; });
        const auto skipped = static_cast<std::size_t>(next - bytes.begin());
        return {{PacketError::NotOurs, size, size}, std::max<std::size_t>(skipped, 1), {}};
    }
    const WireReader reader(bytes, ByteOrder::Little);
    const bool is_2 = bytes.front() == magic_2;
    const std::size_t header = is_2 ? header_2 : header_1;
    const std::size_t payload = reader.at<std::uint8_t>(1);
    const bool is_signed = is_2 && (reader.at<std::uint8_t>(2) & 1U) != 0;
    const std::size_t length = header + payload + sum_bytes + (is_signed ? signature_bytes : 0);
    if (bytes.size() < length) {
        return {{PacketError::WrongSize, size, size}, std::max<std::size_t>(bytes.size(), 1), {}};
    }
    const std::uint32_t number =
        is_2 ? reader.at<std::uint16_t>(7) | static_cast<std::uint32_t>(reader.at<std::uint8_t>(9)) << 16U
             : reader.at<std::uint8_t>(5);
    MavLinkParse parse{.result = {PacketError::Unused, number, size},
        .length = length,
        .frame = {},
        .system = reader.at<std::uint8_t>(is_2 ? 5 : 3),
        .component = reader.at<std::uint8_t>(is_2 ? 6 : 4),
        .sequence = reader.at<std::uint8_t>(is_2 ? 4 : 2)};
    const Message* const message = message_of(number);
    if (message == nullptr) { return parse; }
    const Bytes summed_bytes = bytes.subspan(1, header - 1 + payload);
    const auto sum = reader.at<std::uint16_t>(header + payload);
    if (payload > message->length || sum != sum_of(summed_bytes, message->extra)) {
        return {{PacketError::WrongVersion, number, size}, length, {}};
    }
    parse.result.fault = PacketError::None;
    const Bytes held = bytes.subspan(header, payload);
    parse.frame = MavLinkFrame{message->kind, parse.system, {held.begin(), held.end()}};
    parse.frame->payload.resize(message->length);
    return parse;
}

std::optional<Fix> MavLinkPose::take(const MavLinkFrame& frame, const Ellipsoid& ellipsoid) {
    switch (frame.kind) {
    case MavLinkKind::HilStateQuaternion:
        return take_hil(frame);
    case MavLinkKind::GlobalPositionInt:
        return take_position(frame);
    case MavLinkKind::Attitude:
        return hil_ ? std::nullopt : take_attitude(frame, ellipsoid);
    default:
        return std::nullopt;
    }
}

std::optional<Fix> MavLinkPose::take_hil(const MavLinkFrame& frame) {
    const WireReader reader(frame.payload, ByteOrder::Little);
    constexpr double us_per_s = 1e6;
    Fix fix;
    fix.vehicle = frame.system;
    fix.sent_s = static_cast<double>(reader.at<std::uint64_t>(0)) / us_per_s;
    const glm::dvec3 xyz = reader.floats(12);
    const glm::dquat ned_from_body(static_cast<double>(reader.at<float>(8)), xyz.x, xyz.y, xyz.z);
    const double length = glm::length(ned_from_body);
    constexpr double max_off_unit = 0.1;
    if (!(std::abs(length - 1.0) < max_off_unit)) { return std::nullopt; }
    const glm::dmat3 m = glm::mat3_cast(ned_from_body / length);
    fix.attitude = {wrapped_to_two_pi(std::atan2(m[0].y, m[0].x)), std::asin(std::clamp(-m[0].z, -1.0, 1.0)),
        std::atan2(m[1].z, m[2].z)};
    fix.body_rates_radps = reader.floats(24);
    set_place(reader, 36, fix);
    if (position_) { fix.above_home_m = fix.altitude_m - (position_->altitude_m - *position_->above_home_m); }
    fix.velocity_ned_mps = velocity_ned(reader, 48);
    hil_ = true;
    return plausible(fix);
}

std::optional<Fix> MavLinkPose::take_position(const MavLinkFrame& frame) {
    const WireReader reader(frame.payload, ByteOrder::Little);
    Fix fix;
    fix.vehicle = frame.system;
    fix.sent_s = boot_s(reader);
    set_place(reader, 4, fix);
    fix.above_home_m = reader.at<std::int32_t>(16) / per_metre;
    fix.velocity_ned_mps = velocity_ned(reader, 20);
    constexpr std::uint16_t no_heading = 65535;
    const auto heading_cdeg = reader.at<std::uint16_t>(26);
    fix.attitude.heading_rad = heading_cdeg == no_heading ? 0.0 : rad_from_deg(heading_cdeg / cm_per_m);
    if (!plausible(fix)) { return std::nullopt; }
    position_ = fix;
    // Attitudes come more often; while they do, they carry the position on.
    constexpr double attitude_kept_s = 0.5;
    const bool carried = attitude_s_ && std::abs(*fix.sent_s - *attitude_s_) < attitude_kept_s;
    return hil_ || carried ? std::nullopt : position_;
}

std::optional<Fix> MavLinkPose::take_attitude(const MavLinkFrame& frame, const Ellipsoid& ellipsoid) {
    const WireReader reader(frame.payload, ByteOrder::Little);
    const double sent_s = boot_s(reader);
    attitude_s_ = sent_s;
    if (!position_) { return std::nullopt; }
    constexpr double max_carried_s = 2.0;
    const double carried_s = sent_s - *position_->sent_s;
    if (std::abs(carried_s) > max_carried_s) { return std::nullopt; }
    Fix fix = *position_;
    const glm::dvec3 moved_m = carried_s * *fix.velocity_ned_mps;
    const Geodetic moved = offset_by(
        {rad_from_deg(fix.latitude_deg), rad_from_deg(fix.longitude_deg), fix.altitude_m}, moved_m, ellipsoid);
    fix.latitude_deg = std::clamp(deg_from_rad(moved.latitude_rad), -90.0, 90.0);
    fix.longitude_deg = deg_from_rad(moved.longitude_rad);
    fix.altitude_m = moved.height_m;
    *fix.above_home_m -= moved_m.z;
    fix.sent_s = sent_s;
    const glm::dvec3 angles = reader.floats(4);
    fix.attitude = {angles.z, angles.y, angles.x};
    fix.body_rates_radps = reader.floats(16);
    return plausible(fix);
}

std::string mavlink_text(const DecodeResult& result) {
    switch (result.fault) {
    case PacketError::None:
        return fmt::format("MAVLink message {}: fine", result.got);
    case PacketError::Unused:
        return fmt::format("MAVLink message {}: passed over", result.got);
    case PacketError::WrongVersion:
        return fmt::format("MAVLink message {}: its check sum is wrong", result.got);
    case PacketError::WrongSize:
        return "expected a whole MAVLink frame, got a piece of one";
    default:
        return fmt::format("expected MAVLink 1 or 2, got {} bytes of something else", result.size);
    }
}

} // namespace octant::sim::links
