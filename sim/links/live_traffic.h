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

/// The motion in one packet, in world axes. state.time_s is the time of the sender.
struct LiveSample {
    AircraftState state;
    glm::dvec3 world_radps{0.0};        ///< turn rate in world axes
    glm::dvec3 world_mps2{0.0};         ///< acceleration
    double extrapolation_limit_s = 0.5; ///< longest time the motion may continue after this sample
    double acceleration_limit_s = 0.5;  ///< longest time the acceleration continues after this sample
};

/// The motion of one vehicle from samples that come late, in bursts or not at all. Between samples it follows their
/// curve. After the last sample it continues with its velocity and turn rate as long as that sample allows, then it
/// stops. Corrections are blended in over about 0.15 s; larger ones jump. If the new position is behind, the shown
/// motion slows down until it is reached, so that nothing flies backwards.
class LiveTrack {
public:
    /// Adds a sample that is later than all others (asserted). Samples close in time replace one another, so that
    /// memory is bounded.
    void add(const LiveSample& sample);

    bool empty() const { return samples_.empty(); }

    const LiveSample& last() const { return samples_.back(); }

    /// Samples of the last seconds in order of time.
    const std::deque<LiveSample>& samples() const { return samples_; }

    /// Removes all samples: the next one begins another motion.
    void clear();

    /// The state to show at a time of the clock of the sender, `passed_s` after the state shown last. Requires a sample
    /// (asserted). time_s of the result is `sender_s`.
    AircraftState show(double sender_s, double passed_s);

    /// True if the last state shown was so long after the last sample that the motion stopped.
    bool is_stale() const { return stale_; }

    /// Number of corrections that were too large for blending.
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

/// The sender of a vehicle and the number of the vehicle at this sender.
struct VehicleKey {
    Protocol protocol = Protocol::Fdm;
    PacketSource source;
    std::uint64_t vehicle = 0;

    auto operator<=>(const VehicleKey&) const = default;
};

/// One vehicle flown by another program: from fixes as they arrive to the motion that is shown.
class LiveVehicle {
public:
    explicit LiveVehicle(const VehicleKey& key) : key_(key) {}

    const VehicleKey& key() const { return key_; }

    /// Adds a fix and its position in the world. Returns false for a late fix. Arrivals are seconds on our clock and
    /// must not decrease.
    bool add(const Fix& fix, const glm::dvec3& world_m, double arrival_s);

    /// The state to show at a time of our clock, delayed by `delay_s`, `passed_s` after the state shown last. Requires
    /// a fix (asserted).
    AircraftState show(double now_s, double delay_s, double passed_s);

    /// The motion of the newest fix. Requires a fix (asserted).
    const AircraftState& newest() const { return track_.last().state; }

    /// Hides the vehicle until it is moved again.
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
    double velocity_error_ = 0.0; ///< filtered relative difference of reported velocities and positions
    int repeats_ = 0;             ///< consecutive fixes with the same position
    int typical_repeats_ = 0;     ///< for senders whose positions change less often than they send
    double moved_at_s_ = 0.0;     ///< arrival of the last fix with a new position
    bool hidden_ = false;
    long late_ = 0;
    long taken_ = 0;
};

/// Position of a fix in the world.
struct WorldPosition {
    glm::dvec3 at_m{0.0};
    double north_bearing_rad = 0.0; ///< bearing of true north, clockwise from the y axis
};

using WorldFromFix = std::function<WorldPosition(const VehicleKey& key, const Fix& fix)>;

/// Counts of all packets so far.
struct TrafficCounts {
    long accepted = 0; ///< packets that moved something
    long wrong = 0;    ///< packets that every decoder refused
    long unused = 0;   ///< correct packets of which nothing is shown, including vehicles beyond max_vehicles
    /// Lost packets by the sequence numbers of MAVLink and of CIGI hosts; nothing if no stream is numbered. The other
    /// protocols have no numbers.
    std::optional<long> lost;
    long late = 0;       ///< dropped
    long snaps = 0;      ///< corrections too large to be blended in
    long unreported = 0; ///< packets that packet_reports() leaves out because there are too many kinds
};

/// Summary of the packets of one vehicle, followed or not.
struct VehicleReport {
    std::string name;    ///< see name_of()
    std::string marking; ///< marking of a DIS entity; otherwise empty
    Protocol protocol = Protocol::Fdm;
    PacketSource source;
    long packets = 0;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double altitude_m = 0.0;
    bool is_shown = false;
};

/// Packets of one kind that were accepted, refused or ignored.
struct PacketReport {
    PacketSource source;
    std::string text; ///< message
    long packets = 0;
    bool is_wrong = false;
};

/// Display name of a vehicle: "1:2:3" is site, application and entity of DIS; "system 1" of MAVLink; "entity 5" of
/// CIGI; "aircraft" for senders with only one.
std::string name_of(const VehicleKey& key);

/// All vehicles flown by other programs. Reads packets and gives the states to show at a time. Uses no sockets and no
/// clocks, so that a recording of packets repeats it.
class LiveTraffic {
public:
    static constexpr std::size_t max_vehicles = 256;
    /// Most vehicles that are reported; those beyond max_vehicles are not followed.
    static constexpr std::size_t max_reported = 20000;
    /// Silence after which another vehicle may replace this one.
    static constexpr double gone_after_s = 10.0;
    /// The same if the other vehicle is that of the restarted sender: same number, machine and protocol, another port.
    static constexpr double restarted_after_s = 2.0;

