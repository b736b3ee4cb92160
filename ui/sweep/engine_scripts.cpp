#include "ui/sweep/engine_scripts.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace octant::ui::sweep {

namespace {

constexpr int max_tasks = 1000; // Slurm's MaxArraySize is 1001 where nobody changed it

/// The command that flies the run whose name is in the shell's `variable`.
std::string fly_command(const EngineOptions& options, const std::string& variable) {
    return fmt::format("{0} fly --settings \"jobs/{1}.json\" --record \"runs/{1}\" --if-new --quiet --swept "
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

} // namespace octant::ui::sweep
