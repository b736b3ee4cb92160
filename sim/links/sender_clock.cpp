#include "sim/links/sender_clock.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace octant::sim::links {

namespace {

/// A longer silence of packets without a clock also counts as time at the sender.
constexpr double max_gap_s = 0.25;
constexpr double restart_s = 2.0;
constexpr double min_step_s = 1e-6; ///< shorter differences count as the same time
constexpr int late_before_restart = 10;
constexpr int restarts_before_distrust = 3;
constexpr double min_bucket_s = 0.25; ///< the least delay is that of twelve of them
constexpr double quick_fall_s = 0.1;
constexpr double max_rise = 0.05; ///< seconds a second
constexpr double unit_after_s = 1.0;
constexpr double max_pace_error = 0.3;
constexpr double min_speed_mps = 0.3; ///< below, the distance is no measure of time

} // namespace

void PacketSpacing::add(double distance_s) {
    distances_s_.at(count_ % distances_s_.size()) = distance_s;
    ++count_;
    const double sum_s = std::accumulate(distances_s_.begin(), distances_s_.end(), 0.0);
    period_s_ = sum_s / static_cast<double>(std::min(count_, distances_s_.size()));
}

void SequenceCount::add(std::uint32_t number, int bits, double arrival_s) {
    constexpr std::int32_t max_step = 33;
    constexpr std::int32_t remembered = 64;
    constexpr double max_silence_s = 2.0;
    const int unused_bits = 32 - bits;
    const std::int32_t step = static_cast<std::int32_t>((number - newest_) << unused_bits) >> unused_bits;
    const bool goes_on = has_begun_ && arrival_s - last_s_ <= max_silence_s;
    last_s_ = arrival_s;
    if (!goes_on || step > max_step || step <= -remembered) {
        has_begun_ = true;
        newest_ = number;
        received_mask_ = ~std::uint64_t{0};
        return;
    }
    if (step > 0) {
        lost_ += step - 1;
        newest_ = number;
        received_mask_ = received_mask_ << step | 1U;
        ++taken_;
        return;
    }
    const std::uint64_t place = std::uint64_t{1} << -step;
    const bool is_late = (received_mask_ & place) == 0;
    lost_ -= is_late ? 1 : 0;
    taken_ += is_late ? 1 : 0;
    received_mask_ |= place;
}

void DistanceFit::add(double arrival_s, double distance_m) {
    constexpr double length_s = 3.0;
    constexpr std::size_t max_points = 128;
    constexpr double min_apart_s = length_s / max_points;
    const std::size_t count = points_.size();
    if (count > 1 && points_.back().arrival_s - points_[count - 2].arrival_s < min_apart_s) { points_.pop_back(); }
    points_.push_back({arrival_s, distance_m});
    const auto old =
        std::ranges::find_if(points_, [&](const Point& point) { return point.arrival_s >= arrival_s - length_s; });
    points_.erase(points_.begin(), old);
    fit();
}

void DistanceFit::fit() {
    constexpr std::size_t min_points = 5;
    constexpr double min_length_s = 0.4;
    constexpr std::size_t min_curved_points = 10;
    constexpr double min_curved_length_s = 1.2;
    constexpr int passes = 3;
    const double length_s = points_.back().arrival_s - points_.front().arrival_s;
    ready_ = points_.size() >= min_points && length_s >= min_length_s;
    const bool curved = points_.size() >= min_curved_points && length_s >= min_curved_length_s;
    std::ranges::for_each(points_, [](Point& point) { point.weight = 1.0; });
    for (int pass = 0; ready_ && pass < passes; ++pass) {
        ready_ = solve(curved) && speed_mps() >= min_speed_mps;
        if (ready_ && pass + 1 < passes) { weigh(); }
    }
}

/// Returns false if the points do not determine a line or parabola.
bool DistanceFit::solve(bool curved) {
    ParabolaFit<double> sums;
    const Point& last = points_.back();
    for (const Point& point : points_) {
        sums.add(point.arrival_s - last.arrival_s, point.distance_m - last.distance_m, point.weight);
    }
    const auto solved = curved ? sums.parabola() : sums.line();
    fitted_ = solved.value_or(Parabola<double>{});
    fitted_.value += last.distance_m;
    return solved.has_value();
}

