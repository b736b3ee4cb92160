#include "ui/flight/session_fix.h"

#include "sim/base/axes.h"
#include "sim/base/transverse_mercator.h"

#include <cmath>
#include <cstdint>
#include <optional>

namespace octant::ui::flight {

namespace links = sim::links;

namespace {

const EarthFrame& frame_of(const Session& session) {
    return frame_or_at_zero(
        session.simulation().is_live() ? session.simulation().source().frame()
                                       : session.world().ground_frame.get());
}

/// Microseconds as a clock that wraps around.
std::uint32_t ticks_at(double time_s) {
    constexpr double per_second = 1e6;
    return static_cast<std::uint32_t>(std::llround(time_s * per_second) & 0xffffffffLL);
}

} // namespace

links::Fix fix_of(const Session& session, const sim::AircraftState& state) {
    const glm::dvec3& at_m = state.position_m;
    const EarthFrame& frame = frame_of(session);
    const GeoPosition place = frame.geo_from_local(glm::dvec2(at_m.x, at_m.y));
    links::Fix fix;
    fix.latitude_deg = place.latitude_deg;
    fix.longitude_deg = place.longitude_deg;
    fix.altitude_m = at_m.z;
    if (const auto ground_m = session.world().scene.ground->height_at(at_m.x, at_m.y)) {
        fix.above_ground_m = at_m.z - *ground_m;
    }
    fix.attitude = euler_from_body_to_world(state.body_to_world);
    fix.velocity_ned_mps =
        glm::dvec3(state.velocity_mps.y, state.velocity_mps.x, -state.velocity_mps.z);
    fix.ticks = ticks_at(state.time_s);
    fix = links::with_rotated_axes(fix, -frame.place_of(place).north_bearing_rad);
    fix.attitude.heading_rad = wrapped_to_two_pi(fix.attitude.heading_rad);
    return fix;
}

std::optional<links::Fix> flown_fix(const Session& session, std::size_t aircraft) {
    const Simulation& simulation = session.simulation();
    if (simulation.is_live() && !simulation.source().is_flown(aircraft)) {
        return std::nullopt;
    }
    const links::Fix fix = fix_of(session, session.states()[aircraft]);
    return links::error_of_fix(fix) == links::PacketError::None ? std::optional(fix) : std::nullopt;
}

} // namespace octant::ui::flight
