#include "ui/studies/hybrid_shading/shading_times.h"

#include "ui/base/progress.h"
#include "ui/flight/renderer_choice.h"
#include "ui/flight/session.h"
#include "ui/report/statistics.h"

#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <memory>
#include <utility>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

namespace scene = visuals::scene;

namespace {

constexpr int timed_frames = 100;
constexpr int warm_up_frames = 10;

struct ShadingMode {
    const char* name;
    scene::AircraftShading shading;
    double share = 1.0;
    scene::HybridRule rule = scene::HybridRule::Error;
};

constexpr std::array shading_modes{ShadingMode{"flat", scene::AircraftShading::Flat},
    ShadingMode{"hybrid, 20 %", scene::AircraftShading::Hybrid, 0.2},
    ShadingMode{"hybrid, 20 %, paper's rule", scene::AircraftShading::Hybrid, 0.2, scene::HybridRule::Paper},
    ShadingMode{"hybrid, 50 %", scene::AircraftShading::Hybrid, 0.5},
    ShadingMode{"Gouraud", scene::AircraftShading::Gouraud}, ShadingMode{"Phong", scene::AircraftShading::Phong}};
constexpr std::size_t flat_way = 0; ///< index into ways

using PaintDirection = visuals::raster::Renderer::PaintDirection;

struct RendererMode {
    const char* name;
    settings::RendererKind renderer;
    int samples = 1;
    PaintDirection paint_direction = PaintDirection::NearToFar;
    scene::HiddenSurface hidden_surface = scene::HiddenSurface::Octant;
};

constexpr std::array renderer_modes{RendererMode{"OpenGL", settings::RendererKind::Gl},
    RendererMode{"raster, far to near", settings::RendererKind::Raster, 1, PaintDirection::FarToNear},
    RendererMode{"raster, near to far", settings::RendererKind::Raster},
    RendererMode{"raster, depth buffer", settings::RendererKind::Raster, 1, PaintDirection::NearToFar,
        scene::HiddenSurface::DepthBuffer},
    RendererMode{"raster, 16 samples", settings::RendererKind::Raster, 16}};
constexpr std::size_t near_to_far_drawer = 2; ///< indices into drawers
constexpr std::size_t depth_drawer = 3;

settings::RunSettings settings_of(const std::string& aircraft, const ShadingMode& way, const RendererMode& drawer) {
    settings::RunSettings settings;
    settings.path.name = "turn";
    settings.view.kind = scene::View::Orbit; // so that the choice changes
    settings.path.terrain = "none";
    settings.path.aircraft = {aircraft};
    settings.time.frames = timed_frames;
    settings.time.warm_up = 0;
    settings.drawing.renderer = drawer.renderer;
    settings.view.samples = drawer.samples;
    settings.surface.hidden_surface = drawer.hidden_surface;
    settings.shading.kind = way.shading;
    settings.shading.rule = way.rule;
    settings.shading.far_m = 1e6; // by the share alone
    settings.shading.smooth_share = way.share;
    return settings;
}

std::unique_ptr<flight::Session> session_of(
    const std::string& aircraft, const ShadingMode& way, const RendererMode& drawer) {
    const settings::RunSettings settings = settings_of(aircraft, way, drawer);
    if (drawer.renderer == settings::RendererKind::Gl) { return std::make_unique<flight::Session>(settings); }
    auto renderer = flight::make_raster_renderer(settings);
    renderer->set_paint_direction(drawer.paint_direction);
    return std::make_unique<flight::Session>(settings, flight::PictureContent::World, std::move(renderer));
}

double median_of(const std::vector<double>& times_ms) { return report::statistics_of_times(times_ms).p50_ms; }

/// One way of shading by all drawers.
struct ShadingTimes {
    std::array<std::vector<double>, renderer_modes.size()> draw_ms;
    std::vector<double> plan_ms;
    int polygons = 0;
    int smooth = 0;

