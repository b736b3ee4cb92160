#include "sim/links/cigi_host.h"

#include "sim/base/axes.h"
#include "sim/links/cigi_packets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace octant::sim::links {

namespace {

std::uint8_t flags_of(const CigiResponseHeader& head, unsigned more) {
    constexpr unsigned nibble = 4;
    return static_cast<std::uint8_t>(
        (head.valid ? 1U : 0U) | more | (static_cast<unsigned>(head.host_frame) & 0xfU) << nibble);
}

void set_surface_angles(WireWriter& message, std::size_t at, const CigiSurfacePoint& surface) {
    set_cigi_angle(message, at, surface.azimuth_rad);
    set_cigi_angle(message, at + 4, surface.elevation_rad);
}

} // namespace

void add_start_of_frame(WireWriter& message, const CigiStartOfFrame& frame) {
    constexpr std::uint8_t major = 3;
    constexpr unsigned minor = 3;
    constexpr unsigned timestamp_valid = 1U << 2U;
    const std::size_t at = add_cigi_packet_header(message, 101, 24);
    message.set(at + 2, major);
    message.set(at + 3, frame.database);
    message.set(at + 5, static_cast<std::uint8_t>(static_cast<unsigned>(frame.mode) | timestamp_valid | minor << 4U));
    message.set(at + 6, cigi_magic);
    message.set(at + 8, frame.ig_frame);
    message.set(at + 12, frame.timestamp);
    message.set(at + 16, frame.host_frame);
}

void add_height_response(WireWriter& message, const CigiResponseHeader& head, CigiHeightKind kind, double height_m) {
    const std::size_t at = add_cigi_packet_header(message, 102, 16);
    message.set(at + 2, head.id);
    message.set(at + 4, flags_of(head, kind == CigiHeightKind::Hot ? 2U : 0U));
    message.set(at + 8, head.valid ? height_m : 0.0);
}

void add_extended_height_response(
    WireWriter& message, const CigiResponseHeader& head, double hat_m, const CigiSurfacePoint& surface) {
    const std::size_t at = add_cigi_packet_header(message, 103, 40);
    message.set(at + 2, head.id);
    message.set(at + 4, flags_of(head, 0));
    if (head.valid) {
        message.set(at + 8, hat_m);
        message.set(at + 16, surface.place.z);
        set_surface_angles(message, at + 28, surface);
    }
}

void add_los_response(
    WireWriter& message, const CigiResponseHeader& head, bool extended, const CigiLosResponse& sight) {
    const unsigned visible = sight.visible ? 1U : 0U;
    const auto count = static_cast<std::uint8_t>(1);
    const double range_m = sight.range_m.value_or(0.0);
    if (!extended) {
        const std::size_t at = add_cigi_packet_header(message, 104, 16);
        message.set(at + 2, head.id);
        message.set(at + 4, flags_of(head, visible << 2U));
        message.set(at + 5, count);
        message.set(at + 8, range_m);
        return;
    }
    const unsigned range_valid = sight.range_m ? 1U << 2U : 0U;
    const std::size_t at = add_cigi_packet_header(message, 105, 56);
    message.set(at + 2, head.id);
    message.set(at + 4, flags_of(head, range_valid | visible << 3U));
    message.set(at + 5, count);
    message.set(at + 8, range_m);
    if (sight.met) {
        message.set(at + 16, sight.met->place.x);
        message.set(at + 24, sight.met->place.y);
        message.set(at + 32, sight.met->place.z);
        set_surface_angles(message, at + 48, *sight.met);
    }
}

void add_position(WireWriter& message, std::uint16_t entity, const glm::dvec3& place, const EulerAngles& angles) {
    const std::size_t at = add_cigi_packet_header(message, 108, 48);
    message.set(at + 2, entity);
    message.set(at + 8, place.x);
    message.set(at + 16, place.y);
    message.set(at + 24, place.z);
    set_cigi_angle(message, at + 32, angles.roll_rad);
    set_cigi_angle(message, at + 36, angles.pitch_rad);
    set_cigi_angle(message, at + 40, angles.heading_rad);
}

namespace {

void set_floats(WireWriter& message, std::size_t at, const glm::dvec3& values) {
    for (int i = 0; i < 3; ++i) { message.set(at + 4 * static_cast<std::size_t>(i), static_cast<float>(values[i])); }
}

/// Roll, pitch and yaw, the last one from 0 to 360 degrees.
void set_angles(WireWriter& message, std::size_t at, const EulerAngles& angles) {
    set_cigi_angle(message, at, angles.roll_rad);
    set_cigi_angle(message, at + 4, angles.pitch_rad);
    set_cigi_angle(message, at + 8, wrapped_to_two_pi(angles.heading_rad));
}

} // namespace

