#pragma once

#include "ui/flight/live_flight.h"
#include "ui/flight/live_input.h"
#include "ui/flight/packet_file.h"
#include "ui/flight/session.h"
#include "ui/report/frame_record.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// Where packets come from, and how what they say is shown.
struct ListenerOptions {
    LiveInputOptions input;
    LiveOptions live;
};

/// Lets packets fly a session, picture by picture, and writes into its pictures what is waited for,
/// what comes from whom, and what is wrong with it.
class Listener {
public:
    /// Opens the ports. Throws Error.
    explicit Listener(const ListenerOptions& options);

    /// Flies this session from now on, from the beginning. To be called again whenever its world
    /// was loaded anew. The session must not draw without this any more.
    void attach(Session& session);

    /// From now on keeps what repeats the flight in this folder. Throws Error.
    void start_packet_recording(const std::filesystem::path& folder);

    /// Takes what has come up to now; in steps, up to the next packet that moves something. Returns
    /// the time for which the next picture is to be drawn; in steps nothing where there is none
    /// yet. Throws Error (disk full).
    std::optional<double> take(Session& session);

    /// Completes the record of the picture that was drawn after take(), and tells hosts of CIGI
    /// that it is there, with the answers to what they asked.
    void finish_picture(report::FrameRecord& record);

    /// In steps: sends a Start of Frame where hosts wait for a first one, at most ten a second, and
    /// where one has sent its last message again.
    void contact_hosts();

    /// Ends the recording, if there is one. Throws Error (disk full).
    void finish();

    /// Gives up the recording, if there is one; what it has written so far stays.
    void drop_recording() { writer_.reset(); }

    double now_s() const { return input_.now_s(); }

    /// Nothing can come any more, and all that came was taken.
    bool has_ended() const { return pending_.empty() && input_.has_ended(); }

    /// What a person should be told who reads along: what is waited for, each sender and fault when
    /// it first comes, and how things stand every ten seconds. After take().
    std::vector<std::string> take_new_messages();

    /// What is waited for, and what comes.
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
    /// Nothing = nothing has been told yet.
    std::optional<double> reported_at_s_;
    double hosts_contacted_at_s_ = 0.0;
    std::uint32_t cigi_frames_ = 0;
    /// In steps, of a host of CIGI.
    sim::links::Datagram last_message_;
    bool answers_retransmission_ = false;
    long pictures_ = 0;
};

} // namespace octant::ui::flight
