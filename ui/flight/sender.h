#pragma once

#include "sim/links/fix.h"
#include "sim/links/tacview_server.h"
#include "sim/links/udp_port.h"
#include "ui/flight/session.h"

#include <cstddef>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// Sends what pictures show to other programs: the first aircraft as FlightGear's native FDM
/// (version 24), all of them as DIS entity states or as Tacview's real-time telemetry.
class Sender {
public:
    /// Targets as "fdm:HOST:PORT", "dis:HOST:PORT" or, for readers to come, "tacview:PORT" on
    /// 127.0.0.1 or "tacview:ADDRESS:PORT". Opens what is needed. Throws Error.
    explicit Sender(const std::vector<std::string>& targets);

    /// Sends the states of the session's last picture. Does not wait; what the network does not
    /// take is lost.
    void send(const Session& session);

private:
    enum class Form { Fdm, Dis };

    struct Target {
        Form form;
        sim::links::Source peer;
    };

    void send_fdm(const Target& target, const sim::links::Fix& fix);
    void send_dis(const Target& target, std::size_t number, sim::links::Fix fix, double time_s);

    void send_tacview(const Session& session);

    std::vector<Target> targets_;
    std::vector<sim::links::TacviewServer> tacview_;
    bool head_told_ = false;
    std::vector<sim::links::UdpPort> socket_; ///< one, where there is a target
};

/// An aircraft's motion as packets have it: geodetic by the session's place on the earth, or around
/// 0 N, 0 E where its ground has none.
sim::links::Fix fix_of(const Session& session, const sim::AircraftState& state);

} // namespace octant::ui::flight
