#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/report/child_program.h"
#include "ui/sweep/engine.h"
#include "ui/sweep/engine_scripts.h"

#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <functional>
#include <thread>
#include <utility>

namespace octant::ui::sweep {

namespace {

using report::ChildProgram;

/// Runs a program that must be there and waits; gives its output. When a signal came, `stop` is called once with the
/// program, and it is waited for all the same. What it says when it fails is a note: which runs are done is seen in
/// their folders.
std::string run_engine(
    const std::vector<std::string>& words, bool quiet, const std::function<void(ChildProgram&)>& stop) {
    constexpr auto look_every = std::chrono::milliseconds(50);
    auto child = ChildProgram::start(words);
    if (!child) { throw Error(fmt::format("expected the program {}, which is not installed", words.front())); }
    child->end_input();
    bool is_reported = false;
    while (child->is_running()) {
        if (base::StopSignals::received() && !std::exchange(is_reported, true)) {
            base::print_note(quiet, fmt::format("note: {}: ending {}", base::StopSignals::name(), words.front()));
            stop(*child);
        }
        std::this_thread::sleep_for(look_every);
    }
    const report::ProgramResult ending = child->finish();
    if (!ending.succeeded && !is_reported) {
        base::print_note(quiet, fmt::format("note: {}: {}", words.front(), ending.last_error_line));
    }
    return ending.output;
}

/// The number in "Submitted batch job 123"; empty where there is none.
std::string job_in(const std::string& text) {
    const auto words = split_words(text);
    for (const std::string_view word : words) {
        if (const auto number = whole_number(word.substr(0, word.find('\n')))) { return fmt::format("{}", *number); }
    }
    return {};
}

/// Waits until a job has left Slurm's queue: tasks that were on a node which died are there again when `sbatch --wait`
/// takes the job for ended.
void wait_for_queue(const std::string& job) {
    constexpr auto look_every = std::chrono::seconds(2);
    while (!job.empty()) {
        auto child = ChildProgram::start({"squeue", "--noheader", "--jobs=" + job});
        const report::ProgramResult ending = child ? child->finish() : report::ProgramResult();
        if (!ending.succeeded || ending.output.empty()) { return; }
        std::this_thread::sleep_for(look_every);
    }
}

void check_installed(const std::string& program) {
    auto child = ChildProgram::start({program, "--version"});
    if (!child || !child->finish().succeeded) {
        throw Error(fmt::format("expected the program {}, which is not installed", program));
    }
}

class SlurmEngine : public Engine {
public:
    SlurmEngine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options)
        : folder_(folder), options_(std::move(options)), tasks_(tasks_of(sweep, options_)) {
        check_installed("sbatch");
        options_.machine_sharing = options_.share_cores ? "by Slurm, on shared nodes: compare no frame times"
                                                        : "by Slurm, each alone on its node";
        write_file(script(), sbatch_script(sweep, folder, options_, tasks_));
    }

    void fly(std::span<const std::size_t> runs) override {
        base::print_note(options_.quiet, fmt::format("{} flights by sbatch {}", runs.size(), script().string()));
        // Tasks that wait are taken out of the queue; those that run end their flights in order.
        const auto cancel = [](ChildProgram& sbatch) {
            const std::string job = job_in(sbatch.output());
            auto scancel = job.empty() ? std::nullopt : ChildProgram::start({"scancel", job});
            if (scancel) {
                scancel->finish();
            } else {
                sbatch.signal(SIGTERM);
            }
        };
        wait_for_queue(job_in(
            run_engine({"sbatch", "--wait", "--array=" + array_of(runs), script().string()}, options_.quiet, cancel)));
    }

    std::string machine_sharing() const override { return options_.machine_sharing; }

private:
    std::filesystem::path script() const { return folder_.path() / "sweep.sbatch"; }

    std::string array_of(std::span<const std::size_t> runs) const {
        return task_list(runs, tasks_) + (options_.jobs > 0 ? fmt::format("%{}", options_.jobs) : std::string());
    }

    const SweepFolder& folder_;
    EngineOptions options_;
    int tasks_;
};

class ParallelEngine : public Engine {
public:
    ParallelEngine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options)
        : sweep_(sweep), folder_(folder), options_(std::move(options)) {
        check_installed("parallel");
        options_.machine_sharing = options_.share_cores || options_.jobs > 1
                                       ? "by GNU parallel, on shared cores: compare no frame times"
                                       : "by GNU parallel, one at a time on each machine";
        write_file(script(), parallel_script(sweep, folder, options_));
    }

    void fly(std::span<const std::size_t> runs) override {
        std::string names;
        for (const std::size_t run : runs) { names += sweep_.runs[run].name + "\n"; }
        write_file(folder_.path() / "todo.txt", names);
        base::print_note(options_.quiet, fmt::format("{} flights by {}", runs.size(), script().string()));
        // The first signal: no more flights; the second: those that are flown end in order.
        run_engine({"bash", script().string()}, options_.quiet, [](ChildProgram& parallel) {
            constexpr auto between = std::chrono::milliseconds(500);
            parallel.signal(SIGTERM);
            std::this_thread::sleep_for(between);
            parallel.signal(SIGTERM);
        });
    }

    std::string machine_sharing() const override { return options_.machine_sharing; }

private:
    std::filesystem::path script() const { return folder_.path() / "sweep.parallel.sh"; }

    const Sweep& sweep_;
    const SweepFolder& folder_;
    EngineOptions options_;
};

} // namespace

std::unique_ptr<Engine> slurm_engine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options) {
    return std::make_unique<SlurmEngine>(sweep, folder, std::move(options));
}

std::unique_ptr<Engine> parallel_engine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options) {
    return std::make_unique<ParallelEngine>(sweep, folder, std::move(options));
}

} // namespace octant::ui::sweep
