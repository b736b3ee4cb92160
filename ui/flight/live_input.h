#pragma once

#include "sim/links/datagram.h"
#include "sim/links/line_input.h"
#include "sim/links/source_limit.h"
#include "sim/links/udp_port.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// Where to listen. A port of -1 is not opened, 0 is any free one; one that is unset is the usual
/// one of its protocol, which is closed where a channel is driven by its CIGI host alone.
struct LiveInputOptions {
    std::string bind = "127.0.0.1";
    std::optional<int> fdm_port;
    std::optional<int> mavlink_port;
    std::optional<int> dis_port;
    std::optional<int> xplane_port;
    /// The X-Plane that is asked for its motion, as "HOST" or "HOST:PORT"; empty = none is.
    std::string xplane_host;
    bool is_channel = false;
    int lines_port = -1;
    int cigi_port = 8004;
    /// Who gets the messages of CIGI, as "HOST:PORT".
    std::string cigi_host = "127.0.0.1:8005";
    bool standard_input = false;
    /// Packets from other addresses are not looked at; empty = from everywhere.
    std::string only_from;
};

/// The ports on which packets come, and the clock by which they do.
class LiveInput {
public:
    /// Opens the ports; the clock begins at 0. Throws Error where one is taken.
    explicit LiveInput(const LiveInputOptions& options);
    /// Tells an X-Plane that was asked to send no more.
    ~LiveInput();
    LiveInput(const LiveInput&) = delete;
    LiveInput& operator=(const LiveInput&) = delete;
    LiveInput(LiveInput&&) = delete;
    LiveInput& operator=(LiveInput&&) = delete;

    /// Seconds since the beginning, in whole microseconds.
    double now_s() const;

    /// All packets that have come since the last call, to be moved from until the next one. now_s()
    /// from then on lies behind their arrivals.
    std::vector<sim::links::Datagram>& drain();

    /// Whether CIGI is listened to.
    bool has_cigi() const { return cigi_.has_value(); }

    /// Sends a message to the host of CIGI, where it is listened to.
    void send_cigi(std::span<const std::byte> message);

    /// Nothing can come any more: only standard input was listened to, and it has ended.
    bool has_ended() const;

    /// What is waited for, a line each.
    std::vector<std::string> lines() const;

private:
    struct Port {
        sim::links::Protocol protocol;
        sim::links::UdpPort socket;
    };

    /// Of ports_, and to whom it sends.
    struct Peer {
        std::size_t port = 0;
        sim::links::PacketSource host;
    };

    void request_xplane_data(int per_second);
    void request_silent_xplane_data();

    std::string bind_;
    std::vector<Port> ports_;
    std::optional<Peer> cigi_;
    std::optional<Peer> xplane_;
    /// When the X-Plane was last asked, and when it last sent anything.
    std::optional<double> requested_s_;
    double received_s_ = 0.0;
    std::optional<sim::links::LineServer> line_server_;
    std::optional<sim::links::StandardInput> standard_input_;
    std::optional<std::uint32_t> only_from_;
    sim::links::SourceLimit limit_;
    std::vector<sim::links::Datagram> packets_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

} // namespace octant::ui::flight
