#include "sim/base/error.h"
#include "sim/base/parallel_for.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/sweep/engine.h"

#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace octant::ui::sweep {

namespace {

/// Starts a program whose words go into a log. Throws Error.
pid_t start_child(const std::vector<std::string>& words, const std::filesystem::path& log) {
    std::vector<char*> arguments;
    for (const std::string& word : words) {
        arguments.push_back(const_cast<char*>(word.c_str())); // spawn does not write to them
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_t attributes{};
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP); // Ctrl-C reaches only us
    pid_t process = -1;
    const int code = posix_spawn(&process, arguments.front(), &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (code != 0) { throw Error(fmt::format("{} cannot be started: {}", words.front(), std::strerror(code))); }
    return process;
}

class LocalEngine : public Engine {
public:
    LocalEngine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options)
        : sweep_(sweep), folder_(folder), options_(std::move(options)) {
        const int cores = core_count();
        if (options_.jobs == 0) { options_.jobs = options_.share_cores ? cores : 1; }
        if (options_.jobs > 1 && !options_.share_cores) {
            throw Error(fmt::format("--jobs: expected --share-cores beside more than one at a time, as frame times "
                                    "then "
                                    "depend on each other, got {} without it",
                options_.jobs));
        }
        options_.machine_sharing =
            options_.jobs == 1
                ? "one at a time"
                : fmt::format("up to {} at a time on shared cores: compare no frame times", options_.jobs);
    }

    void fly(std::span<const std::size_t> runs) override;

    std::string machine_sharing() const override { return options_.machine_sharing; }

private:
    void start(const SweepRun& run);
    void wait_for_one();
    void stop_all() const;

    const Sweep& sweep_;
    const SweepFolder& folder_;
    EngineOptions options_;
    std::map<pid_t, std::string> flying_;
    std::string last_;
};

void LocalEngine::start(const SweepRun& run) {
    std::vector<std::string> words = {options_.program, "fly", "--settings", folder_.job(run.name).string(), "--record",
        folder_.recording(run.name).string(), "--if-new", "--quiet", "--swept", options_.machine_sharing};
    if (options_.videos) { words.insert(words.end(), {"--video", folder_.video(run.name).string()}); }
    const pid_t process = start_child(words, folder_.log(run.name));
    flying_.emplace(process, run.name);
}

void LocalEngine::stop_all() const {
    for (const auto& [process, name] : flying_) { ::kill(process, SIGTERM); }
}

/// Signals wake the wait, and are handed on.
void LocalEngine::wait_for_one() {
    constexpr auto look_every = std::chrono::milliseconds(20);
    bool is_reported = false;
    for (;;) {
        for (const auto& [process, name] : flying_) {
            if (::waitpid(process, nullptr, WNOHANG) == process) {
                last_ = name;
                flying_.erase(process);
                return;
            }
        }
        if (base::StopSignals::received() && !std::exchange(is_reported, true)) { stop_all(); }
        std::this_thread::sleep_for(look_every);
    }
}

void LocalEngine::fly(std::span<const std::size_t> runs) {
    base::Progress progress(sweep_.name, static_cast<int>(runs.size()), options_.quiet, "flights");
    std::size_t begun = 0;
    int done = 0;
    while (begun < runs.size() || !flying_.empty()) {
        const bool may_begin = begun < runs.size() && !base::StopSignals::received();
        if (!may_begin && flying_.empty()) { break; }
        if (may_begin && flying_.size() < static_cast<std::size_t>(options_.jobs)) {
            start(sweep_.runs[runs[begun++]]);
        } else {
            wait_for_one();
            progress.show(++done, last_);
        }
    }
    progress.finish();
}

} // namespace

std::unique_ptr<Engine> local_engine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options) {
    return std::make_unique<LocalEngine>(sweep, folder, std::move(options));
}

} // namespace octant::ui::sweep
