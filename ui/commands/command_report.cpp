#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/commands/commands.h"
#include "ui/commands/compare_inputs.h"
#include "ui/report/comparison.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/packed_recording.h"
#include "ui/report/statistics.h"
#include "ui/settings/setting_rows.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace {

struct ReportOptions : base::OutputOptions {
    std::vector<std::filesystem::path> folders;
    std::string out;
    std::string baseline;
    std::string gate;
};

base::JsonValue results_of_run(const report::LoadedRecording& recording) {
    const auto known = [](const std::string& text) { return text.empty() ? base::JsonValue() : base::JsonValue(text); };
    return {{"folder", recording.display_name}, {"capture_format", known(recording.capture_format)},
        {"title", recording.run.title}, {"host", recording.run.machine_info.host},
        {"frames", recording.flight.frames()}, {"ended_early", recording.ended_early},
        {"stopped", known(recording.run.stopped)}, {"disagreement", known(recording.disagreement)},
        {"noise", recording.run.noise}, {"state_hash", known(recording.run.state_hash)},
        {"picture_hash", known(recording.run.picture_hash)},
        {"summary", report::json_of(report::all_statistics(), recording.statistics)}};
}

void make_report(const ReportOptions& options) {
    const std::optional<report::Gate> gate =
        options.gate.empty() ? std::nullopt : std::optional(report::read_gate(options.gate));
    if (gate && options.folders.size() < 2) { throw Error("--gate: expected two recordings or more, got one"); }
    if (!options.baseline.empty() && options.folders.size() < 2) {
        throw Error("--baseline: expected two recordings or more, got one");
    }
    const std::vector<report::LoadedRecording> recordings = report::load_recordings(options.folders);
    for (const report::LoadedRecording& recording : recordings) {
        for (const std::string& note : notes_on(recording)) { base::print_note(options.quiet, "note: " + note); }
    }
    const std::filesystem::path first = options.folders.front();
    if (options.out.empty() && std::filesystem::is_regular_file(first)) {
        throw Error("--out: expected a file for the page, got none");
    }
    const std::filesystem::path file = options.out.empty() ? first / "report.html" : std::filesystem::path(options.out);
    const std::vector<report::ComparedFlight> flights =
        report::compared_flights(recordings, &settings::comparison_role, options.baseline);
    const std::vector<report::FlightChange> changes =
        report::flight_changes(recordings, flights, &settings::comparison_role);
    write_file(file, report::html_report(recordings, {.folder = std::filesystem::absolute(file).parent_path(),
                                                         .flights = flights,
                                                         .changes = changes,
                                                         .roles = &settings::comparison_role}));
    base::print_note(options.quiet, fmt::format("report: {}", file.string()));
    const report::GateResult gate_result =
        gate ? report::gate_result(recordings, flights, *gate) : report::GateResult();
    if (options.json) {
        base::JsonValue list = base::JsonValue::list({});
        std::ranges::for_each(recordings, [&](const auto& each) { list.push_back(results_of_run(each)); });
        base::print_value({{"report", file.string()}, {"recordings", list},
                              {"changes", report::json_rows(report::change_columns(), changes)},
                              {"gate_faults", gate_result.failures}, {"gate_undecided", gate_result.undecided}},
            true);
    } else {
        for (const report::LoadedRecording& recording : recordings) {
            if (!recording.disagreement.empty()) {
                const std::string line = fmt::format("{}: summary and rows disagree, as if rows were cut off: {}\n",
                    printable(recording.display_name), recording.disagreement);
                std::fputs(line.c_str(), stdout);
            }
        }
        for (const std::string& line : gate_result.failures) { std::fputs((line + "\n").c_str(), stdout); }
        for (const std::string& line : gate_result.undecided) {
            std::fputs(fmt::format("cannot tell: {}\n", line).c_str(), stdout);
        }
    }
    const bool cut =
        std::ranges::any_of(recordings, [](const auto& recording) { return !recording.disagreement.empty(); });
    if (!gate_result.failures.empty() || cut) { throw CheckFailed(); }
    if (!gate_result.undecided.empty()) { throw CheckFailed{exit_cannot_tell}; }
}

} // namespace

