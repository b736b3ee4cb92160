#include "sim/base/error.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/documented_lines.h"
#include "ui/command_line/command_line.h"
#include "ui/commands/commands.h"
#include "ui/studies/program/study_program.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <string_view>
#include <vector>

using namespace octant;
using octant::tests::CommandLine;

namespace {

namespace fs = std::filesystem;
namespace command_line = octant::ui::command_line;

/// A scratch folder that is the working folder as long as this lives.
class WorkingFolder {
public:
    explicit WorkingFolder(const std::string& name) : before_(fs::current_path()) {
        fs::current_path(tests::empty_folder(name));
    }

    ~WorkingFolder() { fs::current_path(before_); }

    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;
    WorkingFolder(WorkingFolder&&) = delete;
    WorkingFolder& operator=(WorkingFolder&&) = delete;

private:
    fs::path before_;
};

/// What is wrong with a command line; empty when it can be read, with the files that it names.
std::string fault_of(const CommandLine& line) {
    const bool is_study = line.front() == "study" || line.front() == "bench";
    std::vector<const char*> words = {"octant"};
    for (const std::string& word : line) { words.push_back(word.c_str()); }
    if (line.front() == "study") { words.erase(words.begin() + 1); }
    const command_line::Program program =
        is_study ? ui::studies::program::study_program() : ui::commands::octant_program();
    try {
        command_line::parse_command_line(program, static_cast<int>(words.size()), words.data());
    } catch (const Error& fault) { return fault.what(); }
    return "";
}

/// Reads every line, with the files it names made where they are missing, and runs those that take no window and no
/// minutes.
void check_lines(const std::vector<CommandLine>& lines) {
    constexpr std::array quick = {"fly", "report", "terrain", "draw-order", "mesh-error", "refine", "simplify"};
    for (const CommandLine& line : lines) {
        INFO(fmt::format("octant {}", fmt::join(line, " ")));
        tests::make_inputs(line);
        CHECK(fault_of(line) == "");
        if (std::ranges::find(quick, line.front()) != quick.end()) {
            const tests::ProgramRun run = tests::run_octant(tests::shortened(line));
            INFO(run.err);
            const bool has_gate = std::ranges::find(line, "--gate") != line.end(); // made inputs are all the same
            CHECK(run.exit_code == (has_gate ? 3 : 0));
        }
    }
}

/// Checks the examples of a command's help, and of those below it.
void check_examples(const command_line::Command& command) {
    const std::vector<CommandLine> lines = tests::command_lines(command.footer);
    INFO(command.name);
    CHECK(lines.empty() == !command.program.empty());
    check_lines(lines);
    for (const command_line::Command& below : command.commands) { check_examples(below); }
}

command_line::Command command_named(std::string_view name) {
    const command_line::Program program = ui::commands::octant_program();
    return *std::ranges::find(program.commands, name, &command_line::Command::name);
}

} // namespace

TEST_CASE("command lines are found in a text, without comments, parted by semicolons and &&") {
    const auto lines = tests::command_lines("Examples of octant:\n"
                                            "  octant fly turn --size 64x36   # a comment; octant no\n"
                                            "octant report a; octant report b && octant view\n"
                                            "cmake octant\n");
    REQUIRE(lines.size() == 4);
    CHECK(lines[0] == CommandLine{"fly", "turn", "--size", "64x36"});
    CHECK(lines[1] == CommandLine{"report", "a"});
    CHECK(lines[2] == CommandLine{"report", "b"});
    CHECK(lines[3] == CommandLine{"view"});
}

TEST_CASE("every command line of the README files can be read and, where it is quick, runs") {
    const WorkingFolder folder("documented-readme");
    std::size_t count = 0;
    for (const fs::path& file : tests::readme_files()) {
        const std::vector<CommandLine> lines = tests::command_lines_in_blocks(file);
        INFO(file.string());
        check_lines(lines);
        count += lines.size();
    }
    CHECK(count > 0);
}

TEST_CASE("the examples of octant --help and of fly --help run") {
    const WorkingFolder folder("documented-fly");
    const command_line::Program program = ui::commands::octant_program();
    check_lines(tests::command_lines(program.footer));
    check_examples(command_named("fly"));
}

TEST_CASE("the examples of terrain --help run") {
    const WorkingFolder folder("documented-terrain");
    check_examples(command_named("terrain"));
}

TEST_CASE("the examples of every other command's --help can be read and, where quick, run") {
    const WorkingFolder folder("documented-others");
    const command_line::Program program = ui::commands::octant_program();
    for (const command_line::Command& command : program.commands) {
        if (command.name != "fly" && command.name != "terrain") { check_examples(command); }
    }
    for (const command_line::Command& command : ui::studies::program::study_program().commands) {
        if (command.name != "manual") { check_examples(command); }
    }
}
