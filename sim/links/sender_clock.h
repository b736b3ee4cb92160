#pragma once

#include "sim/links/fix.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::sim::links {

/// What a packet tells of the time that has passed at its sender since the last packet that was Next or Restarts.
struct TimingEvidence {
    std::optional<double> sent_s;       ///< the sender's clock
    std::optional<std::uint32_t> ticks; ///< a clock that wraps around
    double tick_s = 0.0;                ///< its unit; 0 = to be found out
    /// How long the way from the last place takes at the speed that the packet says.
    std::optional<double> moved_s;
    /// The way from the last place in metres, negative where it runs back.
    std::optional<double> distance_m;
};

/// The mean distance of the newest packets in the sender's time.
class PacketSpacing {
public:
    /// Takes the distance of a packet from the one before, in seconds.
    void add(double distance_s);

    /// Seconds, 0 until known.
    double period_s() const { return period_s_; }

    /// Whether there are enough distances for their mean to say something.
    bool is_settled() const { return count_ >= 8; }

private:
    std::array<double, 64> distances_s_{}; ///< a ring
    std::size_t count_ = 0;                ///< of all distances
    double period_s_ = 0.0;
};

/// Counts what a stream lacks whose sender numbers its packets one by one, with numbers that wrap around. Numbers count
/// as missing up to 32 in a row; after more, and after two seconds of silence, the sender may have begun anew, and
/// nothing counts.
class SequenceCount {
public:
    /// Takes the number of a packet, of so many bits, and its arrival. One that comes late is not missing any more; one
    /// that comes twice counts once.
    void add(std::uint32_t number, int bits, double arrival_s);

    /// Whether the sender numbers this stream by itself: eight numbers came, and three quarters of all. A counter that
    /// stands still tells nothing, nor does one that other streams share.
    bool is_numbered() const { return taken_ >= 8 && taken_ >= 3 * lost_; }

    /// Packets that are missing; 0 where the stream is not numbered.
    long lost() const { return is_numbered() ? lost_ : 0; }

private:
    std::uint32_t newest_ = 0;
    std::uint64_t received_mask_ = 0; ///< bit i: the number newest_ - i came, or is from before the beginning
    double last_s_ = 0.0;
    bool has_begun_ = false;
    long taken_ = 0;
    long lost_ = 0;
};

/// When a vehicle was at a place of its way, from the way that it covered by each arrival: a parabola through the last
/// three seconds, in which packets that are late count little. It holds where packets come in bursts, and where the
/// sender's rate is uneven.
class DistanceFit {
public:
    /// Takes the whole way up to a packet, in metres, and its arrival; arrivals do not go back.
    void add(double arrival_s, double distance_m);

    /// Whether there is enough to go by, and the vehicle is fast enough.
    bool is_ready() const { return ready_; }

    /// The time of a place near the last one, by the receiver's clock. is_ready() (asserted).
    double time_s(double distance_m) const;

    /// The speed at the last packet. is_ready() (asserted).
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
    Parabola<double> fitted_; ///< the way by time from the last arrival
};

/// Whether a clock keeps pace with arrivals: judged after one second, then every three.
class ClockRateCheck {
public:
    /// Takes what passed between two packets by arrivals and by the clock.
    void add(double arrived_s, double passed_s);

    /// Whether the clock ran more than 30 % too fast or slow when it was judged last.
    bool is_wrong() const { return wrong_; }

private:
    double arrived_s_ = 0.0;
    double passed_s_ = 0.0;
    bool judged_ = false;
    bool wrong_ = false;
};

/// Finds out when packets were sent, by our clock, from when they came: they come in bursts, at rates that nobody
/// announced. The sender's time runs by its own clock where packets tell one whose unit can be found, else by the
/// vehicle's own motion (the way covered over the speed that is told, else over the speed that the way itself has),
/// else by the mean distance of arrivals. A clock that does not keep pace with arrivals is not followed. Our time from
/// the sender's: the least delay of the last seconds, followed slowly. A function of the calls alone; no clock is read.
class SenderClock {
public:
    enum class Order {
        Next,
        Late,     ///< sent before the last one, or the same again
        Restarts, ///< so far from the last one that the sender must have begun anew
    };

    /// Takes the next packet by its arrival, seconds on our clock, which do not go back.
    Order take(double arrival_s, const TimingEvidence& clue);

    /// The sender's time of the last packet that was Next or Restarts, in seconds from the first.
    double sender_s() const { return sender_s_; }

    /// The sender's time that is to be shown at a time of ours.
    double sender_from_ours_s(double ours_s) const { return ours_s - offset_s_; }

    /// Mean distance of packets, seconds; 0 until known.
    double period_s() const { return spacing_.period_s(); }

    /// How much later than the quickest packets come: the mean over some of them, seconds.
    double jitter_s() const { return jitter_s_; }

private:
    static constexpr std::size_t buckets = 12;

    /// By what the time between two packets is known.
    enum class TimeSource { SentTime, Ticks, ReportedSpeed, Way, Arrivals };

    /// The time since the last packet.
    struct Step {
        TimeSource source = TimeSource::Arrivals;
        double passed_s = 0.0;
        double distance_s = 0.0; ///< the same without what delays have done to it
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
    /// The sender's clock stands, or makes it begin anew with each packet.
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
