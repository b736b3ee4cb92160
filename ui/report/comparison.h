#pragma once

#include "ui/report/frame_change.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/setting_role.h"
#include "ui/report/table.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::report {

/// What makes two recordings different flights, so that their times cannot be compared: names of settings of the scene
/// and of input files whose contents differ, "processor". Empty: they are of one flight.
std::vector<std::string> flight_differences(
    const LoadedRecording& first, const LoadedRecording& second, SettingRoles roles);

/// The repeats of one variant: one flight, drawn in one way by one build of the program. Indices of recordings, in the
/// order in which they were given.
struct Variant {
    std::string name; ///< "order-method exact, samples 4; 1.0 (3f2a91c)": in what it differs from the other variants
    std::vector<std::size_t> runs;
};

/// The recordings of one flight. The first variant is the baseline of the others.
struct ComparedFlight {
    std::string name; ///< title of its first recording; where flights share it, with that in which they differ
    std::vector<Variant> variants;
};

/// Recordings by flight and variant, both in the order of their first recording, but the variant that has the recording
/// or the name `baseline` comes first. Throws Error where no variant has that name.
std::vector<ComparedFlight> compared_flights(Recordings recordings, SettingRoles roles, std::string_view baseline = {});

/// The frame times of a recording up to the first gap in its rows. Throws Error as load_recording() does.
FrameTimes read_frame_times(const LoadedRecording& recording);

/// One comparison of two variants of a flight: a row of the comparison's table, CSV and JSON.
struct FlightChange {
    std::string flight;
    std::string old_variant;
    std::string new_variant;
    bool same_states = true;                     ///< by the hashes of both; true where neither has any
    bool same_pictures = true;                   ///< as same_states
    std::vector<std::string> flight_differences; ///< as of flight_differences(): asked for all the same
    FrameChange frames;
    double adjusted_p = 1.0; ///< by Holm, among all comparisons made with this one

    /// The change is certain at 5 %, all comparisons made with it counted.
    bool is_changed() const;
};

/// Compares each variant with its flight's baseline and adjusts the p values.
std::vector<FlightChange> flight_changes(
    Recordings recordings, std::span<const ComparedFlight> flights, SettingRoles roles);

/// Compares recordings of one flight, or of two that are set against each other all the same.
FlightChange flight_change(Recordings recordings, const Variant& before, const Variant& after, SettingRoles roles);

/// Sets adjusted_p of all.
void adjust_for_number(std::span<FlightChange> changes);

/// The columns of a comparison's table.
std::span<const Column<FlightChange>> change_columns();

/// What is said of changes beyond a limit.
enum class Verdict {
    NotSlower, ///< no slowdown beyond the limit, none above limit + resolution hidden
    Slower,    ///< the lower end of an interval is above the limit
    CannotTell ///< an interval is too wide, or there is none
};

/// The worst of all changes. `limit`, `resolution`: shares, such as 0.02.
Verdict verdict_of(std::span<const FlightChange> changes, double limit, double resolution);

/// The answer in one line: "3.1 % slower (2.4 to 3.9 %); frames 210-260, plan stage +0.8 ms", or of several "4 of 24
/// variants changed, geometric mean +0.6 %".
std::string answer_text(std::span<const FlightChange> changes, double limit, double resolution);

/// What a gate allows: "p50=5%,p99=10%" lets P50 grow by 5 %, P99 by 10 %.
using Gate = std::vector<std::pair<std::string, double>>; ///< key of a figure, share

/// Throws Error "--gate: expected ..., got ..." for other text.
Gate read_gate(const std::string& text);

/// What a gate says.
struct GateResult {
    std::vector<std::string> failures;  ///< figures whose whole interval is above what is allowed, a line each
    std::vector<std::string> undecided; ///< what cannot be compared and why, as too few runs, a line each
};

/// Compares the figures of all variants with those of their baselines.
GateResult gate_result(Recordings recordings, std::span<const ComparedFlight> flights, const Gate& gate);

} // namespace octant::ui::report
