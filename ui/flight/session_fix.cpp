#include "ui/flight/session_fix.h"

#include "flightpaths/local_tangent.h"
#include "sim/base/axes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace octant::ui::flight {

namespace links = sim::links;

namespace {

GeoPlace origin_of(const Session& session) {
    std::optional<GeoPlace> place = session.world().ground_place;
    if (session.simulation().is_live()) {
        place = session.simulation().source().origin();
    }
    return place.value_or(GeoPlace());
}

/// Microseconds as a clock that wraps around.
std::uint32_t ticks_at(double time_s) {
    constexpr double per_second = 1e6;
    return static_cast<std::uint32_t>(std::llround(time_s * per_second) & 0xffffffffLL);
}

} // namespace

links::Fix fix_of(const Session& session, const sim::AircraftState& state) {
    const glm::dvec3& at_m = state.position_m;
    const GeoPlace place =
        flightpaths::geo_from_local(origin_of(session), glm::dvec2(at_m.x, at_m.y));
    links::Fix fix;
    fix.latitude_deg = std::clamp(place.latitude_deg, -90.0, 90.0);
    fix.longitude_deg = place.longitude_deg;
    fix.altitude_m = at_m.z;
    if (const auto ground_m = session.world().scene.ground->height_at(at_m.x, at_m.y)) {
        fix.above_ground_m = at_m.z - *ground_m;
    }
    fix.attitude = euler_from_body_to_world(state.body_to_world);
    fix.velocity_ned_mps =
        glm::dvec3(state.velocity_mps.y, state.velocity_mps.x, -state.velocity_mps.z);
    fix.ticks = ticks_at(state.time_s);
    return fix;
}

} // namespace octant::ui::flight
