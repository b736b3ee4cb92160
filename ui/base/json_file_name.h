#pragma once

#include <string>

namespace octant::ui::base {

/// Encodes a file name for JSON. A name that is not UTF-8, or that begins with "bytes:", becomes "bytes:" followed by the
/// name with its other bytes as %E9. All other names are unchanged.
std::string json_from_file_name(const std::string& name);

/// Decodes json_from_file_name(): the original name, byte for byte.
std::string file_name_from_json(const std::string& text);

} // namespace octant::ui::base
