#include "ui/report/frame_change.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace octant::ui::report {

namespace {

using Values = std::vector<double>;

/// Frames from `begin` to before `end`, as indices.
struct FrameRange {
    std::size_t begin = 0;
    std::size_t end = 0;

    std::size_t size() const { return end - begin; }
};

double mean_of_values(Values values) {
    double sum = 0.0;
    for (const double value : values) { sum += value; }
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// The mean without the least quarter of the values and the greatest. Times of a stage have longer tails than those of
/// frames: what holds up a frame holds up one of its stages.
double mean_of_middle_half(Values values) {
    std::ranges::sort(values);
    const auto quarter = static_cast<std::ptrdiff_t>(values.size() / 4);
    return mean_of_values(Values(values.begin() + quarter, values.end() - quarter));
}

/// The median of values of flights, in which one side's flights together count as much as the other's: where all values
/// of one side are below all of the other, it is in the middle between them, however many flights each side has.
double median_of_sides(const Values& values, std::span<const Side> sides) {
    const auto old_count = static_cast<std::size_t>(std::ranges::count(sides, Side::Old));
    const std::size_t new_count = sides.size() - old_count;
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::size_t passed = 0; // old flights count `new_count`, new ones `old_count`: half of all is their product
    for (std::size_t i = 0; i < order.size(); ++i) {
        passed += sides[order[i]] == Side::Old ? new_count : old_count;
        if (passed == old_count * new_count) { return 0.5 * (values[order[i]] + values[order[i + 1]]); }
        if (passed > old_count * new_count) { return values[order[i]]; }
    }
    return median_of(values);
}

/// Flights whose frames are the same, in the order of time.
class SameFrames {
public:
    SameFrames(std::vector<const FrameTimes*> flights, std::vector<Side> sides, bool in_rounds)
        : flights_(std::move(flights)), sides_(std::move(sides)), in_rounds_(in_rounds) {
        frames_ = flights_.front()->frame_ms.size();
        for (const FrameTimes* flight : flights_) { frames_ = std::min(frames_, flight->frame_ms.size()); }
        usual_ms_ = medians_by_frame([](const FrameTimes& each) { return std::span(each.frame_ms); });
        leave_out_held_frames();
    }

    std::size_t frames() const { return frames_; }

    /// Of the logarithm of the frame time, each frame with the weight of its usual time.
    std::optional<Change> change() const {
        const Values values = logarithms();
        return in_rounds_ ? centre_of(round_differences(trials_of(values))) : change_of(trials_of(values));
    }

    double mann_whitney() const {
        const Values values = logarithms();
        Values before;
        Values after;
        for (std::size_t f = 0; f < values.size(); ++f) {
            (sides_[f] == Side::Old ? before : after).push_back(values[f]);
        }
        return mann_whitney_p(before, after);
    }

    /// Median over a side's flights of their mean time in these frames, in milliseconds.
    double mean_ms(Side side, FrameRange range) const {
        Values means;
        for (std::size_t f = 0; f < flights_.size(); ++f) {
            if (sides_[f] == side) { means.push_back(mean_of_values(kept_values(f, flights_[f]->frame_ms, range))); }
        }
        return median_of(means);
    }

    /// The change in milliseconds a frame of these frames.
    std::optional<Change> change_ms(FrameRange range) const {
        const auto times_of = [](const FrameTimes& each) { return std::span(each.frame_ms); };
        return change_in(range, usual_ms_, times_of, mean_of_values);
    }

    /// As change_ms(), of one stage; nothing where a flight knows no stages.
    std::optional<Change> stage_change_ms(std::size_t stage, FrameRange range) const {
        const auto times_of = [stage](const FrameTimes& each) { return std::span(each.stage_ms[stage]); };
        if (std::ranges::any_of(flights_, [&](const FrameTimes* each) { return times_of(*each).size() < frames_; })) {
            return std::nullopt;
        }
        return change_in(range, medians_by_frame(times_of), times_of, mean_of_middle_half);
    }

    /// The mean change of each frame, in milliseconds.
    Values profile_ms() const {
        Values profile;
        for (std::size_t k = 0; k < frames_; ++k) {
            std::array<Values, 2> times; // by side
            for (std::size_t f = 0; f < flights_.size(); ++f) {
                if (kept_[f][k]) { times[static_cast<std::size_t>(sides_[f])].push_back(flights_[f]->frame_ms[k]); }
            }
            const bool has_both = !times[0].empty() && !times[1].empty();
            profile.push_back(has_both ? mean_of_values(times[1]) - mean_of_values(times[0]) : 0.0);
        }
        return profile;
    }

private:
    /// For each frame the median over all flights. `times_of(flight)`: frame times or those of a stage.
    template <class TimesOf>
    Values medians_by_frame(TimesOf times_of) const {
        Values medians;
        Values column(flights_.size());
        for (std::size_t k = 0; k < frames_; ++k) {
            std::ranges::transform(
                flights_, column.begin(), [&](const FrameTimes* each) { return times_of(*each)[k]; });
            medians.push_back(median_of_sides(column, sides_));
        }
        return medians;
    }

    /// A flight, or the two of a round: what is left out is left out in the whole unit.
    std::size_t unit_size() const { return in_rounds_ ? 2 : 1; }

    /// How far each frame of a unit is from where it should be, as a logarithm: from the other frame of the round, else
    /// from its usual time, and then from the middle of the unit's frames, so that a change of all of them is not far.
    Values distances(std::size_t unit) const {
        Values ratios;
        for (std::size_t k = 0; k < frames_; ++k) {
            const auto time_of = [&](std::size_t f) { return std::max(flights_[f]->frame_ms[k], 1e-6); };
            const double other = in_rounds_ ? time_of(2 * unit + 1) : std::max(usual_ms_[k], 1e-6);
            ratios.push_back(std::log(time_of(unit_size() * unit) / other));
        }
        const double middle = median_of(ratios);
        for (double& ratio : ratios) { ratio = std::abs(ratio - middle); }
        return ratios;
    }

    /// Leaves out frames in which a program was stopped, and those that are far from where they should be, measured by
    /// how far they are in the other units. The distance has no sign, so that the rule treats both sides alike.
    void leave_out_held_frames() {
        constexpr double normal = 1.4826; // standard deviations in a median absolute deviation of normal values
        constexpr double min_deviation = 0.005;
        constexpr double max_deviations = 2.5;
        const std::size_t units = flights_.size() / unit_size();
        std::vector<Values> distances_of_units;
        for (std::size_t u = 0; u < units; ++u) { distances_of_units.push_back(distances(u)); }
        Values usual(frames_);
        Values deviations;
        for (std::size_t k = 0; k < frames_; ++k) {
            Values column;
            for (const Values& of_unit : distances_of_units) { column.push_back(of_unit[k]); }
            usual[k] = in_rounds_ ? median_of(column) : median_of_sides(column, sides_);
            for (const double each : column) { deviations.push_back(std::abs(each - usual[k])); }
        }
        const double limit = max_deviations * std::max(min_deviation, normal * median_of(std::move(deviations)));
        for (const Values& of_unit : distances_of_units) {
            const std::size_t first = kept_.size();
            const auto keep_where = [&](const auto& is_kept) {
                std::vector<bool> kept(frames_);
                for (std::size_t k = 0; k < frames_; ++k) { kept[k] = is_kept(k); }
                return kept;
            };
            const auto are_few = [&](const std::vector<bool>& kept) {
                return 2 * static_cast<std::size_t>(std::ranges::count(kept, true)) < frames_;
            };
            const auto is_running = [&](std::size_t k) {
                return !flights_[first]->is_paused(k) && !flights_[first + unit_size() - 1]->is_paused(k);
            };
            auto kept = keep_where([&](std::size_t k) { return is_running(k) && of_unit[k] <= usual[k] + limit; });
            if (are_few(kept)) { kept = keep_where(is_running); } // the whole unit was slow
            if (are_few(kept)) { kept.assign(frames_, true); }    // turns were shorter than frames
            for (std::size_t i = 0; i < unit_size(); ++i) { kept_.push_back(kept); }
        }
    }

    Values kept_values(std::size_t flight, std::span<const double> times, FrameRange range) const {
        Values values;
        for (std::size_t k = range.begin; k < range.end; ++k) {
            if (kept_[flight][k]) { values.push_back(times[k]); }
        }
        return values;
    }

    Values logarithms() const {
        Values values;
        for (std::size_t f = 0; f < flights_.size(); ++f) {
            double sum = 0.0;
            double weight = 0.0;
            for (std::size_t k = 0; k < frames_; ++k) {
                if (!kept_[f][k] || usual_ms_[k] <= 0.0) { continue; }
                sum += usual_ms_[k] * std::log(std::max(flights_[f]->frame_ms[k], 1e-6) / usual_ms_[k]);
                weight += usual_ms_[k];
            }
            values.push_back(weight > 0.0 ? sum / weight : 0.0);
        }
        return values;
    }

    std::vector<Trial> trials_of(const Values& values) const {
        std::vector<Trial> trials;
        for (std::size_t f = 0; f < values.size(); ++f) { trials.push_back({sides_[f], values[f]}); }
        return trials;
    }

    template <class TimesOf>
    std::optional<Change> change_in(
        FrameRange range, const Values& usual_ms, TimesOf times_of, double (*mean)(Values)) const {
        Values values;
        for (std::size_t f = 0; f < flights_.size(); ++f) {
            Values differences_ms;
            for (std::size_t k = range.begin; k < range.end; ++k) {
                if (kept_[f][k]) { differences_ms.push_back(times_of(*flights_[f])[k] - usual_ms[k]); }
            }
            values.push_back(mean(std::move(differences_ms)));
        }
        return in_rounds_ ? mean_of(round_differences(trials_of(values))) : change_of(trials_of(values));
    }

    std::vector<const FrameTimes*> flights_;
    std::vector<Side> sides_;
    bool in_rounds_;
    std::size_t frames_ = 0;
    Values usual_ms_;                     ///< median over all flights
    std::vector<std::vector<bool>> kept_; ///< by flight and frame
};

/// Some frames in a row, and how sure their change is.
struct Block {
    FrameRange range;
    Change change;
    bool is_sure = false;
};

std::vector<Block> blocks_of(const SameFrames& flights) {
    constexpr std::size_t max_blocks = 25;
    constexpr std::size_t min_frames = 4;
    const std::size_t count = std::clamp<std::size_t>(flights.frames() / min_frames, 1, max_blocks);
    std::vector<Block> blocks;
    Values p_values;
    for (std::size_t b = 0; b < count; ++b) {
        const FrameRange range{b * flights.frames() / count, (b + 1) * flights.frames() / count};
        blocks.push_back({range, flights.change_ms(range).value_or(Change())});
        p_values.push_back(blocks.back().change.p);
    }
    const Values adjusted = holm_adjusted(p_values);
    for (std::size_t b = 0; b < count; ++b) { blocks[b].is_sure = adjusted[b] <= significance_level; }
    return blocks;
}

/// The run of surely changed blocks, all up or all down and with at most one other block between two, that changes the
/// flight's time most.
FrameRange most_changed(std::span<const Block> blocks) {
    FrameRange most;
    double most_ms = 0.0;
    for (std::size_t begin = 0; begin < blocks.size(); ++begin) {
        if (!blocks[begin].is_sure) { continue; }
        const bool is_up = blocks[begin].change.estimate > 0.0;
        double sum_ms = 0.0;
        std::size_t others = 0;
        for (std::size_t end = begin; end < blocks.size() && others < 2; ++end) {
            const Block& block = blocks[end];
            sum_ms += block.change.estimate * static_cast<double>(block.range.size());
            const bool belongs = block.is_sure && (block.change.estimate > 0.0) == is_up;
            others = belongs ? 0 : others + 1;
            if (belongs && std::abs(sum_ms) > most_ms) {
                most_ms = std::abs(sum_ms);
                most = {blocks[begin].range.begin, block.range.end};
            }
        }
    }
    return most;
}

/// The frames near a range, as many as a block beyond its ends, whose change is above half of the range's: those that
/// together exceed it most.
FrameRange sharpened(const SameFrames& flights, FrameRange range, std::size_t block_frames, double change_ms) {
    const Values profile_ms = flights.profile_ms();
    const double sign = change_ms < 0.0 ? -1.0 : 1.0;
    const std::size_t end = std::min(range.end + block_frames, profile_ms.size());
    FrameRange most = range;
    FrameRange now{range.begin - std::min(range.begin, block_frames), 0};
    double most_ms = 0.0;
    double sum_ms = 0.0;
    for (std::size_t k = now.begin; k < end; ++k) {
        sum_ms += sign * profile_ms[k] - 0.5 * std::abs(change_ms);
        if (sum_ms <= 0.0) {
            sum_ms = 0.0;
            now.begin = k + 1;
        } else if (sum_ms > most_ms) {
            most_ms = sum_ms;
            most = {now.begin, k + 1};
        }
    }
    return most;
}

std::optional<ChangedFrames> changed_frames(const SameFrames& flights, int first_frame, FrameRange& range) {
    constexpr double max_share_of_flight = 0.7;
    constexpr double min_share_of_change = 0.7; // in the range, or the change is rather all over the flight
    const std::vector<Block> blocks = blocks_of(flights);
    FrameRange found = most_changed(blocks);
    if (found.size() == 0 ||
        static_cast<double>(found.size()) > max_share_of_flight * static_cast<double>(flights.frames())) {
        return std::nullopt;
    }
    const double rough_ms = flights.change_ms(found).value_or(Change()).estimate;
    found = sharpened(flights, found, blocks.front().range.size(), rough_ms);
    const double change_ms = flights.change_ms(found).value_or(Change()).estimate;
    const double old_ms = flights.mean_ms(Side::Old, found);
    const double whole_ms = flights.change_ms(range).value_or(Change()).estimate * static_cast<double>(range.size());
    const double inside_ms = change_ms * static_cast<double>(found.size());
    if (old_ms <= 0.0 || std::abs(inside_ms) < min_share_of_change * std::abs(whole_ms)) { return std::nullopt; }
    range = found;
    return ChangedFrames{first_frame + static_cast<int>(found.begin), first_frame + static_cast<int>(found.end) - 1,
        change_ms, change_ms / old_ms};
}

std::optional<ChangedStage> changed_stage(const SameFrames& flights, FrameRange range) {
    std::vector<ChangedStage> stages;
    Values p_values;
    for (std::size_t stage = 0; stage < stage_names.size(); ++stage) {
        const auto change = flights.stage_change_ms(stage, range);
        if (!change) { return std::nullopt; }
        stages.push_back({stage, change->estimate});
        p_values.push_back(change->p);
    }
    const Values adjusted = holm_adjusted(p_values);
    std::optional<ChangedStage> most;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        if (adjusted[i] <= significance_level && (!most || std::abs(stages[i].change_ms) > std::abs(most->change_ms))) {
            most = stages[i];
        }
    }
    return most;
}

/// The median frame time, without frames in which the program was stopped where others are half or more.
double median_ms_of(const FrameTimes& flight) {
    Values running;
    for (std::size_t k = 0; k < flight.frame_ms.size(); ++k) {
        if (!flight.is_paused(k)) { running.push_back(flight.frame_ms[k]); }
    }
    return median_of(2 * running.size() < flight.frame_ms.size() ? flight.frame_ms : std::move(running));
}

/// By the flights' median frame times alone.
void compare_figures(
    std::span<const FrameTimes* const> flights, std::span<const Side> sides, bool in_rounds, FrameChange& result) {
    result.pairing = Pairing::Figures;
    std::vector<Trial> trials;
    std::array<Values, 2> medians_ms; // by side
    for (std::size_t f = 0; f < flights.size(); ++f) {
        const double median_ms = std::max(median_ms_of(*flights[f]), 1e-6);
        result.frames = f == 0 ? flights[f]->frame_ms.size() : std::min(result.frames, flights[f]->frame_ms.size());
        trials.push_back({sides[f], std::log(median_ms)});
        medians_ms[static_cast<std::size_t>(sides[f])].push_back(median_ms);
    }
    result.old_ms = median_of(medians_ms[0]);
    result.new_ms = median_of(medians_ms[1]);
    result.change = in_rounds ? centre_of(round_differences(trials)) : change_of(trials);
    result.mann_whitney_p = mann_whitney_p(medians_ms[0], medians_ms[1]);
}

} // namespace

