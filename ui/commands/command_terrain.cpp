#include "models/heights/height_field_export.h"
#include "models/heights/height_source.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_inputs.h"
#include "models/procedural/procedural_terrain.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/report/png_file.h"
#include "ui/report/table.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_check.h"
#include "ui/terrain/error_tables.h"
#include "ui/terrain/ground_view.h"
#include "ui/terrain/map_picture.h"
#include "ui/terrain/mesh_maker.h"
#include "ui/terrain/terrain_check.h"
#include "ui/terrain/terrain_query.h"
#include "ui/world/height_loader.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/ground_import.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/mesh_measurement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

void add_terrain_options(std::vector<Option>& table, std::string& terrain, models::heights::ImportOptions& files) {
    table.push_back(required(text_option("terrain", "NAME|FILE",
        "terrain: hills, canyon, an imported ground file, or a map in a format that GDAL reads", terrain)));
    add_file_options(table, files);
}

/// What refines the mesh, without its budget. `more` are further keys of --terrain-mesh.
void add_mesh_options(std::vector<Option>& table, terrain::GroundMeshOptions& options, bool& curved,
    const std::vector<FamilyKey>& more = {}) {
    visuals::terrain::TerrainLod& lod = options.lod;
    table.push_back(
        value_option({"terrain-lod", "KIND[:KEY=VALUE,...]",
                         "screen-error (longest-edge bisection by error in pixels), or the paper's quadtree: "
                         "exact (midpoint roughness) or paper (printed roughness); keys: fans=partial|full, "
                         "roughness-c=C (weight of the roughness), resolution-c=C"},
            lod));
    table.insert(table.end(),
        {old_name(value_option({"mesh", "KIND", ""}, lod.metric), "--terrain-lod screen-error, exact or paper"),
            old_name(value_option({"fans", "KIND", ""}, lod.fans), "--terrain-lod exact:fans=KIND"),
            old_name(
                value_option({"roughness-c", "C", "", 0.0, 1e5}, lod.roughness_c), "--terrain-lod exact:roughness-c=C"),
            old_name(value_option({"resolution-c", "C", "", 1.0, 1e5}, lod.resolution_c),
                "--terrain-lod exact:resolution-c=C")});
    std::vector<FamilyKey> keys{
        {"geomorphs", flag("--geomorphs,!--no-geomorphs",
                          "screen-error: interpolate vertices that enter the mesh, as flights do; otherwise every "
                          "vertex has its own height",
                          options.geomorphs)},
        {"curvature",
            flag("--curved", "screen-error: lower the ground by d^2 / 2R for earth curvature, as flights do", curved)}};
    keys.insert(keys.end(), more.begin(), more.end());
    add_family(table, {.name = "--terrain-mesh", .form = "KEY,...", .meaning = "properties of the mesh:"}, keys);
}

/// The view, the mesh and its budget.
void add_drawn_mesh_options(std::vector<Option>& table, terrain::GroundViewOptions& view,
    terrain::GroundMeshOptions& mesh, const std::vector<FamilyKey>& more = {}) {
    add_eye_options(table, "in metres: east and north of the map centre, up from the datum", view);
    add_mesh_options(table, mesh, view.curved, more);
    table.insert(table.end(),
        {value_option(
             {"error-px", "PIXELS", "screen-error: refine until the error is at most this", 0.001, 1e4}, mesh.error_px),
            value_option({"triangles", "N", "refine to at most this many triangles", 1, 1e8}, mesh.triangles)});
}

std::vector<std::string> note_texts(const std::vector<models::heights::MapNote>& notes) {
    std::vector<std::string> texts;
    for (const models::heights::MapNote& note : notes) { texts.push_back(note.text); }
    return texts;
}

/// Adds the distortion of the coordinate system at the corners of the ground, or the assumption made without a system,
/// and the deviation of the ground from its source files; both only where they are known.
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

using visuals::groundfile::ImportStage;
using visuals::terrain::GroundMetadata;
using visuals::terrain::GroundShape;

