#pragma once

#include <string>

namespace octant::ui::base {

/// A file name as JSON can carry it. Names that are not UTF-8, which JSON has no letters for, and those that look like
/// such a one are written as "bytes:" with the strange bytes as %E9; all others stay as they are.
std::string json_from_file_name(const std::string& name);

/// The name again, byte for byte.
std::string file_name_from_json(const std::string& text);

} // namespace octant::ui::base
