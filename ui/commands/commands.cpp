#include "ui/commands/commands.h"

#include "ui/base/version.h"
#include "ui/command_line/manual.h"
#include "ui/world/mesh_loader.h"

#include <fmt/format.h>

namespace octant::ui::commands {

using command_line::Command;
using command_line::Program;

Program octant_program() {
    Program program{.name = "octant",
        .about = "Flies polygon aircraft along scripted paths over level-of-detail terrain, and times it.",
        .version = fmt::format("octant {} ({})\nmeshes of .ac .glb .gltf .obj .ply .stl .wrl\n{}",
            base::program_version(), base::program_commit(), world::library_formats()),
        .footer = "Examples:\n"
                  "  octant fly pop-up --aircraft f15 --terrain canyon --record my-flight\n"
                  "  octant view turn --view cockpit\n"
                  "  octant report my-flight\n"
                  "  octant terrain info my-map.tif\n"
                  "  octant draw-order f15 --table\n"
                  "  octant refine bunny.ply --base 100 --save bunny.pm\n"
                  "  octant simplify bunny.ply small.obj --faces 1000\n"
                  "A flag takes =true and =false, too: --scenery=false is --no-scenery.\n"
                  "Another NAME starts the program octant-NAME, as git does.\n"
                  "Every option with its unit and default, and examples: octant COMMAND --help.\n"
                  "All of them: octant --help-all.",
        .commands = {fly_command(), view_command(), listen_command(), report_command(), compare_command(),
            pack_command(), sweep_command(), dataset_command(), terrain_command(), track_command(), model_command(),
            draw_order_command(), simplify_command(), refine_command(), mesh_error_command(),
            Command{.name = "study",
                .summary = "Repeats the experiment of a paper and prints its results next to ours (octant-study)",
                .program = {"octant-study"}},
            Command{.name = "bench",
                .summary = "Benchmarks standard scenes against a minimal baseline scene (octant-study bench)",
                .program = {"octant-study", "bench"}},
            Command{.name = "verify",
                .summary = "Checks a certificate of a painting order with exact arithmetic (octant-verify)",
                .program = {"octant-verify"}}}};
    program.commands.push_back(command_line::manual_command(program));
    return program;
}

} // namespace octant::ui::commands
