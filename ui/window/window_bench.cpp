#include "ui/window/window_bench.h"

#include "ui/base/progress.h"
#include "ui/base/stopwatch.h"
#include "ui/report/frame_times.h"
#include "ui/report/statistics.h"

#include <algorithm>
#include <vector>

namespace octant::ui::window {

namespace {

constexpr int warm_up_frames = 20;

WindowTimes times_of(const std::vector<double>& frame_ms) {
    const report::Statistics statistics = report::statistics_of_times(frame_ms);
    return {statistics.p50_ms, statistics.p99_ms};
}

ViewOptions without_vsync_and_realtime(ViewOptions options) {
    options.vsync = false;
    options.config_folder.clear();
    return options;
}

} // namespace

WindowBench bench_window(const ViewOptions& options, int frames, bool quiet) {
    Viewer viewer(without_vsync_and_realtime(options));
    settings::RunSettings settings = viewer.session().settings();
    settings.drawing.context = settings::ContextKind::OsMesa;
    flight::Session session(settings);
    const int count = std::min(frames + warm_up_frames, session.frames());
    viewer.state().playback.speed = 0.5;
    viewer.state().open.timing = true;
    std::vector<double> without;
    std::vector<double> hidden;
    std::vector<double> open;
    base::Progress progress("window", count, quiet);
    for (int frame = 0; frame < count; ++frame) {
        const auto timed = [&](std::vector<double>& all, const auto& work) {
            const base::Stopwatch watch;
            work();
            if (frame >= warm_up_frames) {
                all.push_back(watch.ms());
            }
        };
        timed(without, [&] { session.draw(frame); });
        viewer.state().open.shown = false;
        timed(hidden, [&] { viewer.run_frame(); });
        viewer.state().open.shown = true;
        timed(open, [&] { viewer.run_frame(); });
        progress.show(frame + 1);
    }
    progress.finish();
    return {times_of(without), times_of(hidden), times_of(open)};
}

} // namespace octant::ui::window
