#pragma once

#include "sim/links/datagram.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace octant::sim::links {

/// "127.0.0.1", "0.0.0.0" or another IPv4 address as a number. Throws Error that names `option`.
std::uint32_t address_from_text(const std::string& option, const std::string& text);

/// "HOST:PORT" of somebody else; HOST is an IPv4 address or a name. Throws Error "option: ...".
PacketSource peer_from_text(const std::string& option, const std::string& text);

/// A UDP socket that never waits.
class UdpPort {
public:
    /// Largest packet that is taken; longer ones are cut and so refused by their decoders.
    static constexpr std::size_t largest_bytes = 4096;
    /// Packets that one call of drain() takes; what is beyond waits, or is dropped by the system.
    static constexpr std::size_t max_a_drain = 8192;

    /// Binds address:port; port 0 = any free one. Throws Error where it is taken or not ours.
    UdpPort(std::uint32_t address, std::uint16_t port);
    ~UdpPort();
    UdpPort(UdpPort&& other) noexcept;
    UdpPort& operator=(UdpPort&& other) noexcept;
    UdpPort(const UdpPort&) = delete;
    UdpPort& operator=(const UdpPort&) = delete;

    /// The port it is bound to.
    std::uint16_t port() const { return port_; }

    /// Appends what has come, by the time it reached this machine, as `protocol`. `now_s` is the time on the caller's
    /// clock; arrivals lie before it.
    void drain(Protocol protocol, double now_s, std::vector<Datagram>& into);

    /// Sends a packet and does not wait; false where it could not be sent.
    bool send(const PacketSource& to, std::span<const std::byte> bytes);

private:
    struct Batch;

    int socket_ = -1;
    std::uint16_t port_ = 0;
    std::unique_ptr<Batch> batch_;
};

} // namespace octant::sim::links
