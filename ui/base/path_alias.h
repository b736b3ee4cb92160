#pragma once

#include <filesystem>
#include <string>

namespace octant::ui::base {

/// From here on messages call `folder` and what lies in it by `name`, as files that were unpacked into a folder of the
/// program's own by the packed file that the user named.
void set_path_alias(const std::filesystem::path& folder, const std::string& name);

/// A message with folders called by the names that set_path_alias() gave them.
std::string with_path_aliases(std::string text);

} // namespace octant::ui::base
