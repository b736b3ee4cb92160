#include "ui/sweep/sweep_folder.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/stop_signals.h"
#include "ui/flight/flight_recorder.h"
#include "ui/report/child_program.h"
#include "ui/report/run_file.h"
#include "ui/report/statistics.h"
#include "ui/settings/settings_file.h"
#include "ui/world/input_files.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

namespace octant::ui::sweep {

namespace {

namespace fs = std::filesystem;

bool follows_clock(const settings::RunSettings& settings) { return settings.adapt.terrain || settings.adapt.shading; }

/// What decides what a run shows, as text.
std::string key_of(const SweepRun& run) {
    return settings::settings_json(run.settings).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Whether a file holds the settings of a run.
bool is_job(const fs::path& file) {
    try {
        settings::read_settings(file);
        return true;
    } catch (const Error&) { return false; }
}

/// Whether a folder is empty, or that of a sweep: its jobs.txt names settings of runs that lie in it. What was killed
/// before it had one has nothing but jobs/ and other empty folders.
bool belongs_to_sweep(const fs::path& folder) {
    std::error_code code;
    const fs::path list = folder / "jobs.txt";
    if (!fs::is_regular_file(list, code)) {
        return std::ranges::all_of(fs::directory_iterator(folder, code), [&](const auto& entry) {
            const std::string name = entry.path().filename().string();
            const bool has_jobs = name == "jobs" && entry.is_directory() &&
                                  std::ranges::all_of(fs::directory_iterator(entry, code), is_job);
            return has_jobs ||
                   ((name == "runs" || name == "logs") && entry.is_directory() && fs::is_empty(entry.path(), code));
        });
    }
    const std::string text = read_file(list);
    const auto names = split_lines(text);
    const auto job = [&](std::string_view name) { return folder / "jobs" / (std::string(name) + ".json"); };
    return !names.empty() && is_job(job(names.front())) &&
           std::ranges::all_of(names, [&](std::string_view name) { return fs::is_regular_file(job(name), code); });
}

/// A hash as a recording's run.json has it; empty = none.
template <auto Member>
constexpr auto recorded_hash(std::string_view key, std::string_view name) {
    auto column = report::column<Member>(key, name);
    column.kind = report::ColumnKind::Hash;
    column.is_optional = true;
    return column;
}

} // namespace

void SweepFolder::prepare(const Sweep& sweep) const {
    std::error_code code;
    if (fs::exists(folder_, code) && !belongs_to_sweep(folder_)) {
        throw_error_in(folder_, "expected an empty folder or that of a sweep, got another");
    }
    for (const char* part : {"jobs", "runs", "logs"}) { make_folder(folder_ / part); }
    std::string names;
    for (const SweepRun& run : sweep.runs) {
        names += run.name + "\n";
        write_file(job(run.name), settings::settings_json(world::with_absolute_paths(run.settings)).dump(2) + "\n");
    }
    write_file(folder_ / "jobs.txt", names);
}

void SweepFolder::remove_logs(const Sweep& sweep, std::span<const std::size_t> runs) const {
    std::error_code ignored;
    for (const std::size_t run : runs) { fs::remove(log(sweep.runs[run].name), ignored); }
}

bool SweepFolder::any_begun(const Sweep& sweep, std::span<const std::size_t> runs) const {
    return std::ranges::any_of(runs, [&](std::size_t run) { return path_exists(log(sweep.runs[run].name)); });
}

std::string text_of(RunState state) {
    constexpr std::array texts{"flown", "failed", "stopped", "not begun"};
    return texts.at(static_cast<std::size_t>(state));
}

namespace {

/// Sets state and fault of a run that is not done. `is_recorded`: it has a run.json.
void set_fault(const SweepFolder& folder, bool is_recorded, RunResult& result) {
    if (!path_exists(folder.log(result.name))) { return; }
    const std::string last = report::last_line_of(read_file(folder.log(result.name)));
    std::string stopped =
        is_recorded ? report::read_run_file(folder.recording(result.name) / "run.json").stopped : std::string();
    if (stopped.empty() && last.empty()) { stopped = base::StopSignals::name(); } // killed while it loaded its world
    // An error comes after a run.json that an earlier call left.
    const bool is_stopped = !stopped.empty() && !last.starts_with("octant: ");
    result.state = is_stopped ? RunState::Stopped : RunState::Failed;
    result.fault = is_stopped ? "ended by " + stopped : last.empty() ? "was not flown to its end" : last;
}

} // namespace

RunResult result_of(const SweepFolder& folder, const SweepRun& run, bool with_video) {
    RunResult result;
    result.name = run.name;
    const fs::path recording = folder.recording(run.name);
    const bool is_recorded = report::is_run_file(recording / "run.json");
    bool done = false;
    try {
        done = flight::is_already_recorded(
            {recording, with_video ? std::optional(folder.video(run.name)) : std::nullopt, std::nullopt, {}},
            world::with_absolute_paths(run.settings));
    } catch (const Error&) {} // a file of the run is missing: its log says so
    if (!done) {
        set_fault(folder, is_recorded, result);
        return result;
    }
    result.state = RunState::Flown;
    const report::RunFile file = report::read_run_file(recording / "run.json");
    result.host = file.machine_info.host;
    result.state_hash = file.state_hash;
    result.picture_hash = file.picture_hash;
    for (const std::string& reason : file.noise) { result.noise += (result.noise.empty() ? "" : " ") + reason; }
    return result;
}

std::vector<std::string> hash_mismatches(const Sweep& sweep, std::span<const RunResult> results) {
    std::vector<std::string> lines;
    std::map<std::string, const RunResult*> firsts;
    for (std::size_t i = 0; i < sweep.runs.size(); ++i) {
        const RunResult& now = results[i];
        if (!now.done() || follows_clock(sweep.runs[i].settings)) { continue; }
        const auto [first, is_first] = firsts.emplace(key_of(sweep.runs[i]), &now);
        const RunResult& before = *first->second;
        const bool states = before.state_hash != now.state_hash;
        if (!is_first && (states || before.picture_hash != now.picture_hash)) {
            lines.push_back(fmt::format("{} of {} on {} and {} on {} differ: expected {}, got {}",
                states ? "states" : "pictures", before.name, before.host, now.name, now.host,
                states ? before.state_hash : before.picture_hash, states ? now.state_hash : now.picture_hash));
        }
    }
    return lines;
}

std::span<const report::Column<RunResult>> result_columns() {
    using R = RunResult;
    static constexpr std::array columns{
        report::column<&R::name>("name", "flight"),
        report::column<[](const R& run) { return text_of(run.state); }>(
            "state", "state", 0, "flown, failed, stopped (by a signal) or not begun"),
        report::column<&R::done>("done", "done"),
        report::column<&R::host>("host", "machine"),
        recorded_hash<&R::state_hash>("state_hash", "states"),
        recorded_hash<&R::picture_hash>("picture_hash", "pictures"),
        report::column<&R::noise>("noise", "noise", 0, "why its timings are not to be trusted; empty = quiet"),
        report::column<&R::fault>("fault", "why", 0, "why a flight that has begun is not done; else empty"),
    };
    return columns;
}

std::string sweep_csv(const SweepFolder& folder, const Sweep& sweep, std::span<const RunResult> results) {
    report::ResultTable table;
    const auto columns = result_columns();
    for (std::size_t i = 0; i < sweep.runs.size(); ++i) {
        const SweepRun& run = sweep.runs[i];
        const RunResult& result = results[i];
        std::vector<report::Cell> row = {{"run", run.name}};
        for (const auto& [name, value] : run.varied) { row.emplace_back(name, value); }
        row.emplace_back("repeat", run.repeat);
        const auto add = [&](const report::Column<RunResult>& column) {
            row.emplace_back(std::string(column.key), report::text_of(column, result));
        };
        std::ranges::for_each(columns.subspan(1, columns.size() - 2), add);
        const report::NamedValues summary = result.done()
                                                ? report::read_run_file(folder.recording(run.name) / "run.json").summary
                                                : report::NamedValues();
        for (const report::Statistic& statistic : report::all_statistics()) {
            row.emplace_back(std::string(statistic.key), report::value_of(summary, statistic.key));
        }
        add(columns.back());
        table.add(std::move(row));
    }
    return report::csv_of(table);
}

} // namespace octant::ui::sweep
