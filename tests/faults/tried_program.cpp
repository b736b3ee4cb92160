#include "tests/faults/tried_program.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <new>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace octant::tests::faults {

namespace {

constexpr std::chrono::seconds longest_run(300);

/// In the child: never returns.
[[noreturn]] void become(const std::filesystem::path& program, const std::vector<std::string>& words,
    const std::filesystem::path& folder, const std::filesystem::path& errors) {
    std::vector<char*> arguments{const_cast<char*>(program.c_str())};
    for (const std::string& word : words) { arguments.push_back(const_cast<char*>(word.c_str())); }
    arguments.push_back(nullptr);
    const int error_file = ::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int nowhere = ::open("/dev/null", O_RDWR);
    if (error_file >= 0 && nowhere >= 0 && ::chdir(folder.c_str()) == 0 && ::dup2(nowhere, 0) == 0 &&
        ::dup2(nowhere, 1) == 1 && ::dup2(error_file, 2) == 2) {
        ::execv(program.c_str(), arguments.data());
    }
    ::_exit(127);
}

/// Waits; ends a child that takes too long.
int wait_for(pid_t child, bool& timed_out) {
    const auto started = std::chrono::steady_clock::now();
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        if (std::chrono::steady_clock::now() - started > longest_run) {
            timed_out = true;
            ::kill(child, SIGKILL);
            ::waitpid(child, &status, 0);
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return status;
}

} // namespace

TriedProgram::TriedProgram(
    std::filesystem::path program, std::filesystem::path preloaded, const std::filesystem::path& scratch)
    : program_(std::move(program)), preloaded_(std::move(preloaded)), counters_file_(scratch / "counters"),
      errors_file_(scratch / "errors.txt") {
    const int file = ::open(counters_file_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0 || ::ftruncate(file, sizeof(FaultCounters)) != 0) {
        throw_error_in(counters_file_, "cannot be written");
    }
    void* const mapped = ::mmap(nullptr, sizeof(FaultCounters), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (mapped == MAP_FAILED) { throw_error_in(counters_file_, "cannot be mapped"); }
    counters_ = new (mapped) FaultCounters{};
}

TriedProgram::~TriedProgram() { ::munmap(counters_, sizeof(FaultCounters)); }

RunSummary TriedProgram::run(
    const std::vector<std::string>& words, const std::filesystem::path& folder, const Fault& fault) {
    counters_->allocations = 0;
    counters_->writes = 0;
    counters_->failing_allocation = fault.kind == Fault::Kind::Allocation ? fault.point : 0;
    counters_->failing_write = fault.kind == Fault::Kind::Write ? fault.point : 0;
    counters_->goes_on = fault.goes_on ? 1 : 0;
    const pid_t child = ::fork();
    if (child < 0) { throw Error("expected to start a child process, got none"); }
    if (child == 0) {
        ::setenv("LD_PRELOAD", preloaded_.c_str(), 1);
        ::setenv(counters_variable, counters_file_.c_str(), 1);
        become(program_, words, folder, errors_file_);
    }
    RunSummary end;
    const int status = wait_for(child, end.timed_out);
    end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    end.errors = read_file(errors_file_);
    end.allocations = counters_->allocations;
    end.writes = counters_->writes;
    return end;
}

} // namespace octant::tests::faults
