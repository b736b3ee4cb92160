#include "ui/report/comparison.h"

#include "sim/base/error.h"
#include "sim/base/nearest_rank.h"
#include "sim/base/random_generator.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>

namespace octant::ui::report {

namespace {

/// Settings that make another flight or another picture of it, not another way to draw it.
constexpr std::array<std::string_view, 17> flight_settings{"path", "aircraft", "axes", "terrain", "terrain-spacing",
    "place", "heading", "height-mode", "view", "size", "rate", "frame-per-sample", "start", "frames", "seconds", "fov",
    "warm-up"};

double bootstrap_median(std::span<const double> values, RandomGenerator& dice) {
    std::vector<double> drawn;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto at = static_cast<std::size_t>(dice.next() * static_cast<double>(values.size()));
        drawn.push_back(values[at]);
    }
    return median_of(std::move(drawn));
}

const Statistic* statistic_of(std::string_view name) {
    const auto found = std::ranges::find_if(all_statistics(), [&](const Statistic& statistic) {
        return statistic.key == name || statistic.key == fmt::format("{}_ms", name);
    });
    return found == all_statistics().end() || !found->less_is_better || found->decimals == 0 ? nullptr : &*found;
}

} // namespace

double median_of(std::vector<double> values) {
    assert(!values.empty());
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 != 0 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<std::string> settings_that_differ(const LoadedRecording& first, const LoadedRecording& second) {
    std::vector<std::string> names;
    for (const std::string_view name : flight_settings) {
        if (value_of(first.run.settings, name) != value_of(second.run.settings, name)) { names.emplace_back(name); }
    }
    if (first.run.machine_info.cpu != second.run.machine_info.cpu ||
        first.run.machine_info.cores != second.run.machine_info.cores) {
        names.emplace_back("processor");
    }
    return names;
}

std::vector<std::vector<std::size_t>> comparable_groups(Recordings recordings) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        const auto found = std::ranges::find_if(groups,
            [&](const auto& group) { return settings_that_differ(recordings[group.front()], recordings[i]).empty(); });
        if (found == groups.end()) {
            groups.push_back({i});
        } else {
            found->push_back(i);
        }
    }
    return groups;
}

std::vector<std::vector<std::size_t>> variants_of(Recordings recordings, std::span<const std::size_t> group) {
    std::vector<std::vector<std::size_t>> variants;
    for (const std::size_t i : group) {
        const auto found = std::ranges::find_if(variants, [&](const auto& variant) {
            return recordings[variant.front()].run.settings == recordings[i].run.settings;
        });
        if (found == variants.end()) {
            variants.push_back({i});
        } else {
            found->push_back(i);
        }
    }
    return variants;
}

RelativeChange relative_change(std::span<const double> before, std::span<const double> after) {
    constexpr std::size_t min_runs = 3;
    constexpr int resamples = 4000;
    RelativeChange change;
    change.share = median_of({after.begin(), after.end()}) / median_of({before.begin(), before.end()}) - 1.0;
    if (before.size() < min_runs || after.size() < min_runs) { return change; }
    RandomGenerator dice(1979);
    std::vector<double> shares;
    for (int i = 0; i < resamples; ++i) {
        const double old = bootstrap_median(before, dice);
        shares.push_back(bootstrap_median(after, dice) / old - 1.0);
    }
    change.has_interval = true;
    change.low = nearest_rank(shares, 25);
    change.high = nearest_rank(shares, 975);
    return change;
}

Gate read_gate(const std::string& text) {
    Gate gate;
    for (const std::string_view part : split_fields(text, ',')) {
        const std::size_t equals = part.find('=');
        const bool whole = equals != std::string_view::npos && part.ends_with('%');
        const Statistic* const statistic = whole ? statistic_of(part.substr(0, equals)) : nullptr;
        const auto percent =
            statistic != nullptr ? finite_number(part.substr(equals + 1, part.size() - equals - 2)) : std::nullopt;
        if (!percent || *percent < 0.0) {
            throw Error(fmt::format("--gate: expected figures and what they may grow by, as in p50=5%,p99=10%, got "
                                    "'{}'",
                printable(text)));
        }
        gate.emplace_back(std::string(statistic->key), *percent / 100.0);
    }
    return gate;
}

std::vector<std::string> gate_failures(Recordings recordings, const Gate& gate) {
    std::vector<std::string> faults;
    const LoadedRecording& first = recordings.front();
    for (const LoadedRecording& recording : recordings.subspan(1)) {
        const auto names = settings_that_differ(first, recording);
        if (!names.empty()) {
            throw_error_in(recording.display_name,
                fmt::format("expected a recording to be compared with {}, got one that differs in {}",
                    first.display_name, fmt::join(names, ", ")));
        }
        for (const auto& [key, allowed] : gate) {
            const Statistic& statistic = *statistic_of(key);
            const double before = statistic.value(first.statistics);
            const double after = statistic.value(recording.statistics);
            if (before <= 0.0 || after <= 0.0) {
                throw_error_in(recording.display_name, "expected frames to compare, got none");
            }
            if (after / before - 1.0 > allowed) {
                faults.push_back(fmt::format("{}: {} {:.3f} ms, {:+.1f} % of {:.3f} ms, above {:+.1f} %",
                    recording.name, key, after, 100.0 * (after / before - 1.0), before, 100.0 * allowed));
            }
        }
    }
    return faults;
}

} // namespace octant::ui::report
