#pragma once

#include "ui/report/loaded_recording.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::report {

/// Names of the settings, or of the machine's parts, in which two recordings differ so that their frame times cannot be
/// compared: the flight, its frames, the picture's size, the processor.
std::vector<std::string> settings_that_differ(const LoadedRecording& first, const LoadedRecording& second);

/// Recordings that may be compared, by their indices, in the order in which the first of each comes. What they differ
/// in is what a comparison is about.
std::vector<std::vector<std::size_t>> comparable_groups(Recordings recordings);

/// The recordings of a group, grouped further by equal settings: the repeats of each variant.
std::vector<std::vector<std::size_t>> variants_of(Recordings recordings, std::span<const std::size_t> group);

/// The middle value, or the mean of the two in the middle. At least one value.
double median_of(std::vector<double> values);

/// How a figure of some runs compares with that of others: ratio of the medians less 1.
struct RelativeChange {
    double share = 0.0;
    bool has_interval = false; ///< both sides have three runs or more
    double low = 0.0;          ///< 95 % interval by the bootstrap
    double high = 0.0;

    /// True when the interval does not contain zero.
    bool is_significant() const { return has_interval && (low > 0.0 || high < 0.0); }
};

/// Medians of both sides and their percentile bootstrap (B. Efron, "Bootstrap methods: another look at the jackknife",
/// 1979): 4000 resamples of the runs of each side, the same ones every time. Both sides have values above 0.
RelativeChange relative_change(std::span<const double> before, std::span<const double> after);

/// What a gate allows: "p50=5%,p99=10%" lets P50 grow by 5 %, P99 by 10 %.
using Gate = std::vector<std::pair<std::string, double>>; ///< key of a figure, share

/// Throws Error "--gate: expected ..., got ..." for other text.
Gate read_gate(const std::string& text);

/// One line for each figure that a later recording has worse than the first by more than the gate allows. Throws Error
/// where the recordings cannot be compared or have no frames.
std::vector<std::string> gate_failures(Recordings recordings, const Gate& gate);

} // namespace octant::ui::report
