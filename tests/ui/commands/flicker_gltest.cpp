#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/printed_json.h"

#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <string>
#include <vector>

using namespace octant;
using octant::tests::run_octant;

namespace {

std::filesystem::path flicker_folder() {
    static const auto made = tests::empty_folder("flicker");
    return made;
}

std::string made_field(const std::string& kind) {
    const std::string file = (flicker_folder() / (kind + ".tif")).string();
    const tests::ProgramRun run =
        run_octant({"terrain", "make", "--kind", kind, "--size", "257", "--spacing", "40", "--out", file, "--quiet"});
    REQUIRE(run.exit_code == 0);
    return file;
}

tests::ProgramRun flicker_study(const std::string& out) {
    return run_octant({"study", "flicker", "--out", (flicker_folder() / out).string(), "--gentle", made_field("hills"),
        "--rugged", made_field("canyon"), "--frames", "100", "--json", "--quiet"});
}

bool is_number_to_15(const tests::PrintedJson& cell) { return cell.is_number() && cell.number() <= 15; }

} // namespace

TEST_CASE("the flicker study writes its tables and figures, the same bytes each time") {
    const tests::ProgramRun run = flicker_study("a");
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.err.empty());
    const tests::PrintedJson tables = tests::PrintedJson(run.out);
    REQUIRE(tables.size() == 6);
    CHECK(tables[0]["rows"].size() == 28); // four c, seven controls
    CHECK(tables[2]["rows"].size() == 12); // two fields, six controls that hold a target
    const tests::PrintedJson by_error = tables[0]["rows"][6];
    CHECK(by_error["control"] == "screen error (default)");
    CHECK(by_error["mean abs dn, last 50"] == 0);
    CHECK(is_number_to_15(by_error["dn = 0 for ever after, frames"]));
    for (const tests::PrintedJson& row : tables[4]["rows"].elements()) {
        for (const char* first : {"C_0 = 2", "C_0 = 16", "C_0 = 64"}) {
            INFO(row);
            CHECK(is_number_to_15(row[first]));
        }
    }
    const tests::PrintedJson reliefs = tables[5]["rows"];
    CHECK(reliefs.size() == 15); // five grounds, three controls
    int met = 0;
    for (const tests::PrintedJson& row : reliefs.elements()) {
        const bool has_enough = row["g, mean"].is_number(); // triangles for N, or g has no value
        if (row["control"] == "damped, own gain" && has_enough) {
            INFO(row);
            CHECK(row["fixed view, mean abs dn"] == 0);
            CHECK(row["path, % of N"].number() <= 0.1);
            ++met;
        }
    }
    CHECK(met == 3);
    CHECK(flicker_study("b").out == run.out);
    for (const char* file : {"fixed-rugged.csv", "fixed-gentle.csv", "path.csv", "damping.csv", "stability.csv",
             "relief.csv", "path-gentle.csv", "path-rugged.csv", "flicker.md", "flicker.html"}) {
        INFO(file);
        const std::string text = read_file(flicker_folder() / "a" / file);
        CHECK_FALSE(text.empty());
        CHECK(read_file(flicker_folder() / "b" / file) == text);
    }
    CHECK(tests::lines_in(read_file(flicker_folder() / "a" / "path-rugged.csv")) == 100);
    const std::string page = read_file(flicker_folder() / "a" / "flicker.html");
    for (const char* figure : {"Figure 3", "Figure 5", "Figure 6", "Figure 8", "Figure 9", "Damping: dn"}) {
        CHECK_THAT(page, Catch::Contains(fmt::format("<h3>{}", figure)));
    }
}

TEST_CASE("the flicker study refuses ground that is not there") {
    const tests::ProgramRun run =
        run_octant({"study", "flicker", "--out", (flicker_folder() / "none").string(), "--rugged", "hols"});
    CHECK(run.exit_code == 2);
    CHECK(tests::lines_in(run.err) == 1);
    CHECK(run.err.find("expected hills, canyon or a file, got 'hols'") != std::string::npos);
}
