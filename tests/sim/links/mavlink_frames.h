#pragma once

#include "sim/links/mavlink.h"
#include "sim/links/wire_bytes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::tests {

/// What MAVLink's definition adds to the check sum of a message of this kind.
inline std::uint8_t mavlink_extra(sim::links::MavLinkKind kind) {
    switch (kind) {
    case sim::links::MavLinkKind::Heartbeat:
        return 50;
    case sim::links::MavLinkKind::Attitude:
        return 39;
    case sim::links::MavLinkKind::GlobalPositionInt:
        return 104;
    case sim::links::MavLinkKind::HilStateQuaternion:
        return 4;
    }
    return 0;
}

/// CRC-16/MCRF4XX, one bit after the other: worked out in another way than the decoder does.
inline std::uint16_t crc_mcrf4xx(std::uint16_t sum, std::byte byte) {
    sum = static_cast<std::uint16_t>(sum ^ std::to_integer<std::uint16_t>(byte));
    for (int bit = 0; bit < 8; ++bit) {
        const bool odd = (sum & 1U) != 0;
        sum = static_cast<std::uint16_t>((sum >> 1U) ^ (odd ? 0x8408U : 0U));
    }
    return sum;
}

/// A frame of MAVLink 2 without a signature, as an autopilot sends it. The payload is taken as it is, also where zeros
/// were cut off its end.
inline std::vector<std::byte> encode_mavlink(const sim::links::MavLinkFrame& frame, std::uint8_t sequence) {
    const auto number = static_cast<std::uint32_t>(frame.kind);
    sim::links::WireWriter writer(sim::links::ByteOrder::Little);
    writer.add(std::uint8_t{0xFD});
    writer.add(static_cast<std::uint8_t>(frame.payload.size()));
    writer.add(std::uint16_t{0}); // flags
    writer.add(sequence);
    writer.add(frame.system);
    writer.add(std::uint8_t{1}); // component: autopilot
    writer.add(static_cast<std::uint16_t>(number & 0xffffU));
    writer.add(static_cast<std::uint8_t>(number >> 16U));
    for (const std::byte byte : frame.payload) { writer.add(std::to_integer<std::uint8_t>(byte)); }
    std::uint16_t sum = 0xffff;
    for (const std::byte byte : writer.bytes().subspan(1)) { sum = crc_mcrf4xx(sum, byte); }
    writer.add(crc_mcrf4xx(sum, std::byte{mavlink_extra(frame.kind)}));
    return writer.take();
}

} // namespace octant::tests
