#include "ui/window/status_marks.h"

#include <fmt/format.h>

namespace octant::ui::window {

std::vector<StatusMark> status_marks(const ViewState& state, const std::optional<ManualFlightStatus>& manual_flight) {
    std::vector<StatusMark> marks;
    if (state.recording) { marks.push_back({fmt::format("REC {}", state.recording->string()), true}); }
    if (!state.playback.playing && !(manual_flight && manual_flight->ended)) { marks.push_back({"paused"}); }
    const double speed = state.playback.speed;
    if (speed != 1.0) { marks.push_back({fmt::format("x{:.3g}", speed)}); }
    if (state.playback.playing && state.real_time_factor.share() < full_speed_share) {
        marks.push_back({fmt::format("x{:.2f} of real time", speed * state.real_time_factor.share()), true});
    }
    if (!manual_flight) { return marks; }
    marks.push_back({"by hand"});
    if (manual_flight->ended) {
        marks.push_back({manual_flight->off_the_map ? "LEFT THE MAP" : "MET THE GROUND", true});
        return marks;
    }
    if (manual_flight->levelling) { marks.push_back({"levelling off"}); }
    if (manual_flight->warnings.stalled) { marks.push_back({"STALL", true}); }
    if (manual_flight->warnings.is_at_limit) { marks.push_back({"LIMIT", true}); }
    return marks;
}

} // namespace octant::ui::window
