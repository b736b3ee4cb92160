#pragma once

#include "ui/command_line/command.h"

namespace octant::ui::studies::program {

/// The program octant-study: one command for each study, bench and manual.
command_line::Program study_program();

} // namespace octant::ui::studies::program
