#pragma once

#include "sim/links/udp_port.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::sim::links {

/// Cuts a stream of bytes into lines (LF or CRLF). A line that grows too long is given as it is up to there, so that
/// its reader refuses it, and the rest of it is passed over.
class LineSplitter {
public:
    /// Calls take(line) for each line that is complete, without its end; empty lines are left out.
    template <class Take>
    void add(std::span<const std::byte> bytes, Take&& take) {
        for (const std::byte byte : bytes) {
            if (byte == std::byte{'\n'}) {
                end_line(take);
            } else if (line_.size() < max_bytes) {
                line_.push_back(byte);
            }
        }
    }

    /// The line that no line end follows, at the end of a stream.
    template <class Take>
    void finish(Take&& take) {
        end_line(take);
    }

private:
    static constexpr std::size_t max_bytes = 4096;

    template <class Take>
    void end_line(Take&& take) {
        if (!line_.empty() && line_.back() == std::byte{'\r'}) { line_.pop_back(); }
        if (!line_.empty()) { take(line_); }
        line_.clear();
    }

    std::vector<std::byte> line_;
};

/// Lines that come on standard input.
class StandardInput {
public:
    /// Appends the lines that are there, as Protocol::Lines; does not wait.
    void drain(double now_s, std::vector<Datagram>& into);

    /// Nothing more will come.
    bool has_ended() const { return ended_; }

private:
    LineSplitter lines_;
    bool ended_ = false;
};

/// A TCP port on which some clients may send lines at a time.
class LineServer {
public:
    static constexpr std::size_t max_clients = 8;
    /// A client that has never sent anything is let go after this.
    static constexpr std::chrono::seconds first_line_timeout{10};

    /// Throws Error where the port is taken; 0 = any free one. Clients from other addresses than `only_from`, where
    /// there is one, are turned away before they hold a place.
    LineServer(std::uint32_t address, std::uint16_t port, std::optional<std::uint32_t> only_from = {});
    ~LineServer();
    LineServer(LineServer&& other) noexcept;
    LineServer& operator=(LineServer&& other) noexcept;
    LineServer(const LineServer&) = delete;
    LineServer& operator=(const LineServer&) = delete;

    std::uint16_t port() const { return port_; }

    /// Takes new clients and appends the lines that have come; does not wait.
    void drain(double now_s, std::vector<Datagram>& into);

private:
    struct Client {
        int socket = -1;
        PacketSource source;
        LineSplitter lines;
        bool has_sent = false;
        std::chrono::steady_clock::time_point since;
    };

    void take_clients();
    static bool read(Client& client, double now_s, std::vector<Datagram>& into);

    int socket_ = -1;
    std::uint16_t port_ = 0;
    std::optional<std::uint32_t> only_from_;
    std::vector<Client> clients_;
};

} // namespace octant::sim::links
