#include "ui/commands/commands.h"

#include "ui/base/version.h"

#include <fmt/format.h>
#include <utility>

namespace octant::ui::commands {

Program octant_program(Command view) {
    return {
        .about = "Octant: flies polygon aircraft along scripted paths over level-of-detail "
                 "terrain, and times it.",
        .version = fmt::format("octant {} ({})", base::program_version(), base::program_commit()),
        .footer = "Examples:\n"
                  "  octant fly pop-up --aircraft f15 --terrain canyon --record my-flight\n"
                  "  octant view turn --view cockpit\n"
                  "  octant report my-flight\n"
                  "  octant terrain info my-map.tif\n"
                  "  octant draw-order f15 --table\n"
                  "  octant refine bunny.ply --base 100 --save bunny.pm\n"
                  "  octant simplify bunny.ply small.obj --faces 1000\n"
                  "Every option with its unit and default, and examples: octant COMMAND --help.\n"
                  "All of them: octant --help-all.",
        .commands = {
            fly_command(),
            std::move(view),
            report_command(),
            terrain_command(),
            draw_order_command(),
            mesh_error_command(),
            refine_command(),
            simplify_command(),
            study_command(),
            bench_command()}};
}

} // namespace octant::ui::commands
