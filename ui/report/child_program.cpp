#include "ui/report/child_program.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace octant::ui::report {

namespace {

void close_if_open(int& descriptor) {
    if (descriptor >= 0) { ::close(std::exchange(descriptor, -1)); }
}

/// From the beginning, without moving the place where the program writes.
std::string all_of(int descriptor) {
    std::string text;
    std::array<char, 65536> piece{};
    while (true) {
        const ssize_t got = ::pread(descriptor, piece.data(), piece.size(), static_cast<off_t>(text.size()));
        if (got > 0) {
            text.append(piece.data(), static_cast<std::size_t>(got));
        } else if (got == 0 || errno != EINTR) {
            return text;
        }
    }
}

std::string exit_text(int status) {
    if (WIFSIGNALED(status)) { return fmt::format("ended by signal {}", WTERMSIG(status)); }
    return fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

/// For exec and spawn, which do not write to them.
std::vector<char*> pointers_to(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words) { arguments.push_back(const_cast<char*>(word.c_str())); }
    arguments.push_back(nullptr);
    return arguments;
}

/// Spawns with standard input, output and error set. Returns errno's value, 0 = running.
int spawn(pid_t& process, const std::vector<std::string>& words, const std::array<int, 3>& streams) {
    const std::vector<char*> arguments = pointers_to(words);
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    for (int i = 0; i < 3; ++i) { posix_spawn_file_actions_adddup2(&actions, streams[static_cast<std::size_t>(i)], i); }
    posix_spawnattr_t attributes{};
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    const int code = posix_spawnp(&process, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return code;
}

/// As spawn(), but the program asks the system for SIGKILL when the thread that started it ends, which spawn cannot.
int fork_bound(pid_t& process, const std::vector<std::string>& words, const std::array<int, 3>& streams) {
    const std::vector<char*> arguments = pointers_to(words);
    const pid_t parent = ::getpid();
    std::array<int, 2> failure{-1, -1}; // its end says that the program runs
    if (::pipe2(failure.data(), O_CLOEXEC) != 0) { return errno; }
    process = ::fork();
    if (process == 0) {
        ::setpgid(0, 0);
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) { ::_exit(1); }
        for (int i = 0; i < 3; ++i) { ::dup2(streams[static_cast<std::size_t>(i)], i); }
        ::execvp(arguments[0], arguments.data());
        const int code = errno;
        const ssize_t told = ::write(failure[1], &code, sizeof code);
        ::_exit(told > 0 ? 1 : 2);
    }
    int code = process < 0 ? errno : 0;
    ::close(failure[1]);
    while (process > 0 && ::read(failure[0], &code, sizeof code) < 0 && errno == EINTR) {}
    ::close(failure[0]);
    if (process > 0 && code != 0) { ::waitpid(process, nullptr, 0); }
    return code;
}

} // namespace

std::string last_line_of(const std::string& text) {
    std::string_view last;
    for (const std::string_view line : split_lines(text)) {
        if (!split_words(line).empty()) { last = line; }
    }
    return std::string(last);
}

std::optional<ChildProgram> ChildProgram::start(
    const std::vector<std::string>& words, const std::filesystem::path& log) {
    return start_by(spawn, words, log);
}

std::optional<ChildProgram> ChildProgram::start_bound(
    const std::vector<std::string>& words, const std::filesystem::path& log) {
    return start_by(fork_bound, words, log);
}

std::optional<ChildProgram> ChildProgram::start_by(
    Starter starter, const std::vector<std::string>& words, const std::filesystem::path& log) {
    assert(!words.empty());
    ChildProgram child;
    // A socket rather than a pipe: send() can be told not to raise SIGPIPE.
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw Error(fmt::format("{} cannot be started: {}", words[0], std::strerror(errno)));
    }
    child.input_ = ends[0];
    child.output_ = log.empty() ? ::memfd_create("output", MFD_CLOEXEC)
                                : ::open(log.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (child.output_ < 0 && !log.empty()) {
        throw_error_in(log, fmt::format("cannot be written: {}", std::strerror(errno)));
    }
    child.error_pipe_ =
        log.empty() ? ::memfd_create("complaints", MFD_CLOEXEC) : ::fcntl(child.output_, F_DUPFD_CLOEXEC, 0);
    const int code = child.output_ < 0 || child.error_pipe_ < 0
                         ? errno
                         : starter(child.process_, words, {ends[1], child.output_, child.error_pipe_});
    ::close(ends[1]);
    if (code == 0) { return child; }
    child.process_ = -1;
    if (code == ENOENT || code == EACCES || code == ENOTDIR) { return std::nullopt; }
    throw Error(fmt::format("{} cannot be started: {}", words[0], std::strerror(code)));
}

ChildProgram::~ChildProgram() {
    close_if_open(input_);
    wait();
    close_if_open(output_);
    close_if_open(error_pipe_);
}

ChildProgram::ChildProgram(ChildProgram&& other) noexcept
    : process_(std::exchange(other.process_, -1)), status_(other.status_), input_(std::exchange(other.input_, -1)),
      output_(std::exchange(other.output_, -1)), error_pipe_(std::exchange(other.error_pipe_, -1)) {}

ChildProgram& ChildProgram::operator=(ChildProgram&& other) noexcept {
    std::swap(process_, other.process_);
    std::swap(status_, other.status_);
    std::swap(input_, other.input_);
    std::swap(output_, other.output_);
    std::swap(error_pipe_, other.error_pipe_);
    return *this;
}

bool ChildProgram::send(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) { continue; }
        if (sent < 0) { return false; }
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

int ChildProgram::wait() {
    int status = status_.value_or(0);
    if (process_ > 0 && !status_) {
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {}
    }
    process_ = -1;
    return status;
}

void ChildProgram::end_input() { close_if_open(input_); }

bool ChildProgram::is_running() {
    int status = 0;
    if (process_ > 0 && !status_ && ::waitpid(process_, &status, WNOHANG) == process_) { status_ = status; }
    return process_ > 0 && !status_;
}

void ChildProgram::signal(int number) {
    if (is_running()) { ::kill(process_, number); }
}

void ChildProgram::signal_group(int number) {
    if (is_running()) { ::kill(-process_, number); }
}

std::string ChildProgram::output() const { return all_of(output_); }

ProgramResult ChildProgram::finish() {
    assert(process_ > 0);
    end_input();
    const int status = wait();
    ProgramResult ending;
    ending.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    ending.output = all_of(output_);
    ending.errors = all_of(error_pipe_);
    ending.last_error_line = last_line_of(ending.errors);
    if (ending.last_error_line.empty() && !ending.succeeded) { ending.last_error_line = exit_text(status); }
    return ending;
}

} // namespace octant::ui::report
