#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"

#include <catch2/catch.hpp>

#include <string>

using namespace octant;
using octant::tests::run_octant;

namespace {

std::filesystem::path folder() {
    static const auto made = tests::empty_folder("simplification");
    return made;
}

tests::ProgramRun study(std::vector<std::string> more) {
    std::vector<std::string> words{"study", "simplification", "--quiet", "--out", (folder() / "out").string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_octant(words);
}

} // namespace

TEST_CASE("the study of simplification prints the paper's tables with ours beside") {
    const tests::ProgramRun run = study({"--paper-only", "--json"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const auto tables = tests::PrintedJson(run.out);
    REQUIRE(tables.size() == 2);
    CHECK(tables[0]["rows"].size() == 6);
    CHECK(tables[1]["rows"].size() == 18);
    CHECK(tables[0]["rows"][0]["mesh"] == "globe");
    CHECK(tables[0]["rows"][0]["paper: outside"] == "2479236 of 2713824 = 91.36 %");
    for (const char* name : {"table-1.csv", "table-2.csv", "simplification.md"}) {
        CHECK(std::filesystem::exists(folder() / "out" / name));
    }
    const std::string markdown = read_text_file(folder() / "out" / "simplification.md");
    CHECK(markdown.find("How the paper is read") < markdown.find("Table 1"));
    CHECK(markdown.find("Left out: the bunny") != std::string::npos);
}

TEST_CASE("a bunny that is none, meshes that are not there and peers that are none are refused") {
    const std::string triangle = (folder() / "triangle.obj").string();
    write_file(triangle, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const tests::ProgramRun other = study({"--bunny", triangle});
    CHECK(other.exit_code == 2);
    CHECK(other.err.find("expected the Stanford bunny") != std::string::npos);
    CHECK(study({"--mesh", "/nowhere.obj"}).exit_code == 2);
    for (const char* name : {"simplification", "refinement", "shading"}) {
        INFO(name);
        const std::filesystem::path out = folder() / "no-tables";
        const tests::ProgramRun none =
            tests::run_octant({"study", name, "--mesh", "/nowhere.obj", "--out", out.string()});
        CHECK(none.exit_code == 2);
        CHECK(none.err.find("/nowhere.obj") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(out));
    }
    const tests::ProgramRun peers = study({"--peers", "/bin/true"});
    CHECK(peers.exit_code == 2);
    CHECK(peers.err.find("expected a line of JSON") != std::string::npos);
}
