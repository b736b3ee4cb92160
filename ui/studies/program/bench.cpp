#include "ui/studies/program/bench.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/nearest_rank.h"
#include "sim/base/stopwatch.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/command_line/setting_option.h"
#include "ui/flight/renderer_choice.h"
#include "ui/report/statistics.h"
#include "ui/studies/study.h"
#include "visuals/gl/bare_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::studies::program {

using namespace command_line;

namespace {

namespace scene = visuals::scene;
using settings::RunSettings;

/// What makes a picture richer: its share of what it can be in settings, 0: off.
struct Feature {
    std::string_view name;
    double (*share)(const RunSettings&);
    void (*put)(RunSettings&, double share);
    double on = 1.0; ///< the share that is measured
};

double share_in(double value) { return value; }

/// 0.5 for a flag that is not set. put_share() makes 0 false, 1 true, and others not set.
double share_in(const std::optional<bool>& value) { return !value ? 0.5 : *value ? 1.0 : 0.0; }

void put_share(double share, double& value) { value = share; }

void put_share(double share, bool& value) { value = share != 0.0; }

void put_share(double share, std::optional<bool>& value) {
    value = share == 0.0 || share == 1.0 ? std::optional(share == 1.0) : std::nullopt;
}

/// A feature that is a field of a part of the settings: a flag or a share.
template <auto part, auto field>
constexpr Feature feature(std::string_view name, double on = 1.0) {
    return {name, [](const RunSettings& settings) { return share_in((settings.*part).*field); },
        [](RunSettings& settings, double share) { put_share(share, (settings.*part).*field); }, on};
}

constexpr double cloud_share = 0.5;

using scene::AirSettings;
using scene::GroundSettings;
using scene::SurfaceSettings;

constexpr std::array features{feature<&RunSettings::air, &AirSettings::sky>("sky"),
    feature<&RunSettings::air, &AirSettings::relief_shadows>("relief shadows"),
    feature<&RunSettings::surface, &SurfaceSettings::shadows>("aircraft's shadows"),
    feature<&RunSettings::ground, &GroundSettings::near_detail>("near detail"),
    feature<&RunSettings::ground, &GroundSettings::scenery>("scenery"),
    feature<&RunSettings::ground, &GroundSettings::roads>("roads"),
    feature<&RunSettings::air, &AirSettings::clouds>("clouds", cloud_share),
    feature<&RunSettings::surface, &SurfaceSettings::effects>("effects"),
    feature<&RunSettings::view, &scene::ViewSettings::path_ribbon>("path ribbon")};

/// The settings of a scene with each feature's share as `share_of` says.
template <class ShareOf>
RunSettings with_features(RunSettings settings, const ShareOf& share_of) {
    for (const Feature& feature : features) { feature.put(settings, share_of(feature)); }
    return settings;
}

} // namespace

std::vector<BenchScene> feature_scenes(const BenchScene& scene) {
    std::vector<BenchScene> scenes;
    const auto add = [&](std::string_view name, RunSettings settings) {
        scenes.push_back({scene.name + ": " + std::string(name), std::move(settings), false});
    };
    const auto with = [&](const auto& share_of) { return with_features(scene.settings, share_of); };
    const RunSettings none = with([](const Feature&) { return 0.0; });
    add("no features", none);
    for (const Feature& feature : features) {
        RunSettings one = none;
        feature.put(one, feature.on);
        add(feature.name, one);
    }
    RunSettings textured = none;
    textured.air.ground_shading = visuals::scene::GroundShading::Texture;
    RunSettings with_airfield = none;
    with_airfield.ground.airfield = true;
    const bool has_ground = scene.settings.path.terrain != "none";
    if (has_ground) {
        add("ground by texture", textured);
        add("airfield", with_airfield);
        scenes.back().is_optional = true;
    }
    const RunSettings by_default = with([](const Feature& feature) { return feature.share(RunSettings()); });
    add("those of the defaults", by_default);
    add("all of them", with([](const Feature& feature) { return feature.on; }));
    if (scene.settings.drawing.renderer != settings::RendererKind::Gl) {
        if (has_ground) {
            textured.drawing.renderer = settings::RendererKind::Gl;
            textured.view.samples.reset();
            add("ground by texture by OpenGL", textured);
        }
        RunSettings by_gl = by_default;
        by_gl.drawing.renderer = settings::RendererKind::Gl;
        by_gl.view.samples.reset();
        add("those of the defaults by OpenGL", by_gl);
    }
    return scenes;
}

