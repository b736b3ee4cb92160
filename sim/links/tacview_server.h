#pragma once

#include "sim/links/udp_port.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::sim::links {

/// A TCP server for the real-time telemetry of Tacview: it speaks first and then sends ACMI text as it is made. Late
/// clients first get the header and the properties of all objects; clients that do not keep up are disconnected.
class TacviewServer {
public:
    static constexpr std::uint16_t usual_port = 42674;
    static constexpr std::size_t max_readers = 16;
    /// Most clients that may be in their handshake; a further one replaces the oldest.
    static constexpr std::size_t max_handshakes = 64;
    static constexpr std::size_t max_waiting_bytes = std::size_t{1} << 20;
    static constexpr std::chrono::seconds handshake_timeout{5};

    /// Throws Error if the port is taken; 0 = any free one.
    TacviewServer(std::uint32_t address, std::uint16_t port, std::string name);
    ~TacviewServer();
    TacviewServer(TacviewServer&& other) noexcept;
    TacviewServer& operator=(TacviewServer&& other) noexcept;
    TacviewServer(const TacviewServer&) = delete;
    TacviewServer& operator=(const TacviewServer&) = delete;

    std::uint16_t port() const { return port_; }

    /// Sets the text that each client gets first: the header and the properties of the objects.
    void set_head(std::string head) { head_ = std::move(head); }

    /// Accepts new clients, continues handshakes and sends this text to all others, without waiting.
    void send(std::string_view text);

    /// Number of clients that have completed the handshake.
    std::size_t readers() const;

private:
    struct Client {
        int socket = -1;
        bool ready = false;
        std::string heard; ///< received text of the handshake
        std::string waiting;
        std::chrono::steady_clock::time_point since;
    };

    void take_clients();
    bool do_handshake(Client& client) const;
    static bool flush(Client& client);

    int socket_ = -1;
    std::uint16_t port_ = 0;
    std::string name_;
    std::string head_;
    std::vector<Client> clients_;
};

} // namespace octant::sim::links
