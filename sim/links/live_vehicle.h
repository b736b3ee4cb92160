#pragma once

#include "sim/links/datagram.h"
#include "sim/links/fix.h"
#include "sim/links/live_track.h"
#include "sim/links/sender_clock.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace octant::sim::links {

/// Who sends a vehicle's motion, and which of his vehicles it is.
struct VehicleKey {
    Protocol protocol = Protocol::Fdm;
    PacketSource source;
    std::uint64_t vehicle = 0;

    auto operator<=>(const VehicleKey&) const = default;
};

/// One vehicle that somebody else flies: from fixes as they arrive to the motion that is shown.
class LiveVehicle {
public:
    explicit LiveVehicle(const VehicleKey& key)
        : key_(key) {}

    const VehicleKey& key() const { return key_; }

    /// Takes a fix and where it lies in the world. Returns false for one that came too late.
    /// Arrivals are seconds on our clock and do not go back.
    bool add(const Fix& fix, const glm::dvec3& world_m, double arrival_s);

    /// What is to be shown at a time of our clock, `delay_s` behind it and `passed_s` after what
    /// was shown last. There must be a fix (asserted).
    AircraftState show(double now_s, double delay_s, double passed_s);

    /// The motion of the newest fix. There must be one (asserted).
    const AircraftState& newest() const { return track_.last().state; }

    /// Not to be seen until it is moved again.
    void hide() { hidden_ = true; }

    bool is_hidden() const { return hidden_; }

    bool is_stale() const { return track_.is_stale(); }

    double last_arrival_s() const { return last_arrival_s_; }

    const SenderClock& clock() const { return clock_; }

    long late() const { return late_; }

    long snaps() const { return track_.snaps(); }

    long taken() const { return taken_; }

private:
    bool is_repeated(const Fix& fix, const glm::dvec3& world_m, double arrival_s);
    bool is_stationary() const;
    bool has_jumped(const Fix& fix, const glm::dvec3& world_m, double arrival_s) const;
    TimingEvidence timing_evidence_of(const Fix& fix, const glm::dvec3& world_m);
    std::optional<double> distance_along_track(const glm::dvec3& distance_m) const;
    void set_motion(const Fix& fix, LiveSample& sample, double step_s);
    bool trusts_velocity(const Fix& fix, const LiveSample& sample, double step_s);
    glm::dvec3 turn_of(const Fix& fix, const LiveSample& sample) const;
    double speed_rate_of(const glm::dvec3& velocity_mps, double step_s) const;

    VehicleKey key_;
    SenderClock clock_;
    LiveTrack track_;
    std::optional<Fix> last_fix_;
    double last_arrival_s_ = 0.0;
    double velocity_error_ = 0.0; ///< share by which velocities contradict positions, filtered
    int repeats_ = 0;             ///< fixes in a row that say the same place
    int typical_repeats_ = 0;       ///< of a sender whose places change less often than it sends
    double moved_at_s_ = 0.0;     ///< arrival of the last fix that said another place
    bool hidden_ = false;
    long late_ = 0;
    long taken_ = 0;
};

} // namespace octant::sim::links
