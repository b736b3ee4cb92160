#include "ui/studies/draw_order/surface_race.h"

#include "ui/base/progress.h"
#include "ui/flight/session.h"
#include "ui/report/frame_times.h"
#include "ui/report/statistics.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace octant::ui::studies::draw_order {

namespace {

constexpr int warm_up_frames = 20;

RaceTimes figures_of(const std::vector<double>& frame_ms, std::vector<int> draw_calls) {
    const report::Statistics times = report::statistics_of_times(frame_ms);
    std::nth_element(
        draw_calls.begin(), draw_calls.begin() + static_cast<std::ptrdiff_t>(draw_calls.size() / 2), draw_calls.end());
    return {times.p50_ms, times.p99_ms, draw_calls[draw_calls.size() / 2]};
}

} // namespace

Race race(const settings::RunSettings& settings, int frames, bool quiet) {
    std::array<std::unique_ptr<flight::Session>, raced_methods.size()> sessions;
    std::array<std::vector<double>, raced_methods.size()> frame_ms;
    std::array<std::vector<int>, raced_methods.size()> draw_calls;
    for (std::size_t mode = 0; mode < raced_methods.size(); ++mode) {
        settings::RunSettings own = settings;
        own.surface.hidden_surface = raced_methods[mode];
        own.time.frames = frames + warm_up_frames;
        own.drawing.renderer = settings::RendererKind::Gl; // whose depth buffer is a tuned one
        sessions[mode] = std::make_unique<flight::Session>(own);
    }
    std::vector<std::unique_ptr<flight::Session>> raster_sessions;
    for (const RasterMode& mode : raster_modes) {
        settings::RunSettings own = settings;
        own.time.frames = frames + warm_up_frames;
        raster_sessions.push_back(raster_session(own, mode));
    }
    Race raced;
    raced.scene = settings.path.terrain;
    raced.aircraft = static_cast<int>(settings.path.aircraft.size());
    raced.width_px = settings.view.size_px.x;
    raced.height_px = settings.view.size_px.y;
    base::Progress progress(
        fmt::format("{}, {} aircraft, {}x{}", raced.scene, raced.aircraft, raced.width_px, raced.height_px),
        sessions[0]->frames(), quiet);
    for (int frame = 0; frame < sessions[0]->frames(); ++frame) {
        for (std::size_t turn = 0; turn < raced_methods.size(); ++turn) {
            const std::size_t mode = (turn + static_cast<std::size_t>(frame)) % raced_methods.size();
            const report::FrameRecord record = sessions[mode]->draw(frame);
            if (frame >= warm_up_frames) {
                frame_ms[mode].push_back(record.frame_ms);
                draw_calls[mode].push_back(record.draw_calls);
            }
        }
        for (std::size_t turn = 0; turn < raster_modes.size(); ++turn) {
            const std::size_t mode = (turn + static_cast<std::size_t>(frame)) % raster_modes.size();
            const report::FrameRecord record = raster_sessions[mode]->draw(frame);
            if (frame >= warm_up_frames) { raced.raster.add(mode, record); }
        }
        progress.show(frame + 1);
    }
    progress.finish();
    for (std::size_t mode = 0; mode < raced_methods.size(); ++mode) {
        raced.gl_times[mode] = figures_of(frame_ms[mode], draw_calls[mode]);
    }
    raced.frames = static_cast<int>(frame_ms[0].size());
    return raced;
}

} // namespace octant::ui::studies::draw_order