Command report_command() {
    auto options = std::make_shared<ReportOptions>();
    return {.name = "report",
        .summary = "Writes report.html from one recording, or compares several side by side",
        .options = with_output_options(*options,
            {required(list_option("folders", "DIR...",
                 "folders of recordings, packed recordings, or frame times that PresentMon, CapFrameX (CSV or JSON) or "
                 "MangoHud recorded; recordings of killed flights work too",
                 Arity::OneOrMore, options->folders)),
                with_shown_default("report.html in the first folder",
                    text_option("--out", "FILE.html", "page to write", options->out)),
                with_shown_default("the first recording",
                    text_option("--baseline", "NAME",
                        "recording, or variant as the page names it, with which the others are compared",
                        options->baseline)),
                text_option("--gate", "FIGURE=N%,...",
                    "exit code 1 when a figure (p50, p95, p99, mean, ...) of a variant is more than N % above the "
                    "baseline's, the 95 % interval over three runs or more of each counted",
                    options->gate)}),
        .footer = "Recordings of one flight are variants where settings of drawing or the program differ, else repeats "
                  "of a variant. The page of several begins with what changed from the baseline.\n"
                  "Of a file with frame times of several applications or swap chains only those of the swap chain "
                  "with the most frames are taken.\n"
                  "Exit code 0: done. 1: a gate fails, or a recording's rows are not those of its summary (the page "
                  "says so). 2: invalid input. 3: a gate cannot tell: nothing to compare, or fewer than three runs.\n"
                  "Examples:\n"
                  "  octant report my-flight\n"
                  "  octant report octant-run depth-buffer-run --out both.html\n"
                  "  octant report b1 b2 b3 a1 a2 a3 --gate p50=5%,p99=10% --out change.html\n"
                  "  octant report exact-1 paper-1 exact-2 paper-2 --baseline exact-1 --json --out both.html\n"
                  "  octant report presentmon.csv mangohud.csv --out captures.html",
        .run = [options] { make_report(*options); }};
}

namespace {

struct PackOptions : base::OutputOptions {
    std::filesystem::path folder;
    std::optional<std::filesystem::path> out;
    bool with_terrain = false;
};

void pack(const PackOptions& options) {
    std::filesystem::path folder = options.folder;
    if (!folder.has_filename()) { // "my-flight/"
        folder = folder.parent_path();
    }
    const std::filesystem::path file = options.out.value_or(folder.string() + ".zip");
    const report::PackResult packing = report::pack_recording(folder, file, options.with_terrain);
    for (const std::string& note : packing.notes) { base::print_note(options.quiet, "note: " + note); }
    if (options.json) {
        base::print_value({{"file", file.string()}, {"files", packing.files}, {"notes", packing.notes}}, true);
    }
    base::print_note(options.quiet, fmt::format("packed: {}, {} files", file.string(), packing.files));
}

} // namespace

Command pack_command() {
    auto options = std::make_shared<PackOptions>();
    return {.name = "pack",
        .summary = "Packs a recording into one file that can be reported and replayed on any machine",
        .options = with_output_options(
            *options, {required(text_option("folder", "DIR", "folder of the recording", options->folder)),
                          with_shown_default("DIR.zip", text_option("--out", "FILE.zip", "the file", options->out)),
                          flag("--with-terrain", "include the terrain file", options->with_terrain)}),
        .footer = "Examples:\n"
                  "  octant pack my-flight --out my-flight.zip\n"
                  "On any machine then: octant report my-flight.zip --out page.html; and octant fly\n"
                  "--replay or --settings my-flight.zip.",
        .run = [options] { pack(*options); }};
}

} // namespace octant::ui::commands
