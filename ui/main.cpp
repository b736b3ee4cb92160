#include "sim/base/utf8.h"
#include "ui/base/data_files.h"
#include "ui/base/stop_signals.h"
#include "ui/commands/command_line.h"
#include "ui/commands/commands.h"
#include "ui/report/packed_recording.h"
#include "ui/window/window_commands.h"
#include "visuals/gl/platform_tuning.h"
#include "visuals/groundfile/tile_damage_log.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <new>
#include <string>

namespace {

constexpr int exit_check_failed = 1;
constexpr int exit_invalid_input = 2;

int print_error(const std::string& line) {
    const std::string named = octant::ui::base::with_path_aliases(line);
    std::fputs(fmt::format("octant: {}\n", octant::one_line(named)).c_str(), stderr);
    return exit_invalid_input;
}

/// Parses the command line and runs the command that it names. Returns the exit code.
int run(int argc, char** argv) {
    using namespace octant::ui;
    const commands::Program program = commands::octant_program({window::view_command(), window::listen_command()});
    int code = 0;
    try {
        const std::function<void()> run_command = commands::parse_command_line(program, argc, argv);
        run_command();
    } catch (const commands::CheckFailed&) { code = exit_check_failed; } catch (const base::StoppedBySignal&) {
        return code; // main() ends the program by the signal
    }
    for (const std::string& line : octant::visuals::groundfile::tile_damage_messages()) {
        std::fputs(fmt::format("octant: {}\n", line).c_str(), stderr);
        code = exit_check_failed;
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        return print_error(fmt::format("results cannot be written to standard output: {}", std::strerror(errno)));
    }
    return code;
}

} // namespace

// The state of the whole process is read and ended here alone: the signal that came, unpacked recordings, the names of
// their folders, and what was wrong with the ground's tiles.
int main(int argc, char** argv) {
    octant::visuals::gl::tune_allocator(); // before anything is allocated
    std::signal(SIGXFSZ, SIG_IGN);         // a file that grows too large is a write error, told in one line
    std::signal(SIGCHLD, SIG_DFL);         // child programs are waited for
    try {
        const int code = run(argc, argv);
        octant::ui::report::remove_unpacked();
        octant::ui::base::exit_by_received_signal();
        return code;
    } catch (const std::bad_alloc&) {
        std::fputs("octant: expected enough memory for this input, got none\n", stderr);
        return exit_invalid_input;
    } catch (const std::filesystem::filesystem_error& fault) {
        return print_error(fmt::format("{}: {}", fault.path1().string(), fault.code().message()));
    } catch (const std::exception& fault) { return print_error(fault.what()); }
}
