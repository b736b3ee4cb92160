#pragma once

#include "ui/commands/command.h"

namespace octant::ui::window {

/// The command that opens windows. It needs a display; Error where there is none.
commands::Command view_command();

} // namespace octant::ui::window
