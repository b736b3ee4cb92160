#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace octant::ui::report {

/// How a program ended.
struct ProgramResult {
    bool succeeded = false;      ///< exit code 0
    std::string output;          ///< all of its standard output
    std::string errors;          ///< all of its standard error
    std::string last_error_line; ///< last line of its standard error, or how it ended
};

/// The last line of a program's output that has something in it; empty where none has.
std::string last_line_of(const std::string& text);

/// A child process that reads its standard input from us; no shell is involved. It has a process group of its own:
/// Ctrl-C reaches only us, and when we are killed it meets the end of its input and finishes in order.
class ChildProgram {
public:
    /// Starts `words[0]`, looked up on PATH, with the rest as arguments. With a `log`, its output and its errors go
    /// into that file. Nothing if there is no such program. Throws Error when the system cannot start it.
    static std::optional<ChildProgram> start(
        const std::vector<std::string>& words, const std::filesystem::path& log = {});

    /// As start(), but the system kills the program when the calling thread ends, by SIGKILL too: for programs that are
    /// stopped by signals, which could not see the end of their input, or that must not outlive us.
    static std::optional<ChildProgram> start_bound(
        const std::vector<std::string>& words, const std::filesystem::path& log);

    /// Ends the input and waits.
    ~ChildProgram();
    ChildProgram(ChildProgram&& other) noexcept;
    ChildProgram& operator=(ChildProgram&& other) noexcept;
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    /// Writes to the program's standard input, and blocks until it has read enough. Returns false once the program
    /// reads no more (it ended); raises no SIGPIPE.
    bool send(std::string_view bytes);

    /// Nothing more is sent.
    void end_input();

    /// Whether it has not ended yet. Does not wait.
    bool is_running();

    /// Sends it a signal, where it has not ended yet.
    void signal(int number);

    /// Sends a signal to all processes of its group, those that it started too, where it has not ended yet.
    void signal_group(int number);

    /// What it has written to its standard output so far.
    std::string output() const;

    /// Closes the input and waits for the program. May be called once.
    ProgramResult finish();

private:
    /// Starts a program; gives errno's value, 0 = running.
    using Starter = int (*)(pid_t& process, const std::vector<std::string>& words, const std::array<int, 3>& streams);

    ChildProgram() = default;
    static std::optional<ChildProgram> start_by(
        Starter starter, const std::vector<std::string>& words, const std::filesystem::path& log);
    int wait();

    pid_t process_ = -1;
    std::optional<int> status_; ///< once it has ended
    int input_ = -1;
    int output_ = -1;
    int error_pipe_ = -1;
};

} // namespace octant::ui::report
