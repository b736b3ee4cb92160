#pragma once

#include "sim/links/line_input.h"
#include "sim/links/udp_port.h"
#include "ui/flight/live_flight.h"
#include "ui/flight/packet_file.h"
#include "ui/flight/session.h"
#include "ui/report/frame_record.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// Where to listen. A port of -1 is not opened, 0 is any free one; one that is unset is the usual one of its protocol,
/// which is closed where a channel is driven by its CIGI host alone.
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

    /// Packets received since the last call; they may be moved from until the next call. Later now_s() is after their
    /// arrival.
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

/// Where packets come from, and how what they say is shown.
struct ListenerOptions {
    LiveInputOptions input;
    LiveOptions live;
};

/// Flies a session by packets, picture by picture. Writes into its pictures which packets it waits for, which senders
/// it hears, and their faults.
class Listener {
public:
    /// Opens the ports. Throws Error.
    explicit Listener(const ListenerOptions& options);

    /// Flies this session from now on, from the beginning. To be called again whenever its world was loaded anew. The
    /// session must not draw without this any more.
    void attach(Session& session);

    /// From now on writes packets.bin, which repeats the flight, into this folder. Throws Error.
    void start_packet_recording(const std::filesystem::path& folder);

    /// Takes the packets received up to now; in steps, up to the next packet that moves something. Returns the time of
    /// the next picture; in steps nothing if no packet moved anything. Throws Error (disk full).
    std::optional<double> take(Session& session);

    /// Completes the record of the picture that was drawn after take(), and tells hosts of CIGI that it is there, with
    /// the answers to what they asked.
    void finish_picture(report::FrameRecord& record);

    /// In steps: sends a Start of Frame where hosts wait for a first one, at most ten a second, and where one has sent
    /// its last message again.
    void contact_hosts();

    /// Ends the recording, if there is one. Throws Error (disk full).
    void finish();

    /// Ends the recording, if there is one, without an error; the file so far stays.
    void drop_recording() { writer_.reset(); }

    double now_s() const { return input_.now_s(); }

    /// No packet can come any more, and all that came were taken.
    bool has_ended() const { return pending_.empty() && input_.has_ended(); }

    /// Messages for the user since the last call: what is waited for, each sender and fault when it first comes, and a
    /// summary every ten seconds. To be called after take().
    std::vector<std::string> take_new_messages();

    /// What is waited for and what comes, as the pictures show it.
    std::vector<std::string> lines() const;

    const LiveFlight& live() const { return *live_; }

private:
    bool take_pending();
    bool is_retransmission(const sim::links::Datagram& packet);

    ListenerOptions options_;
    LiveInput input_;
    std::unique_ptr<LiveFlight> live_;
    std::optional<PacketWriter> writer_;
    std::deque<sim::links::Datagram> pending_;
    double overlay_at_s_ = 0.0;
    /// When the last summary was made; nothing before the first.
    std::optional<double> reported_at_s_;
    double hosts_contacted_at_s_ = 0.0;
    std::uint32_t cigi_frames_ = 0;
    /// In steps, of a host of CIGI.
    sim::links::Datagram last_message_;
    bool answers_retransmission_ = false;
    long pictures_ = 0;
};

} // namespace octant::ui::flight
