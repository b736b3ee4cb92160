#pragma once

#include "sim/base/units.h"
#include "sim/links/wire_bytes.h"

#include <cstddef>
#include <cstdint>

namespace octant::sim::links {

/// The word by which the byte order of a CIGI 3 message is told, as its sender writes it.
inline constexpr std::uint16_t cigi_magic = 0x8000;
inline constexpr std::uint16_t swapped_cigi_magic = 0x0080;

/// Adds a packet of zeros with its opcode and size; says where it begins.
inline std::size_t add_cigi_packet_header(WireWriter& message, std::uint8_t opcode, std::uint8_t size) {
    const std::size_t at = message.size();
    message.add_zeros(size);
    message.set(at, opcode);
    message.set(at + 1, size);
    return at;
}

/// Degrees in single precision.
inline void set_cigi_angle(WireWriter& message, std::size_t at, double angle_rad) {
    message.set(at, static_cast<float>(deg_from_rad(angle_rad)));
}

} // namespace octant::sim::links
