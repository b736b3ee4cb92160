#include "ui/studies/hybrid_shading/shading_times.h"

#include "ui/base/progress.h"
#include "ui/flight/session.h"
#include "ui/report/frame_times.h"
#include "ui/report/statistics.h"

#include <array>
#include <fmt/format.h>
#include <memory>

namespace octant::ui::studies::hybrid_shading {

namespace scene = visuals::scene;

namespace {

constexpr int frames = 100;
constexpr int warm_up_frames = 10;

struct Way {
    const char* name;
    scene::AircraftShading shading;
    double share = 1.0;
    scene::HybridRule rule = scene::HybridRule::Error;
};

constexpr std::array ways{
    Way{"flat", scene::AircraftShading::Flat},
    Way{"hybrid, 20 %", scene::AircraftShading::Hybrid, 0.2},
    Way{"hybrid, 20 %, paper's rule",
        scene::AircraftShading::Hybrid,
        0.2,
        scene::HybridRule::Paper},
    Way{"hybrid, 50 %", scene::AircraftShading::Hybrid, 0.5},
    Way{"Gouraud", scene::AircraftShading::Gouraud}};

settings::RunSettings settings_of(const std::string& aircraft, const Way& way) {
    settings::RunSettings settings;
    settings.path.name = "turn";
    settings.view.kind = scene::View::Orbit; // so that the choice changes
    settings.path.terrain = "none";
    settings.path.aircraft = {aircraft};
    settings.time.frames = frames;
    settings.time.warm_up = 0;
    settings.drawing.renderer = settings::RendererKind::Gl; // where Gouraud shading has its price
    settings.shading.kind = way.shading;
    settings.shading.rule = way.rule;
    settings.shading.far_m = 1e6; // by the share alone
    settings.shading.smooth_share = way.share;
    return settings;
}

struct Medians {
    std::vector<double> frame_ms;
    std::vector<double> plan_ms;
    int polygons = 0;
    int smooth = 0;

    static double of(const std::vector<double>& times_ms) {
        return report::statistics_of_times(times_ms).p50_ms;
    }
};

std::array<Medians, ways.size()> measured(const std::string& aircraft, bool quiet) {
    std::array<std::unique_ptr<flight::Session>, ways.size()> sessions;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        sessions[way] = std::make_unique<flight::Session>(settings_of(aircraft, ways[way]));
    }
    std::array<Medians, ways.size()> medians;
    base::Progress progress(fmt::format("{} flown", aircraft), frames, quiet);
    for (int frame = 0; frame < frames; ++frame) {
        for (std::size_t turn = 0; turn < ways.size(); ++turn) {
            const std::size_t way = (turn + static_cast<std::size_t>(frame)) % ways.size();
            const report::FrameRecord record = sessions[way]->draw(frame);
            if (frame >= warm_up_frames) {
                medians[way].frame_ms.push_back(record.frame_ms);
                medians[way].plan_ms.push_back(record.plan_ms - record.refine_ms);
                medians[way].polygons = record.aircraft_polygons;
                medians[way].smooth = record.smooth_polygons;
            }
        }
        progress.show(frame + 1);
    }
    progress.finish();
    return medians;
}

} // namespace

report::HtmlTable shading_times_table(std::span<const std::string> aircraft, bool quiet) {
    report::HtmlTable table;
    table.title = "Frame times flown, by OSMesa";
    table.header = {
        "aircraft", "shading", "polygons drawn", "smooth", "frame, ms", "of it planning, ms"};
    for (const std::string& each : aircraft) {
        const auto medians = measured(each, quiet);
        for (std::size_t way = 0; way < ways.size(); ++way) {
            table.rows.push_back(
                {std::filesystem::path(each).stem().string(),
                 ways[way].name,
                 fmt::format("{}", medians[way].polygons),
                 fmt::format("{}", medians[way].smooth),
                 fmt::format("{:.2f}", Medians::of(medians[way].frame_ms)),
                 fmt::format("{:.3f}", Medians::of(medians[way].plan_ms))});
        }
    }
    table.note = fmt::format(
        "Medians of {} frames of the path turn without ground, orbit view, 1280 x 720, the ways "
        "frame by frame beside each other. Counts are the last frame's: of polygon models those in "
        "view of the eye's cell and the smooth ones of the whole model, of meshes triangles as "
        "they are refined. Planning: without refining; the choice of smooth polygons and the "
        "writing of refined meshes included. Times are the machine's, not the same twice.",
        frames - warm_up_frames);
    return table;
}

} // namespace octant::ui::studies::hybrid_shading
