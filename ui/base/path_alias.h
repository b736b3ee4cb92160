#pragma once

#include <filesystem>
#include <string>

namespace octant::ui::base {

/// Sets the name that messages show in place of `folder` and of the paths below it. A packed recording is unpacked into a
/// temporary folder; messages then name the packed file that the user gave.
void set_path_alias(const std::filesystem::path& folder, const std::string& name);

/// `text` with each aliased folder replaced by its name.
std::string with_path_aliases(std::string text);

} // namespace octant::ui::base
