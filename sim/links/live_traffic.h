#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/earth_frame.h"
#include "sim/links/cigi_image_generator.h"
#include "sim/links/fix.h"
#include "sim/links/mavlink.h"
#include "sim/links/named_columns.h"
#include "sim/links/sender_clock.h"
#include "sim/links/udp_port.h"
#include "sim/links/xplane.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace octant::sim::links {

/// One packet's motion in world axes. state.time_s is the sender's time.
struct LiveSample {
    AircraftState state;
    glm::dvec3 world_radps{0.0};        ///< rate of turn in world axes
    glm::dvec3 world_mps2{0.0};         ///< acceleration
    double extrapolation_limit_s = 0.5; ///< how long the motion may go on beyond it
    double accelerated_s = 0.5;         ///< how long it accelerates beyond it
};

/// The motion of one vehicle, put together from samples that come late, in bursts or not at all. Between samples it
/// lies on their curve; beyond the last one it goes on by velocity and rate of turn for as long as that sample allows,
/// then it stands. What new samples put right is blended in over about 0.15 s, unless it is too far for that; what lies
/// behind along the flight is waited for at less speed, so that nothing flies backwards.
class LiveTrack {
public:
    /// A sample after all others (asserted). Those that are near one another in time give way, so that memory is
    /// bounded.
    void add(const LiveSample& sample);

    bool empty() const { return samples_.empty(); }

    const LiveSample& last() const { return samples_.back(); }

    /// Those of the last seconds, in the order of time.
    const std::deque<LiveSample>& samples() const { return samples_; }

    /// Forgets all: the next sample begins another motion.
    void clear();

    /// What is to be shown `passed_s` after what was shown last, at a time of the sender's clock. There must be a
    /// sample (asserted). time_s of what it gives is `sender_s`.
    AircraftState show(double sender_s, double passed_s);

    /// Whether the last picture is so far beyond the last sample that the motion stands.
    bool is_stale() const { return stale_; }

    /// How often a correction was too far to be blended in.
    long snaps() const { return snaps_; }

private:
    AircraftState raw_at(double sender_s) const;
    AircraftState beyond(double sender_s) const;
    void blend(AircraftState& state, double sender_s, double passed_s);

    std::deque<LiveSample> samples_;
    std::optional<AircraftState> shown_;
    bool stale_ = false;
    long snaps_ = 0;
};

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
    explicit LiveVehicle(const VehicleKey& key) : key_(key) {}

    const VehicleKey& key() const { return key_; }

    /// Takes a fix and where it lies in the world. Returns false for one that came too late. Arrivals are seconds on
    /// our clock and do not go back.
    bool add(const Fix& fix, const glm::dvec3& world_m, double arrival_s);

    /// What is to be shown at a time of our clock, `delay_s` behind it and `passed_s` after what was shown last. There
    /// must be a fix (asserted).
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
    int typical_repeats_ = 0;     ///< of a sender whose places change less often than it sends
    double moved_at_s_ = 0.0;     ///< arrival of the last fix that said another place
    bool hidden_ = false;
    long late_ = 0;
    long taken_ = 0;
};

/// Where a fix lies in the world.
struct WorldPosition {
    glm::dvec3 at_m{0.0};
    double north_bearing_rad = 0.0; ///< of true north there, clockwise from the y axis
};

using WorldFromFix = std::function<WorldPosition(const VehicleKey& key, const Fix& fix)>;

/// What came so far.
struct TrafficCounts {
    long accepted = 0; ///< packets that moved something
    long wrong = 0;    ///< packets that no decoder took
    long unused = 0;   ///< right ones of which nothing is shown, of vehicles beyond the cap too
    /// As the numbers say that MAVLink and hosts of CIGI give their messages, whatever these hold; nothing where no
    /// stream is numbered. The other protocols number nothing.
    std::optional<long> lost;
    long late = 0;   ///< dropped
    long snaps = 0;  ///< corrections too large to be blended in
    long untold = 0; ///< packets of so many kinds that packet_reports() leaves them out
};

/// What came of one vehicle, followed or not.
struct VehicleReport {
    std::string name;    ///< as name_of() has it
    std::string marking; ///< what a DIS entity calls itself; else empty
    Protocol protocol = Protocol::Fdm;
    PacketSource source;
    long packets = 0;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double altitude_m = 0.0;
    bool is_shown = false;
};

/// Packets of one form that were refused or passed over, or taken.
struct PacketReport {
    PacketSource source;
    std::string text; ///< what a person should be told of them
    long packets = 0;
    bool is_wrong = false;
};

/// How people call a vehicle: "1:2:3" is site, application and entity of DIS; "system 1" of MAVLink; "entity 5" of
/// CIGI; "aircraft" where a sender has but one.
std::string name_of(const VehicleKey& key);

/// All vehicles that others fly. Takes packets as they came and gives what is shown at a time; no sockets and no clocks
/// in here, so that a recording of packets repeats it.
class LiveTraffic {
public:
    static constexpr std::size_t max_vehicles = 256;
    /// Vehicles that are reported; those beyond max_vehicles are not followed.
    static constexpr std::size_t max_reported = 20000;
    /// Silence after which a vehicle gives its place to another one.
    static constexpr double gone_after_s = 10.0;
    /// The same where the other one is its sender begun anew: of the same number, machine and protocol, by another
    /// port.
    static constexpr double restarted_after_s = 2.0;

