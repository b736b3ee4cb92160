#include "ui/studies/flicker/study_popping.h"

#include "sim/base/nearest_rank.h"
#include "sim/base/thread_pool.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/flight/session.h"
#include "ui/flight/simulation.h"
#include "ui/terrain/ground_view.h"
#include "ui/terrain/mesh_maker.h"
#include "ui/world/height_loader.h"
#include "ui/world/world.h"
#include "visuals/landscape/ground.h"
#include "visuals/scene/camera_rig.h"
#include "visuals/terrain/frustum.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/mesh_measurement.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::studies::flicker {

namespace terrain = visuals::terrain;

namespace {

constexpr int pixel_step = 4;
constexpr double reach_m = 100000.0;

/// Two hits this near to each other, with distance, are the same ground.
double same_ground_tolerance_m(double distance_m) { return 0.5 + 0.002 * distance_m; }

glm::dvec3 lowered(glm::dvec3 place_m, const glm::dvec3& eye_m, double radius_m) {
    const glm::dvec2 level_m = glm::dvec2(place_m) - glm::dvec2(eye_m);
    place_m.z -= terrain::curvature_drop_m(glm::dot(level_m, level_m), radius_m);
    return place_m;
}

/// The cameras of all frames of a run, as a session with these settings has them, without drawing. Loads the world.
/// Throws Error.
std::vector<FlightCamera> flight_cameras(const settings::RunSettings& settings) {
    const world::World world = world::load_world(settings);
    const world::PictureTimes times = world::picture_times_of(settings, world.flight);
    const GroundHeight ground = [&](double x_m, double y_m) { return world.scene.ground->height_at(x_m, y_m); };
    flight::Simulation simulation(world);
    simulation.begin_at(times.times_s.front());
    visuals::scene::Subject subject = world.scene.model_of(0).subject;
    subject.radius_m = simulation.formation().framed_radius_m(subject.radius_m);
    std::vector<FlightCamera> cameras;
    for (const double time_s : times.times_s) {
        simulation.advance_to(time_s);
        const sim::AircraftState& state = simulation.states().front();
        cameras.push_back(
            {visuals::scene::camera_of(settings.view, state, simulation.rig(), subject, world.points, ground),
                state.position_m, subject.radius_m});
    }
    return cameras;
}

/// Whether a pixel, from the middle, lies near the aircraft's.
bool near_aircraft(const FlightCamera& frame, const terrain::PerspectiveView& view, const glm::dvec2& pixel) {
    const glm::dvec3 seen = view.seen_m(frame.aircraft_m - view.eye_m);
    if (seen.z <= frame.aircraft_radius_m) { return seen.z > -frame.aircraft_radius_m; }
    const double radius_px = 1.5 * view.focal_px * frame.aircraft_radius_m / seen.z;
    return glm::distance(view.pixel(seen), pixel) < radius_px;
}

/// Where the frame shows a place of the ground, from the middle of the picture.
std::optional<glm::dvec2> pixel_of(const terrain::GroundSamples& ground, const terrain::PerspectiveView& view,
    const glm::dvec3& place_m, double radius_m) {
    const glm::dvec3 from_eye_m = lowered(place_m, view.eye_m, radius_m) - view.eye_m;
    const glm::dvec3 seen = view.seen_m(from_eye_m);
    if (!view.shows(seen)) { return std::nullopt; }
    const auto hit_m = terrain::intersect_ground(ground, view.eye_m, glm::normalize(from_eye_m), reach_m, radius_m);
    if (!hit_m || glm::distance(*hit_m, place_m) > same_ground_tolerance_m(glm::length(from_eye_m))) {
        return std::nullopt;
    }
    return view.pixel(seen);
}

double luminance(const visuals::scene::Picture& picture, int x, int y) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
    return 0.2126 * picture.rgba[at] + 0.7152 * picture.rgba[at + 1] + 0.0722 * picture.rgba[at + 2];
}

double luminance_between(const visuals::scene::Picture& picture, const glm::dvec2& at) {
    const int x = static_cast<int>(at.x);
    const int y = static_cast<int>(at.y);
    const double east = at.x - x;
    const double south = at.y - y;
    return (1.0 - south) * ((1.0 - east) * luminance(picture, x, y) + east * luminance(picture, x + 1, y)) +
           south * ((1.0 - east) * luminance(picture, x, y + 1) + east * luminance(picture, x + 1, y + 1));
}

} // namespace