std::vector<BenchScene> triangle_count_scenes(const BenchScene& scene) {
    std::vector<BenchScene> scenes;
    for (const int triangles : {20000, 50000, 100000, 200000}) {
        scenes.push_back({fmt::format("{}, {}", scene.name, triangles), scene.settings, false});
        scenes.back().settings.ground.triangles = triangles;
    }
    return scenes;
}

/// What was measured of one scene.
struct BenchResult {
    std::string name;
    Records records = {};               ///< Of the timed frames.
    std::vector<double> cpu_ms = {};    ///< Of each, the time that all threads took of processors.
    Hash hash = {};                     ///< Over the pixels of these frames.
    double floor_ms = 1.0;              ///< Median frame time of the floor.
    double plain_cpu_ms = std::nan(""); ///< Median processor time of the same scene without features, if it was drawn.

    void add(const report::FrameRecord& record, double took_ms, const visuals::scene::Picture& picture) {
        records.push_back(record);
        cpu_ms.push_back(took_ms);
        hash.add(std::as_bytes(std::span(picture.rgba)));
    }

    template <class Value = double>
    double median(Value report::FrameRecord::*value = &report::FrameRecord::frame_ms) const {
        return median_of(values_of(records, value, 0));
    }
};

namespace {

constexpr int baseline_triangles = 20000;
constexpr int warm_up_frames = 20;
constexpr int default_frames = 300;
constexpr int feature_frames = 30; ///< a minute for them all

settings::RunSettings by_gl(settings::RunSettings settings) {
    settings.drawing.renderer = settings::RendererKind::Gl;
    settings.view.samples = 1;
    return settings;
}

/// The platform's floor, drawn by OpenGL with one sample a pixel.
class BaselineScene {
public:
    explicit BaselineScene(const settings::RunSettings& settings) : renderer_(flight::make_renderer(by_gl(settings))) {
        plan_.view_to_clip =
            scene::view_to_clip({}, static_cast<double>(settings.view.size_px.x) / settings.view.size_px.y);
        grid_ = visuals::gl::bare_grid(baseline_triangles, plan_.view_to_clip);
        plan_.ground = {grid_.vertices, grid_.indices};
        plan_.steps.push_back(
            {scene::PaintStep::Content::Ground, 0, static_cast<std::uint32_t>(plan_.ground.indices.size())});
        renderer_->warm_up();
    }

    report::FrameRecord draw() {
        report::FrameRecord record;
        const Stopwatch whole;
        Stopwatch stage;
        renderer_->draw(plan_);
        renderer_->finish();
        record.draw_ms = stage.lap_ms();
        renderer_->finish_and_read(picture_);
        record.read_ms = stage.lap_ms();
        record.frame_ms = whole.ms();
        record.terrain_triangles = static_cast<int>(grid_.indices.size() / 3);
        return record;
    }

