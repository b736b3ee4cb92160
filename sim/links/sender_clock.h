#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace octant::sim::links {

/// What a packet tells of the time that has passed at its sender since the packet before.
struct TimeClue {
    std::optional<double> sent_s;       ///< the sender's clock
    std::optional<std::uint32_t> ticks; ///< a clock that wraps around
    double tick_s = 0.0;                ///< its unit; 0 = to be found out
    /// How long the way from the last place takes at the speed that the packet says.
    std::optional<double> moved_s;
};

/// Finds out when packets were sent, by our clock, from when they came: they come in bursts, at
/// rates that nobody announced. The sender's time runs by its own clock where packets tell one
/// whose unit can be found, else by the vehicle's own motion (the way covered over the speed), else
/// by the mean distance of arrivals. Ours from it: the least delay of the last seconds, followed
/// slowly. A function of the calls alone; no clock is read.
class SenderClock {
public:
    enum class Order {
        Next,
        Late,     ///< sent before the last one, or the same again
        Restarts, ///< so far from the last one that the sender must have begun anew
    };

    /// Takes the next packet by its arrival, seconds on our clock, which do not go back.
    Order take(double arrival_s, const TimeClue& clue);

    /// The sender's time of the last packet that was Next or Restarts, in seconds from the first.
    double sender_s() const { return sender_s_; }

    /// The sender's time that is to be shown at a time of ours.
    double sender_from_ours_s(double ours_s) const { return ours_s - offset_s_; }

    /// Mean distance of packets, seconds; 0 until known.
    double period_s() const { return period_s_; }

    /// How much later than the quickest packets come: the mean over some of them, seconds.
    double jitter_s() const { return jitter_s_; }

    /// Packets that the sender's clock says were sent and never came.
    long lost() const { return lost_; }

private:
    static constexpr std::size_t buckets = 12;

    std::optional<double> passed_s(double arrival_s, const TimeClue& clue);
    std::optional<double> by_ticks(double arrival_s, const TimeClue& clue);
    void learn_period(double step_s, double arrival_s);
    void follow(double arrival_s);
    void begin(double arrival_s, const TimeClue& clue);

    bool begun_ = false;
    double sender_s_ = 0.0;
    double last_arrival_s_ = 0.0;
    double last_sent_s_ = 0.0;
    std::uint32_t last_ticks_ = 0;
    // The unit of the ticks.
    double ticks_since_s_ = 0.0;
    double ticks_passed_ = 0.0;
    long ticks_changed_ = 0;
    long ticks_seen_ = 0;
    double seconds_a_tick_ = 0.0; ///< 0 = not known
    // Whether the motion can be trusted.
    double motion_since_s_ = 0.0;
    double motion_passed_s_ = 0.0;
    bool motion_refuted_ = false;
    double period_s_ = 0.0;
    long arrivals_ = 0;
    int late_in_a_row_ = 0;
    long lost_ = 0;
    // By how much sender and receiver differ, from the least delays of late.
    std::array<double, buckets> least_s_{};
    long bucket_ = 0;
    double offset_s_ = 0.0;
    double jitter_s_ = 0.0;
};

} // namespace octant::sim::links
