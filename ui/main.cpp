#include "sim/base/error.h"
#include "ui/base/version.h"
#include "ui/commands/commands.h"
#include "visuals/gl/platform_tuning.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <string>

namespace {

constexpr int check_said_no = 1;
constexpr int wrong_input = 2;

int fail(std::string line) {
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::fputs(fmt::format("octant: {}\n", line).c_str(), stderr);
    return wrong_input;
}

int run(int argc, char** argv) {
    CLI::App program("Octant: flies polygon aircraft along scripted paths over level-of-detail "
                     "terrain, and times it.");
    program.set_version_flag(
        "--version",
        fmt::format(
            "octant {} ({})",
            octant::ui::base::program_version(),
            octant::ui::base::program_commit()));
    program.require_subcommand(1);
    program.get_formatter()->column_width(34);
    program.footer(
        "Examples:\n"
        "  octant fly pop-up --aircraft f15 --terrain canyon --record my-flight\n"
        "  octant view turn --view cockpit\n"
        "  octant report my-flight\n"
        "  octant terrain info my-map.tif\n"
        "  octant draw-order f15 --table\n"
        "  octant refine bunny.ply --base 100 --save bunny.pm\n"
        "  octant simplify bunny.ply small.obj --faces 1000\n"
        "octant COMMAND --help shows every option with its unit, default and an example.");
    octant::ui::commands::add_fly_command(program);
    octant::ui::commands::add_view_command(program);
    octant::ui::commands::add_report_command(program);
    octant::ui::commands::add_terrain_command(program);
    octant::ui::commands::add_draw_order_command(program);
    octant::ui::commands::add_mesh_error_command(program);
    octant::ui::commands::add_refine_command(program);
    octant::ui::commands::add_simplify_command(program);
    octant::ui::commands::add_study_command(program);
    octant::ui::commands::add_bench_command(program);
    try {
        program.parse(argc, argv);
    } catch (const octant::ui::commands::CheckSaidNo&) {
        return check_said_no;
    } catch (const CLI::ParseError& fault) {
        if (fault.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
            return program.exit(fault);
        }
        const bool no_command = program.get_subcommands().empty();
        const std::string got = argc > 1 ? argv[1] : "none";
        return fail(
            no_command ? fmt::format(
                             "expected a command (fly, view, report, terrain, draw-order, "
                             "simplify, mesh-error, refine, study, bench), got {}",
                             got)
                       : std::string(fault.what()));
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    octant::visuals::gl::tune_allocator();
    std::signal(SIGXFSZ, SIG_IGN); // a file that grows too large is a write error, told in one line
    try {
        const int code = run(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            return fail(fmt::format(
                "results cannot be written to standard output: {}", std::strerror(errno)));
        }
        return code;
    } catch (const octant::Error& fault) {
        return fail(fault.what());
    } catch (const std::bad_alloc&) {
        return fail("expected enough memory for this input, got none");
    } catch (const std::exception& fault) {
        return fail(fault.what());
    }
}