    const scene::Picture& picture() const { return picture_; }

private:
    std::unique_ptr<scene::Renderer> renderer_;
    visuals::gl::BareGrid grid_;
    scene::FramePlan plan_;
    scene::Picture picture_;
};

/// "f15+500md"; "10 f15" where all are alike.
std::string names_of(const std::vector<std::string>& aircraft) {
    const bool are_alike = std::ranges::adjacent_find(aircraft, std::not_equal_to<>()) == aircraft.end();
    return are_alike && aircraft.size() > 1 ? fmt::format("{} {}", aircraft.size(), aircraft[0])
                                            : fmt::format("{}", fmt::join(aircraft, "+"));
}

std::string name_of(const settings::RunSettings& settings) {
    const bool gl = settings.drawing.renderer == settings::RendererKind::Gl;
    return fmt::format("{}, {}, {}", std::filesystem::path(settings.path.terrain).filename().string(),
        names_of(settings.path.aircraft), gl ? "OpenGL" : "raster");
}

std::vector<std::string> terrains_of(const BenchOptions& options) {
    if (!options.terrains.empty()) { return options.terrains; }
    return options.features ? std::vector<std::string>{"hills"}
                            : std::vector<std::string>{"hills", "canyon", "background60"};
}

/// A scene for each ground and renderer: both, unless one is asked for; features are measured with OpenGL beside them
/// anyway.
std::vector<BenchScene> scenes_of(const BenchOptions& options) {
    using settings::RendererKind;
    std::vector<BenchScene> scenes;
    const RendererKind wanted = options.settings.drawing.renderer;
    const RendererKind asked = wanted == RendererKind::Auto && options.features ? RendererKind::Raster : wanted;
    for (const std::string& terrain : terrains_of(options)) {
        for (const RendererKind kind : {RendererKind::Raster, RendererKind::Gl}) {
            if (asked != RendererKind::Auto && asked != kind) { continue; }
            settings::RunSettings settings = options.settings;
            settings.path.terrain = terrain;
            settings.time.frames = timed_frames(options) + warm_up_frames;
            settings.drawing.renderer = kind;
            if (kind == RendererKind::Gl && settings.view.samples == 16) { settings.view.samples.reset(); }
            const BenchScene scene{name_of(settings), settings, false};
            if (options.triangle_counts) {
                std::ranges::move(triangle_count_scenes(scene), std::back_inserter(scenes));
            } else {
                scenes.push_back(scene);
            }
        }
    }
    return scenes;
}

/// A scene's session; none of an optional one whose world cannot be loaded.
std::unique_ptr<flight::Session> session_of(const BenchScene& scene, bool quiet) {
    base::print_note(quiet, fmt::format("loading {}", scene.name));
    try {
        return std::make_unique<flight::Session>(scene.settings);
    } catch (const Error& error) {
        if (!scene.is_optional) { throw; }
        base::print_note(quiet, fmt::format("left out: {}", error.what()));
        return nullptr;
    }
}

/// Draws scenes and the floor in turn.
std::vector<BenchResult> timed_in_turn(const std::vector<BenchScene>& scenes, const BenchOptions& options) {
    BaselineScene floor(options.settings);
    std::vector<BenchResult> timed{{fmt::format("floor: bare grid of {} triangles", baseline_triangles)}};
    std::vector<std::unique_ptr<flight::Session>> sessions;
    for (const BenchScene& scene : scenes) {
        if (auto session = session_of(scene, options.quiet)) {
            sessions.push_back(std::move(session));
            timed.push_back({scene.name});
        }
    }
    const int frames = timed_frames(options) + warm_up_frames;
    base::Progress progress("bench", frames, options.quiet);
    for (int frame = 0; frame < frames; ++frame) {
        const bool counts = frame >= warm_up_frames;
        double before_ms = 1e3 * process_cpu_s();
        const auto add = [&](BenchResult& to, const report::FrameRecord& record, const auto& drawn) {
            const double after_ms = 1e3 * process_cpu_s();
            if (counts) { to.add(record, after_ms - before_ms, drawn.picture()); }
            before_ms = 1e3 * process_cpu_s();
        };
        add(timed[0], floor.draw(), floor);
        for (std::size_t i = 0; i < sessions.size(); ++i) {
            if (frame < sessions[i]->frames()) { add(timed[i + 1], sessions[i]->draw(frame), *sessions[i]); }
        }
        progress.show(frame + 1);
    }
    progress.finish();
    const double floor_ms = timed[0].median();
    for (BenchResult& result : timed) { result.floor_ms = floor_ms; }
    return timed;
}

} // namespace

