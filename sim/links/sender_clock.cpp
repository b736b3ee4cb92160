#include "sim/links/sender_clock.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::sim::links {

namespace {

/// A longer silence of packets without a clock counts as time that passed at the sender too.
constexpr double longest_gap_s = 0.25;
constexpr double restart_s = 2.0;
constexpr double least_step_s = 1e-6; ///< what is nearer counts as the same time
constexpr double most_missing = 1e6;  ///< packets in one gap
constexpr int late_before_restart = 10;
constexpr double bucket_s = 0.25; ///< the least delay is that of twelve of them
constexpr double quick_fall_s = 0.1;
constexpr double slowest_rise = 0.05; ///< seconds a second
constexpr double unit_after_s = 1.0;
constexpr double motion_after_s = 1.0;
constexpr double most_motion_error = 0.2;

} // namespace

void SenderClock::begin(double arrival_s, const TimeClue& clue) {
    const double before_s = begun_ ? sender_s_ : 0.0;
    const long lost = lost_;
    *this = {};
    begun_ = true;
    lost_ = lost;
    // Goes on so that what is shown never meets older times again.
    sender_s_ = before_s + (before_s > 0.0 ? restart_s : 0.0);
    last_arrival_s_ = arrival_s;
    last_sent_s_ = clue.sent_s.value_or(0.0);
    last_ticks_ = clue.ticks.value_or(0);
    ticks_since_s_ = arrival_s;
    motion_since_s_ = arrival_s;
    least_s_.fill(std::numeric_limits<double>::infinity());
    offset_s_ = arrival_s - sender_s_;
    bucket_ = static_cast<long>(std::floor(arrival_s / bucket_s));
    follow(arrival_s);
}

/// Time by a clock whose unit nobody told, once it is known: the power of ten that fits the
/// arrivals of a second.
std::optional<double> SenderClock::by_ticks(double arrival_s, const TimeClue& clue) {
    const auto change = static_cast<std::int32_t>(*clue.ticks - last_ticks_);
    ++ticks_seen_;
    ticks_changed_ += change != 0 ? 1 : 0;
    ticks_passed_ += std::max(change, 0);
    const double since_s = arrival_s - ticks_since_s_;
    if (seconds_a_tick_ == 0.0 && since_s >= unit_after_s && ticks_passed_ > 0.0) {
        // A clock that stands still for most packets is too coarse to tell them apart.
        const bool fine = 10 * ticks_changed_ >= 9 * ticks_seen_;
        const double unit_s = clue.tick_s > 0.0
                                  ? clue.tick_s
                                  : std::pow(10.0, std::round(std::log10(since_s / ticks_passed_)));
        const double error = std::abs(unit_s * ticks_passed_ / since_s - 1.0);
        constexpr double most_error = 0.3;
        seconds_a_tick_ = fine && error < most_error ? unit_s : -1.0;
    }
    return seconds_a_tick_ > 0.0 ? std::optional(change * seconds_a_tick_) : std::nullopt;
}

/// Seconds that passed at the sender since the last packet; nothing where the clues do not say.
std::optional<double> SenderClock::passed_s(double arrival_s, const TimeClue& clue) {
    const std::optional<double> ticked = clue.ticks ? by_ticks(arrival_s, clue) : std::nullopt;
    if (clue.sent_s) {
        return *clue.sent_s - last_sent_s_;
    }
    if (ticked) {
        return ticked;
    }
    if (!clue.moved_s || motion_refuted_) {
        return std::nullopt;
    }
    motion_passed_s_ += *clue.moved_s;
    const double since_s = arrival_s - motion_since_s_;
    if (since_s >= motion_after_s) {
        const double error = std::abs(motion_passed_s_ / since_s - 1.0);
        motion_refuted_ = error > most_motion_error;
        motion_since_s_ = arrival_s;
        motion_passed_s_ = 0.0;
    }
    return clue.moved_s;
}

void SenderClock::learn_period(double step_s, double arrival_s) {
    ++arrivals_;
    const double between_s = arrival_s - last_arrival_s_;
    constexpr long most = 200;
    const double share = 1.0 / static_cast<double>(std::min(arrivals_, most));
    const double observed_s = step_s > 0.0 ? step_s : between_s;
    if (period_s_ > 0.0 && arrivals_ > 20 && observed_s > 1.5 * period_s_) {
        const long missing = std::lround(std::min(observed_s / period_s_, most_missing)) - 1;
        lost_ += step_s > 0.0 ? missing : 0;
        if (step_s > 0.0) {
            return; // The distance of neighbours is what is learned.
        }
    }
    period_s_ += share * (observed_s - period_s_);
}

/// Follows the least delay of the last seconds: downwards quickly, upwards slowly.
void SenderClock::follow(double arrival_s) {
    const double delay_s = arrival_s - sender_s_;
    const auto now = static_cast<long>(std::floor(arrival_s / bucket_s));
    for (bucket_ = std::max(bucket_, now - static_cast<long>(buckets)); bucket_ < now; ++bucket_) {
        const long next = bucket_ + 1;
        if (now - next < static_cast<long>(buckets)) {
            least_s_[static_cast<std::size_t>(next) % buckets] =
                std::numeric_limits<double>::infinity();
        }
    }
    double& own = least_s_[static_cast<std::size_t>(now) % buckets];
    own = std::min(own, delay_s);
    const double least_s = *std::min_element(least_s_.begin(), least_s_.end());
    const double since_s = std::max(arrival_s - last_arrival_s_, 0.0);
    if (least_s < offset_s_) {
        offset_s_ += (least_s - offset_s_) * (1.0 - std::exp(-since_s / quick_fall_s));
    } else {
        offset_s_ += std::min(least_s - offset_s_, slowest_rise * since_s);
    }
    constexpr double jitter_share = 0.02;
    jitter_s_ += jitter_share * (std::max(delay_s - least_s, 0.0) - jitter_s_);
}

SenderClock::Order SenderClock::take(double arrival_s, const TimeClue& clue) {
    if (!begun_) {
        begin(arrival_s, clue);
        return Order::Restarts;
    }
    arrival_s = std::max(arrival_s, last_arrival_s_);
    const std::optional<double> told_s = passed_s(arrival_s, clue);
    double step_s = 0.0;
    if (told_s) {
        step_s = *told_s > 0.0 && *told_s < least_step_s ? 0.0 : *told_s;
        if (step_s <= 0.0 && step_s > -restart_s && ++late_in_a_row_ < late_before_restart) {
            lost_ -= step_s < 0.0 && lost_ > 0 ? 1 : 0;
            return Order::Late;
        }
        if (step_s <= 0.0 || step_s > std::max(restart_s, 2.0 * (arrival_s - last_arrival_s_))) {
            begin(arrival_s, clue);
            return Order::Restarts;
        }
    } else {
        const double between_s = arrival_s - last_arrival_s_;
        step_s = between_s > longest_gap_s || period_s_ <= 0.0 ? between_s : period_s_;
        step_s = std::max(step_s, least_step_s);
    }
    late_in_a_row_ = 0;
    learn_period(told_s ? step_s : 0.0, arrival_s);
    sender_s_ += step_s;
    follow(arrival_s);
    last_arrival_s_ = arrival_s;
    last_sent_s_ = clue.sent_s.value_or(0.0);
    last_ticks_ = clue.ticks.value_or(0);
    return Order::Next;
}

} // namespace octant::sim::links
