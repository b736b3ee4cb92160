#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/aircraft_limits.h"
#include "visuals/overlay/instrument_panel.h"

namespace octant::visuals::planning {

/// The dials that a cockpit's model (body axes, from the pilot's eye) has room for: one where its first part named
/// dial_speed, dial_altitude, dial_attitude, dial_heading or dial_load begins, as large as fits into that polygon,
/// which lies ahead and square to the x axis. Scales hold what `limits` allow. Loading work.
overlay::InstrumentLayout dials_of(const models::polygons::PolygonModel& cockpit, const sim::AircraftLimits& limits);

} // namespace octant::visuals::planning