std::vector<ReprojectedPixel> reprojected_pixels(const terrain::GroundSamples& ground, const FlightCamera& earlier,
    const FlightCamera& later, const glm::ivec2& size_px, double radius_m) {
    const terrain::PerspectiveView before = ui::terrain::picture_view(earlier.camera, size_px);
    const terrain::PerspectiveView now = ui::terrain::picture_view(later.camera, size_px);
    const glm::dvec2 corner(-now.half_width_px + 0.5, now.half_height_px - 0.5);
    std::vector<ReprojectedPixel> matches;
    for (int y = 0; y < size_px.y; y += pixel_step) {
        for (int x = 0; x < size_px.x; x += pixel_step) {
            const glm::dvec2 pixel = corner + glm::dvec2(x, -y);
            if (near_aircraft(later, now, pixel)) { continue; }
            const glm::dvec3 ray = glm::normalize(now.ahead + (now.right * pixel.x + now.up * pixel.y) / now.focal_px);
            const auto hit_m = terrain::intersect_ground(ground, now.eye_m, ray, reach_m, radius_m);
            const auto was = hit_m ? pixel_of(ground, before, *hit_m, radius_m) : std::optional<glm::dvec2>();
            if (!was || near_aircraft(earlier, before, *was)) { continue; }
            const glm::dvec2 at(was->x - corner.x, corner.y - was->y);
            if (at.x >= 0.0 && at.y >= 0.0 && at.x < size_px.x - 1 && at.y < size_px.y - 1) {
                matches.push_back({{x, y}, at});
            }
        }
    }
    return matches;
}

double mean_change(const visuals::scene::Picture& earlier, const visuals::scene::Picture& later,
    const std::vector<ReprojectedPixel>& matches) {
    double sum = 0.0;
    for (const ReprojectedPixel& place : matches) {
        sum += std::abs(luminance(later, place.pixel.x, place.pixel.y) - luminance_between(earlier, place.before));
    }
    return matches.empty() ? 0.0 : sum / static_cast<double>(matches.size());
}

namespace scene = visuals::scene;

namespace {

struct DrawnWay {
    int samples;
    bool geomorphs;
};

constexpr std::array drawn_ways = {DrawnWay{1, false}, DrawnWay{1, true}, DrawnWay{4, false}, DrawnWay{4, true}};

/// Sums over pairs of frames.
struct Change {
    std::string path;
    std::array<double, drawn_ways.size()> sum{};
    std::size_t pairs = 0;
    std::size_t pixels = 0;

