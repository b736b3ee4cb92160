#pragma once

#include "ui/commands/command.h"

namespace octant::ui::window {

/// The command that opens windows. It needs a display; Error where there is none.
commands::Command view_command();

/// The command that shows what other programs fly, in a window or without one.
commands::Command listen_command();

} // namespace octant::ui::window
