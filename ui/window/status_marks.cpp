#include "ui/window/status_marks.h"

#include <fmt/format.h>

namespace octant::ui::window {

std::vector<StatusMark>
status_marks(const ViewState& state, const std::optional<HandStatus>& hand) {
    std::vector<StatusMark> marks;
    if (state.recording) {
        marks.push_back({fmt::format("REC {}", state.recording->string()), true});
    }
    if (!state.playback.playing && !(hand && hand->ended)) {
        marks.push_back({"paused"});
    }
    const double speed = state.playback.speed;
    if (speed != 1.0) {
        marks.push_back({fmt::format("x{:.3g}", speed)});
    }
    if (state.playback.playing && state.pace.share() < full_pace) {
        marks.push_back({fmt::format("x{:.2f} of real time", speed * state.pace.share()), true});
    }
    if (!hand) {
        return marks;
    }
    marks.push_back({"by hand"});
    if (hand->ended) {
        marks.push_back({hand->off_the_map ? "LEFT THE MAP" : "MET THE GROUND", true});
        return marks;
    }
    if (hand->levelling) {
        marks.push_back({"levelling off"});
    }
    if (hand->warnings.stalled) {
        marks.push_back({"STALL", true});
    }
    if (hand->warnings.at_a_limit) {
        marks.push_back({"LIMIT", true});
    }
    return marks;
}

} // namespace octant::ui::window
