#include "tests/ui/commands/command_line.h"
#include "ui/settings/settings_fields.h"

#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <string>

using namespace octant;

TEST_CASE("help lists every setting under the headline of its group") {
    for (const std::string command : {"fly", "view"}) {
        const tests::ProgramRun run = tests::run_octant({command, "--help"});
        REQUIRE(run.exit_code == 0);
        ui::settings::visit_rows([&](const ui::settings::SettingInfo& info) {
            CAPTURE(command, info.name);
            const std::size_t headline = run.out.find(fmt::format("\n{}:\n", name_of(info.group)));
            REQUIRE(headline != std::string::npos);
            if (info.name == "path") {
                return; // It is the word without dashes, which stands above all options.
            }
            const std::size_t end = run.out.find("\n\n", headline + 1);
            const std::string section = run.out.substr(headline, end - headline);
            CHECK(section.find(fmt::format("\n  --{}", info.name)) != std::string::npos);
        });
    }
}
