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

/// Tacview's real-time telemetry: a TCP server that speaks first and then sends ACMI text as it comes. Late joiners get
/// the header and what every object is first; readers that do not keep up are let go.
class TacviewServer {
public:
    static constexpr std::uint16_t usual_port = 42674;
    static constexpr std::size_t max_readers = 16;
    /// Clients that have not shaken hands yet; the oldest makes room for another one.
    static constexpr std::size_t max_handshakes = 64;
    static constexpr std::size_t max_waiting_bytes = std::size_t{1} << 20;
    static constexpr std::chrono::seconds handshake_timeout{5};

    /// Throws Error where the port is taken; 0 = any free one.
    TacviewServer(std::uint32_t address, std::uint16_t port, std::string name);
    ~TacviewServer();
    TacviewServer(TacviewServer&& other) noexcept;
    TacviewServer& operator=(TacviewServer&& other) noexcept;
    TacviewServer(const TacviewServer&) = delete;
    TacviewServer& operator=(const TacviewServer&) = delete;

    std::uint16_t port() const { return port_; }

    /// What each client gets first: the header and the objects' properties. Kept for late joiners.
    void set_head(std::string head) { head_ = std::move(head); }

    /// Takes new clients, goes on with handshakes and sends this text to all others; does not wait.
    void send(std::string_view text);

    /// Clients that have shaken hands.
    std::size_t readers() const;

private:
    struct Client {
        int socket = -1;
        bool ready = false;
        std::string heard; ///< of the handshake
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
