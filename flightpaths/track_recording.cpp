#include "flightpaths/track_recording.h"

#include <fmt/format.h>

namespace octant::flightpaths {

std::string_view text_of(HeightKind kind) {
    switch (kind) {
    case HeightKind::Sea:
        return "above the sea";
    case HeightKind::Ellipsoid:
        return "above the ellipsoid of WGS 84";
    case HeightKind::Pressure:
        return "pressure heights of the standard atmosphere";
    case HeightKind::AboveGround:
        return "above the ground";
    case HeightKind::Absent:
        return "none";
    case HeightKind::Unknown:
        break;
    }
    return "as recorded, above the sea as the file seems to mean";
}

std::string display_name(const TrackedAircraft& aircraft, std::size_t index) {
    for (const std::string* name : {&aircraft.call_sign, &aircraft.name, &aircraft.id}) {
        if (!name->empty()) { return *name; }
    }
    return fmt::format("aircraft {}", index + 1);
}

} // namespace octant::flightpaths