    void add(const Change& other) {
        std::ranges::transform(sum, other.sum, sum.begin(), std::plus());
        pairs += other.pairs;
        pixels += other.pixels;
    }
};

Change shimmer_along(
    const settings::RunSettings& flown, const ui::terrain::LoadedGround& ground, std::size_t every, bool quiet) {
    const terrain::GroundSamples samples = ground.samples();
    const std::vector<FlightCamera> cameras = flight_cameras(flown);
    Sessions sessions;
    for (const DrawnWay& way : drawn_ways) {
        settings::RunSettings settings = flown;
        settings.view.samples = way.samples;
        settings.ground.geomorphs = way.geomorphs;
        sessions.push_back(std::make_unique<flight::Session>(settings));
    }
    const double radius_m = flown.ground.earth_curvature ? ground.mean_radius_m() : 0.0;
    base::Progress progress(flown.path.name, static_cast<int>(cameras.size()), quiet);
    Change change{.path = flown.path.name};
    for (std::size_t frame = 0; frame + 1 < cameras.size(); frame += every) {
        const std::vector<ReprojectedPixel> matches =
            reprojected_pixels(samples, cameras[frame], cameras[frame + 1], flown.view.size_px, radius_m);
        for (std::size_t k = 0; k < sessions.size(); ++k) {
            flight::Session& session = *sessions[k];
            session.draw(static_cast<int>(frame));
            const visuals::scene::Picture earlier = session.picture();
            session.draw(static_cast<int>(frame) + 1);
            change.sum[k] += mean_change(earlier, session.picture(), matches);
        }
        ++change.pairs;
        change.pixels += matches.size();
        progress.show(static_cast<int>(frame));
    }
    return change;
}

report::ResultTable shimmer_table(const PoppingStudyOptions& options) {
    const ui::terrain::LoadedGround ground =
        ui::terrain::load_ground(options.settings.path.terrain, world::import_options(options.settings.path),
            true); // the popping table has printed the notes
    std::vector<Change> changes = run_cases(base::built_in_paths, options, [&](std::string_view path, bool quiet) {
        settings::RunSettings settings = options.settings;
        settings.path.name = std::string(path);
        settings.surface.shadows = false;
        settings.ground.lod.metric = terrain::GroundMetric::ScreenError;
        return shimmer_along(settings, ground, static_cast<std::size_t>(options.every), quiet);
    });
    Change all{.path = "all"};
    for (const Change& change : changes) { all.add(change); }
    changes.push_back(all);
    report::ResultTable table{"Shimmer: mean change of luminance (0 to 255) after the motion is taken out"};
    for (const Change& change : changes) {
        std::vector<report::Cell> row = {
            {"path", change.path}, {"pairs of frames", change.pairs}, {"pixels", change.pixels}};
        for (std::size_t k = 0; k < drawn_ways.size(); ++k) {
            const DrawnWay& way = drawn_ways[k];
            row.push_back({fmt::format("{} sample{}, {}geomorphs", way.samples, way.samples == 1 ? "" : "s",
                               way.geomorphs ? "" : "no "),
                "{:.3f}", change.sum[k] / static_cast<double>(change.pairs)});
        }
        table.add(std::move(row));
    }
    table.note = "Every fourth pixel, both ways, of the later frame that shows ground which the "
                 "earlier one shows: rays to the full-resolution ground; the earlier picture is "
                 "read between its pixels. Not near the aircraft; no shadows.";
    return table;
}

struct Meshing {
    const char* name;
    terrain::GroundMetric mesh;
    bool geomorphs;
    bool near_detail;
};

/// The last one is measured where near detail is asked for.
constexpr std::array meshings = {Meshing{"midpoint, exact budget", terrain::GroundMetric::Midpoint, false, false},
    Meshing{"screen-error, no geomorphs", terrain::GroundMetric::ScreenError, false, false},
    Meshing{"screen-error, geomorphs", terrain::GroundMetric::ScreenError, true, false},
    Meshing{"screen-error, geomorphs, near detail", terrain::GroundMetric::ScreenError, true, true}};

/// The mesh of a frame, valid until the next call but one.
using MeshOfFrame = std::function<terrain::GroundMesh(const scene::Camera&)>;

/// Jumps of a flight, one a frame after the first.
struct Jumps {
    std::vector<double> jumps_px;
    double largest_px = 0.0;
    std::size_t largest_frame = 0;

