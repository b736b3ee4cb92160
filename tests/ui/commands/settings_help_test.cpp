#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_checks.h"
#include "tests/ui/commands/command_line.h"
#include "ui/commands/commands.h"
#include "ui/settings/setting_rows.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace octant;
using ui::command_line::Shown;

namespace {

/// Lines of help that begin with an option.
int options_in(const std::string& help) {
    int count = 0;
    for (std::size_t at = help.find("\n  --"); at != std::string::npos; at = help.find("\n  --", at + 1)) { ++count; }
    return count;
}

} // namespace

TEST_CASE("each setting is an option of fly and view, or a key of one, under the headline of its group") {
    const std::set<std::string_view> internal{"part", "order-seconds", "raster-threads"};
    for (const auto& command : {ui::commands::fly_command(), ui::commands::view_command()}) {
        ui::settings::visit_rows([&](const ui::settings::SettingInfo& info) {
            CAPTURE(command.name, info.name);
            const auto found = std::ranges::find_if(command.options, [&](const auto& option) {
                return option.name == info.name || option.name == fmt::format("--{}", info.name) ||
                       option.name == fmt::format("--{0},!--no-{0}", info.name);
            });
            REQUIRE(found != command.options.end());
            CHECK(found->heading == name_of(info.group));
            const bool is_key = found->shown == Shown::Never && found->note != nullptr;
            CHECK((found->shown == Shown::Never) == (is_key || internal.contains(info.name)));
        });
    }
}

TEST_CASE("help of fly, view and listen shows what most people use on sixty lines, --help-all the rest") {
    for (const std::string command : {"fly", "view", "listen"}) {
        const std::string help = tests::run_octant({command, "--help"}).out;
        const std::string all = tests::run_octant({command, "--help-all"}).out;
        CAPTURE(command, help);
        CHECK(tests::lines_in(help) <= 60);
        CHECK(options_in(help) <= 25);
        CHECK(options_in(all) > options_in(help) + 20);
        CHECK(help.find("\n  octant " + command) != std::string::npos);
        CHECK(help.find("{false}") == std::string::npos);
        for (const char* option : {"--aircraft ", "--terrain ", "--view "}) {
            CHECK(help.find(option) != std::string::npos);
        }
        for (std::size_t at = 0; at < all.size();) {
            const std::size_t end = all.find('\n', at);
            const std::string line = all.substr(at, end - at);
            if (!line.starts_with("  octant") && line.find(' ', 30) != std::string::npos) { CHECK(line.size() <= 80); }
            at = end + 1;
        }
        CHECK(all.find("--machine-sharing") == std::string::npos);
        CHECK(all.find("--detail") == std::string::npos);
    }
}

TEST_CASE("old names of options are read, with one note each that names the new form") {
    const auto run = tests::run_octant({"fly", "--terrain", "/nowhere.tif", "--mesh", "printed", "--control-a", "1000",
        "--no-roads", "--order-method", "tree"});
    CHECK(run.exit_code == 2);
    CHECK(tests::lines_in(run.err) == 5);
    for (const char* note :
        {"note: --mesh is now --terrain-lod ", "note: --control-a is now --terrain-lod paper:control-a=A;",
            "note: --no-roads is now --show no-roads;", "--order-method: 'tree' is the old name of exact"}) {
        INFO(run.err);
        CHECK(run.err.find(note) != std::string::npos);
    }
    tests::check_refused("fly", {"--terrain", "/nowhere.tif", "--no-roads", "--order-method", "tree"}, "/nowhere.tif");
}

TEST_CASE("an old name in a settings file is told once, and not with --quiet") {
    const std::string file = (tests::empty_folder("old-settings") / "settings.json").string();
    write_file(file, "{\"order-method\": \"tree\", \"terrain\": \"/nowhere.tif\"}");
    const auto run = tests::run_octant({"fly", "--settings", file});
    CHECK(run.err.starts_with("note: order-method: 'tree' is the old name of exact\n"));
    CHECK(tests::lines_in(run.err) == 2);
    tests::check_refused("fly", {"--settings", file}, "/nowhere.tif");
}

TEST_CASE("all commands together have at most 149 options") {
    const std::string all = tests::run_octant({"--help-all"}).out;
    std::set<std::string> names;
    for (const std::string_view line : split_lines(all)) {
        std::string_view name = split_words(line).empty() ? "" : split_words(line).front();
        if (name.starts_with("--[no-]")) { name.remove_prefix(5); }
        if (line.starts_with("  --")) { names.emplace(name.substr(name.find_first_not_of('-'))); }
    }
    CHECK(names.size() > 100);
    CHECK(names.size() <= 149);
}

TEST_CASE("a key of a family of options is read and refused as an option is") {
    for (const auto& [word, expected] : std::map<std::string, std::string>{
             {"roads=perhaps", "--show: expected head-up-display, "}, {"rivers", "got 'rivers'"},
             {"mesh=red", "--show mesh: expected one of none, edges, levels, got 'red'"}, {"mesh", "got 'mesh'"}}) {
        tests::check_refused("fly", {"--show", word}, expected);
    }
    tests::check_refused(
        "fly", {"--show", "roads,no-shadows,mesh=levels", "--terrain", "/nowhere.tif"}, "/nowhere.tif");
}

TEST_CASE("a flag that is not set is neither of its values: rotors are discs, with --no-effects blades") {
    const auto picture = [](const std::string& flag) {
        std::vector<std::string> words{"straight", "--aircraft", "500md", "--terrain", "none", "--size", "96x54",
            "--renderer", "raster", "--frames", "1", "--warm-up", "0"};
        if (!flag.empty()) { words.push_back(flag); }
        return tests::results_of_run("fly", words)["picture_hash"].text();
    };
    const std::string discs = picture("");
    CHECK(picture("--effects") == discs); // a helicopter has no plumes
    CHECK(picture("--no-effects") != discs);
}
