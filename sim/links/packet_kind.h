#pragma once

#include "sim/links/udp_port.h"
#include "sim/links/wire_bytes.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace octant::sim::links {

/// What a packet is by its form, whichever port it came to.
enum class PacketKind : std::uint32_t {
    Fdm,
    SwappedFdm, ///< with its bytes the other way round
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

/// The kind of a packet that begins, and is as long, as packets of that kind are; nothing for one that is of none.
std::optional<PacketKind> packet_kind(Bytes datagram);

/// The protocol that reads packets of a kind; nothing where none does.
std::optional<Protocol> protocol_of(PacketKind kind);

/// What a person should be told of packets of a kind that came to a port where they are not read: what they are, and
/// what to do.
std::string_view text_of(PacketKind kind);

} // namespace octant::sim::links
