#include "ui/studies/hybrid_shading/shading_times.h"

#include "ui/base/progress.h"
#include "ui/studies/study.h"

#include <array>
#include <cstddef>
#include <fmt/format.h>
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
constexpr std::size_t flat_way = 0; ///< index into shading_modes

constexpr auto renderer_modes = [] {
    using enum settings::RendererKind;
    using enum scene::HiddenSurface;
    using enum visuals::raster::Renderer::PaintDirection;
    return std::array{DrawingMode{"OpenGL", Gl, Octant},
        DrawingMode{"raster, far to near", Raster, Octant, 1, FarToNear}, DrawingMode{"raster, near to far", Raster},
        DrawingMode{"raster, depth buffer", Raster, DepthBuffer},
        DrawingMode{"raster, 16 samples", Raster, Octant, 16}};
}();
constexpr std::size_t near_to_far_drawer = 2; ///< indices into renderer_modes
constexpr std::size_t depth_drawer = 3;

settings::RunSettings settings_of(const std::string& aircraft, const ShadingMode& way) {
    settings::RunSettings settings;
    settings.path.name = "turn";
    settings.view.kind = scene::View::Orbit; // so that the choice changes
    settings.path.terrain = "none";
    settings.path.aircraft = {aircraft};
    settings.time.frames = timed_frames;
    settings.time.warm_up = 0;
    settings.shading.kind = way.shading;
    settings.shading.rule = way.rule;
    settings.shading.far_m = 1e6; // by the share alone
    settings.shading.smooth_share = way.share;
    return settings;
}

/// One way of shading by all drawers.
struct ShadingTimes {
    std::array<double, renderer_modes.size()> draw_ms{}; ///< medians
    double plan_ms = 0.0;
    int polygons = 0;
    int smooth = 0;
};

ShadingTimes times_of(std::span<const Records> of_drawers) {
    ShadingTimes times;
    std::vector<double> plan_ms;
    for (std::size_t drawer = 0; drawer < renderer_modes.size(); ++drawer) {
        const Records& records = of_drawers[drawer];
        times.draw_ms[drawer] = median_of(records, &report::FrameRecord::draw_ms, warm_up_frames);
        for (const report::FrameRecord& record : std::span(records).subspan(warm_up_frames)) {
            plan_ms.push_back(record.plan_ms - record.refine_ms);
        }
        times.polygons = records.back().aircraft_polygons;
        times.smooth = records.back().smooth_polygons;
    }
    times.plan_ms = report::statistics_of_times(plan_ms).p50_ms;
    return times;
}

std::array<ShadingTimes, shading_modes.size()> measured(const std::string& aircraft, bool quiet) {
    Sessions sessions;
    for (const ShadingMode& way : shading_modes) {
        for (const DrawingMode& drawer : renderer_modes) {
            sessions.push_back(session_of(settings_of(aircraft, way), drawer));
        }
    }
    base::Progress progress(fmt::format("{} flown", aircraft), timed_frames, quiet);
    const std::vector<Records> records = draw_in_turn(sessions, timed_frames, [&](int, const auto&) {
        progress.tick();
        return true;
    });
    std::array<ShadingTimes, shading_modes.size()> times;
    for (std::size_t way = 0; way < times.size(); ++way) {
        times[way] = times_of(std::span(records).subspan(way * renderer_modes.size(), renderer_modes.size()));
    }
    return times;
}

} // namespace

report::ResultTable shading_times_table(std::span<const std::string> aircraft, bool quiet) {
    report::ResultTable table{"Times flown: drawing by each renderer, ms, and over that of all flat"};
    for (const std::string& each : aircraft) {
        const auto times = measured(each, quiet);
        for (std::size_t way = 0; way < shading_modes.size(); ++way) {
            const ShadingTimes& own = times[way];
            std::vector<report::Cell> row = {{"aircraft", std::filesystem::path(each).stem().string()},
                {"shading", shading_modes[way].name}, {"polygons drawn", own.polygons}, {"smooth", own.smooth},
                {"planning, ms", "{:.3f}", own.plan_ms}};
            for (std::size_t drawer = 0; drawer < renderer_modes.size(); ++drawer) {
                const double ms = own.draw_ms[drawer];
                row.push_back({fmt::format("{}, ms", renderer_modes[drawer].name), "{:.2f}", ms});
                row.push_back({fmt::format("{}, / flat", renderer_modes[drawer].name), "{:.2f}",
                    ms / times[flat_way].draw_ms[drawer]});
            }
            row.push_back({"raster: depth buffer / near to far", "{:.2f}",
                own.draw_ms[depth_drawer] / own.draw_ms[near_to_far_drawer]});
            table.add(std::move(row));
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
