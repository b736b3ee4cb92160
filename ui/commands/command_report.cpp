#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/commands/commands.h"
#include "ui/flight/track_files.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::commands {

namespace {

struct ReportOptions {
    std::vector<std::string> folders;
    std::string out;
    bool quiet = false;
};

void make_report(const ReportOptions& options) {
    std::vector<report::LoadedRecording> recordings;
    for (const std::string& folder : options.folders) {
        recordings.push_back(report::load_recording(folder));
        if (recordings.back().ended_early) {
            base::say(
                options.quiet,
                fmt::format(
                    "note: {} ended early, after {} frames",
                    folder,
                    recordings.back().records.size()));
            report::complete_timing_files(recordings.back());
            flight::cut_tracks(
                folder,
                recordings.back().records.empty() ? 0.0
                                                  : recordings.back().records.back().sim_time_s);
        }
    }
    const std::filesystem::path file =
        options.out.empty() ? std::filesystem::path(options.folders.front()) / "report.html"
                            : std::filesystem::path(options.out);
    write_file(file, report::html_report(recordings));
    base::say(options.quiet, fmt::format("report: {}", file.string()));
}

} // namespace

void add_report_command(CLI::App& program) {
    auto options = std::make_shared<ReportOptions>();
    CLI::App* command = program.add_subcommand(
        "report", "Makes report.html from recordings; several are compared side by side");
    command
        ->add_option(
            "folders", options->folders, "folders of recordings, also of flights that were killed")
        ->type_name("DIR...")
        ->required();
    command->add_option("--out", options->out, "the page to write")
        ->type_name("FILE.html")
        ->default_str("report.html in the first folder");
    command->add_flag("--quiet", options->quiet, "no notes");
    command->footer("Examples:\n"
                    "  octant report my-flight\n"
                    "  octant report octant-run depth-buffer-run --out both.html");
    command->callback([options] { make_report(*options); });
}

} // namespace octant::ui::commands
