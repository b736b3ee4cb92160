#pragma once

#include "sim/links/udp_port.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace octant::sim::links {

/// A TCP socket that listens and does not wait, and the port it has. Throws Error where the port is taken; 0 = any free
/// one.
std::pair<int, std::uint16_t> listening_socket(std::uint32_t address, std::uint16_t port);

/// The next client that asks, with its socket, which does not wait either; nothing if there is none.
std::optional<std::pair<int, PacketSource>> accepted_client(int listening);

} // namespace octant::sim::links
