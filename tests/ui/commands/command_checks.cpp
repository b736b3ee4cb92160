#include "tests/ui/commands/command_checks.h"

#include <catch2/catch.hpp>

namespace octant::tests {

PrintedJson results_of_run(const std::string& command, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), command);
    arguments.insert(arguments.end(), {"--json", "--quiet"});
    const ProgramRun run = run_octant(arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.err.empty());
    return PrintedJson(run.out);
}

void check_refusal(const ProgramRun& run, const std::string& expected) {
    INFO(run.err);
    CHECK(run.exit_code == 2);
    CHECK(lines_in(run.err) == 1);
    CHECK(run.err.find(expected) != std::string::npos);
    CHECK(run.out.empty());
}

void check_refused(const std::string& command, std::vector<std::string> arguments, const std::string& expected) {
    arguments.insert(arguments.begin(), command);
    arguments.emplace_back("--quiet");
    check_refusal(run_octant(arguments), expected);
}

} // namespace octant::tests