int timed_frames(const BenchOptions& options) {
    return options.frames.value_or(options.features ? feature_frames : default_frames);
}

namespace {

std::vector<BenchResult> run_bench(const BenchOptions& options) {
    const std::vector<BenchScene> scenes = scenes_of(options);
    if (!options.features) { return timed_in_turn(scenes, options); }
    std::vector<BenchResult> results;
    for (const BenchScene& scene : scenes) {
        std::vector<BenchResult> of_scene = timed_in_turn(feature_scenes(scene), options);
        const double plain_cpu_ms = median_of(of_scene[1].cpu_ms);
        for (BenchResult& result : of_scene) { result.plain_cpu_ms = plain_cpu_ms; }
        std::ranges::move(of_scene, std::back_inserter(results));
    }
    return results;
}

struct BenchCommand {
    BenchOptions options;
    bool formation = false;
};

/// A scene that is harder than the usual ones: ten aircraft in a picture of two million pixels.
void set_formation(BenchOptions& options) {
    constexpr std::size_t aircraft = 10;
    options.terrains = {"canyon"};
    options.settings.path.aircraft.assign(aircraft, "f15");
    options.settings.view.size_px = {1920, 1080};
    options.settings.ground.triangles = 25000;
}

using Record = report::FrameRecord;
using report::ColumnKind;

/// A column of numbers. Those that some scenes do not have are not finite there.
constexpr report::Column<BenchResult> number(report::ColumnHead head, double (*value)(const BenchResult&)) {
    return {head, value, nullptr};
}

/// Median of a value of the frames, milliseconds.
template <auto value>
constexpr report::Column<BenchResult> median_column(std::string_view key, std::string_view name, int decimals) {
    return number({.key = key, .name = name, .decimals = decimals},
        [](const BenchResult& result) { return result.median(value); });
}

constexpr std::array result_columns{
    report::column<&BenchResult::name>("name", "scene"),
    median_column<&Record::frame_ms>("median_ms", "median ms", 2),
    number({.key = "p99_ms", .name = "p99 ms", .decimals = 2},
        [](const BenchResult& result) {
            return report::statistics_of_times(values_of(result.records, &Record::frame_ms, 0)).p99_ms;
        }),
    number({.key = "ratio", .name = "ratio", .decimals = 2, .definition = "median over that of the platform's floor"},
        [](const BenchResult& result) { return result.median() / result.floor_ms; }),
    median_column<&Record::sim_ms>("sim_ms", "sim ms", 3),
    median_column<&Record::plan_ms>("plan_ms", "plan ms", 2),
    median_column<&Record::draw_ms>("draw_ms", "draw ms", 2),
    median_column<&Record::read_ms>("read_ms", "read ms", 2),
    median_column<&Record::mesh_wait_ms>("mesh_wait_ms", "mesh wait", 2),
    median_column<&Record::draw_wait_ms>("draw_wait_ms", "draw wait", 2),
    number(
        {.key = "cpu_ms", .name = "CPU ms", .decimals = 2, .definition = "median of the processor time of all threads"},
        [](const BenchResult& result) { return median_of(result.cpu_ms); }),
    number({.key = "of_plain",
               .name = "of plain",
               .decimals = 2,
               .definition = "processor time over that of the same scene without features",
               .is_optional = true},
        [](const BenchResult& result) { return median_of(result.cpu_ms) / result.plain_cpu_ms; }),
    number({.key = "triangles", .name = "triangles", .kind = ColumnKind::Whole},
        [](const BenchResult& result) { return result.median(&Record::terrain_triangles); }),
    number({.key = "ms_per_1000_triangles", .name = "ms/1000", .decimals = 3, .is_optional = true},
        [](const BenchResult& result) {
            const double triangles = result.median(&Record::terrain_triangles);
            return triangles > 0.0 ? result.median() * 1000.0 / triangles : std::nan("");
        }),
    report::Column<BenchResult>{
        {.key = "hash", .name = "hash", .kind = ColumnKind::Hash, .definition = "over the pixels of the timed frames"},
        nullptr, [](const BenchResult& result) { return report::hash_text(result.hash.value()); }},
};

} // namespace