double FrameChange::share() const { return change ? std::expm1(change->estimate) : new_ms / old_ms - 1.0; }

double FrameChange::low_share() const { return change ? std::expm1(change->low) : -1.0; }

double FrameChange::high_share() const { return change ? std::expm1(change->high) : HUGE_VAL; }

FrameChange frame_change(std::span<const FrameTimes> before, std::span<const FrameTimes> after,
    std::span<const Side> sides_in_time, bool same_frames) {
    assert(!before.empty() && !after.empty());
    std::vector<const FrameTimes*> flights;
    std::vector<Side> sides(sides_in_time.begin(), sides_in_time.end());
    for (std::size_t i = 0; sides_in_time.empty() && i < std::min(before.size(), after.size()); ++i) {
        sides.insert(sides.end(), {Side::Old, Side::New});
    }
    std::array<std::size_t, 2> next{};
    std::vector<Trial> order;
    for (const Side side : sides) {
        const std::size_t at = next[static_cast<std::size_t>(side)]++;
        flights.push_back(side == Side::Old ? &before[at] : &after[at]);
        order.push_back({side, 0.0});
    }
    const bool in_rounds = sides_in_time.empty() || is_in_rounds(order);
    FrameChange result;
    result.old_runs = next[0];
    result.new_runs = next[1];
    const bool is_aligned = std::ranges::all_of(
        flights, [&](const FrameTimes* each) { return each->first_frame == flights.front()->first_frame; });
    if (!same_frames || !is_aligned) {
        compare_figures(flights, sides, in_rounds, result);
        return result;
    }
    const int first_frame = flights.front()->first_frame;
    const SameFrames compared(std::move(flights), std::move(sides), in_rounds);
    FrameRange range{0, compared.frames()};
    result.pairing = in_rounds ? Pairing::Rounds : Pairing::Frames;
    result.frames = compared.frames();
    result.old_ms = compared.mean_ms(Side::Old, range);
    result.new_ms = compared.mean_ms(Side::New, range);
    result.change = compared.change();
    result.mann_whitney_p = compared.mann_whitney();
    if (result.change) {
        result.frames_changed = changed_frames(compared, first_frame, range);
        result.stage_changed = changed_stage(compared, range);
    }
    return result;
}

} // namespace octant::ui::report
