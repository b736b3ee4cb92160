#include "tests/ui/commands/command_line.h"
#include "ui/commands/commands.h"

#include <catch2/catch.hpp>

using namespace octant::ui;
using Catch::Contains;

TEST_CASE("the manual page has every command and option, and no line that man takes for a request") {
    const command_line::Program program = commands::octant_program();
    const std::string page = octant::tests::run_octant({"manual", "man"}).out;
    CHECK_THAT(page, Catch::StartsWith(".TH OCTANT 1 "));
    for (const command_line::Command& command : program.commands) {
        if (command.name == "manual") { continue; }
        CAPTURE(command.name);
        const std::size_t at = page.find(".SS \"octant " + command.name.substr(0, 4));
        CHECK(at != std::string::npos);
    }
    CHECK_THAT(page, Contains(".B \\-\\-order\\-method METHOD"));
    CHECK_THAT(page, Contains("octant sweep budgets.toml \\-\\-list"));
    CHECK(page.find("\n'") == std::string::npos);
}

TEST_CASE("completions offer the options of the command that stands there") {
    const command_line::Program program = commands::octant_program();
    const std::string text = octant::tests::run_octant({"manual", "bash"}).out;
    const std::size_t report = text.find("    'report') words=\"");
    REQUIRE(report != std::string::npos);
    const std::string line = text.substr(report, text.find('\n', report) - report);
    CHECK_THAT(line, Contains(" --gate") && Contains(" --out") && !Contains("--order-method"));
    CHECK_THAT(text, Contains("    'terrain query') words=\"--help"));
    for (const command_line::Command& command : program.commands) {
        CAPTURE(command.name);
        const bool is_followed = text.find("'" + command.name + " '*") != std::string::npos;
        CHECK(is_followed == !command.commands.empty());
        const bool by_other = text.find("      " + command.name + ") _octant_other octant-") != std::string::npos;
        CHECK(by_other == !command.program.empty());
    }
    CHECK_THAT(text, Contains(" --sky --no-sky"));
    CHECK_THAT(octant::tests::run_octant({"manual", "zsh"}).out, Catch::StartsWith("#compdef octant\n"));
}
