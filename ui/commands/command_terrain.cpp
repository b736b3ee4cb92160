#include "models/heights/height_field_export.h"
#include "models/heights/height_source.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_inputs.h"
#include "models/procedural/procedural_terrain.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "ui/base/progress.h"
#include "ui/base/results_text.h"
#include "ui/commands/command_terrain_parts.h"
#include "ui/commands/commands.h"
#include "ui/commands/terrain_options.h"
#include "ui/commands/value_option.h"
#include "ui/report/png_file.h"
#include "ui/settings/terrain_name.h"
#include "ui/terrain/loaded_ground.h"
#include "ui/terrain/map_picture.h"
#include "ui/world/scene_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>

namespace octant::ui::commands {

namespace {

struct TerrainOptions {
    std::string terrain;
    models::heights::ImportOptions files;
    bool json = false;
    bool quiet = false;
    bool verify = false;
    std::string picture;
    std::string kind = "hills";
    models::procedural::ProceduralTerrainOptions made;
    int seed = 1;
    std::string out;
};

base::JsonValue results_of_run(const models::heights::HeightField& field) {
    base::JsonValue results;
    double sum_m = 0.0;
    double steepest_rad = 0.0;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            sum_m += static_cast<double>(field.height_m(column, row));
            steepest_rad = std::max(
                steepest_rad, std::acos(std::min(1.0, static_cast<double>(field.normal_at_sample(column, row).z))));
        }
    }
    results["name"] = field.name;
    results["columns"] = field.columns();
    results["rows"] = field.rows();
    results["spacing_m"] = field.spacing_m();
    results["extent_east_m"] = 2.0 * field.half_extent_m().x;
    results["extent_north_m"] = 2.0 * field.half_extent_m().y;
    results["lowest_m"] = field.lowest_m();
    results["highest_m"] = field.highest_m();
    results["mean_m"] = sum_m / field.columns() / field.rows();
    results["steepest_deg"] = deg_from_rad(steepest_rad);
    results["filled_voids"] = field.filled_voids;
    if (field.place) {
        results["latitude_deg"] = field.place->latitude_deg;
        results["longitude_deg"] = field.place->longitude_deg;
    }
    return results;
}

/// Adds what only the files themselves tell, which are read once more.
void add_source(const models::heights::HeightField& field, const TerrainOptions& options, base::JsonValue& results) {
    const models::heights::HeightSource source(models::heights::map_inputs({options.terrain}), options.files);
    results["voids"] = source.count_voids();
    results["cell_m"] = source.cell_m().x;
    results["cell_north_m"] = source.cell_m().y;
    if (!source.system_name().empty()) { results["system"] = source.system_name(); }
    const auto deviation = source.deviation_of([&field](double x_m, double y_m) { return field.height_at(x_m, y_m); });
    add_accuracy(field.system, field.half_extent_m(), deviation, results);
}

void show(const TerrainOptions& options) {
    if (settings::is_imported_ground(options.terrain)) {
        if (!options.picture.empty()) {
            const terrain::LoadedGround ground = terrain::load_ground(options.terrain, options.files);
            report::write_png(options.picture, terrain::map_picture(ground.samples(), {}).view());
        }
        show_ground_file(options.terrain, options.verify, options.json);
        return;
    }
    const models::heights::HeightField field = world::load_height_field(options.terrain, options.files);
    base::JsonValue results = results_of_run(field);
    if (!settings::is_built_in_ground(options.terrain)) { add_source(field, options, results); }
    results["notes"] = note_texts(field.notes);
    if (!options.picture.empty()) {
        const visuals::terrain::GroundSamples samples(field);
        report::write_png(options.picture, terrain::map_picture(samples, field.notes).view());
        results["picture"] = options.picture;
    }
    base::print_value(results, options.json);
}