std::span<const report::Column<BenchResult>> bench_columns() { return result_columns; }

namespace {

void print_results(const std::vector<BenchResult>& results, bool json) {
    if (json) {
        base::print_value({{"scenes", report::json_rows(bench_columns(), results)}}, true);
        return;
    }
    report::ResultTable table;
    for (const BenchResult& result : results) { table.add(report::cells_of(bench_columns(), result)); }
    std::fputs(report::text_of(table).c_str(), stdout);
}

constexpr std::array sample_counts{1, 4, 16};

/// An option for one thing each time that it stands, with all defaults in help.
Option repeat_option(std::string name, std::string meaning, std::vector<std::string>& values) {
    return with_shown_default(fmt::format("[{}]", fmt::join(values, ",")),
        list_option(std::move(name), "NAME|FILE", std::move(meaning), Arity::Repeatable, values));
}

std::vector<Option> options_of(BenchCommand& bench) {
    BenchOptions& options = bench.options;
    settings::RunSettings& settings = options.settings;
    std::vector<Option> table = with_output_options(options,
        {with_shown_default("[hills,canyon,background60; with --features: hills]",
             list_option("--terrain", "NAME|FILE", "terrain; one scene for each; repeatable", Arity::Repeatable,
                 options.terrains)),
            repeat_option("--aircraft", "aircraft in every scene; repeat for a formation", settings.path.aircraft),
            value_option({"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 8192}, settings.view.size_px),
            with_shown_default("20000",
                value_option({"triangles", "N", "ground triangle budget", 100, 10000000}, settings.ground.triangles)),
            value_option({"renderer", "KIND", "raster or gl; auto: both in turn (with --features: raster)"},
                settings.drawing.renderer),
            value_option(
                {"samples", "N", "samples per pixel [raster: 16, gl: 1]", 1, 16, sample_counts}, settings.view.samples),
            value_option({"context", "KIND", "OpenGL context: osmesa or egl"}, settings.drawing.context),
            value_option(
                {"frames", "N", "number of timed frames of each scene [300; with --features: 30, about a minute]", 1,
                    100000},
                options.frames),
            flag("--formation", "replace the scenes by ten F-15s over the canyon, 25,000 triangles, 1920x1080",
                bench.formation),
            flag("--near-detail", "draw procedural ground detail near the eye", settings.ground.near_detail),
            flag("--scenery", "draw procedural trees and houses near the eye", settings.ground.scenery),
            flag("--features",
                "print the cost of each feature (near detail, scenery, sky, ...): render each scene with no feature, "
                "one "
                "feature, an airfield, the defaults, and all features, alternating frame by frame",
                options.features),
            flag("--growth",
                "ignore --triangles and render each scene with 20,000, 50,000, 100,000 and 200,000 ground triangles; "
                "ms/1000 is the median time per 1,000 triangles",
                options.triangle_counts)});
    add_file_options(table, settings.path);
    return table;
}

} // namespace

Command bench_command() {
    auto bench = std::make_shared<BenchCommand>();
    return {.name = "bench",
        .summary = "Benchmarks standard scenes against a minimal baseline scene and prints the ratios",
        .options = options_of(*bench),
        .footer = "Example:\n  octant bench --terrain map.tif --size 1920x1080 --json\n"
                  "  octant bench --features --terrain hills --aircraft 500md --renderer raster\n"
                  "  octant bench --growth --terrain canyon",
        .run = [bench] {
            if (bench->formation) { set_formation(bench->options); }
            const std::vector<BenchResult> results = run_bench(bench->options);
            print_results(results, bench->options.json);
        }};
}

} // namespace octant::ui::studies::program
