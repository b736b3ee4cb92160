#include "models/heights/height_field_export.h"
#include "models/heights/height_field_import.h"
#include "models/made/made_terrain.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "ui/base/figures_text.h"
#include "ui/base/progress.h"
#include "ui/commands/command_terrain_import.h"
#include "ui/commands/command_terrain_measure.h"
#include "ui/commands/commands.h"
#include "ui/commands/settings_options.h"
#include "ui/settings/terrain_name.h"
#include "ui/world/terrain_file.h"
#include "visuals/terrain/ground_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace octant::ui::commands {

namespace {

struct TerrainOptions {
    std::string terrain;
    double spacing_m = 30.0;
    bool json = false;
    bool quiet = false;
    bool verify = false;
    std::string kind = "hills";
    models::made::MadeOptions made;
    int seed = 1;
    std::string out;
};

nlohmann::ordered_json figures_of(const models::heights::HeightField& field) {
    nlohmann::ordered_json figures;
    double sum_m = 0.0;
    double steepest_rad = 0.0;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            sum_m += static_cast<double>(field.height_m(column, row));
            steepest_rad = std::max(
                steepest_rad,
                std::acos(
                    std::min(1.0, static_cast<double>(field.normal_at_sample(column, row).z))));
        }
    }
    figures["name"] = field.name;
    figures["columns"] = field.columns();
    figures["rows"] = field.rows();
    figures["spacing_m"] = field.spacing_m();
    figures["extent_east_m"] = 2.0 * field.half_extent_m().x;
    figures["extent_north_m"] = 2.0 * field.half_extent_m().y;
    figures["lowest_m"] = field.lowest_m();
    figures["highest_m"] = field.highest_m();
    figures["mean_m"] = sum_m / field.columns() / field.rows();
    figures["steepest_deg"] = deg_from_rad(steepest_rad);
    figures["filled_voids"] = field.filled_voids;
    if (field.place) {
        figures["latitude_deg"] = field.place->latitude_deg;
        figures["longitude_deg"] = field.place->longitude_deg;
    }
    return figures;
}

void show(const TerrainOptions& options) {
    if (settings::is_imported_ground(options.terrain)) {
        show_ground_file(options.terrain, options.verify, options.json);
        return;
    }
    base::print_figures(
        figures_of(world::load_height_field(options.terrain, options.spacing_m)), options.json);
}

void make(TerrainOptions options) {
    options.made.seed = static_cast<std::uint64_t>(options.seed);
    const auto field = models::made::made_terrain(options.kind, options.made);
    if (!field) {
        throw Error(
            fmt::format("--kind: expected hills or canyon, got '{}'", printable(options.kind)));
    }
    models::heights::write_height_field(options.out, *field);
    base::say(
        options.quiet,
        fmt::format(
            "{}: {} x {} samples, {} m apart, {:.0f} to {:.0f} m",
            options.out,
            field->columns(),
            field->rows(),
            field->spacing_m(),
            field->lowest_m(),
            field->highest_m()));
}

void add_info(CLI::App& terrain) {
    auto options = std::make_shared<TerrainOptions>();
    CLI::App* info =
        terrain.add_subcommand("info", "Shows size, heights, slopes, voids and place of a terrain");
    info->add_option("terrain", options->terrain, "hills, canyon or a file that GDAL reads")
        ->type_name("NAME|FILE")
        ->required();
    add_number_option(
        *info,
        {"terrain-spacing", "METRES", "sample spacing of files that do not say", 0.01, 1e5},
        options->spacing_m);
    info->add_flag("--json", options->json, "as JSON");
    info->add_flag("--verify", options->verify, "check all of an imported ground");
    info->footer("Example:\n  octant terrain info map.tif --json");
    info->callback([options] { show(*options); });
}

void add_make(CLI::App& terrain) {
    auto options = std::make_shared<TerrainOptions>();
    CLI::App* make_command =
        terrain.add_subcommand("make", "Makes a terrain from a seed and writes it as GeoTIFF");
    make_command->add_option("--kind", options->kind, "hills (gentle) or canyon (rugged)")
        ->type_name("KIND")
        ->capture_default_str();
    add_number_option(*make_command, {"size", "N", "samples a side", 2, 20000}, options->made.size);
    add_number_option(
        *make_command,
        {"spacing", "METRES", "between samples", 0.1, 1000},
        options->made.spacing_m);
    add_number_option(
        *make_command, {"seed", "S", "another seed, another terrain", 0, 1e9}, options->seed);
    make_command->add_option("--out", options->out, "the file to write")
        ->type_name("FILE.tif")
        ->required();
    make_command->add_flag("--quiet", options->quiet, "no notes");
    make_command->footer(
        "Example:\n  octant terrain make --kind canyon --size 2049 --seed 7 --out made.tif");
    make_command->callback([options] { make(*options); });
}

} // namespace

void add_terrain_command(CLI::App& program) {
    CLI::App* terrain = program.add_subcommand(
        "terrain", "Height fields: show, make, import, mesh, measure, ask, check");
    terrain->require_subcommand(1);
    terrain->footer("Examples:\n  octant terrain info map.tif\n  octant terrain make --kind canyon "
                    "--seed 7 --out made.tif");
    add_info(*terrain);
    add_make(*terrain);
    add_terrain_import(*terrain);
    add_terrain_mesh(*terrain);
    add_terrain_error(*terrain);
    add_terrain_query(*terrain);
    add_terrain_check(*terrain);
}

} // namespace octant::ui::commands
