#pragma once

#include "sim/links/fix.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::sim::links {

/// Evidence in one packet for the time that passed at its sender since the last packet with the result Next or Restarts
/// (SenderClock::Order).
struct TimingEvidence {
    std::optional<double> sent_s;       ///< the sender's clock
    std::optional<std::uint32_t> ticks; ///< a clock that wraps around
    double tick_s = 0.0;                ///< unit of the ticks; 0 = unknown
    /// Time to cover the distance from the last position at the speed that the packet reports.
    std::optional<double> moved_s;
    /// Distance from the last position along the track, metres; negative if backwards.
    std::optional<double> distance_m;
};

/// The mean time between the newest packets, by the clock of the sender.
class PacketSpacing {
public:
    /// Adds the time between a packet and the one before, seconds.
    void add(double distance_s);

    /// Seconds, 0 until known.
    double period_s() const { return period_s_; }

    /// True if there are enough packets for a mean.
    bool is_settled() const { return count_ >= 8; }

private:
    std::array<double, 64> distances_s_{}; ///< a ring
    std::size_t count_ = 0;                ///< of all distances
    double period_s_ = 0.0;
};

/// Counts the lost packets of a stream whose sender numbers its packets one by one, with numbers that wrap around. Up
/// to 32 missing numbers in a row count as lost. After more, or after two seconds of silence, the sender may have
/// restarted, and nothing counts as lost.
class SequenceCount {
public:
    /// Adds a packet by its number, which has `bits` bits, and its arrival. A late packet is no longer missing; a
    /// repeated one counts once.
    void add(std::uint32_t number, int bits, double arrival_s);

    /// True if the sender numbers this stream: eight numbers came, and three quarters of them follow one another. A
    /// counter that stands still or that several streams share is no evidence.
    bool is_numbered() const { return taken_ >= 8 && taken_ >= 3 * lost_; }

    /// Number of missing packets; 0 if the stream is not numbered.
    long lost() const { return is_numbered() ? lost_ : 0; }

private:
    std::uint32_t newest_ = 0;
    std::uint64_t received_mask_ = 0; ///< bit i: number newest_ - i was received or precedes the first
    double last_s_ = 0.0;
    bool has_begun_ = false;
    long taken_ = 0;
    long lost_ = 0;
};

/// Estimates when a vehicle was at a point of its track, from the distance covered by each arrival: a parabola through
/// the last three seconds, in which late packets have little weight. Works for bursts and for uneven rates of the
/// sender.
class DistanceFit {
public:
    /// Adds the distance covered up to a packet, metres, and its arrival. Arrivals must not decrease.
    void add(double arrival_s, double distance_m);

    /// True if there are enough packets and the vehicle is fast enough.
    bool is_ready() const { return ready_; }

    /// Time, by the clock of the receiver, at which a point near the last one was passed. Requires is_ready()
    /// (asserted).
    double time_s(double distance_m) const;

    /// Speed at the last packet. Requires is_ready() (asserted).
    double speed_mps() const { return fitted_.slope; }

private:
    struct Point {
        double arrival_s = 0.0;
        double distance_m = 0.0;
        double weight = 1.0;
    };

    void fit();
    bool solve(bool curved);
    void weigh();

    std::vector<Point> points_;
    bool ready_ = false;
    Parabola<double> fitted_; ///< distance over time since the last arrival
};

/// Checks that a clock keeps pace with arrivals: first after one second, then every three.
class ClockRateCheck {
public:
    /// Adds the time between two packets by arrivals and by the clock.
    void add(double arrived_s, double passed_s);

    /// True if the clock was more than 30 % too fast or too slow at the last check.
    bool is_wrong() const { return wrong_; }

private:
    double arrived_s_ = 0.0;
    double passed_s_ = 0.0;
    bool judged_ = false;
    bool wrong_ = false;
};

/// Estimates when packets were sent, by our clock, from their arrivals, which come in bursts and at unknown rates. The
/// time of the sender is taken, in this order, from its own clock if its unit can be found; from the distance covered
/// over the reported speed; from the distance covered over the speed of the track itself; from the mean time between
/// arrivals. A clock that does not keep pace with arrivals is ignored. The offset to our clock is the smallest delay of
/// the last seconds, followed slowly. A function of its calls only; reads no clock.
class SenderClock {
public:
    enum class Order {
        Next,
        Late,     ///< sent before the last packet, or a repetition of it
        Restarts, ///< so far from the last packet that the sender must have restarted
    };

    /// Adds the next packet by its arrival, seconds on our clock, which must not decrease.
    Order take(double arrival_s, const TimingEvidence& clue);

    /// Time of the sender at the last packet that was Next or Restarts, seconds since the first packet.
    double sender_s() const { return sender_s_; }

    /// The time of the sender for a time of our clock.
    double sender_from_ours_s(double ours_s) const { return ours_s - offset_s_; }

    /// Mean time between packets, seconds; 0 until known.
    double period_s() const { return spacing_.period_s(); }

    /// Mean delay of packets beyond the quickest ones, seconds.
    double jitter_s() const { return jitter_s_; }

private:
    static constexpr std::size_t buckets = 12;

    /// The source of the time between two packets.
    enum class TimeSource { SentTime, Ticks, ReportedSpeed, Way, Arrivals };

    /// The time since the last packet.
    struct Step {
        TimeSource source = TimeSource::Arrivals;
        double passed_s = 0.0;
        double distance_s = 0.0; ///< the same without the influence of delays
    };

    Step step_of(double arrival_s, const TimingEvidence& clue);
    std::optional<double> step_by_ticks(double arrival_s, const TimingEvidence& clue);
    Step step_by_distance(double arrival_s, double distance_m);
    Step step_by_arrivals(double arrival_s);
    bool is_late(const Step& step);
    void check_clock_rate(double arrival_s, const TimingEvidence& clue);
    void follow(double arrival_s);
    void begin_offset(double arrival_s);
    void begin(double arrival_s, const TimingEvidence& clue);

    bool has_begun_ = false;
    double sender_s_ = 0.0;
    double last_arrival_s_ = 0.0;
    double last_sent_s_ = 0.0;
    ClockRateCheck sent_rate_check_;
    /// True if the clock of the sender stands still or restarts with each packet.
    bool ignores_sent_time_ = false;
    std::uint32_t last_ticks_ = 0;
    // What the last second says of the unit of the ticks.
    double ticks_since_s_ = 0.0;
    double ticks_passed_ = 0.0;
    long ticks_changed_ = 0;
    long ticks_seen_ = 0;
    double seconds_per_tick_ = 0.0; ///< 0 = not known
    ClockRateCheck ticks_rate_check_;
    ClockRateCheck sent_speed_rate_check_;
    DistanceFit distance_fit_;
    double distance_m_ = 0.0;
    /// The sender's time less that of the fit; nothing where the fit does not count.
    std::optional<double> distance_shift_s_;
    /// The sender's time less arrivals; nothing where those do not count.
    std::optional<double> arrival_shift_s_;
    PacketSpacing spacing_;
    int consecutive_late_ = 0;
    int consecutive_restarts_ = 0;
    // By how much sender and receiver differ, from the least delays of late.
    std::array<double, buckets> min_s_{};
    std::size_t bucket_ = 0;
    double bucket_since_s_ = 0.0;
    double offset_s_ = 0.0;
    double jitter_s_ = 0.0;
};

} // namespace octant::sim::links
