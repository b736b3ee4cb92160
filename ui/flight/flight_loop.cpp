#include "ui/flight/flight_loop.h"

#include "sim/base/stopwatch.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/report/statistics.h"
#include "ui/settings/frame_part.h"

#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <thread>

namespace octant::ui::flight {

std::string fly_frames(
    const settings::TimeSettings& time, bool quiet, Session& session, Sender& sender, FlightRecorder& recorder) {
    const int first = time.part ? session.begin_frame_range(*settings::part_from_text(*time.part)).first : 0;
    const int count = session.frames() - first;
    base::Progress progress(session.world().flight.title, count, quiet);
    for (const std::string& line : sender.wait_for_channels(session)) { base::print_note(false, line); }
    const Stopwatch since_start;
    int frame = first;
    for (; frame < session.frames() && !(base::StopSignals::received() && frame > first); ++frame) {
        const double due_s = (frame - first) / session.rate_hz();
        if (time.realtime) { std::this_thread::sleep_for(std::chrono::duration<double>(due_s - since_start.s())); }
        report::FrameRecord record = session.draw(frame);
        if (time.realtime) {
            const double late_s = since_start.s() - due_s;
            record.latency_ms = 1000.0 * late_s;
            record.missed = late_s > 1.0 / session.rate_hz() ? 1 : 0;
        }
        sender.send(session);
        record.skew_frames = sender.wait_for_pictures();
        recorder.add(record, session);
        progress.show(frame + 1 - first, fmt::format("{:.1f} ms", record.frame_ms));
    }
    progress.finish();
    for (const std::string& line : sender.channel_lines()) { base::print_note(false, line); }
    return frame == session.frames()
               ? std::string()
               : fmt::format("{} after {} of {} frames", base::StopSignals::name(), frame - first, count);
}

void print_result(const FlightResult& result, const std::optional<ReplayComparison>& comparison, bool json,
    const base::JsonValue::JsonMembers& extra_results) {
    if (json) {
        base::JsonValue object = report::json_of(report::all_statistics(), result.statistics);
        object["state_hash"] = report::hash_text(result.state_hash);
        object["picture_hash"] = report::hash_text(result.picture_hash);
        if (comparison) {
            object["replay"] = {{"state_hash", comparison->state_hash}, {"picture_hash", comparison->picture_hash}};
        }
        for (const auto& [name, value] : extra_results) { object[name] = value; }
        base::print_value(object, true);
        return;
    }
    const auto print_row = [](std::string_view name, const std::string& value) {
        std::fputs(fmt::format("{:<28} {}\n", name, value).c_str(), stdout);
    };
    for (const report::Statistic& statistic : report::all_statistics()) {
        print_row(statistic.name, report::statistic_text(statistic, result.statistics));
    }
    print_row("state hash", report::hash_text(result.state_hash));
    print_row("picture hash", report::hash_text(result.picture_hash));
    if (comparison) { print_row("replay", comparison->line); }
}

} // namespace octant::ui::flight
