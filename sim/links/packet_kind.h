#pragma once

#include "sim/links/udp_port.h"
#include "sim/links/wire_bytes.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace octant::sim::links {

/// The kind of a packet by its form, whatever the port.
enum class PacketKind : std::uint32_t {
    Fdm,
    SwappedFdm, ///< little-endian
    Cigi3,
    OlderCigi, ///< 1 or 2
    Cigi4,
    MavLink,
    Dis,
    XPlane,      ///< DATA, or answers (RREF)
    OtherXPlane, ///< another of its messages
    ForeFlight,  ///< of X-Plane or another simulator for tablets
    Nmea,
    Acmi,
};

/// The kind of a packet by its beginning and its length; nothing if unknown.
std::optional<PacketKind> packet_kind(Bytes datagram);

/// The protocol that reads packets of a kind; nothing if none does.
std::optional<Protocol> protocol_of(PacketKind kind);

/// Message about packets of a kind that came to a port where they are not read: what they are, and what to do.
std::string_view text_of(PacketKind kind);

} // namespace octant::sim::links
