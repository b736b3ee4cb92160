#pragma once

#include "sim/links/live_traffic.h"
#include "sim/links/udp_port.h"

#include <chrono>
#include <cstdint>
#include <vector>

namespace octant::tests {

/// Memory of this process that is in use, bytes: resident, or allocated under a sanitizer.
double used_bytes();

/// Sends packets to a port of this machine that are nearly right, and some that are anything: `per_s` a second, or as
/// fast as it can where that is 0.
void attack(sim::links::Protocol protocol, std::uint16_t port, int packets, double per_s);

/// A receiver as a program has it, looked after a thousand times a second.
class Receiver {
public:
    explicit Receiver(sim::links::Protocol protocol) : protocol_(protocol) {}

    std::uint16_t port() const { return socket_.port(); }

    /// Takes what has come.
    void look();

    /// The same, then sleeps a millisecond.
    void work();

    const sim::links::TrafficCounts& counts() const { return traffic_.counts(); }

private:
    sim::links::Protocol protocol_;
    sim::links::UdpPort socket_{0x7f000001, 0};
    sim::links::SourceLimit limit_;
    sim::links::LiveTraffic traffic_{[](const sim::links::VehicleKey&, const sim::links::Fix& fix) {
        return sim::links::WorldPosition{.at_m = glm::dvec3(fix.latitude_deg * 1e5)};
    }};
    std::vector<sim::links::Datagram> packets_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Attacks a receiver, which works meanwhile. Returns by how many bytes this process grew at most.
double growth_under_attack(Receiver& receiver, sim::links::Protocol protocol, int packets, double per_s);

/// How a flood of packets that are all right was received.
struct ValidFlood {
    sim::links::TrafficCounts counts;
    double longest_look_s = 0.0; ///< of one Receiver::look()
};

/// Sends a receiver so many packets of the FDM by 20 senders, 20,000 a second.
ValidFlood flood_validly(int packets);

} // namespace octant::tests
