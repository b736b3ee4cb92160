#include "ui/flight/live_environment.h"

namespace octant::ui::flight {

void apply_host_visibility(LiveFlight& live, Session& session) {
    const glm::dvec2 size_px(session.settings().view.size_px);
    live.set_aspect(size_px.x / size_px.y);
    if (!live.traffic().cigi().atmosphere()) { return; }
    const double visibility_m = live.air_of(session.settings().air).visibility_m;
    if (visibility_m != session.settings().air.visibility_m) {
        settings::RunSettings settings = session.settings();
        settings.air.visibility_m = visibility_m;
        session.apply(settings);
    }
}

std::optional<std::string> apply_host_time_of_day(const LiveFlight& live, Session& session) {
    if (session.poll_set_sun()) { return session.settings().air.time; }
    if (!live.traffic().cigi().celestial() || session.is_setting_sun()) { return std::nullopt; }
    settings::RunSettings settings = session.settings();
    settings.air.time = live.air_of(settings.air).time;
    if (settings.air.time == session.settings().air.time) { return std::nullopt; }
    if (!live.is_stepped()) {
        session.begin_set_sun(settings);
        return std::nullopt;
    }
    session.apply(settings);
    return settings.air.time;
}

void set_time_of_day(const std::string& time_of_day, Session& session) {
    settings::RunSettings settings = session.settings();
    settings.air.time = time_of_day;
    session.apply(settings);
}

} // namespace octant::ui::flight
