#pragma once

#include <string>
#include <vector>

namespace octant::ui::window {

/// The aircraft of a run with `count` >= 1 of them: the last ones leave, or more of the first kind
/// join. `aircraft` is not empty.
std::vector<std::string> with_count(std::vector<std::string> aircraft, int count);

/// With another kind of aircraft in front, and in place of all of the kind that was there.
std::vector<std::string> with_leader(std::vector<std::string> aircraft, const std::string& leader);

} // namespace octant::ui::window
