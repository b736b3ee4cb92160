#include "ui/sweep/engine.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "sim/base/thread_pool.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/report/child_program.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <functional>
#include <set>
#include <thread>
#include <utility>

namespace octant::ui::sweep {

namespace {

constexpr int max_tasks = 1000; // Slurm's MaxArraySize is 1001 where nobody changed it

/// The command that flies the run whose name is in the shell's `variable`.
std::string fly_command(const EngineOptions& options, const std::string& variable) {
    return fmt::format("{0} fly --settings \"jobs/{1}.json\" --record \"runs/{1}\" --if-new --quiet --machine-sharing "
                       "{2}{3} "
                       ">\"logs/{1}.log\" 2>&1",
        shell_quoted(options.program), variable, shell_quoted(options.machine_sharing),
        options.videos ? fmt::format(" --video \"videos/{}.mp4\"", variable) : std::string());
}

} // namespace

std::string shell_quoted(const std::string& text) {
    std::string word = "'";
    for (const char letter : text) { word += letter == '\'' ? std::string("'\\''") : std::string(1, letter); }
    return word + "'";
}

int tasks_of(const Sweep& sweep, const EngineOptions& options) {
    const int runs = static_cast<int>(sweep.runs.size());
    const int wanted = options.tasks > 0 ? options.tasks : max_tasks;
    return std::clamp(wanted, 1, std::max(1, runs));
}

std::string sbatch_script(const Sweep& sweep, const SweepFolder& folder, const EngineOptions& options, int tasks) {
    std::string text = "#!/bin/bash\n";
    text += fmt::format("# Flies {} runs of the sweep {}. Submitted again (sbatch {}), it flies what is not "
                        "done.\n",
        sweep.runs.size(), sweep.name, "sweep.sbatch");
    text += fmt::format("#SBATCH --job-name=octant-{}\n", sweep.name);
    text +=
        fmt::format("#SBATCH --array=0-{}{}\n", tasks - 1, options.jobs > 0 ? fmt::format("%{}", options.jobs) : "");
    text += fmt::format("#SBATCH --time={}\n", options.minutes);
    text += "#SBATCH --requeue\n#SBATCH --open-mode=append\n";
    const std::string place = folder.path().string();
    std::string pattern; // in which % stands for more than itself
    for (const char letter : place) { pattern += letter == '%' ? "%%" : std::string(1, letter); }
    text += fmt::format("#SBATCH --chdir=\"{}\"\n#SBATCH --output=\"{}/logs/slurm-%a.log\"\n", place, pattern);
    text += options.share_cores ? "" : "#SBATCH --exclusive\n";
    for (const std::string& option : options.sbatch_options) { text += fmt::format("#SBATCH {}\n", option); }
    // Where a node does not have the folder, Slurm starts the task in another.
    text += fmt::format("cd {} || exit 2\n", shell_quoted(place));
    text += "fault=0\nwhile read -r run; do\n  ";
    text += fly_command(options, "$run");
    text += fmt::format(" </dev/null || fault=$?\ndone < <(awk \"NR % {} == ($SLURM_ARRAY_TASK_ID + 1) % {}\" "
                        "jobs.txt)\nexit $fault\n",
        tasks, tasks);
    return text;
}

std::string task_list(std::span<const std::size_t> runs, int tasks) {
    std::set<std::size_t> numbers;
    for (const std::size_t run : runs) { numbers.insert(run % static_cast<std::size_t>(tasks)); }
    return fmt::format("{}", fmt::join(numbers, ","));
}

std::string parallel_script(const Sweep& sweep, const SweepFolder& folder, const EngineOptions& options) {
    std::string text = "#!/bin/bash\n";
    text +=
        fmt::format("# Flies the runs of the sweep {} that todo.txt names on the machines of a file.\n", sweep.name);
    text += fmt::format("cd {} || exit 2\n", shell_quoted(folder.path().string()));
    text += "exec parallel --will-cite --retries 3 --joblog logs/parallel.log --workdir \"$PWD\""
            " --termseq TERM,120000,KILL,25";
    text += fmt::format(" --timeout {}", 60 * options.minutes);
    if (options.jobs > 0) {
        text += fmt::format(" --jobs {}", options.jobs);
    } else {
        text += options.share_cores ? " --jobs 100%" : " --jobs 1";
    }
    if (!options.hosts.empty()) { text += " --sshloginfile " + shell_quoted(options.hosts.string()); }
    // In place of its shell: one that dies of the signal at once would make GNU parallel kill the flight at once, too.
    text += " --arg-file todo.txt " + shell_quoted("exec " + fly_command(options, "{}")) + "\n";
    return text;
}

namespace {

using report::ChildProgram;

class LocalEngine : public Engine {
public:
    LocalEngine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options)
        : sweep_(sweep), folder_(folder), options_(std::move(options)) {
        const int cores = core_count();
        if (options_.jobs == 0) { options_.jobs = options_.share_cores ? cores : 1; }
        if (options_.jobs > 1 && !options_.share_cores) {
            throw Error(
                fmt::format("--jobs: expected --batch share-cores beside more than one at a time, as frame times then "
                            "depend on each other, got {} without it",
                    options_.jobs));
        }
        options_.machine_sharing =
            options_.jobs == 1
                ? "one at a time"
                : fmt::format("up to {} at a time on shared cores: compare no frame times", options_.jobs);
    }

