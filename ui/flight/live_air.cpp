#include "ui/flight/live_air.h"

namespace octant::ui::flight {

void follow_visibility(LiveFlight& live, Session& session) {
    const glm::dvec2 size_px(session.settings().view.size_px);
    live.set_aspect(size_px.x / size_px.y);
    if (!live.traffic().cigi().atmosphere()) {
        return;
    }
    const double visibility_m = live.air_of(session.settings().air).visibility_m;
    if (visibility_m != session.settings().air.visibility_m) {
        settings::RunSettings settings = session.settings();
        settings.air.visibility_m = visibility_m;
        session.apply(settings);
    }
}

std::optional<std::string> follow_sun(const LiveFlight& live, Session& session) {
    if (session.take_light()) {
        return session.settings().air.time;
    }
    if (!live.traffic().cigi().celestial() || session.is_relighting()) {
        return std::nullopt;
    }
    settings::RunSettings settings = session.settings();
    settings.air.time = live.air_of(settings.air).time;
    if (settings.air.time == session.settings().air.time) {
        return std::nullopt;
    }
    if (!live.is_stepped()) {
        session.relight_beside(settings);
        return std::nullopt;
    }
    session.apply(settings);
    return settings.air.time;
}

void bring_sun_to(const std::string& time_of_day, Session& session) {
    settings::RunSettings settings = session.settings();
    settings.air.time = time_of_day;
    session.apply(settings);
}

} // namespace octant::ui::flight
