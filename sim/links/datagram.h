#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace octant::sim::links {

/// What a packet's bytes mean. The values stand in recordings.
enum class Protocol : std::uint8_t { Fdm = 1, Lines = 2, MavLink = 3, Dis = 4, Cigi = 5, XPlane = 6 };

/// As people call it: "DIS".
std::string_view name_of(Protocol protocol);

/// Where a packet came from: an IPv4 address and a port, both as numbers; 0:0 is standard input.
struct PacketSource {
    std::uint32_t address = 0;
    std::uint16_t port = 0;

    auto operator<=>(const PacketSource&) const = default;
};

/// "127.0.0.1:5550"; "standard input" for 0:0.
std::string text_of(const PacketSource& source);

/// One packet as it came.
struct Datagram {
    Protocol protocol = Protocol::Fdm;
    PacketSource source;
    double arrival_s = 0.0; ///< on the clock of whoever received it
    std::vector<std::byte> bytes;
};

} // namespace octant::sim::links
