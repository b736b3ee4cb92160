#include "tests/ui/commands/command_line.h"

#include "sim/base/text_file.h"
#include "tests/scratch.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char** environ; // NOLINT(readability-redundant-declaration)

namespace octant::tests {

namespace {

pid_t start(const std::vector<std::string>& arguments, const std::string& out, const std::string& err) {
    std::vector<std::string> words = {OCTANT_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    std::ranges::transform(words, std::back_inserter(pointers), [](std::string& word) { return word.data(); });
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    // Shells let programs in the background ignore SIGINT.
    sigset_t usual{};
    sigemptyset(&usual);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) { sigaddset(&usual, number); }
    posix_spawnattr_t attributes{};
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t child = 0;
    const int fault = posix_spawn(&child, OCTANT_PROGRAM, &files, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (fault != 0) { throw std::runtime_error("the program cannot be started"); }
    return child;
}

int wait_for(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

} // namespace

namespace {

/// Runs it; `meanwhile` gets its process.
template <class Meanwhile>
ProgramRun run_meanwhile(const std::vector<std::string>& arguments, Meanwhile meanwhile) {
    const std::string out = (scratch_folder() / "stdout").string();
    const std::string err = (scratch_folder() / "stderr").string();
    ProgramRun run;
    const pid_t child = start(arguments, out, err);
    meanwhile(child);
    run.exit_code = wait_for(child);
    run.out = read_file(out);
    run.err = read_file(err);
    return run;
}

} // namespace

ProgramRun run_octant(const std::vector<std::string>& arguments) {
    return run_meanwhile(arguments, [](pid_t) {});
}

ProgramRun run_octant_and_signal(
    const std::vector<std::string>& arguments, const std::filesystem::path& file, int signal) {
    return run_meanwhile(arguments, [&](pid_t child) {
        for (int tenth = 0; tenth < 1200 && !std::filesystem::exists(file); ++tenth) {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        kill(child, signal);
    });
}

int lines_in(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

} // namespace octant::tests
