#include "sim/links/cigi_responses.h"

#include "sim/links/cigi_packet_header.h"

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

} // namespace octant::sim::links