    void fly(std::span<const std::size_t> runs) override {
        base::Progress progress(sweep_.name, static_cast<int>(runs.size()), options_.quiet, "flights");
        std::size_t begun = 0;
        for (;;) {
            const bool may_begin = begun < runs.size() && !base::StopSignals::received();
            if (!may_begin && flying_.empty()) { break; }
            if (may_begin && flying_.size() < static_cast<std::size_t>(options_.jobs)) {
                start(sweep_.runs[runs[begun++]]);
            } else {
                progress.tick(wait_for_one());
            }
        }
        progress.finish();
    }

    std::string machine_sharing() const override { return options_.machine_sharing; }

private:
    struct Flying {
        std::string run;
        ChildProgram program;
    };

    void start(const SweepRun& run) {
        std::vector<std::string> words = {options_.program, "fly", "--settings", folder_.job(run.name).string(),
            "--record", folder_.recording(run.name).string(), "--if-new", "--quiet", "--machine-sharing",
            options_.machine_sharing};
        if (options_.videos) { words.insert(words.end(), {"--video", folder_.video(run.name).string()}); }
        // A flight that outlived the sweep would hold its recording against the next call.
        auto program = ChildProgram::start_bound(words, folder_.log(run.name));
        if (!program) { throw Error(fmt::format("{} cannot be started: No such program", options_.program)); }
        program->end_input();
        flying_.push_back({run.name, std::move(*program)});
    }

    /// The run that ends first. A signal that comes meanwhile is sent on to all.
    std::string wait_for_one() {
        constexpr auto look_every = std::chrono::milliseconds(20);
        bool is_reported = false;
        for (;;) {
            const auto ended = std::ranges::find_if(flying_, [](Flying& each) { return !each.program.is_running(); });
            if (ended != flying_.end()) {
                std::string run = ended->run;
                flying_.erase(ended);
                return run;
            }
            if (base::StopSignals::received() && !std::exchange(is_reported, true)) {
                for (Flying& each : flying_) { each.program.signal(SIGTERM); }
            }
            std::this_thread::sleep_for(look_every);
        }
    }

    const Sweep& sweep_;
    const SweepFolder& folder_;
    EngineOptions options_;
    std::vector<Flying> flying_;
};

} // namespace

std::unique_ptr<Engine> local_engine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options) {
    return std::make_unique<LocalEngine>(sweep, folder, std::move(options));
}

