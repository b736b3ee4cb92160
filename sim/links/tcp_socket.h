#pragma once

#include "sim/links/udp_port.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace octant::sim::links {

/// A listening non-blocking TCP socket and its port. Throws Error if the port is taken; 0 = any free one.
std::pair<int, std::uint16_t> listening_socket(std::uint32_t address, std::uint16_t port);

/// Accepts the next client with its non-blocking socket; nothing if there is none.
std::optional<std::pair<int, PacketSource>> accepted_client(int listening);

} // namespace octant::sim::links
