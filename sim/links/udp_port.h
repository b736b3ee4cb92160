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

/// The protocol of a packet. The values are stored in recordings.
enum class Protocol : std::uint8_t { Fdm = 1, Lines = 2, MavLink = 3, Dis = 4, Cigi = 5, XPlane = 6 };

/// Display name, such as "DIS".
std::string_view name_of(Protocol protocol);

/// Sender of a packet: IPv4 address and port as numbers; 0:0 is standard input.
struct PacketSource {
    std::uint32_t address = 0;
    std::uint16_t port = 0;

    auto operator<=>(const PacketSource&) const = default;
};

/// "127.0.0.1:5550"; "standard input" for 0:0.
std::string text_of(const PacketSource& source);

/// One received packet.
struct Datagram {
    Protocol protocol = Protocol::Fdm;
    PacketSource source;
    double arrival_s = 0.0; ///< by the clock of the receiver
    std::vector<std::byte> bytes;
};

/// Parses an IPv4 address such as "127.0.0.1". Throws Error that names `option`.
std::uint32_t address_from_text(const std::string& option, const std::string& text);

/// Parses "HOST:PORT"; HOST is an IPv4 address or a name. Throws Error "option: ...".
PacketSource peer_from_text(const std::string& option, const std::string& text);

/// A non-blocking UDP socket.
class UdpPort {
public:
    /// Longest packet in bytes; longer ones are cut, so that their decoders refuse them.
    static constexpr std::size_t largest_bytes = 4096;
    /// Most packets that one call of drain() reads; the system keeps or drops the rest.
    static constexpr std::size_t max_a_drain = 8192;

    /// Binds address:port; port 0 = any free one. Throws Error if the port is taken or the address is not local.
    UdpPort(std::uint32_t address, std::uint16_t port);
    ~UdpPort();
    UdpPort(UdpPort&& other) noexcept;
    UdpPort& operator=(UdpPort&& other) noexcept;
    UdpPort(const UdpPort&) = delete;
    UdpPort& operator=(const UdpPort&) = delete;

    /// The port it is bound to.
    std::uint16_t port() const { return port_; }

    /// Appends the received packets as `protocol`, in order of arrival at this machine. `now_s` is the time on the
    /// clock of the caller; arrivals are earlier.
    void drain(Protocol protocol, double now_s, std::vector<Datagram>& into);

    /// Sends a packet without waiting; false if it could not be sent.
    bool send(const PacketSource& to, std::span<const std::byte> bytes);

private:
    struct Batch;

    int socket_ = -1;
    std::uint16_t port_ = 0;
    std::unique_ptr<Batch> batch_;
};

/// Limits the packets per second of each sender by a token bucket. Senders may share a bucket, so that memory does not
/// grow with their number.
class SourceLimit {
public:
    static constexpr double packets_per_s = 25000.0;
    static constexpr double burst = 25000.0;

    SourceLimit() { buckets_.fill({burst, 0.0}); }

    /// True if a packet that arrived at this time passes.
    bool admits(const PacketSource& source, double arrival_s);

private:
    struct Bucket {
        double tokens = 0.0;
        double filled_s = 0.0;
    };

    std::array<Bucket, 1024> buckets_{};
};

} // namespace octant::sim::links