void make(TerrainOptions options) {
    options.made.seed = static_cast<std::uint64_t>(options.seed);
    const auto field = models::procedural::procedural_terrain(options.kind, options.made);
    if (!field) { throw Error(fmt::format("--kind: expected hills or canyon, got '{}'", printable(options.kind))); }
    models::heights::write_height_field(options.out, *field);
    if (options.json) {
        base::print_value(
            {{"file", options.out}, {"columns", field->columns()}, {"rows", field->rows()},
                {"spacing_m", field->spacing_m()}, {"lowest_m", field->lowest_m()}, {"highest_m", field->highest_m()}},
            true);
    }
    base::print_note(
        options.quiet, fmt::format("{}: {} x {} samples, {} m apart, {:.0f} to {:.0f} m", options.out, field->columns(),
                           field->rows(), field->spacing_m(), field->lowest_m(), field->highest_m()));
}

Command info_command() {
    auto options = std::make_shared<TerrainOptions>();
    Command command{.name = "info",
        .summary = "Shows size, heights, slopes, voids and place of a terrain, errors of the map "
                   "projection, and differences between the loaded heights and the file's",
        .options = {required(text_option("terrain", "NAME|FILE",
                        "hills, canyon, an imported ground, or maps that GDAL reads", options->terrain)),
            text_option("--picture", "OUT.png",
                "draw it from above with a legend of heights; red rings mark the places of the "
                "notes, by their number",
                options->picture),
            flag("--json", "as JSON", options->json),
            flag("--verify", "check all of an imported ground", options->verify)},
        .footer = "Example:\n  octant terrain info map.tif --json",
        .run = [options] { show(*options); }};
    add_file_options(command.options, options->files);
    return command;
}

Command make_command() {
    auto options = std::make_shared<TerrainOptions>();
    return {.name = "make",
        .summary = "Makes a terrain from a seed and writes it as GeoTIFF",
        .options = {text_option("--kind", "KIND", "hills (gentle) or canyon (rugged)", options->kind),
            value_option({"size", "N", "samples a side", 2, 20000}, options->made.size),
            value_option({"spacing", "METRES", "between samples", 0.1, 1000}, options->made.spacing_m),
            value_option({"seed", "S", "another seed, another terrain", 0, 1e9}, options->seed),
            required(text_option("--out", "FILE.tif", "the file to write", options->out)),
            flag("--json", "what was made as JSON", options->json), flag("--quiet", "no notes", options->quiet)},
        .footer = "Example:\n  octant terrain make --kind canyon --size 2049 --seed 7 --out made.tif",
        .run = [options] { make(*options); }};
}

} // namespace

std::vector<std::string> note_texts(const std::vector<models::heights::MapNote>& notes) {
    std::vector<std::string> texts;
    for (const models::heights::MapNote& note : notes) { texts.push_back(note.text); }
    return texts;
}

void add_accuracy(const std::optional<models::heights::CoordinateSystem>& system, const glm::dvec2& half_extent_m,
    const std::optional<models::heights::HeightDeviation>& deviation, base::JsonValue& results) {
    if (!system) { results["system"] = "none named: cells count as metres"; }
    const auto distortion = system ? models::heights::distortion_at_corners(*system, half_extent_m) : std::nullopt;
    if (distortion) {
        results["corner_scale_off_percent"] = distortion->scale_percent;
        results["corner_north_off_deg"] = distortion->turn_deg;
    }
    if (deviation) {
        results["source_rms_m"] = deviation->rms_m;
        results["source_worst_m"] = deviation->worst_m;
        results["source_places"] = deviation->places;
    }
}

Command terrain_command() {
    return {.name = "terrain",
        .summary = "Height fields: show, make, import, mesh, measure, ask, check",
        .footer = "Examples:\n  octant terrain info map.tif\n  octant terrain make --kind canyon "
                  "--seed 7 --out made.tif",
        .commands = {info_command(), make_command(), terrain_import_command(), terrain_mesh_command(),
            terrain_error_command(), terrain_query_command(), terrain_check_command()}};
}

} // namespace octant::ui::commands