    /// `ground` answers CIGI hosts and must outlive this; null: all is outside the map. `ellipsoid` is that of the
    /// ground.
    explicit LiveTraffic(
        WorldFromFix world_from_fix, const CigiGround* ground = nullptr, const Ellipsoid& ellipsoid = wgs84)
        : world_from_fix_(std::move(world_from_fix)), ellipsoid_(ellipsoid), cigi_(ground) {}

    CigiImageGenerator& cigi() { return cigi_; }

    const CigiImageGenerator& cigi() const { return cigi_; }

    enum class PacketOutcome {
        Wrong, ///< refused by the decoder; only counts changed
        Right, ///< correct; may matter for later packets
        Moved
    };

    /// Decodes one packet. Never throws because of its contents.
    PacketOutcome take(const Datagram& datagram);

    /// In the order of their first packets.
    std::span<const LiveVehicle> vehicles() const { return vehicles_; }

    /// States of the first vehicles from their newest packets, neither smoothed nor extrapolated. Returns the number of
    /// states written.
    std::size_t show_newest(double now_s, std::span<AircraftState> states);

    /// States of the first vehicles at a time of our clock, not before that of the last call. Returns the number of
    /// states written.
    std::size_t show(double now_s, double delay_s, std::span<AircraftState> states);

    const TrafficCounts& counts() const { return counts_; }

    /// True if any shown vehicle stopped at the last show() for lack of packets.
    bool is_stale() const;

    /// Arrival of the newest packet that moved a vehicle, on our clock.
    double newest_s() const { return newest_s_; }

    /// Messages since the last call: one line for each kind of packet of each sender; of each fault at most 16 kinds of
    /// one sender and 100 kinds in all, but always the first kind of each of 100 more senders.
    std::vector<std::string> take_new_messages();

    /// Status lines: senders and what is wrong with their packets.
    std::vector<std::string> lines() const;

    /// All vehicles that sent a packet, by protocol, source and number.
    std::vector<VehicleReport> vehicle_reports() const;

    /// All kinds of packets of each sender with their numbers.
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

    /// Number of packets of one kind from one sender.
    struct PacketTally {
        DecodeResult first;
        long packets = 0;
        bool is_uniform = true; ///< of one size
    };

    /// A kind of packet. Sizes do not belong to it, because damaged packets have any size.
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

    /// The state of a stream between its packets.
    template <class Value>
    struct Stream {
        Value value;
        double last_s = 0.0; ///< arrival of its newest packet
    };

    std::map<PacketSource, Stream<NamedColumns>> columns_;
    std::map<std::pair<PacketSource, std::uint8_t>, Stream<MavLinkPose>> poses_;
    std::map<PacketSource, Stream<XPlanePose>> xplanes_;
    /// By sender and, for MAVLink, by system and component in one number.
    std::map<std::tuple<Protocol, PacketSource, std::uint16_t>, Stream<SequenceCount>> sequences_;
    CigiImageGenerator cigi_;
    TrafficCounts counts_;
    /// Packets by kind, as far as they are reported.
    std::map<PacketErrorKey, PacketTally> packet_tallies_;
    std::map<PacketError, std::size_t> error_keys_; ///< number of packet_tallies_ with this fault
    bool has_reported_dis_ = false;                 ///< whether the message about the earth as the only body was given
    /// Without names, which the keys give.
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