namespace {

/// What a program that failed said, in one line without its name, each of its lines once: "Invalid partition name".
std::string complaint_of(const std::string& program, const report::ProgramResult& ending) {
    std::vector<std::string_view> lines;
    for (std::string_view line : split_lines(ending.errors)) {
        for (const std::string& start :
            {program + ": ", std::string("error: "), std::string("Error: "), std::string("fatal: ")}) {
            if (line.starts_with(start)) { line.remove_prefix(start.size()); }
        }
        if (!split_words(line).empty() && std::ranges::find(lines, line) == lines.end()) { lines.push_back(line); }
    }
    return lines.empty() ? ending.last_error_line : fmt::format("{}", fmt::join(lines, "; "));
}

[[noreturn]] void refuse(const std::string& program, const report::ProgramResult& ending) {
    throw Error(fmt::format("{}: {}", program, complaint_of(program, ending)));
}

ChildProgram start_installed(const std::string& program, const std::vector<std::string>& words) {
    auto child = ChildProgram::start(words);
    if (!child) { throw Error(fmt::format("expected the program {}, which is not installed", program)); }
    child->end_input();
    return std::move(*child);
}

/// Runs a program that must be there and waits. When a signal came, `stop` is called once with the program, and it is
/// waited for all the same.
report::ProgramResult run_engine(
    const std::vector<std::string>& words, bool quiet, const std::function<void(ChildProgram&)>& stop) {
    constexpr auto look_every = std::chrono::milliseconds(50);
    ChildProgram child = start_installed(words.front(), words);
    bool is_reported = false;
    while (child.is_running()) {
        if (base::StopSignals::received() && !std::exchange(is_reported, true)) {
            base::print_note(quiet, fmt::format("note: {}: ending {}", base::StopSignals::name(), words.front()));
            stop(child);
        }
        std::this_thread::sleep_for(look_every);
    }
    return child.finish();
}

/// Tells how a scheduler that was given these runs failed: by an Error when none of the runs has begun, else by a note,
/// as the runs' logs then say what failed.
void check_scheduler(const std::string& program, const report::ProgramResult& ending, bool any_begun, bool quiet) {
    if (ending.succeeded || base::StopSignals::received()) { return; }
    const std::string complaint = fmt::format("{}: {}", program, complaint_of(program, ending));
    if (!any_begun) { throw Error(complaint + (ending.errors.empty() ? " and no flight began" : "")); }
    base::print_note(quiet, "note: " + complaint);
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
/// takes the job for ended. Throws Error when Slurm does not answer several times, as the job's flights may then still
/// be flown.
void wait_for_queue(const std::string& job) {
    constexpr auto look_every = std::chrono::seconds(2);
    constexpr int max_failures = 3; // in a row; squeue itself tries for some seconds
    int failures = 0;
    while (!job.empty()) {
        auto child = ChildProgram::start({"squeue", "--noheader", "--jobs=" + job});
        const report::ProgramResult ending = child ? child->finish() : report::ProgramResult();
        const bool is_gone = !child || ending.errors.find("Invalid job id") != std::string::npos;
        if (is_gone || (ending.succeeded && ending.output.empty())) { return; }
        failures = ending.succeeded ? 0 : failures + 1;
        if (failures == max_failures && base::StopSignals::received()) { return; }
        if (failures == max_failures) { refuse("squeue", ending); }
        std::this_thread::sleep_for(look_every);
    }
}

void check_installed(const std::string& program) {
    const report::ProgramResult ending = start_installed(program, {program, "--version"}).finish();
    if (!ending.succeeded) { refuse(program, ending); }
}

class SlurmEngine : public Engine {
public:
    SlurmEngine(const Sweep& sweep, const SweepFolder& folder, EngineOptions options)
        : sweep_(sweep), folder_(folder), options_(std::move(options)), tasks_(tasks_of(sweep, options_)) {
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
        const report::ProgramResult ending =
            run_engine({"sbatch", "--wait", "--array=" + array_of(runs), script().string()}, options_.quiet, cancel);
        wait_for_queue(job_in(ending.output));
        check_scheduler("sbatch", ending, folder_.any_begun(sweep_, runs), options_.quiet);
    }

    std::string machine_sharing() const override { return options_.machine_sharing; }

private:
    std::filesystem::path script() const { return folder_.path() / "sweep.sbatch"; }

    std::string array_of(std::span<const std::size_t> runs) const {
        return task_list(runs, tasks_) + (options_.jobs > 0 ? fmt::format("%{}", options_.jobs) : std::string());
    }

    const Sweep& sweep_;
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
        const report::ProgramResult ending =
            run_engine({"bash", script().string()}, options_.quiet, [](ChildProgram& parallel) {
                constexpr auto between = std::chrono::milliseconds(500);
                parallel.signal(SIGTERM);
                std::this_thread::sleep_for(between);
                parallel.signal(SIGTERM);
            });
        check_scheduler("parallel", ending, folder_.any_begun(sweep_, runs), options_.quiet);
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
