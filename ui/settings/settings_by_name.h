#pragma once

#include "ui/settings/settings.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::settings {

/// Sets one setting by its name, as words on a command line would; only lists take several. Throws Error "NAME:
/// expected ..., got ..." and for a name that no setting has.
void set_by_name(RunSettings& settings, std::string_view name, const std::vector<std::string>& words);

/// Names files that lie where the settings say when looked for from `folder` as they are to be found from here.
/// Built-in names come first; what does not lie there stays.
void resolve_paths_from(const std::filesystem::path& folder, RunSettings& settings);

} // namespace octant::ui::settings
