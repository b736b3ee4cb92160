#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "ui/base/stop_signals.h"
#include "ui/sweep/turns.h"

#include <catch2/catch.hpp>

#include <csignal>
#include <fmt/format.h>
#include <functional>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace octant;
using namespace octant::ui::sweep;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

/// A flight by a shell script, whose $1 is the recording's folder.
TurnFlight flight_by(const fs::path& folder, const std::string& name, const std::string& script) {
    make_folder(folder / name);
    const fs::path program = folder / (name + ".sh");
    write_file(program, "#!/bin/sh\necho $$ > " + (folder / name / "process").string() + "\n" + script + "\n");
    fs::permissions(program, fs::perms::owner_all);
    return {name, {program.string(), (folder / name).string()}, folder / name, folder / (name + ".log")};
}

/// Begins a flight; then counts by 1 in a file, which shows when it ran, until `end` of them.
std::string counting(int end) {
    return fmt::format(
        "echo {{}} > \"$1/run.json\"\ni=0; while [ $i -lt {} ]; do i=$((i + 1)); echo \"$0 $i\" >> \"$1/../both\"; "
        "done",
        end);
}

/// A script that begins a flight and then goes on for ever.
constexpr const char* endless = "echo {} > \"$1/run.json\"\nwhile :; do :; done";

/// "T" for a stopped process, "Z" for a zombie; empty where there is none.
std::string process_state(const fs::path& folder, const std::string& name) {
    if (!fs::exists(folder / name / "process")) { return {}; }
    const std::string process = read_file(folder / name / "process");
    std::ifstream file("/proc/" + process.substr(0, process.find('\n')) + "/status");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("State:\t")) { return line.substr(7, 1); }
    }
    return {};
}

/// Waits until neither process of two flights is there any more, or at most as a zombie that is no child of ours; false
/// if one still is after ten seconds.
bool both_go_away(const fs::path& folder, const std::string& allowed_state = {}) {
    const auto is_gone = [&](const std::string& name) {
        const std::string state = process_state(folder, name);
        return state.empty() || state == allowed_state;
    };
    for (int i = 0; i < 1000; ++i) {
        if (is_gone("old") && is_gone("new")) { return true; }
        std::this_thread::sleep_for(10ms);
    }
    return false;
}

/// Runs something in a process of its own, and `meanwhile` with its number; its wait status.
int in_other_process(const std::function<void()>& work, const std::function<void(pid_t)>& meanwhile) {
    const pid_t process = ::fork();
    if (process == 0) {
        work();
        ::_exit(0);
    }
    meanwhile(process);
    int status = 0;
    ::waitpid(process, &status, 0);
    return status;
}

void wait_for_both_to_begin(const fs::path& folder) {
    for (int i = 0; i < 1000 && !(fs::exists(folder / "old/run.json") && fs::exists(folder / "new/run.json")); ++i) {
        std::this_thread::sleep_for(10ms);
    }
    std::this_thread::sleep_for(50ms);
}

} // namespace

TEST_CASE("two flights go on in turns until both have ended") {
    const fs::path folder = tests::empty_folder("turns");
    RandomGenerator dice(1);
    const auto ran_s = fly_in_turns(
        {flight_by(folder, "old", counting(8000)), flight_by(folder, "new", counting(16000))}, 0.005, dice);
    CHECK(ran_s[0] > 0.0);
    CHECK(ran_s[1] > 0.0);
    CHECK(both_go_away(folder));
    const std::string both = read_file(folder / "both");
    int changes = 0;
    std::string_view before;
    for (const std::string_view line : split_lines(both)) {
        const std::string_view now = line.substr(0, line.find(' '));
        changes += now != before ? 1 : 0;
        before = now;
    }
    CHECK(split_lines(both).size() == 24000);
    CHECK(changes > 4);
    CHECK_THAT(both, Contains("old.sh 8000\n") && Contains("new.sh 16000\n"));
}