struct ImportCommand : base::OutputOptions {
    std::vector<std::string> inputs;
    std::string out;
    models::heights::ImportOptions files;
    int threads = 2;
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
    Stopwatch lap_;
    Stopwatch since_save_;
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
    const Stopwatch whole;
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

/// Prints the properties of an imported ground file; `verify` checks the whole file first. Throws Error for a damaged
/// file.
void show_ground_file(const std::string& file, bool verify, bool json) {
    const Stopwatch opening;
    const visuals::terrain::GroundTiles ground = visuals::groundfile::open_ground(file);
    const double open_ms = opening.ms();
    if (verify) { visuals::groundfile::verify_ground(file); }
    auto results = results_of_run(ground.shape(), ground.metadata(), std::filesystem::file_size(file));
    results["open_ms"] = open_ms;
    results["verified"] = verify;
    base::print_value(results, json);
}

Command terrain_import_command() {
    auto work = std::make_shared<ImportCommand>();
    ImportCommand& options = *work;
    Command command{.name = "import",
        .summary = "Makes one file that is mapped, not read, of one or several height files",
        .options = with_output_options(
            options, {required(list_option("files", "FILE",
                          "what GDAL reads, folders, patterns and archives of it; the first counts where "
                          "they "
                          "overlap",
                          Arity::OneOrMore, options.inputs)),
                         required(text_option("--out", "FILE.ground", "output file", options.out)),
                         value_option({"threads", "N", "that build", 1, 256}, options.threads)}),
        .footer = "A stopped import goes on from FILE.ground.part when it is called again.\n"
                  "Examples:\n  octant terrain import west.tif east.tif --out both.ground\n  octant "
                  "terrain import tiles/ --out region.ground",
        .run = [work] { import(*work); }};
    add_file_options(command.options, options.files);
    return command;
}

struct MeshOptions : base::OutputOptions {
    ui::terrain::GroundViewOptions view;
    ui::terrain::GroundMeshOptions mesh;
    std::string out;
    bool ascii = false;
};

void write_mesh(MeshOptions options) {
    const visuals::scene::Camera camera = ui::terrain::camera_of(options.view);
    const terrain::LoadedGround ground = terrain::load_ground(options.view, options.quiet);
    const auto maker = ui::terrain::make_mesh_maker(ground, options.mesh);
    const visuals::terrain::GroundMesh mesh =
        ui::terrain::mesh_from_options(*maker, ui::terrain::mesh_view(camera, options.view), options.mesh);
    write_file(options.out, ui::terrain::ply_of(mesh, camera.eye_m, options.ascii));
    if (options.json) {
        base::JsonValue results;
        results["file"] = options.out;
        results["triangles"] = mesh.counters.triangles;
        results["vertices"] = mesh.vertices.size();
        results["error_px"] = mesh.error_px;
        results["resolution_c"] = mesh.resolution;
        base::print_value(results, true);
        return;
    }
    base::print_note(options.quiet,
        fmt::format("{}: {} triangles, {} vertices, {}", options.out, mesh.counters.triangles, mesh.vertices.size(),
            mesh.resolution > 0.0 ? fmt::format("C = {:.4g}", mesh.resolution)
                                  : fmt::format("error {:.4g} px", mesh.error_px)));
}

std::vector<Option> options_of(MeshOptions& options) {
    std::vector<Option> table;
    add_terrain_options(table, options.view.terrain, options.view.files);
    add_drawn_mesh_options(table, options.view, options.mesh,
        {{"ascii", flag("--ascii", "write text instead of little-endian binary", options.ascii)}});
    table.push_back(required(text_option("--out", "FILE.ply", "output file", options.out)));
    return with_output_options(options, std::move(table));
}

Command terrain_mesh_command() {
    auto options = std::make_shared<MeshOptions>();
    return {.name = "mesh",
        .summary = "Writes the terrain mesh for one eye point, in world coordinates, as PLY",
        .options = options_of(*options),
        .footer = "Example:\n  octant terrain mesh canyon --eye 0,0,900 --look 3000,2000,300 "
                  "--triangles 20000 --out mesh.ply",
        .run = [options] { write_mesh(*options); }};
}

struct ErrorOptions : base::OutputOptions {
    ui::terrain::GroundViewOptions view;
    ui::terrain::GroundMeshOptions mesh;
    std::optional<double> target_error_px;
    std::string eye_points;
    std::string map;
    bool compare = false;
};

void show_error(ErrorOptions options) {
    if (options.compare && !options.target_error_px) {
        throw Error("--study compare: expected solve=PIXELS with it, got none");
    }
    const terrain::LoadedGround ground = terrain::load_ground(options.view, options.quiet);
    ui::terrain::ErrorMeasurement run{options.view, options.mesh, {}, options.target_error_px, options.quiet};
    if (options.eye_points.empty()) {
        run.cameras.push_back(ui::terrain::camera_of(options.view));
    } else {
        const std::string map =
            options.map.empty() ? std::filesystem::path(options.view.terrain).stem().string() : options.map;
        const visuals::terrain::GroundSamples samples = ground.samples();
        for (const ui::terrain::EyePoint& point : ui::terrain::read_eye_points(options.eye_points, map)) {
            run.cameras.push_back(ui::terrain::camera_at(point, samples, options.view.fov_deg));
        }
    }
    std::vector<report::ResultTable> tables = {ui::terrain::error_table(ground, run)};
    if (options.compare) { tables.push_back(ui::terrain::comparison_table(ground, run)); }
    std::fputs((options.json ? report::json_of(tables) : report::markdown_of(tables)).c_str(), stdout);
}

std::vector<Option> options_of(ErrorOptions& options) {
    std::vector<Option> table;
    add_terrain_options(table, options.view.terrain, options.view.files);
    add_drawn_mesh_options(table, options.view, options.mesh);
    add_family(table,
        {.name = "--study", .form = "KEY[=VALUE],...", .meaning = "many views, and the mesh that meets an error:"},
        {{"solve", value_option({"solve", "PIXELS",
                                    "find the coarsest mesh whose 99.9th error percentile is at most this", 0.001, 1e4},
                       options.target_error_px)},
            {"eye-points",
                text_option("--eye-points", "FILE",
                    "CSV table of views with the columns map,x_m,y_m,agl_m,heading_deg,pitch_deg", options.eye_points)},
            {"map",
                text_option("--map", "NAME",
                    "use the table rows with this map name [name of the terrain file without ending]", options.map)},
            {"compare", flag("--compare", "with solve: also measure Roettger's rule, with full and partial fans",
                            options.compare)}});
    return with_output_options(options, std::move(table));
}

Command terrain_error_command() {
    auto options = std::make_shared<ErrorOptions>();
    return {.name = "error",
        .summary = "Measures the screen-space distance of meshes from the full-resolution terrain",
        .options = options_of(*options),
        .footer = "Examples:\n  octant terrain error canyon --eye 0,0,900 --look 3000,2000,300 --triangles 20000\n"
                  "  octant terrain error map.tif --eye 0,0,2000 --look 3000,2000,300 --study solve=1",
        .run = [options] { show_error(*options); }};
}

struct QueryOptions : base::OutputOptions {
    ui::terrain::GroundViewOptions view;
    ui::terrain::GroundMeshOptions mesh;
    std::vector<std::string> at; ///< points or CSV files of points
    std::vector<std::string> source;
    std::optional<glm::dvec3> from_m;
    std::optional<glm::dvec3> to_m;
    bool flat = false;
    bool as_drawn = false;
};

std::vector<ui::terrain::QueryPoint> query_points(const QueryOptions& options) {
    std::vector<ui::terrain::QueryPoint> points;
    for (const std::string& text : options.at) {
        if (const auto point = ui::terrain::point_from_text(text)) {
            points.push_back(*point);
        } else if (is_file(text) || extension_of(text) == ".csv") {
            const std::vector<ui::terrain::QueryPoint> more = ui::terrain::read_points(text);
            points.insert(points.end(), more.begin(), more.end());
        } else {
            throw Error(fmt::format("--at: expected X,Y, X,Y,Z or a CSV file, got '{}'", printable(text)));
        }
    }
    return points;
}

/// Answers from the files that a ground was made of.
std::vector<ui::terrain::QueryPointResult> query_source(const QueryOptions& options,
    const visuals::terrain::GroundSamples& ground, const std::vector<ui::terrain::QueryPoint>& points) {
    const models::heights::HeightSource source(models::heights::map_inputs(options.source), options.view.files);
    if (!source.system() || source.columns() != ground.columns() || source.rows() != ground.rows() ||
        source.spacing_m() != ground.spacing_m()) {
        throw Error(fmt::format("--source: expected the maps, with a coordinate system, that {} is made of, got others",
            options.view.terrain));
    }
    std::vector<ui::terrain::QueryPointResult> answers;
    for (const ui::terrain::QueryPoint& point : points) {
        answers.push_back(ui::terrain::answer_of(point, source.height_at(point.x_m, point.y_m)));
    }
    return answers;
}

void query(QueryOptions options) {
    if (options.from_m.has_value() != options.to_m.has_value()) {
        throw Error("expected --from X,Y,Z and --to X,Y,Z, got only one of them");
    }
    const std::vector<ui::terrain::QueryPoint> points = query_points(options);
    if (points.empty() && !options.from_m) { throw Error("expected --at or --from and --to, got none"); }
    const terrain::LoadedGround ground = terrain::load_ground(options.view, options.quiet);
    const visuals::terrain::GroundSamples samples = ground.samples();
    ui::terrain::QueryResults answers;
    if (options.as_drawn) {
        const visuals::scene::Camera camera = ui::terrain::camera_of(options.view);
        const auto maker = ui::terrain::make_mesh_maker(ground, options.mesh);
        const visuals::terrain::MeshView view = ui::terrain::mesh_view(camera, options.view);
        ui::terrain::DrawnMesh drawn{{}, camera.eye_m, view.earth_radius_m};
        drawn.surface.set_mesh(ui::terrain::mesh_from_options(*maker, view, options.mesh), camera.eye_m);
        answers.points = ui::terrain::drawn_heights_at(drawn, points);
        if (options.from_m) { answers.sight = ui::terrain::drawn_line_of_sight(drawn, *options.from_m, *options.to_m); }
    } else {
        answers.points = options.source.empty() ? ui::terrain::ground_heights_at(samples, points)
                                                : query_source(options, samples, points);
        if (options.from_m) {
            answers.sight = ui::terrain::line_of_sight_answer(
                samples, *options.from_m, *options.to_m, options.flat ? 0.0 : ground.mean_radius_m());
        }
    }
    std::fputs(ui::terrain::query_text(answers, options.json).c_str(), stdout);
}

std::vector<Option> options_of(QueryOptions& options) {
    constexpr double far_m = 1e7;
    std::vector<Option> table;
    add_terrain_options(table, options.view.terrain, options.view.files);
    table.insert(table.end(),
        {list_option("--at", "X,Y[,Z]|FILE.csv",
             "print the ground height at X,Y or at each line x,y[,z] of a CSV file; with Z also the height above "
             "ground",
             Arity::OneOrMore, options.at),
            old_name({.name = "--points",
                         .form = "FILE",
                         .read = [&options](const Words& words) { options.at.push_back(words.front()); }},
                "--at FILE.csv"),
            list_option("--source", "FILE",
                "read point heights from these source maps of the terrain, at their own resolution", Arity::OneOrMore,
                options.source),
            value_option({"from", "X,Y,Z", "start point of a line of sight", -far_m, far_m}, options.from_m),
            value_option({"to", "X,Y,Z", "end point of the line of sight", -far_m, far_m}, options.to_m),
            flag("--flat",
                "lines of sight over a flat earth instead of a sphere of the planet's mean radius (6371 km for the "
                "earth)",
                options.flat),
            flag("--as-drawn", "query the mesh drawn from --eye instead of the full-resolution terrain",
                options.as_drawn)});
    add_drawn_mesh_options(table, options.view, options.mesh);
    return with_output_options(options, std::move(table));
}

Command terrain_query_command() {
    auto options = std::make_shared<QueryOptions>();
    return {.name = "query",
        .summary = "Prints ground heights, heights above ground and lines of sight, at full resolution",
        .options = options_of(*options),
        .footer = "Metres, x east, y north of the map centre, z up from datum. The ground between four "
                  "samples is bilinear; the mesh's is flat triangles. How far the samples of a resampled "
                  "map lie "
                  "from it says octant terrain info; --source asks the map itself.\n"
                  "Example:\n  octant terrain query canyon --at 1200,-800\n  octant terrain query canyon "
                  "--from 0,0,900 --to 5000,3000,250 --json",
        .run = [options] { query(*options); }};
}

struct CheckOptions : base::OutputOptions {
    ui::terrain::GroundViewOptions view;
    ui::terrain::GroundMeshOptions mesh;
    ui::terrain::TerrainCheck check;
};

void check(CheckOptions options) {
    const terrain::LoadedGround ground = terrain::load_ground(options.view, options.quiet);
    const auto maker = ui::terrain::make_mesh_maker(ground, options.mesh);
    ui::terrain::TerrainCheck asked = options.check;
    asked.quiet = options.quiet;
    asked.earth_radius_m = options.view.earth_radius_m;
    asked.by_error = visuals::terrain::ground_metric(options.mesh.lod) == visuals::terrain::GroundMetric::ScreenError;
    const ui::terrain::TerrainCheckResult check_result = ui::terrain::check_terrain(*maker, asked);
    if (options.json) {
        base::JsonValue results;
        results["views"] = check_result.views;
        results["drawn"] = check_result.drawn;
        results["triangles"] = check_result.triangles;
        results["cracked_views"] = check_result.cracked_views;
        results["open_edges"] = check_result.edges.open_edges;
        results["corners_on_edges"] = check_result.edges.t_junctions;
        results["crowded_edges"] = check_result.edges.overlapping_edges;
        results["turned_triangles"] = check_result.edges.inverted_triangles;
        results["doubled_vertices"] = check_result.edges.duplicate_vertices;
        results["key_pixels"] = check_result.key_pixels;
        base::print_value(results, true);
    } else {
        std::fputs(fmt::format("{} views, {} triangles, {} drawn: {} views with faults\n{}\n{} pixels of key "
                               "colour inside the ground\n",
                       check_result.views, check_result.triangles, check_result.drawn, check_result.cracked_views,
                       check_result.edges.text(), check_result.key_pixels)
                       .c_str(),
            stdout);
    }
    if (check_result.cracked_views > 0) { throw CheckFailed(); }
}

std::vector<Option> options_of(CheckOptions& options) {
    ui::terrain::TerrainCheck& asked = options.check;
    std::vector<Option> table;
    add_terrain_options(table, options.view.terrain, options.view.files);
    add_mesh_options(table, options.mesh, options.view.curved);
    table.insert(table.end(),
        {value_option({"frames", "N", "number of random views", 1, 1e8}, asked.views),
            old_name(value_option({"views", "N", "", 1, 1e8}, asked.views), "--frames"),
            value_option({"seed", "S", "random seed", 0, 1e9}, asked.seed),
            hidden(value_option({"every", "N", "mesh only every Nth view", 1, 1e6}, asked.every)),
            hidden(
                value_option({"draw-every", "N", "also draw every Nth meshed view over a key colour; 0 = none", 0, 1e6},
                    asked.draw_every))});
    return with_output_options(options, std::move(table));
}

Command terrain_check_command() {
    auto options = std::make_shared<CheckOptions>();
    return {.name = "check",
        .summary = "Checks the meshes of random views for cracks and holes, by edges and by pictures",
        .options = options_of(*options),
        .footer = "Exit code 1 when there is a crack or a hole.\n"
                  "Example:\n  octant terrain check canyon --frames 10000 --seed 1",
        .run = [options] { check(*options); }};
}

struct TerrainOptions : base::OutputOptions {
    std::string terrain;
    models::heights::ImportOptions files;
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
            const terrain::LoadedGround ground = terrain::load_ground(options.terrain, options.files, options.quiet);
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
    std::vector<Option> table;
    add_terrain_options(table, options->terrain, options->files);
    table.insert(table.end(),
        {text_option("--picture", "OUT.png",
             "write a picture of the terrain from above with a height legend; numbered red rings mark the locations "
             "of the notes",
             options->picture),
            flag("--check", "check the whole imported ground file for damage", options->verify),
            old_name(flag("--verify", "", options->verify), "--check")});
    return {.name = "info",
        .summary = "Shows size, heights, slopes, voids and location of a terrain, map projection errors, and the "
                   "deviation of loaded heights from the file",
        .options = with_output_options(*options, std::move(table)),
        .footer = "Example:\n  octant terrain info map.tif --json",
        .run = [options] { show(*options); }};
}

Command make_command() {
    auto options = std::make_shared<TerrainOptions>();
    return {.name = "make",
        .summary = "Generates a procedural terrain from a seed and writes it as GeoTIFF",
        .options = with_output_options(*options,
            {text_option("--kind", "KIND", "hills (gentle) or canyon (rugged)", options->kind),
                value_option({"size", "N", "number of samples per side", 2, 20000}, options->made.size),
                value_option(
                    {"terrain-spacing", "METRES", "sample spacing in metres", 0.1, 1000}, options->made.spacing_m),
                old_name(
                    value_option({"spacing", "METRES", "", 0.1, 1000}, options->made.spacing_m), "--terrain-spacing"),
                value_option({"seed", "S", "random seed", 0, 1e9}, options->seed),
                required(text_option("--out", "FILE.tif", "output file", options->out))}),
        .footer = "Example:\n  octant terrain make --kind canyon --size 2049 --seed 7 --out made.tif",
        .run = [options] { make(*options); }};
}

} // namespace

Command terrain_command() {
    return {.name = "terrain",
        .summary = "Inspects, generates, imports, meshes, measures, queries and checks terrain",
        .footer = "Examples:\n  octant terrain info map.tif\n  octant terrain make --kind canyon "
                  "--seed 7 --out made.tif",
        .commands = {info_command(), make_command(), terrain_import_command(), terrain_mesh_command(),
            terrain_error_command(), terrain_query_command(), terrain_check_command()}};
}

} // namespace octant::ui::commands