    /// Hosts of CIGI are answered over `ground`, which must outlive this; null: all is outside. `ellipsoid` is that of
    /// the ground.
    explicit LiveTraffic(
        WorldFromFix world_from_fix, const CigiGround* ground = nullptr, const Ellipsoid& ellipsoid = wgs84)
        : world_from_fix_(std::move(world_from_fix)), ellipsoid_(ellipsoid), cigi_(ground) {}

    CigiImageGenerator& cigi() { return cigi_; }

    const CigiImageGenerator& cigi() const { return cigi_; }

    enum class PacketOutcome {
        Wrong, ///< no decoder knows it; it changed nothing but counts
        Right, ///< it may matter for later ones
        Moved
    };

    /// Decodes one packet. Never throws for what it holds.
    PacketOutcome take(const Datagram& datagram);

    /// In the order in which they came first.
    std::span<const LiveVehicle> vehicles() const { return vehicles_; }

    /// States of the first vehicles as their newest packets say, neither smoothed nor carried on.
    std::size_t show_newest(double now_s, std::span<AircraftState> states);

    /// States of the first vehicles at a time of our clock, not before that of the last call. Returns how many of
    /// `states` were filled in.
    std::size_t show(double now_s, double delay_s, std::span<AircraftState> states);

    const TrafficCounts& counts() const { return counts_; }

    /// Whether any vehicle that is shown has stood since the last show() for want of packets.
    bool is_stale() const;

    /// When the newest packet came that moved something, on our clock.
    double newest_s() const { return newest_s_; }

    /// What was told for the first time since the last call: each sender with each kind of packet once, a line each; of
    /// each fault at most 16 kinds from one sender and 100 kinds in all, but always the first kind of each of 100
    /// senders more.
    std::vector<std::string> take_new_messages();

    /// What a person should be told, a line each: senders and what is wrong with them.
    std::vector<std::string> lines() const;

    /// All vehicles of which something came, by protocol, source and number.
    std::vector<VehicleReport> vehicle_reports() const;

    /// What came, each form of packet of each sender once, with the number of such packets.
    std::vector<PacketReport> packet_reports() const;

private:
    struct LastReport {
        Protocol protocol = Protocol::Fdm;
        PacketSource source;
        DecodeResult result;
        double at_s = -1.0;
    };

    PacketOutcome take_fdm(const Datagram& datagram);
    PacketOutcome take_line(const Datagram& datagram);
    PacketOutcome take_mavlink(const Datagram& datagram);
    PacketOutcome take_dis(const Datagram& datagram);
    PacketOutcome take_cigi(const Datagram& datagram);
    PacketOutcome take_xplane(const Datagram& datagram);
    void remove_hidden(std::span<AircraftState> states) const;
    PacketOutcome move(const Datagram& datagram, const Fix& fix, const std::string& marking = {});
    void report(const VehicleKey& key, const Fix& fix, const std::string& marking);
    LiveVehicle* vehicle_of(const VehicleKey& key, double arrival_s);
    PacketOutcome count(const Datagram& datagram, const DecodeResult& result);
    void tally(const Datagram& datagram, const DecodeResult& result);
    void number(const Datagram& datagram, std::uint16_t stream, std::uint32_t number, int bits);
    std::optional<long> lost_of(const VehicleKey& key) const;

    /// Packets of one kind from one sender.
    struct PacketTally {
        DecodeResult first;
        long packets = 0;
        bool is_uniform = true; ///< of one size
    };

    /// A kind of packet. Sizes are no part of it: damaged packets have any.
    struct PacketErrorKey {
        PacketError fault = PacketError::None;
        PacketSource source;
        Protocol protocol = Protocol::Fdm;
        std::uint32_t got = 0;

        auto operator<=>(const PacketErrorKey&) const = default;
    };

    WorldFromFix world_from_fix_;
    Ellipsoid ellipsoid_;
    std::vector<LiveVehicle> vehicles_;
    std::map<VehicleKey, std::size_t> numbers_; ///< of vehicles_, by their keys

    /// What is kept of a stream between its packets.
    template <class Value>
    struct Stream {
        Value value;
        double last_s = 0.0; ///< arrival of its newest packet
    };

    std::map<PacketSource, Stream<NamedColumns>> columns_;
    std::map<std::pair<PacketSource, std::uint8_t>, Stream<MavLinkPose>> poses_;
    std::map<PacketSource, Stream<XPlanePose>> xplanes_;
    /// By sender and, for MAVLink, system and component in one number.
    std::map<std::tuple<Protocol, PacketSource, std::uint16_t>, Stream<SequenceCount>> sequences_;
    CigiImageGenerator cigi_;
    TrafficCounts counts_;
    /// Packets by what they were, as far as that is told.
    std::map<PacketErrorKey, PacketTally> packet_tallies_;
    std::map<PacketError, std::size_t> error_keys_; ///< how many of packet_tallies_ have a fault
    bool has_reported_dis_ = false;                 ///< that it knows the earth alone
    /// Without names, which follow from the keys.
    std::map<VehicleKey, VehicleReport> reports_;
    std::vector<std::string> messages_;
    LastReport last_accepted_;
    LastReport last_rejected_;
    double newest_s_ = 0.0;
    double shown_s_ = 0.0;
    bool has_shown_ = false;
    std::size_t shown_ = 0;
};

} // namespace octant::sim::links
