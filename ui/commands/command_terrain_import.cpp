#include "models/heights/map_inputs.h"
#include "sim/base/error.h"
#include "ui/base/progress.h"
#include "ui/base/results_text.h"
#include "ui/base/stopwatch.h"
#include "ui/commands/command_terrain_parts.h"
#include "ui/commands/terrain_options.h"
#include "ui/commands/value_option.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/ground_import.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

namespace {

using visuals::groundfile::ImportStage;
using visuals::terrain::GroundMetadata;
using visuals::terrain::GroundShape;

struct ImportCommand {
    std::vector<std::string> inputs;
    std::string out;
    models::heights::ImportOptions files;
    int threads = 2;
    bool json = false;
    bool quiet = false;
};

constexpr std::size_t stage_count = 5;
constexpr std::array<const char*, stage_count> stage_names = {
    "scanning", "reading", "filling voids", "building", "writing"};
constexpr std::array<const char*, stage_count> stage_keys = {"scan_s", "read_s", "fill_s", "build_s", "fsync_s"};

/// Times the stages, draws the progress line and says when work shall be made safe.
class StageProgress {
public:
    explicit StageProgress(bool quiet) : quiet_(quiet) {}

    bool operator()(ImportStage stage, double done) {
        const auto index = static_cast<std::size_t>(stage);
        if (!stage_ || *stage_ != stage) {
            stage_ = stage;
            progress_.emplace(stage_names[index], 100, quiet_, "%");
            lap_.lap_ms();
        }
        seconds_[index] += lap_.lap_ms() / 1000.0;
        progress_->show(static_cast<int>(100.0 * done));
        constexpr double between_saves_s = 8.0;
        if (since_save_.s() < between_saves_s || stage == ImportStage::Writing) { return false; }
        since_save_.lap_ms();
        return true;
    }

    void finish() { progress_.reset(); }

    double seconds(std::size_t stage) const { return seconds_[stage]; }

private:
    bool quiet_;
    std::optional<ImportStage> stage_;
    std::optional<base::Progress> progress_;
    base::Stopwatch lap_;
    base::Stopwatch since_save_;
    std::array<double, stage_count> seconds_{};
};

base::JsonValue results_of_run(const GroundShape& shape, const GroundMetadata& metadata, std::uintmax_t bytes) {
    const glm::dvec2 half_m(0.5 * (shape.columns - 1) * shape.spacing_m, 0.5 * (shape.rows - 1) * shape.spacing_m);
    base::JsonValue results;
    results["name"] = metadata.name;
    results["columns"] = shape.columns;
    results["rows"] = shape.rows;
    results["spacing_m"] = shape.spacing_m;
    results["extent_east_m"] = (shape.columns - 1) * shape.spacing_m;
    results["extent_north_m"] = (shape.rows - 1) * shape.spacing_m;
    results["lowest_m"] = metadata.lowest_m;
    results["highest_m"] = metadata.highest_m;
    results["mean_m"] = metadata.mean_m;
    results["height_unit_m"] = shape.height_unit_m;
    results["filled_voids"] = metadata.filled_voids;
    if (metadata.place) {
        results["latitude_deg"] = metadata.place->latitude_deg;
        results["longitude_deg"] = metadata.place->longitude_deg;
    }
    add_accuracy(metadata.system, half_m, metadata.deviation, results);
    const double samples = static_cast<double>(shape.columns) * shape.rows;
    results["samples"] = static_cast<std::int64_t>(samples);
    results["bytes"] = bytes;
    results["bytes_a_sample"] = static_cast<double>(bytes) / samples;
    return results;
}

/// How the import is told of in one line.
std::string line_of(const visuals::groundfile::ImportSummary& summary) {
    const auto& deviation = summary.metadata.deviation;
    const std::string off = deviation ? fmt::format(", {:.2g} m off its source (root mean square; at most {:.3g} m)",
                                            deviation->rms_m, deviation->worst_m)
                                      : "";
    return fmt::format("{} x {} samples, {:.6g} m apart, {:.0f} to {:.0f} m{}, {} voids filled, {:.1f} MB",
        summary.shape.columns, summary.shape.rows, summary.shape.spacing_m, summary.metadata.lowest_m,
        summary.metadata.highest_m, off, summary.metadata.filled_voids, static_cast<double>(summary.bytes) / 1e6);
}

void import(const ImportCommand& command) {
    visuals::groundfile::GroundImportOptions options;
    options.source_options = command.files;
    options.threads = command.threads;
    StageProgress watch(command.quiet);
    const base::Stopwatch whole;
    const auto summary = visuals::groundfile::import_ground(
        models::heights::map_inputs(command.inputs), command.out, options, std::ref(watch));
    const double whole_s = whole.s();
    watch.finish();
    if (!summary.note.empty()) { base::print_note(command.quiet, summary.note); }
    for (const models::heights::MapNote& note : summary.notes) { base::print_note(command.quiet, note.text); }
    if (!command.json) {
        base::print_note(command.quiet, fmt::format("{}: {}, {:.2f} s", command.out, line_of(summary), whole_s));
        return;
    }
    auto results = results_of_run(summary.shape, summary.metadata, summary.bytes);
    results["seconds"] = whole_s;
    for (std::size_t stage = 0; stage < stage_count; ++stage) { results[stage_keys[stage]] = watch.seconds(stage); }
    results["note"] = summary.note;
    results["notes"] = note_texts(summary.notes);
    base::print_value(results, true);
}

} // namespace

void show_ground_file(const std::string& file, bool verify, bool json) {
    const base::Stopwatch opening;
    const visuals::terrain::GroundTiles ground = visuals::groundfile::open_ground(file);
    const double open_ms = opening.ms();
    if (verify) { visuals::groundfile::verify_ground(file); }
    auto results = results_of_run(ground.shape(), ground.metadata(), std::filesystem::file_size(file));
    results["open_ms"] = open_ms;
    results["verified"] = verify;
    base::print_value(results, json);
}

Command terrain_import_command() {
    auto import_options = std::make_shared<ImportCommand>();
    ImportCommand& options = *import_options;
    Command command{.name = "import",
        .summary = "Makes one file that is mapped, not read, of one or several height files",
        .options = {required(list_option("files", "FILE",
                        "what GDAL reads, folders, patterns and archives of it; the first counts where "
                        "they "
                        "overlap",
                        Arity::OneOrMore, options.inputs)),
            required(text_option("--out", "FILE.ground", "the file to write", options.out)),
            value_option({"threads", "N", "that build", 1, 256}, options.threads),
            flag("--json", "figures as JSON on stdout", options.json), flag("--quiet", "no notes", options.quiet)},
        .footer = "A stopped import goes on from FILE.ground.part when it is called again.\n"
                  "Examples:\n  octant terrain import west.tif east.tif --out both.ground\n  octant "
                  "terrain import tiles/ --out region.ground",
        .run = [import_options] { import(*import_options); }};
    add_file_options(command.options, options.files);
    return command;
}

} // namespace octant::ui::commands
