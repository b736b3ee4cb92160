#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
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

/// Lets so many packets a second through from each sender, by a bucket of tokens. Senders share buckets by chance, so
/// that no number of them takes more memory.
class SourceLimit {
public:
    static constexpr double packets_per_s = 25000.0;
    static constexpr double burst = 25000.0;

    SourceLimit() { buckets_.fill({burst, 0.0}); }

    /// Whether a packet that came at this time is let through.
    bool admits(const PacketSource& source, double arrival_s);

private:
    struct Bucket {
        double tokens = 0.0;
        double filled_s = 0.0;
    };

    std::array<Bucket, 1024> buckets_{};
};

} // namespace octant::sim::links