    void add(const report::FrameRecord& record, std::size_t drawer) {
        draw_ms[drawer].push_back(record.draw_ms);
        plan_ms.push_back(record.plan_ms - record.refine_ms);
        polygons = record.aircraft_polygons;
        smooth = record.smooth_polygons;
    }
};

std::array<ShadingTimes, shading_modes.size()> measured(const std::string& aircraft, bool quiet) {
    constexpr std::size_t all = shading_modes.size() * renderer_modes.size();
    std::array<std::unique_ptr<flight::Session>, all> sessions;
    for (std::size_t i = 0; i < all; ++i) {
        sessions[i] =
            session_of(aircraft, shading_modes[i / renderer_modes.size()], renderer_modes[i % renderer_modes.size()]);
    }
    std::array<ShadingTimes, shading_modes.size()> result;
    base::Progress progress(fmt::format("{} flown", aircraft), timed_frames, quiet);
    for (int frame = 0; frame < timed_frames; ++frame) {
        for (std::size_t turn = 0; turn < all; ++turn) {
            const std::size_t i = (turn + static_cast<std::size_t>(frame)) % all;
            const report::FrameRecord record = sessions[i]->draw(frame);
            if (frame >= warm_up_frames) { result[i / renderer_modes.size()].add(record, i % renderer_modes.size()); }
        }
        progress.show(frame + 1);
    }
    progress.finish();
    return result;
}

} // namespace

report::HtmlTable shading_times_table(std::span<const std::string> aircraft, bool quiet) {
    report::HtmlTable table;
    table.title = "Times flown: drawing by each renderer, ms, and over that of all flat";
    table.header = {"aircraft", "shading", "polygons drawn", "smooth", "planning, ms"};
    for (const RendererMode& drawer : renderer_modes) {
        table.header.push_back(fmt::format("{}, ms", drawer.name));
        table.header.push_back(fmt::format("{}, / flat", drawer.name));
    }
    table.header.emplace_back("raster: depth buffer / near to far");
    for (const std::string& each : aircraft) {
        const auto times = measured(each, quiet);
        for (std::size_t way = 0; way < shading_modes.size(); ++way) {
            const ShadingTimes& own = times[way];
            std::vector<std::string> cells =
                report::cells("{}\t{}\t{}\t{}\t{:.3f}", std::filesystem::path(each).stem().string(),
                    shading_modes[way].name, own.polygons, own.smooth, median_of(own.plan_ms));
            for (std::size_t drawer = 0; drawer < renderer_modes.size(); ++drawer) {
                const double ms = median_of(own.draw_ms[drawer]);
                const double flat_ms = median_of(times[flat_way].draw_ms[drawer]);
                report::append_cells(cells, "{:.2f}\t{:.2f}", ms, ms / flat_ms);
            }
            report::append_cells(
                cells, "{:.2f}", median_of(own.draw_ms[depth_drawer]) / median_of(own.draw_ms[near_to_far_drawer]));
            table.rows.push_back(std::move(cells));
        }
    }
    table.note =
        fmt::format("Medians of {} frames of the path turn without ground, orbit view, 1280 x 720, one sample "
                    "a pixel where none are named, all frame by frame beside each other. Drawing: from the "
                    "plan to pixels in memory, sky included. Counts are the last frame's: of polygon models "
                    "those in view of the eye's cell and the smooth ones of the whole model, of meshes "
                    "triangles as they are refined. Planning: without refining; the choice of smooth polygons "
                    "and the writing of refined meshes included. Times are the machine's, not the same twice. "
                    "In the paper's count of operations Gouraud costs 1.3 times as much as flat, on devices "
                    "that divided for each pixel; the columns say what it costs here, and what light in each "
                    "pixel (Phong) does. The last columns paint by a depth buffer, which asks for depth in each "
                    "sample of the aircraft and is not tuned as the painter is.",
            timed_frames - warm_up_frames);
    return table;
}

} // namespace octant::ui::studies::hybrid_shading
