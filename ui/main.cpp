// octant: flies, shows and records; tools for terrain, models and meshes. It starts octant-study and octant-verify.
#include "ui/command_line/command_line.h"
#include "ui/commands/commands.h"
#include "visuals/gl/platform_tuning.h"

int main(int argc, char** argv) {
    octant::visuals::gl::tune_allocator(); // before any memory is allocated: frames by the software GL driver get
                                           // faster
    return octant::ui::command_line::run_program("octant", octant::ui::commands::octant_program, argc, argv);
}
