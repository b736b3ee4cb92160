#pragma once

#include "ui/settings/settings.h"
#include "ui/settings/settings_text.h"

namespace CLI {
class App;
}

namespace octant::ui::commands {

/// Adds one option for every setting, and --settings FILE, which is read before the others so that
/// they override it. The first word without dashes is the path when `path_is_positional`. A wrong
/// value throws Error while the command line is parsed.
void add_setting_options(CLI::App& command, settings::Settings& settings, bool path_is_positional);

/// Adds an option for one number within the bounds of `info`, read as settings are ("nan" is none),
/// among the command's own. Its default is shown in words where `info.meaning` ends with [words].
void add_number_option(CLI::App& command, const settings::FieldInfo& info, double& value);
void add_number_option(CLI::App& command, const settings::FieldInfo& info, int& value);

} // namespace octant::ui::commands
