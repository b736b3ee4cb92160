#include "ui/window/aircraft_list.h"

#include "ui/settings/aircraft_entry.h"

#include <algorithm>
#include <cstddef>

namespace octant::ui::window {

std::vector<std::string> with_aircraft_count(std::vector<std::string> aircraft, int count) {
    const std::string first = settings::aircraft_shape(aircraft.front());
    aircraft.resize(static_cast<std::size_t>(std::max(count, 1)), first);
    return aircraft;
}

std::vector<std::string> with_lead_aircraft(std::vector<std::string> aircraft, const std::string& leader) {
    const std::string before = aircraft.front();
    std::ranges::replace(aircraft, before, leader);
    return aircraft;
}

} // namespace octant::ui::window
