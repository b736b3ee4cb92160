#pragma once

#include "ui/commands/option.h"
#include "ui/settings/settings.h"

#include <vector>

namespace octant::ui::commands {

/// Adds --settings FILE and then one option for every setting, each under the heading of its group.
/// The file is read first, so that the others override it. The path is the word without dashes.
void add_setting_options(std::vector<Option>& options, settings::RunSettings& settings);

} // namespace octant::ui::commands
