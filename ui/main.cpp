#include "sim/base/error.h"
#include "ui/commands.h"
#include "ui/version.h"
#include "visuals/gl/platform_tuning.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <string>

namespace {

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
        fmt::format("octant {} ({})", octant::ui::program_version(), octant::ui::program_commit()));
    program.require_subcommand(1);
    program.get_formatter()->column_width(34);
    program.footer(
        "Examples:\n"
        "  octant fly pop-up --aircraft f15 --terrain canyon --record my-flight\n"
        "  octant report my-flight\n"
        "  octant terrain info my-map.tif\n"
        "octant COMMAND --help shows every option with its unit, default and an example.");
    octant::ui::add_fly_command(program);
    octant::ui::add_report_command(program);
    octant::ui::add_terrain_command(program);
    octant::ui::add_study_command(program);
    octant::ui::add_bench_command(program);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& fault) {
        if (fault.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
            return program.exit(fault);
        }
        return fail(fault.what());
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    octant::visuals::gl::tune_allocator();
    try {
        return run(argc, argv);
    } catch (const octant::Error& fault) {
        return fail(fault.what());
    } catch (const octant::ui::CheckSaidNo&) {
        return 1;
    } catch (const std::bad_alloc&) {
        return fail("expected enough memory for this input, got none");
    } catch (const std::exception& fault) {
        return fail(fault.what());
    }
}
