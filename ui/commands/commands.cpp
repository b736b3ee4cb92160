#include "ui/commands/commands.h"

#include "ui/base/version.h"
#include "ui/world/mesh_loader.h"

#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace octant::ui::commands {

Program octant_program(std::vector<Command> window_commands) {
    Program program{.about = "Octant: flies polygon aircraft along scripted paths over level-of-detail "
                             "terrain, and times it.",
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
                  "Every option with its unit and default, and examples: octant COMMAND --help.\n"
                  "All of them: octant --help-all.",
        .commands = {fly_command(), report_command(), pack_command(), terrain_command(), draw_order_command(),
            mesh_error_command(), model_command(), refine_command(), simplify_command(), sweep_command(),
            study_command(), bench_command()}};
    constexpr std::ptrdiff_t after_fly = 1;
    program.commands.insert(program.commands.begin() + after_fly, std::make_move_iterator(window_commands.begin()),
        std::make_move_iterator(window_commands.end()));
    program.commands.push_back(manual_command(std::make_shared<const Program>(program)));
    return program;
}

} // namespace octant::ui::commands
