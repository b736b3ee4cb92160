#pragma once

#include "sim/links/earth.h"
#include "sim/links/fix.h"
#include "sim/links/tacview_server.h"
#include "sim/links/udp_port.h"
#include "ui/flight/cigi_channels.h"
#include "ui/flight/session.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// Sends what pictures show to other programs: the first aircraft as FlightGear's native FDM
/// (version 24) or X-Plane's DATA, all of them as DIS entity states, as Tacview's real-time
/// telemetry, or with the camera to image generators of CIGI.
class Sender {
public:
    /// Targets as "fdm:HOST:PORT", "xplane:HOST:PORT", "dis:HOST:PORT", as CigiChannels has them
    /// or, for readers to come, "tacview:PORT" on 127.0.0.1 or "tacview:ADDRESS:PORT". Opens what
    /// is needed. Throws Error.
    explicit Sender(const std::vector<std::string>& targets);

    /// Waits for the channels of CIGI as CigiChannels::wait_for_first_frames() does; readers of Tacview's
    /// telemetry are answered meanwhile. To be called before the first picture is sent.
    std::vector<std::string> wait_for_channels(const Session& session);

    /// Sends the states of the session's last picture. Does not wait; what the network does not
    /// take is lost.
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