    void add(const Jumps& other) {
        jumps_px.insert(jumps_px.end(), other.jumps_px.begin(), other.jumps_px.end());
        if (other.largest_px > largest_px) {
            largest_px = other.largest_px;
            largest_frame = other.largest_frame;
        }
    }
};

ui::terrain::GroundMeshOptions mesh_options(const settings::RunSettings& settings, const Meshing& way) {
    constexpr double default_error_px = 0.25; // as Settings::error_px
    ui::terrain::GroundMeshOptions options;
    options.lod.metric = way.mesh;
    options.lod.fans = settings.ground.lod.fans;
    options.geomorphs = way.geomorphs;
    options.error_px = settings.ground.error_px.value_or(default_error_px);
    return options;
}

/// Meshes of the ground alone, within the budget.
MeshOfFrame given_ground(
    const ui::terrain::LoadedGround& ground, const settings::RunSettings& settings, const Meshing& way) {
    ui::terrain::GroundViewOptions seen;
    seen.size_px = settings.view.size_px;
    seen.earth_radius_m = settings.ground.earth_curvature ? ground.mean_radius_m() : 0.0;
    const std::shared_ptr<ui::terrain::MeshMaker> maker =
        ui::terrain::make_mesh_maker(ground, mesh_options(settings, way));
    return [maker, seen, triangles = scene::triangle_target(settings)](const scene::Camera& camera) {
        return maker->mesh_within(ui::terrain::mesh_view(camera, seen), triangles);
    };
}

/// The ground of a flight as it is drawn, with detail near the eye in the same budget, but nothing that stands on it.
MeshOfFrame ground_with_detail(settings::RunSettings settings) {
    settings.ground.lod.metric = terrain::GroundMetric::ScreenError;
    settings.ground.scenery = false;
    const std::shared_ptr<visuals::landscape::GroundMesher> mesher =
        world::load_world(settings).scene.ground->mesher(visuals::landscape::mesh_settings(settings, false));
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
    const MeshOfFrame& mesh_of, const settings::RunSettings& settings, const std::vector<FlightCamera>& cameras) {
    terrain::PoppingMeter meter;
    Jumps found;
    for (std::size_t frame = 0; frame < cameras.size(); ++frame) {
        const scene::Camera& camera = cameras[frame].camera;
        const auto jump = meter.next(mesh_of(camera), ui::terrain::picture_view(camera, settings.view.size_px));
        if (!jump) { continue; }
        found.add({{jump->popping_px}, jump->popping_px, frame});
    }
    return found;
}

double percentile_px(std::vector<double> jumps_px, int permille) { return nearest_rank(jumps_px, permille); }

/// A built-in path with its ground meshed in one way.
struct MeshedPath {
    std::size_t path = 0;
    const Meshing* meshing = nullptr;
};

report::ResultTable popping_table(const PoppingStudyOptions& options) {
    const ui::terrain::LoadedGround ground = ui::terrain::load_ground(
        options.settings.path.terrain, world::import_options(options.settings.path), options.quiet);
    const terrain::GroundSamples samples = ground.samples();
    const int asked = scene::triangle_target(options.settings);
    const auto few = world::few_samples_note(options.settings.path.terrain, {samples.columns(), samples.rows()}, asked,
        "--triangles with fewer, or --terrain with a larger map");
    base::print_note(options.quiet || asked == terrain::unlimited_triangles || !few, few.value_or(""));
    std::vector<settings::RunSettings> flown(base::built_in_paths.size(), options.settings);
    std::vector<std::vector<FlightCamera>> cameras;
    std::vector<MeshedPath> cases;
    const auto ways = std::span(meshings).first(meshings.size() - (options.settings.ground.near_detail ? 0 : 1));
    for (std::size_t path = 0; path < flown.size(); ++path) {
        flown[path].path.name = std::string(base::built_in_paths[path]);
        cameras.push_back(flight_cameras(flown[path]));
        for (const Meshing& way : ways) { cases.push_back({path, &way}); }
    }
    base::Progress progress("popping", static_cast<int>(cases.size()), options.quiet, "flights");
    std::vector<Jumps> found = run_cases(cases, options, [&](const MeshedPath& meshed, bool /*quiet*/) {
        const Meshing& way = *meshed.meshing;
        Jumps jumps = jumps_along(
            way.near_detail ? ground_with_detail(flown[meshed.path]) : given_ground(ground, options.settings, way),
            options.settings, cameras[meshed.path]);
        progress.tick(flown[meshed.path].path.name);
        return jumps;
    });
    progress.finish();
    std::vector<Jumps> all(ways.size());
    for (std::size_t i = 0; i < cases.size(); ++i) { all[i % ways.size()].add(found[i]); }
    std::ranges::move(all, std::back_inserter(found));
    report::ResultTable table{"Largest jump of a vertex from frame to frame"};
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Jumps& jumps = found[i];
        table.add(
            {{"path", i < cases.size() ? flown[cases[i].path].path.name : "all"}, {"mesh", ways[i % ways.size()].name},
                {"frames", jumps.jumps_px.size()}, {"maximum px", "{:.3f}", jumps.largest_px},
                {"in frame", jumps.largest_frame}, {"99.9 % px", "{:.3f}", percentile_px(jumps.jumps_px, 999)},
                {"median px", "{:.3f}", percentile_px(jumps.jumps_px, 500)}});
    }
    table.note =
        fmt::format("Each frame: the two meshes' surfaces at every vertex of either that both frames show "
                    "(from 10 m on), apart on the screen as the later frame sees it. {}, {} triangles at most, "
                    "{}x{}, {:.4g} frames a second.",
            options.settings.path.terrain, scene::triangle_target(options.settings), options.settings.view.size_px.x,
            options.settings.view.size_px.y, options.settings.time.rate_hz);
    return table;
}

} // namespace

void study_popping(const PoppingStudyOptions& options) {
    Study study(options);
    study.add("popping", popping_table(options));
    if (options.shimmer) { study.add("shimmer", shimmer_table(options)); }
    study.finish("popping");
}

} // namespace octant::ui::studies::flicker
