#pragma once

#include "sim/base/geo_position.h"
#include "sim/links/cigi_packets.h"
#include "visuals/scene/settings.h"

#include <optional>

namespace octant::ui::flight {

/// Air as a host of CIGI has it: its visibility, from 50 m to 500 km, and the time of day at that
/// longitude by its universal time; what it has not told as in `defaults`. Without a place its time is
/// taken as the sun's own.
visuals::scene::AirSettings air_from_cigi(
    visuals::scene::AirSettings defaults,
    const std::optional<sim::links::CigiAtmosphere>& atmosphere,
    const std::optional<sim::links::CigiCelestial>& celestial,
    const std::optional<GeoPosition>& place);

} // namespace octant::ui::flight
