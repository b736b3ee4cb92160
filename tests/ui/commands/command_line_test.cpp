#include "ui/command_line/command_line.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace octant::ui::command_line;

namespace {

/// A program of two commands, one of which has commands below it.
Program small_program() {
    const auto read = [](const Words&) {};
    const Option out{.name = "--out", .form = "FILE", .read = read, .required = true};
    const Option frames{.name = "--frames", .form = "N", .read = read};
    const Option region{
        .name = "--region", .form = "X Y RADIUS", .arity = Arity::OneOrMore, .read = read, .words_per_use = 3};
    const Option quiet{.name = "--quiet", .arity = Arity::None, .read = read, .shown_default = {}};
    const Option vsync{.name = "--vsync,!--no-vsync", .arity = Arity::None, .read = read};
    const Option input{.name = "in", .form = "FILE", .read = read, .required = true};
    const auto run = [] {};
    return {.name = "octant",
        .about = "small",
        .version = "1",
        .footer = {},
        .commands = {{.name = "fly", .summary = "flies", .options = {frames, quiet, vsync, region}, .run = run},
            {.name = "terrain",
                .summary = "ground",
                .commands = {{.name = "make", .summary = "makes", .options = {input, out}, .run = run}}}}};
}

std::string refusal_of(std::vector<std::string> words, const Program& program = small_program()) {
    words.insert(words.begin(), "octant");
    std::vector<const char*> arguments;
    for (const std::string& word : words) { arguments.push_back(word.c_str()); }
    try {
        parse_command_line(program, static_cast<int>(arguments.size()), arguments.data());
    } catch (const std::exception& fault) { return fault.what(); }
    return "accepted";
}

} // namespace

TEST_CASE("what is wrong with a command line is said as what was expected and what came") {
    CHECK(refusal_of({"fly", "--frames", "3", "--quiet"}) == "accepted");
    CHECK(refusal_of({}) == "expected a command (fly, terrain), got none");
    CHECK(refusal_of({"terain"}) == "expected a command (fly, terrain), got terain; perhaps terrain is meant");
    CHECK(refusal_of({"terrain"}) == "terrain: expected a command (make), got none");
    CHECK(refusal_of({"terrain", "maek"}) == "terrain: expected a command (make), got maek; perhaps make is meant");
    CHECK(refusal_of({"fly", "--frams", "3"}) ==
          "fly: expected one of its options, got --frams; perhaps --frames is meant");
    CHECK(refusal_of({"fly", "--frams=3"}) ==
          "fly: expected one of its options, got --frams=3; perhaps --frames is meant");
    CHECK(refusal_of({"fly", "-x"}) == "fly: expected one of its options, got -x");
    CHECK(refusal_of({"fly", "there"}) == "fly: expected no further argument, got 'there'");
    CHECK(refusal_of({"fly", "--frames"}) == "--frames: expected N, got none");
    CHECK(refusal_of({"fly", "--frames", "3", "--frames", "4"}) == "--frames: expected N once, got 3 4");
    CHECK(refusal_of({"fly", "--frames", ""}) == "--frames: expected N, got none");
    CHECK(refusal_of({"terrain", "make", "", "--out", "a"}) == "IN: expected FILE, got none");
    CHECK(refusal_of({"fly", "--region", "1", "2"}) == "--region: expected X Y RADIUS, got 1 2");
    CHECK(refusal_of({"fly", "--quiet=perhaps"}) == "--quiet: expected nothing, =true or =false after it, got perhaps");
    for (const char* const value : {"3", "0", "1", "on", "False", "-1"}) {
        CHECK(refusal_of({"fly", std::string("--quiet=") + value}) ==
              std::string("--quiet: expected nothing, =true or =false after it, got ") + value);
    }
    CHECK(refusal_of({"fly", "--no-vsync=false"}) ==
          "--no-vsync: expected nothing after it, got false; --vsync=true or --vsync=false is taken");
    CHECK(refusal_of({"terrain", "make"}) == "IN: expected FILE, got none");
    CHECK(refusal_of({"terrain", "make", "a.tif"}) == "--out: expected FILE, got none");
}

TEST_CASE("a flag is set and unset by its value as by its names") {
    const auto value_after = [](bool before, const char* word) {
        bool value = before;
        const auto run = [] {};
        const Program program{.name = "octant",
            .about = "small",
            .version = "1",
            .footer = {},
            .commands = {{.name = "fly",
                .summary = "flies",
                .options = {flag("--sky,!--no-sky", "sky", value), flag("--json", "", value)},
                .run = run}}};
        const std::vector<const char*> arguments{"octant", "fly", word};
        parse_command_line(program, static_cast<int>(arguments.size()), arguments.data());
        return value;
    };
    for (const bool before : {false, true}) {
        CHECK(value_after(before, "--sky"));
        CHECK(value_after(before, "--sky=true"));
        CHECK_FALSE(value_after(before, "--sky=false"));
        CHECK_FALSE(value_after(before, "--no-sky"));
        CHECK(value_after(before, "--json=true"));
        CHECK_FALSE(value_after(before, "--json=false"));
    }
}

TEST_CASE("bytes of the command line that a terminal would obey are not handed on") {
    const std::string text = refusal_of({"fly", "\x1b[31m"});
    CHECK(text.find('\x1b') == std::string::npos);
}

TEST_CASE("a slip of the fingers finds the command that was meant, another word none") {
    const auto meant = [](const std::string& word, const std::vector<std::string>& known) {
        Program program{.name = "octant", .about = {}, .version = {}, .footer = {}, .commands = {}};
        for (const std::string& name : known) { program.commands.push_back({.name = name, .summary = {}}); }
        const std::string refusal = refusal_of({word}, program);
        const std::size_t at = refusal.find("; perhaps ");
        return at == std::string::npos ? "" : refusal.substr(at);
    };
    const std::vector<std::string> known{"frames", "frame-per-sample", "seconds", "size", "start", "rate"};
    for (const std::string word : {"frams", "frmaes", "-frames"}) {
        CHECK(meant(word, known) == "; perhaps frames is meant");
    }
    CHECK(meant("sec", known) == "; perhaps seconds is meant");
    CHECK(meant("starts", known) == "; perhaps start is meant");
    for (const std::string& word : {std::string("video"), std::string(), std::string(100'000, 'a')}) {
        CHECK(meant(word, known).empty());
    }
    CHECK(meant("tear", {"near", "fear"}).empty()); // equally near
}
