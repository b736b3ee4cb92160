#include "ui/studies/flicker/study_popping.h"

#include "sim/base/output_file.h"
#include "sim/base/parallel_for.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/flight/flight_cameras.h"
#include "ui/report/html_text.h"
#include "ui/report/statistics.h"
#include "ui/report/table_text.h"
#include "ui/studies/flicker/shimmer_table.h"
#include "ui/terrain/loaded_ground.h"
#include "ui/terrain/mesh_maker.h"
#include "ui/world/terrain_file.h"
#include "ui/world/world.h"
#include "visuals/landscape/ground.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/vertex_popping.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::studies::flicker {

namespace scene = visuals::scene;
namespace terrain = visuals::terrain;

namespace {

struct Meshing {
    const char* name;
    scene::GroundMetric mesh;
    bool geomorphs;
    bool near_detail;
};

/// The last one is measured where near detail is asked for.
constexpr std::array meshings = {
    Meshing{"midpoint, exact budget", scene::GroundMetric::Midpoint, false, false},
    Meshing{"screen-error, no geomorphs", scene::GroundMetric::ScreenError, false, false},
    Meshing{"screen-error, geomorphs", scene::GroundMetric::ScreenError, true, false},
    Meshing{"screen-error, geomorphs, near detail", scene::GroundMetric::ScreenError, true, true}};

std::span<const Meshing> meshings_of(const settings::RunSettings& settings) {
    return std::span(meshings).first(meshings.size() - (settings.ground.near_detail ? 0 : 1));
}

/// The mesh of a frame, valid until the next call but one.
using MeshOfFrame = std::function<terrain::GroundMesh(const scene::Camera&)>;

/// Jumps of a flight, one a frame after the first.
struct Jumps {
    std::vector<double> jumps_px;
    double largest_px = 0.0;
    std::size_t largest_frame = 0;
};

ui::terrain::GroundMeshOptions
mesh_options(const settings::RunSettings& settings, const Meshing& way) {
    constexpr double default_error_px = 0.25; // as Settings::error_px
    ui::terrain::GroundMeshOptions options;
    options.mesh = way.mesh;
    options.fans = settings.ground.fans;
    options.geomorphs = way.geomorphs;
    options.error_px = settings.ground.error_px.value_or(default_error_px);
    return options;
}

/// Meshes of the ground alone, within the budget.
MeshOfFrame given_ground(
    const ui::terrain::LoadedGround& ground,
    const settings::RunSettings& settings,
    const Meshing& way) {
    ui::terrain::GroundViewOptions seen;
    seen.size_px = settings.view.size_px;
    seen.earth_radius_m = settings.ground.earth_curvature ? ground.mean_radius_m() : 0.0;
    const std::shared_ptr<ui::terrain::MeshMaker> maker =
        ui::terrain::make_mesh_maker(ground, mesh_options(settings, way));
    return
        [maker, seen, triangles = scene::triangle_target(settings)](const scene::Camera& camera) {
            return maker->mesh_within(ui::terrain::mesh_view(camera, seen), triangles);
        };
}

/// The ground of a flight as it is drawn, with detail near the eye in the same budget, but nothing
/// that stands on it.
MeshOfFrame ground_with_detail(settings::RunSettings settings) {
    settings.ground.mesh = scene::GroundMetric::ScreenError;
    settings.ground.scenery = false;
    const std::shared_ptr<visuals::landscape::GroundMesher> mesher =
        world::load_world(settings).scene.ground->mesher(
            visuals::landscape::mesh_settings(settings, false));
    const glm::dvec2 size_px(settings.view.size_px);
    return [mesher, aspect = size_px.x / size_px.y, triangles = scene::triangle_target(settings)](
               const scene::Camera& camera) {
        visuals::landscape::GroundCounts counts;
        const scene::TriangleDraw drawn = mesher->triangles({camera, aspect, triangles}, counts);
        terrain::GroundMesh mesh;
        mesh.vertices = drawn.vertices;
        mesh.indices = drawn.indices;
        return mesh;
    };
}

Jumps jumps_along(
    const MeshOfFrame& mesh_of,
    const settings::RunSettings& settings,
    const std::vector<flight::FlightCamera>& cameras) {
    terrain::PoppingMeter meter;
    Jumps found;
    for (std::size_t frame = 0; frame < cameras.size(); ++frame) {
        const scene::Camera& camera = cameras[frame].camera;
        const auto jump =
            meter.next(mesh_of(camera), ui::terrain::picture_view(camera, settings.view.size_px));
        if (!jump) {
            continue;
        }
        found.jumps_px.push_back(jump->popping_px);
        if (jump->popping_px > found.largest_px) {
            found.largest_px = jump->popping_px;
            found.largest_frame = frame;
        }
    }
    return found;
}

double percentile_px(std::vector<double> jumps_px, int permille) {
    std::sort(jumps_px.begin(), jumps_px.end());
    return report::nearest_rank(jumps_px, permille);
}

void add_popping(
    report::HtmlTable& table, const std::string& path, const Meshing& way, const Jumps& found) {
    table.rows.push_back(
        {path,
         way.name,
         fmt::format("{}", found.jumps_px.size()),
         fmt::format("{:.3f}", found.largest_px),
         fmt::format("{}", found.largest_frame),
         fmt::format("{:.3f}", percentile_px(found.jumps_px, 999)),
         fmt::format("{:.3f}", percentile_px(found.jumps_px, 500))});
}

using JumpsByMeshing = std::array<Jumps, meshings.size()>;

/// Of every built-in path by every meshing, `jobs` of these at once.
std::vector<JumpsByMeshing> jumps_of_paths(const PoppingStudyOptions& options) {
    const ui::terrain::LoadedGround ground = ui::terrain::load_ground(
        options.settings.path.terrain, world::import_options(options.settings.path), options.quiet);
    const terrain::GroundSamples samples = ground.samples();
    const int asked = scene::triangle_target(options.settings);
    const auto few = world::few_samples_note(
        options.settings.path.terrain,
        {samples.columns(), samples.rows()},
        asked,
        "--triangles with fewer, or --terrain with a larger map");
    base::print_note(options.quiet || asked == scene::unlimited_triangles || !few, few.value_or(""));
    std::vector<settings::RunSettings> flown(base::built_in_paths.size(), options.settings);
    std::vector<std::vector<flight::FlightCamera>> cameras;
    for (std::size_t path = 0; path < flown.size(); ++path) {
        flown[path].path.name = std::string(base::built_in_paths[path]);
        cameras.push_back(flight::flight_cameras(flown[path]));
    }
    const std::size_t ways = meshings_of(options.settings).size();
    std::vector<JumpsByMeshing> found(cameras.size());
    base::Progress progress(
        "popping", static_cast<int>(found.size() * ways), options.quiet, "flights");
    int done = 0;
    std::mutex telling;
    parallel_for(found.size() * ways, options.jobs, [&](std::size_t i, std::size_t /*worker*/) {
        const std::size_t path = i / ways;
        const Meshing& way = meshings[i % ways];
        found[path][i % ways] = jumps_along(
            way.near_detail ? ground_with_detail(flown[path])
                            : given_ground(ground, options.settings, way),
            options.settings,
            cameras[path]);
        const std::scoped_lock lock(telling);
        progress.show(++done, std::string(base::built_in_paths[path]));
    });
    progress.finish();
    return found;
}

report::HtmlTable popping_table(const PoppingStudyOptions& options) {
    report::HtmlTable table;
    table.title = "Largest jump of a vertex from frame to frame";
    table.header = {"path", "mesh", "frames", "maximum px", "in frame", "99.9 % px", "median px"};
    const std::vector<JumpsByMeshing> found = jumps_of_paths(options);
    const std::size_t ways = meshings_of(options.settings).size();
    JumpsByMeshing all;
    for (std::size_t path = 0; path < found.size(); ++path) {
        for (std::size_t k = 0; k < ways; ++k) {
            const Jumps& jumps = found[path][k];
            add_popping(table, std::string(base::built_in_paths[path]), meshings[k], jumps);
            all[k].jumps_px.insert(
                all[k].jumps_px.end(), jumps.jumps_px.begin(), jumps.jumps_px.end());
            if (jumps.largest_px > all[k].largest_px) {
                all[k].largest_px = jumps.largest_px;
                all[k].largest_frame = jumps.largest_frame;
            }
        }
    }
    for (std::size_t k = 0; k < ways; ++k) {
        add_popping(table, "all", meshings[k], all[k]);
    }
    table.note = fmt::format(
        "Each frame: the two meshes' surfaces at every vertex of either that both frames show "
        "(from 10 m on), apart on the screen as the later frame sees it. {}, {} triangles at most, "
        "{}x{}, {:.4g} frames a second.",
        options.settings.path.terrain,
        scene::triangle_target(options.settings),
        options.settings.view.size_px.x,
        options.settings.view.size_px.y,
        options.settings.time.rate_hz);
    return table;
}

} // namespace

void study_popping(const PoppingStudyOptions& options) {
    make_folder(options.out);
    std::vector<report::HtmlTable> tables = {popping_table(options)};
    std::vector<std::string> files = {"popping"};
    if (options.shimmer) {
        tables.push_back(
            shimmer_table({options.settings, options.every, options.jobs, options.quiet}));
        files.emplace_back("shimmer");
    }
    std::string markdown;
    for (std::size_t k = 0; k < tables.size(); ++k) {
        write_file(options.out / (files[k] + ".csv"), report::csv_of(tables[k]));
        markdown += (k == 0 ? "" : "\n") + report::markdown_of(tables[k]);
    }
    write_file(options.out / "popping.md", markdown);
    std::fputs((options.json ? report::json_of(tables) : markdown).c_str(), stdout);
}

} // namespace octant::ui::studies::flicker
