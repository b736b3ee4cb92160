#pragma once

#include "visuals/scene/settings.h"

namespace CLI {
class App;
}

namespace octant::ui {

/// Adds one option for every setting, and --settings FILE, which is read before the others so that
/// they override it. The first word without dashes is the path when `path_is_positional`. A wrong
/// value throws Error while the command line is parsed.
void add_setting_options(
    CLI::App& command, visuals::scene::Settings& settings, bool path_is_positional);

} // namespace octant::ui
