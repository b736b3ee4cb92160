#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>

using namespace octant;
namespace fs = std::filesystem;

namespace {

fs::path status_path(const std::string& name) { return tests::scratch_folder() / name; }

/// A link that leads to itself.
fs::path link_in_a_circle() {
    const fs::path link = status_path("circle");
    fs::remove(link);
    fs::create_symlink(link, link);
    return link;
}

} // namespace

TEST_CASE("files and folders are told apart, and what cannot be looked up is not there") {
    const fs::path file = status_path("plain");
    write_file(file, "x");
    CHECK(path_exists(file));
    CHECK(is_file(file));
    CHECK_FALSE(is_folder(file));
    CHECK(is_folder(tests::scratch_folder()));
    CHECK(path_exists("/dev/null"));
    CHECK_FALSE(is_file("/dev/null"));
    const fs::path circle = link_in_a_circle();
    for (const fs::path& name : {circle, circle / "in", fs::path(std::string(5000, 'n')), fs::path()}) {
        CHECK_FALSE(path_exists(name));
        CHECK_FALSE(is_file(name));
        CHECK_FALSE(is_folder(name));
        CHECK_FALSE(is_same_file(name, file));
    }
    CHECK_THROWS_AS(read_file(circle), Error);
    CHECK_THROWS_AS(write_file(std::string(5000, 'n'), "x"), Error);
    CHECK_THROWS_AS(check_can_write(circle / "in"), Error);
    CHECK_THROWS_AS(make_folder(circle / "in"), Error);
}

TEST_CASE("two names of one file are the same file, be it there or not") {
    const fs::path file = status_path("named");
    write_file(file, "x");
    const fs::path link = status_path("link");
    fs::remove(link);
    fs::create_symlink(file, link);
    const fs::path around = status_path(".") / "." / "named";
    CHECK(is_same_file(file, link));
    CHECK(is_same_file(file, around));
    CHECK(is_same_file(status_path("none"), status_path(".") / "none"));
    CHECK_FALSE(is_same_file(file, status_path("other")));
    CHECK_FALSE(is_same_file("", ""));
    CHECK(absolute_path("/a/./b/../c") == "/a/c");
}

TEST_CASE("a file may have the longest name there is") {
    const fs::path file = status_path(std::string(255, 'n'));
    write_file(file, "whole");
    CHECK(read_file(file) == "whole");
    CHECK(is_unfinished("folder/.octant-12-0.part"));
    CHECK_FALSE(is_unfinished(file));
}

TEST_CASE("a file that is too large is refused by its size, unread") {
    const fs::path file = status_path("sparse");
    write_file(file, "");
    fs::resize_file(file, std::uintmax_t{40} << 30);
    CHECK_THROWS_WITH(read_file(file), file.string() + ": expected at most 268435456 bytes, got more");
    fs::remove(file);
}

TEST_CASE("a text from outside becomes one line that a terminal only shows") {
    CHECK(one_line("a\nb\r\nc\td") == "a b  c d");
    CHECK(one_line("\x1b[31mred\x1b[0m\x07") == "?[31mred?[0m?");
    CHECK(one_line("caf\xC3\xA9 \xE2\x82\xAC") == "caf\xC3\xA9 \xE2\x82\xAC");
    CHECK(one_line("\xC2\x9B"
                   "31m \xFF \x7F") == "?31m ? ?");
    CHECK(one_line("\xE2\x82") == "??");
    CHECK(one_line("").empty());
}
