#pragma once

#include "ui/commands/option.h"
#include "ui/settings/settings.h"

#include <string>
#include <vector>

namespace octant::ui::commands {

/// Adds --settings FILE and then one option for every setting, each under the heading of its group. The file is read
/// first, so that the others override it. The path is the word without dashes. `given` gets the names of those that
/// stand on the command line; null = nobody asks.
void add_setting_options(
    std::vector<Option>& options, settings::RunSettings& settings, std::vector<std::string>* given = nullptr);

} // namespace octant::ui::commands