void add_ig_control(WireWriter& message, const CigiIgControl& control) {
    constexpr std::uint8_t major = 3;
    constexpr unsigned minor = 3;
    const std::size_t at = add_cigi_packet_header(message, 1, 24);
    message.set(at + 2, major);
    message.set(at + 3, control.database);
    message.set(at + 4, static_cast<std::uint8_t>(static_cast<unsigned>(control.mode) |
                                                  (control.timestamp_valid ? 1U : 0U) << 2U | minor << 4U));
    message.set(at + 6, cigi_magic);
    message.set(at + 8, control.host_frame);
    message.set(at + 12, control.timestamp);
    message.set(at + 16, control.last_ig_frame);
}

void add_entity(WireWriter& message, const CigiEntityControl& entity) {
    constexpr std::uint8_t opaque = 255;
    const std::size_t at = add_cigi_packet_header(message, 2, 48);
    message.set(at + 2, entity.entity);
    message.set(
        at + 4, static_cast<std::uint8_t>(static_cast<unsigned>(entity.state) | (entity.attached ? 1U : 0U) << 2U |
                                          static_cast<unsigned>(entity.clamp) << 5U));
    message.set(at + 6, opaque);
    message.set(at + 8, entity.type);
    message.set(at + 10, entity.parent);
    set_angles(message, at + 12, entity.attitude);
    message.set(at + 24, entity.place.x);
    message.set(at + 32, entity.place.y);
    message.set(at + 40, entity.place.z);
}

void add_rate(WireWriter& message, const CigiRateControl& rate) {
    const std::size_t at = add_cigi_packet_header(message, 8, 32);
    message.set(at + 2, rate.entity);
    message.set(at + 5, static_cast<std::uint8_t>((rate.of_part ? 1U : 0U) | (rate.local ? 1U : 0U) << 1U));
    set_floats(message, at + 8, rate.mps);
    for (int i = 0; i < 3; ++i) { set_cigi_angle(message, at + 20 + 4 * static_cast<std::size_t>(i), rate.radps[i]); }
}

void add_view_control(WireWriter& message, const CigiViewControl& view) {
    constexpr std::uint8_t all = 0x3f;
    const std::size_t at = add_cigi_packet_header(message, 16, 32);
    message.set(at + 2, view.view);
    message.set(at + 4, view.group);
    message.set(at + 5, all);
    message.set(at + 6, view.entity);
    set_floats(message, at + 8, view.offset_m);
    set_angles(message, at + 20, view.angles);
}

void add_view_definition(WireWriter& message, const CigiViewDefinition& view) {
    constexpr std::uint8_t sides = 0x3c;
    const std::size_t at = add_cigi_packet_header(message, 21, 32);
    message.set(at + 2, view.view);
    message.set(at + 4, view.group);
    message.set(at + 5, sides);
    set_cigi_angle(message, at + 16, view.left_rad);
    set_cigi_angle(message, at + 20, view.right_rad);
    set_cigi_angle(message, at + 24, view.top_rad);
    set_cigi_angle(message, at + 28, view.bottom_rad);
}

std::optional<CigiStartOfFrame> start_of_frame_of(Bytes message) {
    constexpr std::size_t bytes = 24;
    constexpr std::uint8_t opcode = 101;
    constexpr std::uint8_t major = 3;
    if (message.size() < bytes) { return std::nullopt; }
    const WireReader big(message, ByteOrder::Big);
    const auto word = big.at<std::uint16_t>(6);
    const bool swapped = word != cigi_magic;
    if (big.at<std::uint8_t>(0) != opcode || big.at<std::uint8_t>(1) != bytes || big.at<std::uint8_t>(2) != major ||
        (swapped && word != swapped_cigi_magic)) {
        return std::nullopt;
    }
    const WireReader reader(message, swapped ? ByteOrder::Little : ByteOrder::Big);
    CigiStartOfFrame frame;
    frame.database = reader.at<std::int8_t>(3);
    constexpr unsigned mode_bits = 3U;
    constexpr unsigned last_mode = 2U;
    frame.mode =
        static_cast<CigiMode>(std::min(static_cast<unsigned>(reader.at<std::uint8_t>(5)) & mode_bits, last_mode));
    frame.ig_frame = reader.at<std::uint32_t>(8);
    frame.timestamp = reader.at<std::uint32_t>(12);
    frame.host_frame = reader.at<std::uint32_t>(16);
    return frame;
}

} // namespace octant::sim::links
