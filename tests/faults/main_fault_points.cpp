// fault_points PROGRAM PRELOADED FOLDER [--only NAME] [--points N] [--all]: fails the N-th allocation and the N-th
// write of each command in turn. Exit code 0: each ended in one line and left no half file; 1: one did not.
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/faults/commands.h"
#include "tests/faults/tried_program.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <map>

namespace {

using namespace octant;
using namespace octant::tests::faults;
namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>; ///< names in a folder, and what they hold

Files files_in(const fs::path& folder) {
    Files files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) { files[fs::relative(entry.path(), folder).string()] = read_file(entry.path()); }
    }
    return files;
}

void fill(const fs::path& folder, const fs::path& prepared) {
    fs::remove_all(folder);
    fs::copy(prepared, folder, fs::copy_options::recursive);
}

/// Whether a file of a failed run is half of what a whole run makes: not in it, or a piece of it.
bool is_half(const std::string& name, const std::string& bytes, const Files& whole) {
    const auto found = whole.find(name);
    return found == whole.end() || (bytes.size() < found->second.size() && found->second.starts_with(bytes));
}

/// What is wrong with the end of a run; empty when nothing is.
std::string fault_of(const TriedCommand& command, const RunSummary& end, const fs::path& folder, const Files& whole) {
    if (end.timed_out) { return "it did not end"; }
    if (end.signal != 0) { return fmt::format("ended by signal {}", end.signal); }
    if (end.exit_code == 0) { return command.may_end_well ? "" : "exit code 0"; }
    if (end.exit_code != 2) { return fmt::format("exit code {}", end.exit_code); }
    const auto lines = split_lines(end.errors);
    if (lines.size() != 1 || !lines.front().starts_with("octant: ")) {
        return fmt::format("{} lines: {}", lines.size(), printable(end.errors));
    }
    for (const auto& [name, bytes] : files_in(folder)) {
        if (std::ranges::find(command.may_leave, name) == command.may_leave.end() && is_half(name, bytes, whole)) {
            return fmt::format("left {} of {} bytes", name, bytes.size());
        }
    }
    return "";
}

/// About `wanted` points from 1 to `count`: each of the first ones, then fewer and fewer.
std::vector<std::uint64_t> some_points(std::uint64_t count, std::uint64_t wanted) {
    std::vector<std::uint64_t> points;
    const double growth = wanted < 2 ? 2.0 : std::pow(static_cast<double>(count), 1.0 / static_cast<double>(wanted));
    for (double at = 1.0; at <= static_cast<double>(count); at = std::max(at * growth, at + 1.0)) {
        points.push_back(static_cast<std::uint64_t>(at));
    }
    return points;
}

struct Options {
    fs::path program;
    fs::path preloaded;
    fs::path folder;
    std::string only;
    std::uint64_t points = 8; ///< about so many of each kind and command; 0 = all
};

class Trial {
public:
    explicit Trial(const Options& options)
        : options_(options), prepared_(options.folder / "prepared"), run_(options.folder / "run"),
          program_(options.program, options.preloaded, options.folder) {
        fs::remove_all(prepared_);
        make_folder(prepared_);
        for (const std::vector<std::string>& words : preparations()) {
            const RunSummary end = program_.run(words, prepared_, {});
            if (end.exit_code != 0) {
                throw Error(fmt::format(
                    "expected octant {} to end well, got exit code {}: {}", words.front(), end.exit_code, end.errors));
            }
        }
    }

    /// Tries one command; the number of findings.
    int command(const TriedCommand& command) {
        fill(run_, prepared_);
        const RunSummary end = program_.run(command.words, run_, {});
        if (end.exit_code != 0 || end.allocations == 0 || end.writes == 0) {
            throw Error(
                fmt::format("{}: expected a run without faults to end well, got: {}", command.name, end.errors));
        }
        const Files whole = files_in(run_);
        int findings = 0;
        findings += points(command, {Fault::Kind::Allocation, 0, false}, end.allocations, whole);
        findings += points(command, {Fault::Kind::Write, 0, false}, end.writes, whole);
        findings += points(command, {Fault::Kind::Write, 0, true}, end.writes, whole);
        return findings;
    }

private:
    int points(const TriedCommand& command, Fault fault, std::uint64_t count, const Files& whole) {
        const char* const kind = fault.kind == Fault::Kind::Allocation ? "allocation"
                                 : fault.goes_on                       ? "full disk from write"
                                                                       : "write";
        int findings = 0;
        const auto tried = some_points(count, options_.points == 0 ? count * 100 : options_.points);
        for (const std::uint64_t point : tried) {
            fault.point = point;
            fill(run_, prepared_);
            const RunSummary end = program_.run(command.words, run_, fault);
            const bool reached = (fault.kind == Fault::Kind::Allocation ? end.allocations : end.writes) >= point;
            const std::string wrong = reached ? fault_of(command, end, run_, whole) : "";
            if (!wrong.empty()) {
                fmt::print("{}, {} {}: {}; {}\n", command.name, kind, point, wrong, printable(end.errors));
                ++findings;
            }
        }
        fmt::print("{}: {} of {} points tried ({}), {} findings\n", command.name, tried.size(), count, kind, findings);
        return findings;
    }

    Options options_;
    fs::path prepared_;
    fs::path run_;
    TriedProgram program_;
};

Options read_options(int count, char** words) {
    if (count < 4) { throw Error("expected PROGRAM PRELOADED FOLDER [--only NAME] [--points N], got less"); }
    Options options{fs::absolute(words[1]), fs::absolute(words[2]), fs::absolute(words[3]), {}, 8};
    for (int i = 4; i + 1 < count; i += 2) {
        const std::string option = words[i];
        const auto number = whole_number(words[i + 1]);
        if (option == "--only") {
            options.only = words[i + 1];
        } else if (option == "--points" && number && *number >= 0) {
            options.points = static_cast<std::uint64_t>(*number);
        } else {
            throw Error("expected --only NAME or --points N, got " + option);
        }
    }
    return options;
}

} // namespace

int main(int count, char** words) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    try {
        const Options options = read_options(count, words);
        make_folder(options.folder);
        Trial trial(options);
        int findings = 0;
        for (const TriedCommand& command : tried_commands()) {
            if (options.only.empty() || options.only == command.name) { findings += trial.command(command); }
        }
        return findings == 0 ? 0 : 1;
    } catch (const Error& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 2;
    }
}