/// Packets far off the fit count less, by Cauchy's weight.
void DistanceFit::weigh() {
    constexpr double min_scale_s = 0.002;
    double sum_s = 0.0;
    for (Point& point : points_) {
        point.weight = std::abs(point.arrival_s - time_s(point.distance_m));
        sum_s += point.weight;
    }
    const double scale_s = 2.0 * std::max(sum_s / static_cast<double>(points_.size()), min_scale_s);
    for (Point& point : points_) {
        const double share = point.weight / scale_s;
        point.weight = 1.0 / (1.0 + share * share);
    }
}

double DistanceFit::time_s(double distance_m) const {
    assert(ready_);
    // The root of the parabola that is near the last arrival.
    const double left_m = distance_m - fitted_.value;
    const double square = fitted_.slope * fitted_.slope + 4.0 * fitted_.bend * left_m;
    const double root = std::sqrt(std::max(square, 0.25 * fitted_.slope * fitted_.slope));
    return points_.back().arrival_s + 2.0 * left_m / (fitted_.slope + root);
}

void ClockRateCheck::add(double arrived_s, double passed_s) {
    arrived_s_ += arrived_s;
    passed_s_ += passed_s;
    constexpr double first_s = 1.0;
    constexpr double later_s = 3.0;
    if (arrived_s_ >= (judged_ ? later_s : first_s)) {
        wrong_ = std::abs(passed_s_ / arrived_s_ - 1.0) > max_pace_error;
        judged_ = true;
        arrived_s_ = 0.0;
        passed_s_ = 0.0;
    }
}

void SenderClock::begin(double arrival_s, const TimingEvidence& clue) {
    const double before_s = has_begun_ ? sender_s_ : 0.0;
    const int restarts = has_begun_ ? consecutive_restarts_ + 1 : 0;
    const bool useless = ignores_sent_time_ || restarts >= restarts_before_distrust;
    *this = {};
    has_begun_ = true;
    consecutive_restarts_ = restarts;
    ignores_sent_time_ = useless;
    // Continues so that the shown time never decreases.
    sender_s_ = before_s + (before_s > 0.0 ? restart_s : 0.0);
    last_arrival_s_ = arrival_s;
    last_sent_s_ = clue.sent_s.value_or(0.0);
    last_ticks_ = clue.ticks.value_or(0);
    ticks_since_s_ = arrival_s;
    begin_offset(arrival_s);
    follow(arrival_s);
}

void SenderClock::begin_offset(double arrival_s) {
    min_s_.fill(std::numeric_limits<double>::infinity());
    offset_s_ = arrival_s - sender_s_;
    bucket_since_s_ = arrival_s;
}

/// Time by a clock of unknown unit, once the unit is found: the power of ten that fits the arrivals of a second.
std::optional<double> SenderClock::step_by_ticks(double arrival_s, const TimingEvidence& clue) {
    const auto change = static_cast<std::int32_t>(*clue.ticks - last_ticks_);
    if (ticks_rate_check_.is_wrong()) {
        seconds_per_tick_ = 0.0;
        ticks_rate_check_ = {};
    }
    if (seconds_per_tick_ > 0.0) { return change * seconds_per_tick_; }
    ++ticks_seen_;
    ticks_changed_ += change != 0 ? 1 : 0;
    ticks_passed_ += std::max(change, 0);
    const double since_s = arrival_s - ticks_since_s_;
    if (since_s < unit_after_s) { return std::nullopt; }
    if (ticks_passed_ > 0.0) {
        // A clock that stands still for most packets is too coarse to tell them apart.
        const bool fine = 10 * ticks_changed_ >= 9 * ticks_seen_;
        const double unit_s =
            clue.tick_s > 0.0 ? clue.tick_s : std::pow(10.0, std::round(std::log10(since_s / ticks_passed_)));
        const double error = std::abs(unit_s * ticks_passed_ / since_s - 1.0);
        seconds_per_tick_ = fine && error < max_pace_error ? unit_s : 0.0;
    }
    ticks_since_s_ = arrival_s;
    ticks_passed_ = 0.0;
    ticks_changed_ = 0;
    ticks_seen_ = 0;
    return seconds_per_tick_ > 0.0 ? std::optional(change * seconds_per_tick_) : std::nullopt;
}

