// Runs of the terrain's triangle control for `octant study flicker`.
//
// Source: E. K. Choi, B. S. Shin, "A Quadtree-Based CLOD Method that Minimize Flickering Effect", section 4: fixed view
// and 1000 frames along a path. Deviations: the paper gives neither eye points nor a target; both are chosen here by
// rules that fit any field. A frame at a fixed view with the C of the frame before is not made again.
#include "ui/studies/flicker/flicker_runs.h"

#include "visuals/scene/camera.h"
#include "visuals/terrain/detail_controller.h"
#include "visuals/terrain/ground_builder.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace octant::ui::studies::flicker {

namespace {

namespace terrain = visuals::terrain;

constexpr double height_m = 300.0; ///< over the ground
constexpr double looking_down = 0.1;
constexpr double max_resolution = 1000.0;

terrain::MeshView view_at(const models::heights::HeightField& field, double x_m, double y_m, double yaw_rad) {
    const double ground_m = field.height_at(x_m, y_m).value_or(0.0);
    const glm::dvec3 eye_m(x_m, y_m, ground_m + height_m);
    const glm::dvec3 ahead(std::cos(yaw_rad), std::sin(yaw_rad), -looking_down);
    const visuals::scene::Camera camera = visuals::scene::camera_looking_at(eye_m, eye_m + ahead);
    terrain::MeshView view;
    view.eye_m = eye_m;
    view.frustum_normals = visuals::scene::frustum_normals(camera, 16.0 / 9.0);
    return view;
}

bool same(const terrain::MeshView& a, const terrain::MeshView& b) {
    return a.eye_m == b.eye_m && a.frustum_normals == b.frustum_normals;
}

/// The way of a control by C; `dead_band` as in ControlSettings.
CountNextFrame controlled(
    FlickerGround& ground, const FlickerSettings& settings, terrain::ControlMethod method, double dead_band) {
    terrain::ControlSettings control;
    control.method = method;
    control.target_triangles = settings.target_triangles;
    control.triangles_per_resolution = settings.triangles_per_resolution;
    control.averaged_frames = settings.averaged_frames;
    control.dead_band = dead_band;
    control.max_resolution = max_resolution;
    const terrain::QuadtreeDetail detail{0.0, settings.roughness_weight, terrain::FanKind::Partial};
    return [&ground, control, detail, state = terrain::initial_state(settings.first_resolution, control),
               last_view = std::optional<terrain::MeshView>(),
               last = CountedFrame()](const terrain::MeshView& view) mutable {
        const bool same_view = last_view && same(*last_view, view);
        last_view = view;
        if (same_view && last.resolution == state.resolution) {
            state = terrain::next_state(state, control, last.triangles, same_view);
            return last;
        }
        const terrain::CountedMesh mesh = terrain::controlled_mesh(state, control, same_view, [&](double resolution) {
            terrain::QuadtreeDetail with_resolution = detail;
            with_resolution.resolution = resolution;
            return ground.mesher.count(view, with_resolution);
        });
        last = {mesh.counters.triangles, mesh.counters.fans, mesh.resolution};
        last.estimated_gain = control.method == terrain::ControlMethod::Tuned
                                  ? state.exponent * mesh.counters.triangles / mesh.resolution
                                  : control.triangles_per_resolution;
        return last;
    };
}

CountNextFrame previous(FlickerGround& ground, const FlickerSettings& settings) {
    return controlled(ground, settings, terrain::ControlMethod::Previous, 0.0);
}

CountNextFrame damped_as_printed(FlickerGround& ground, const FlickerSettings& settings) {
    return controlled(ground, settings, terrain::ControlMethod::Damped, 0.0);
}

CountNextFrame damped(FlickerGround& ground, const FlickerSettings& settings) {
    return controlled(ground, settings, terrain::ControlMethod::Damped, terrain::ControlSettings().dead_band);
}

CountNextFrame tuned(FlickerGround& ground, const FlickerSettings& settings) {
    return controlled(ground, settings, terrain::ControlMethod::Tuned, 0.0);
}

CountNextFrame literal(FlickerGround& ground, const FlickerSettings& settings) {
    return controlled(ground, settings, terrain::ControlMethod::Printed, 0.0);
}

CountNextFrame exact(FlickerGround& ground, const FlickerSettings& settings) {
    const terrain::QuadtreeDetail detail{0.0, settings.roughness_weight, terrain::FanKind::Partial};
    const terrain::TriangleBudget budget{settings.target_triangles, max_resolution};
    return [&ground, detail, budget](const terrain::MeshView& view) {
        const terrain::CountedMesh mesh = ground.mesher.count_within(view, detail, budget);
        return CountedFrame{mesh.counters.triangles, mesh.counters.fans, mesh.resolution};
    };
}

/// As flights are drawn by default, but for the error below which they leave triangles unused.
CountNextFrame by_screen_error(FlickerGround& ground, const FlickerSettings& settings) {
    const terrain::ErrorTarget target{.error_px = 0.0, .max_triangles = settings.target_triangles, .geomorphs = true};
    return [&ground, target](const terrain::MeshView& view) {
        const terrain::GroundMesh mesh = ground.error_mesher.mesh(view, target);
        return CountedFrame{mesh.counters.triangles, mesh.counters.fans, 0.0};
    };
}

constexpr std::array all_controls = {TriangleControl{"previous (4)", true, previous},
    TriangleControl{"damped (5), as printed", true, damped_as_printed},
    TriangleControl{"damped, dead band", true, damped}, TriangleControl{"damped, own gain", true, tuned},
    TriangleControl{"literal (4)", false, literal}, TriangleControl{"exact", true, exact},
    TriangleControl{"screen error (default)", true, by_screen_error}};

} // namespace

