#pragma once

#include <string>

namespace octant::ui::base {

/// Version of the program, such as "0.1.0".
std::string program_version();

/// Commit it was built from, with "+" when the tree had changes; "unknown" outside a checkout.
std::string program_commit();

} // namespace octant::ui::base
