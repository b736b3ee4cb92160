#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/commands/commands.h"
#include "ui/report/comparison.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/packed_recording.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

namespace {

struct ReportOptions {
    std::vector<std::string> folders;
    std::string out;
    std::string gate;
    bool quiet = false;
};

void make_report(const ReportOptions& options) {
    const std::optional<report::Gate> gate =
        options.gate.empty() ? std::nullopt : std::optional(report::read_gate(options.gate));
    if (gate && options.folders.size() < 2) {
        throw Error("--gate: expected two recordings or more, got one");
    }
    std::vector<report::LoadedRecording> recordings;
    for (const std::string& folder : options.folders) {
        recordings.push_back(report::load_recording(report::recording_folder(folder)));
        if (recordings.back().ended_early) {
            base::say(
                options.quiet,
                fmt::format(
                    "note: {} ended early, after {} frames",
                    folder,
                    recordings.back().records.size()));
        }
        if (!recordings.back().disagreement.empty()) {
            base::say(
                options.quiet,
                fmt::format(
                    "note: {}: summary and rows disagree: {}",
                    folder,
                    recordings.back().disagreement));
        }
    }
    const std::filesystem::path first = options.folders.front();
    if (options.out.empty() && std::filesystem::is_regular_file(first)) {
        throw Error("--out: expected a file for the report of a packed recording, got none");
    }
    const std::filesystem::path file =
        options.out.empty() ? first / "report.html" : std::filesystem::path(options.out);
    write_file(
        file, report::html_report(recordings, {}, std::filesystem::absolute(file).parent_path()));
    base::say(options.quiet, fmt::format("report: {}", file.string()));
    if (gate) {
        const std::vector<std::string> faults = report::gate_faults(recordings, *gate);
        for (const std::string& fault : faults) {
            std::fputs((fault + "\n").c_str(), stdout);
        }
        if (!faults.empty()) {
            throw CheckSaidNo();
        }
    }
}

} // namespace

Command report_command() {
    auto options = std::make_shared<ReportOptions>();
    return {
        .name = "report",
        .summary = "Makes report.html from recordings; several are compared side by side",
        .options =
            {required(list_option(
                 "folders",
                 "DIR...",
                 "folders of recordings, also of flights that were killed, or packed ones",
                 Takes::SomeWords,
                 options->folders)),
             showing(
                 "report.html in the first folder",
                 text_option("--out", "FILE.html", "the page to write", options->out)),
             text_option(
                 "--gate",
                 "FIGURE=N%,...",
                 "exit code 1 where a recording's figures are above the first one's by more",
                 options->gate),
             flag("--quiet", "no notes", options->quiet)},
        .footer = "Examples:\n"
                  "  octant report my-flight\n"
                  "  octant report octant-run depth-buffer-run --out both.html\n"
                  "  octant report before after --gate p50=500%,p99=900% --out change.html",
        .run = [options] { make_report(*options); }};
}

} // namespace octant::ui::commands
