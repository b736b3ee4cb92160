#pragma once

#include "sim/aircraft_state.h"
#include "sim/links/datagram.h"
#include "sim/links/live_vehicle.h"

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::sim::links {

/// Where a fix lies in the world, in metres.
using WorldFromFix = std::function<glm::dvec3(const VehicleKey& key, const Fix& fix)>;

/// What came so far.
struct TrafficCounts {
    long accepted = 0; ///< packets that moved something
    long wrong = 0;    ///< packets that no decoder took
    long unused = 0;   ///< right ones of which nothing is shown, of vehicles beyond the cap too
    long lost = 0;     ///< as the senders' clocks say
    long late = 0;     ///< dropped
    long snaps = 0;    ///< corrections too large to be blended in
};

/// All vehicles that others fly. Takes packets as they came and gives what is shown at a time; no
/// sockets and no clocks in here, so that a recording of packets repeats it.
class LiveTraffic {
public:
    static constexpr std::size_t most_vehicles = 256;
    /// Silence after which a vehicle gives its place to another one.
    static constexpr double gone_after_s = 10.0;

    explicit LiveTraffic(WorldFromFix world_from_fix)
        : world_from_fix_(std::move(world_from_fix)) {}

    /// Decodes one packet. Never throws for what it holds. Returns whether something moved.
    bool take(const Datagram& datagram);

    /// In the order in which they came first.
    std::span<const LiveVehicle> vehicles() const { return vehicles_; }

    /// States of the first vehicles at a time of our clock, not before that of the last call.
    /// Returns how many of `states` were filled in.
    std::size_t show(double now_s, double delay_s, std::span<AircraftState> states);

    const TrafficCounts& counts() const { return counts_; }

    /// Whether any vehicle that is shown has stood since the last show() for want of packets.
    bool is_stale() const;

    /// When the newest packet came that moved something, on our clock.
    double newest_s() const { return newest_s_; }

    /// What a person should be told, a line each: senders and what is wrong with them.
    std::vector<std::string> lines() const;

private:
    struct Said {
        Source source;
        Verdict verdict;
        double at_s = -1.0;
    };

    bool take_fdm(const Datagram& datagram);
    bool move(const VehicleKey& key, const Fix& fix, double arrival_s);
    LiveVehicle* vehicle_of(const VehicleKey& key, double arrival_s);
    void count(const Datagram& datagram, const Verdict& verdict);

    WorldFromFix world_from_fix_;
    std::vector<LiveVehicle> vehicles_;
    TrafficCounts counts_;
    Said fine_;
    Said wrong_;
    double newest_s_ = 0.0;
    double shown_s_ = 0.0;
    bool shown_once_ = false;
    std::size_t shown_ = 0;
};

} // namespace octant::sim::links
