#pragma once

#include "sim/aircraft_state.h"
#include "sim/links/fix.h"
#include "sim/links/tacview_server.h"
#include "sim/links/udp_port.h"
#include "ui/flight/session.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// Image generators that show what a session shows, as their CIGI 3.3 host: all aircraft as entities by their numbers
/// (48 at most, as many as one packet takes) with their rates, their shapes as types (1 = the first aircraft's), and
/// the camera as view 0 of entity 0 with its frustum.
class CigiChannels {
public:
    /// The port that receives Start of Frame, unless a channel names another.
    static constexpr std::uint16_t default_own_port = 8005;

    /// Adds "cigi:HOST:PORT" or "cigi:HOST:PORT:OWN", OWN the port on which they answer. Throws Error.
    void add(const std::string& target);

    bool empty() const { return channels_.empty(); }

    /// Waits until each has sent a Start of Frame, for ten seconds at most, and does `meanwhile` again and again.
    /// Returns a line for each that has not.
    std::vector<std::string> wait_for_first_frames(const std::function<void()>& meanwhile);

    /// Sends the last picture to all. Does not wait.
    void send(const Session& session);

    /// Waits until all that have ever answered show what was sent last, for a second at most, and sends it again
    /// meanwhile, in case that it was lost. After a second without it a channel is waited for a tenth of a second a
    /// frame, after five such frames no more until it answers. Returns how many host frames the channel that is the
    /// furthest behind is behind, those among them that are not waited for; -1 where none has ever answered.
    int wait_for_pictures();

    /// What happened to the frames of each channel, a line each; none where all were shown at once.
    std::vector<std::string> lines() const;

private:
    struct Channel {
        sim::links::PacketSource peer;
        /// Where its answers come from: another port than `peer` where a relay lies between. Nothing = it has never
        /// answered.
        std::optional<sim::links::PacketSource> answer_source = {};
        /// The host frame that it shows.
        std::uint32_t shown_host_frame = 0;
        /// The number of its own frame.
        std::uint32_t ig_frame = 0;
        /// Frames in a row that it did not show in time.
        int consecutive_missed = 0;
        long missed = 0;
        long resent = 0;
        /// What was sent last.
        std::vector<std::byte> message = {};
    };

    Channel* channel_of_source(const sim::links::PacketSource& source);
    bool has_answered(const Channel& channel) const;
    void receive();
    bool all_have_answered(int max_missed) const;
    void resend();
    std::vector<std::byte> message_for(const Session& session, std::uint32_t last_ig_frame) const;

    std::vector<Channel> channels_;
    std::uint16_t own_port_ = default_own_port;
    std::optional<sim::links::UdpPort> socket_;
    std::vector<sim::links::Datagram> received_;
    std::uint32_t host_frame_ = 0;
    /// How long pictures were waited for of late, at most, where nothing was lost.
    double typical_wait_s_ = 0.25;
    /// The states in the picture that was sent last.
    std::vector<sim::AircraftState> previous_states_;
};

/// Sends what pictures show to other programs: the first aircraft as FlightGear's native FDM (version 24) or X-Plane's
/// DATA, all of them as DIS entity states, as Tacview's real-time telemetry, or with the camera to image generators of
/// CIGI.
class Sender {
public:
    /// Targets as "fdm:HOST:PORT", "xplane:HOST:PORT", "dis:HOST:PORT", as CigiChannels has them or, for readers to
    /// come, "tacview:PORT" on 127.0.0.1 or "tacview:ADDRESS:PORT". Opens what is needed. Throws Error.
    explicit Sender(const std::vector<std::string>& targets);

    /// Waits for the channels of CIGI as CigiChannels::wait_for_first_frames() does; readers of Tacview's telemetry are
    /// answered meanwhile. To be called before the first picture is sent.
    std::vector<std::string> wait_for_channels(const Session& session);

    /// Sends the states of the session's last picture. Does not wait; what the network does not take is lost.
    void send(const Session& session);

    /// As CigiChannels::wait_for_pictures().
    int wait_for_pictures() { return channels_.wait_for_pictures(); }

    /// As CigiChannels::lines().
    std::vector<std::string> channel_lines() const { return channels_.lines(); }

private:
    enum class PacketFormat { Fdm, XPlane, Dis };

    struct Target {
        PacketFormat packet_format;
        sim::links::PacketSource peer;
    };

    void send_fdm(const Target& target, const sim::links::Fix& fix);
    void send_xplane(const Target& target, const sim::links::Fix& fix, double time_s);
    void send_dis(const Target& target, std::size_t number, sim::links::Fix fix, double time_s);

    void send_header(const Session& session);
    void send_tacview(const Session& session);

    std::vector<Target> targets_;
    std::vector<sim::links::TacviewServer> tacview_;
    CigiChannels channels_;
    bool header_is_sent_ = false;
    /// Of X-Plane's local axes: where the first aircraft was sent first.
    std::optional<sim::links::Geodetic> origin_;
    /// One, where there is a target.
    std::vector<sim::links::UdpPort> socket_;
};

} // namespace octant::ui::flight