/// Time from the speed of the track itself. The time of the fit is followed as long as the speed stays within half and
/// double.
SenderClock::Step SenderClock::step_by_distance(double arrival_s, double distance_m) {
    if (distance_m <= 0.0) {
        const double back_s = distance_fit_.is_ready() ? distance_m / distance_fit_.speed_mps() : -min_step_s;
        return {TimeSource::Way, distance_m < 0.0 ? std::max(back_s, -0.5 * restart_s) : 0.0};
    }
    const bool was_ready = distance_fit_.is_ready();
    const double before_s = was_ready ? distance_fit_.time_s(distance_m_) : 0.0;
    distance_m_ += distance_m;
    distance_fit_.add(arrival_s, distance_m_);
    if (!was_ready || !distance_fit_.is_ready()) {
        distance_shift_s_.reset();
        return step_by_arrivals(arrival_s);
    }
    arrival_shift_s_.reset();
    distance_shift_s_ = distance_shift_s_.value_or(sender_s_ - before_s);
    const double even_s = distance_m / distance_fit_.speed_mps();
    const double fitted_s = distance_fit_.time_s(distance_m_) + *distance_shift_s_ - sender_s_;
    return {TimeSource::Way, std::clamp(fitted_s, 0.5 * even_s, 2.0 * even_s), even_s};
}

/// Time from arrivals, averaged over about ten packets.
SenderClock::Step SenderClock::step_by_arrivals(double arrival_s) {
    const double between_s = std::max(arrival_s - last_arrival_s_, min_step_s);
    const double period_s = spacing_.period_s();
    constexpr double many = 3.0;
    if (!spacing_.is_settled() || between_s > std::max(max_gap_s, many * period_s)) {
        arrival_shift_s_ = sender_s_ + between_s - arrival_s;
        return {TimeSource::Arrivals, between_s, between_s};
    }
    constexpr double share = 0.1;
    arrival_shift_s_ = arrival_shift_s_.value_or(sender_s_ - last_arrival_s_);
    const double behind_s = arrival_s + *arrival_shift_s_ - sender_s_ - period_s;
    const double step_s = std::max(period_s + share * behind_s, share * period_s);
    return {TimeSource::Arrivals, std::max(step_s, min_step_s), between_s};
}

/// Time at the sender since the last packet, from the best source.
SenderClock::Step SenderClock::step_of(double arrival_s, const TimingEvidence& clue) {
    const std::optional<double> ticked = clue.ticks ? step_by_ticks(arrival_s, clue) : std::nullopt;
    const auto reported = [](TimeSource source, double passed_s) {
        const double step_s = std::abs(passed_s) < min_step_s ? 0.0 : passed_s;
        return Step{source, step_s, step_s};
    };
    const bool by_speed = clue.moved_s && !sent_speed_rate_check_.is_wrong();
    const bool sent = clue.sent_s && !ignores_sent_time_ && !sent_rate_check_.is_wrong();
    if (!sent && !ticked && !by_speed && clue.distance_m) { return step_by_distance(arrival_s, *clue.distance_m); }
    distance_fit_ = {};
    distance_m_ = 0.0;
    distance_shift_s_.reset();
    if (!sent && !ticked && !by_speed) { return step_by_arrivals(arrival_s); }
    arrival_shift_s_.reset();
    return sent     ? reported(TimeSource::SentTime, *clue.sent_s - last_sent_s_)
           : ticked ? reported(TimeSource::Ticks, *ticked)
                    : reported(TimeSource::ReportedSpeed, *clue.moved_s);
}

