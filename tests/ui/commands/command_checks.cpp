#include "tests/ui/commands/command_checks.h"

#include "sim/base/text_file.h"

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

void check_refusals(const std::string& command, const Refusals& refusals) {
    for (const auto& [line, expected] : refusals) {
        CAPTURE(command, line);
        const std::vector<std::string_view> words = split_words(line);
        check_refused(command, {words.begin(), words.end()}, expected);
    }
}

} // namespace octant::tests
