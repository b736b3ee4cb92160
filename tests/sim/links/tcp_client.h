#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace octant::tests {

/// The other side of a TCP server on this machine's loopback.
class TcpClient {
public:
    static constexpr std::uint32_t loopback = 0x7f000001;

    /// Connects from an address of its own; fails the test where that does not succeed.
    explicit TcpClient(std::uint16_t port, std::uint32_t own_address = loopback);
    ~TcpClient();
    TcpClient(const TcpClient&) = delete;
    TcpClient& operator=(const TcpClient&) = delete;
    TcpClient(TcpClient&&) = delete;
    TcpClient& operator=(TcpClient&&) = delete;

    /// Sends what there is room for. Returns how many bytes that was, or -1.
    long say(std::string_view text) const;

    /// All that has come and was not read.
    std::string read() const;

private:
    int socket_;
};

} // namespace octant::tests
