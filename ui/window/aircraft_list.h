#pragma once

#include <string>
#include <vector>

namespace octant::ui::window {

/// Returns `aircraft`, which is not empty, with `count` >= 1 members: the last ones are left out, or more of the first
/// kind are added.
std::vector<std::string> with_aircraft_count(std::vector<std::string> aircraft, int count);

/// Returns `aircraft` with the first one, and all others of its kind, replaced by `leader`.
std::vector<std::string> with_lead_aircraft(std::vector<std::string> aircraft, const std::string& leader);

} // namespace octant::ui::window