/// Follows the smallest delay of the last seconds: downwards quickly, upwards slowly.
void SenderClock::follow(double arrival_s) {
    const double delay_s = arrival_s - sender_s_;
    const double bucket_s = std::max(min_bucket_s, period_s());
    const double passed = std::floor((arrival_s - bucket_since_s_) / bucket_s);
    if (passed > 0.0) {
        bucket_since_s_ += passed * bucket_s;
        for (double i = 0.0; i < std::min(passed, static_cast<double>(buckets)); i += 1.0) {
            bucket_ = (bucket_ + 1) % buckets;
            min_s_[bucket_] = std::numeric_limits<double>::infinity();
        }
    }
    min_s_[bucket_] = std::min(min_s_[bucket_], delay_s);
    const double min_s = *std::ranges::min_element(min_s_);
    const double since_s = std::max(arrival_s - last_arrival_s_, 0.0);
    if (min_s < offset_s_) {
        offset_s_ += (min_s - offset_s_) * (1.0 - std::exp(-since_s / quick_fall_s));
    } else {
        offset_s_ += std::min(min_s - offset_s_, max_rise * since_s);
    }
    constexpr double jitter_share = 0.02;
    jitter_s_ += jitter_share * (std::max(delay_s - min_s, 0.0) - jitter_s_);
}

/// Discards the state of a clock that proved wrong.
void SenderClock::check_clock_rate(double arrival_s, const TimingEvidence& clue) {
    const double between_s = arrival_s - last_arrival_s_;
    const auto wrong = [this] {
        return sent_rate_check_.is_wrong() || ticks_rate_check_.is_wrong() || sent_speed_rate_check_.is_wrong();
    };
    const bool was_wrong = wrong();
    if (clue.sent_s) { sent_rate_check_.add(between_s, *clue.sent_s - last_sent_s_); }
    if (clue.ticks && seconds_per_tick_ > 0.0) {
        const auto change = static_cast<std::int32_t>(*clue.ticks - last_ticks_);
        ticks_rate_check_.add(between_s, change * seconds_per_tick_);
    }
    if (clue.moved_s) { sent_speed_rate_check_.add(between_s, *clue.moved_s); }
    if (wrong() && !was_wrong) {
        begin_offset(arrival_s);
        spacing_ = {};
    }
}

/// True if the packet is late. A clock that stands still is ignored.
bool SenderClock::is_late(const Step& step) {
    if (step.passed_s > 0.0 || step.passed_s <= -restart_s) { return false; }
    const bool too_many = ++consecutive_late_ >= late_before_restart;
    const bool stands = step.passed_s == 0.0 && too_many;
    ignores_sent_time_ = ignores_sent_time_ || (stands && step.source == TimeSource::SentTime);
    seconds_per_tick_ = stands && step.source == TimeSource::Ticks ? 0.0 : seconds_per_tick_;
    const bool has_clock = step.source == TimeSource::SentTime || step.source == TimeSource::Ticks;
    return !too_many || (stands && has_clock);
}

SenderClock::Order SenderClock::take(double arrival_s, const TimingEvidence& clue) {
    if (!has_begun_) {
        begin(arrival_s, clue);
        return Order::Restarts;
    }
    arrival_s = std::max(arrival_s, last_arrival_s_);
    const Step step = step_of(arrival_s, clue);
    if (is_late(step)) { return Order::Late; }
    const double max_step_s = std::max(restart_s, 2.0 * (arrival_s - last_arrival_s_));
    if (step.passed_s <= 0.0 || step.passed_s > max_step_s) {
        begin(arrival_s, clue);
        return Order::Restarts;
    }
    consecutive_late_ = 0;
    consecutive_restarts_ = 0;
    spacing_.add(step.distance_s);
    sender_s_ += step.passed_s;
    check_clock_rate(arrival_s, clue);
    follow(arrival_s);
    last_arrival_s_ = arrival_s;
    last_sent_s_ = clue.sent_s.value_or(last_sent_s_);
    last_ticks_ = clue.ticks.value_or(last_ticks_);
    return Order::Next;
}

} // namespace octant::sim::links