TEST_CASE("without turns one flight follows the other, in an order that the seed decides") {
    const fs::path folder = tests::empty_folder("turns");
    int old_first = 0;
    RandomGenerator dice(1);
    for (int round = 0; round < 12; ++round) {
        fs::remove_all(folder);
        fly_in_turns({flight_by(folder, "old", counting(3)), flight_by(folder, "new", counting(3))}, {}, dice);
        const std::string both = read_file(folder / "both");
        const auto lines = split_lines(both);
        REQUIRE(lines.size() == 6);
        old_first += lines[2].ends_with("old.sh 3") ? 1 : 0;
        CHECK((lines[2].ends_with("old.sh 3") || lines[2].ends_with("new.sh 3")));
    }
    CHECK(old_first > 0);
    CHECK(old_first < 12);
}

TEST_CASE("a program that fails ends the other, and its last line is told") {
    const fs::path folder = tests::empty_folder("turns");
    RandomGenerator dice(1);
    const auto fly = [&](const std::string& old_script, const std::string& new_script) {
        fs::remove_all(folder);
        fly_in_turns({flight_by(folder, "old", old_script), flight_by(folder, "new", new_script)}, 0.01, dice, 1000ms);
    };
    CHECK_THROWS_WITH(fly(endless, "echo {} > \"$1/run.json\"; echo one; echo no map >&2; exit 2"), "new: no map");
    CHECK(both_go_away(folder));
    CHECK(read_file(folder / "new.log") == "one\nno map\n");
    CHECK_THROWS_WITH(fly("exit 3", endless), "old: ended with exit code 3");
    CHECK_THROWS_WITH(fly("exit 0", endless), Contains("old: expected a program that writes ") &&
                                                  Contains("old/run.json when its flight begins, got one that ended"));
    CHECK_THROWS_WITH(fly(endless, "sleep 30"), Contains("new: expected a program that writes ") &&
                                                    Contains("new/run.json when its flight begins, got one that did"));
    CHECK(both_go_away(folder));
    const TurnFlight none{"old", {(folder / "none").string()}, folder / "old", folder / "old.log"};
    CHECK_THROWS_WITH(fly_in_turns({none, none}, 0.01, dice), "old: expected a program that can be started, got none");
}

TEST_CASE("a stop signal ends both flights in order, with nothing left stopped") {
    const fs::path folder = tests::empty_folder("turns");
    const std::string in_order =
        "trap 'echo ended in order; exit 0' TERM\necho {} > \"$1/run.json\"\nwhile :; do :; done";
    const int status = in_other_process(
        [&] {
            const ui::base::StopSignals stop_signals;
            RandomGenerator dice(1);
            try {
                fly_in_turns({flight_by(folder, "old", in_order), flight_by(folder, "new", in_order)}, 0.02, dice);
            } catch (const ui::base::StoppedBySignal&) { ::_exit(7); }
        },
        [&](pid_t process) {
            wait_for_both_to_begin(folder);
            ::kill(process, SIGTERM);
        });
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 7);
    CHECK(both_go_away(folder));
    CHECK(read_file(folder / "old.log") == "ended in order\n");
    CHECK(read_file(folder / "new.log") == "ended in order\n");
}

TEST_CASE("no program is left, running or stopped, when the one that flies them is killed") {
    const fs::path folder = tests::empty_folder("turns");
    const int status = in_other_process(
        [&] {
            RandomGenerator dice(1);
            fly_in_turns({flight_by(folder, "old", endless), flight_by(folder, "new", endless)}, 0.02, dice);
        },
        [&](pid_t process) {
            wait_for_both_to_begin(folder);
            ::kill(process, SIGKILL);
        });
    CHECK(WIFSIGNALED(status));
    CHECK(both_go_away(folder, "Z"));
}

TEST_CASE("a program that watches for signals counts how often it went on after a stop") {
    const int before = ui::base::StopSignals::pauses();
    ::raise(SIGCONT);
    CHECK(ui::base::StopSignals::pauses() == before);
    const ui::base::StopSignals stop_signals;
    ::raise(SIGCONT);
    ::raise(SIGCONT);
    CHECK(ui::base::StopSignals::pauses() == before + 2);
    CHECK_FALSE(ui::base::StopSignals::received());
}