FlickerGround::FlickerGround(models::heights::HeightField made)
    : field(std::move(made)), tree(field, {.roughness = terrain::Roughness::Printed}),
      colours(static_cast<std::size_t>(field.columns()) * static_cast<std::size_t>(field.rows()), 0U),
      mesher(tree, colours), tiles(terrain::make_ground_tiles(field)), error_mesher(tiles) {}

std::span<const TriangleControl> triangle_controls() { return all_controls; }

FlickerRun run_along(const TriangleControl& triangle_control, FlickerGround& ground, const FlickerSettings& settings,
    std::span<const terrain::MeshView> views) {
    FlickerRun run;
    const CountNextFrame next = triangle_control.start(ground, settings);
    for (const terrain::MeshView& view : views) {
        const CountedFrame frame = next(view);
        run.triangles.push_back(frame.triangles);
        run.fans.push_back(frame.fans);
        run.resolution.push_back(frame.resolution);
        run.estimated_gain.push_back(frame.estimated_gain);
    }
    return run;
}

terrain::MeshView roughest_view(FlickerGround& ground) {
    const glm::dvec2 quarter_m = 0.25 * ground.field.half_extent_m();
    terrain::MeshView roughest;
    int most = -1;
    for (int place = 0; place < 25; ++place) {
        for (int heading = 0; heading < 8; ++heading) {
            const terrain::MeshView view = view_at(ground.field, (place % 5 - 2) * quarter_m.x,
                (place / 5 - 2) * quarter_m.y, heading * std::numbers::pi / 4.0);
            const int triangles =
                ground.mesher.count(view, {.resolution = 16.0, .roughness_weight = 5.0}).counters.triangles;
            if (triangles > most) {
                most = triangles;
                roughest = view;
            }
        }
    }
    return roughest;
}

std::vector<terrain::MeshView> ellipse_views(const FlickerGround& ground, int frames) {
    const glm::dvec2 radius_m = glm::dvec2(0.6, 0.4) * ground.field.half_extent_m();
    std::vector<terrain::MeshView> views;
    for (int frame = 0; frame < frames; ++frame) {
        const double angle = 2.0 * std::numbers::pi * frame / frames;
        views.push_back(view_at(ground.field, radius_m.x * std::cos(angle), radius_m.y * std::sin(angle),
            std::atan2(radius_m.y * std::cos(angle), -radius_m.x * std::sin(angle))));
    }
    return views;
}

} // namespace octant::ui::studies::flicker
