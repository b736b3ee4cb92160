#include "sim/base/axes.h"
#include "sim/base/binary_file.h"
#include "sim/base/column_reader.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "sim/base/units.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <set>
#include <span>
#include <sys/resource.h>

using namespace octant;

namespace {

std::filesystem::path scratch(const std::string& name) { return tests::scratch_folder() / name; }

void check_vector(const glm::dvec3& got, const glm::dvec3& expected) {
    for (int axis = 0; axis < 3; ++axis) { CHECK(got[axis] == Approx(expected[axis]).margin(1e-12)); }
}

} // namespace

TEST_CASE("a level aircraft heading north has its nose north, right wing east and belly down") {
    const glm::dquat q = body_to_world_from_euler({});
    check_vector(q * glm::dvec3(1, 0, 0), {0, 1, 0});
    check_vector(q * glm::dvec3(0, 1, 0), {1, 0, 0});
    check_vector(q * glm::dvec3(0, 0, 1), {0, 0, -1});
}

TEST_CASE("heading 90 points east, positive pitch lifts the nose, positive roll drops the right wing") {
    check_vector(body_to_world_from_euler({rad_from_deg(90), 0, 0}) * glm::dvec3(1, 0, 0), {1, 0, 0});
    CHECK((body_to_world_from_euler({0, 0.3, 0}) * glm::dvec3(1, 0, 0)).z == Approx(std::sin(0.3)));
    CHECK((body_to_world_from_euler({0, 0, 0.3}) * glm::dvec3(0, 1, 0)).z == Approx(-std::sin(0.3)));
}

TEST_CASE("Euler angles survive the way to a rotation and back") {
    for (double heading = 0.0; heading < 6.2; heading += 0.7) {
        for (double pitch = -1.5; pitch <= 1.5; pitch += 0.5) {
            for (double roll = -3.0; roll <= 3.0; roll += 0.75) {
                const EulerAngles back = euler_from_body_to_world(body_to_world_from_euler({heading, pitch, roll}));
                CHECK(wrapped_to_pi(back.heading_rad - heading) == Approx(0.0).margin(1e-9));
                CHECK(back.pitch_rad == Approx(pitch).margin(1e-9));
                CHECK(back.roll_rad == Approx(roll).margin(1e-9));
            }
        }
    }
}

TEST_CASE("straight up and down keep a heading and give no roll") {
    const EulerAngles up = euler_from_body_to_world(body_to_world_from_euler({1.0, pi / 2, 0.0}));
    CHECK(up.pitch_rad == Approx(pi / 2).margin(1e-6));
    CHECK(up.roll_rad == 0.0);
    CHECK(up.heading_rad == Approx(1.0).margin(1e-6));
}

TEST_CASE("numbers are read whole, finite and in the C locale or not at all") {
    CHECK(finite_number("-1.5e3") == -1500.0);
    CHECK(finite_number("+2") == 2.0);
    for (const char* bad : {"", "1,5", "nan", "inf", "1x", " 1", "--1"}) { CHECK_FALSE(finite_number(bad)); }
    CHECK(whole_number("-12") == -12);
    CHECK_FALSE(whole_number("1.0"));
    CHECK_FALSE(whole_number("99999999999999999999"));
}

TEST_CASE("lines, words and fields are split without their separators") {
    CHECK(split_lines("a\r\nb\n\nc") == std::vector<std::string_view>{"a", "b", "", "c"});
    CHECK(split_words("  f 1\t2 ") == std::vector<std::string_view>{"f", "1", "2"});
    CHECK(split_fields("a, b ,,", ',') == std::vector<std::string_view>{"a", "b", "", ""});
}

TEST_CASE("a missing file, a folder and a binary file are refused by name") {
    CHECK_THROWS_WITH(read_file("/nowhere/x.obj"), "/nowhere/x.obj: expected a file, found none");
    CHECK_THROWS_WITH(read_file("/tmp"), "/tmp: expected a file, got a folder");
    const auto path = scratch("binary");
    write_file(path, std::string_view("a\0b", 3));
    CHECK_THROWS_WITH(read_text_file(path), path.string() + ": expected text, got binary data");
    CHECK_THROWS_WITH(read_file("/dev/zero"), "/dev/zero: expected a regular file, got a device or pipe");
    write_file(path, std::string(1001, 'x'));
    CHECK_THROWS_WITH(read_file(path, 1000), path.string() + ": expected at most 1000 bytes, got more");
}

TEST_CASE("a file is written whole, replaced whole, and a full disk leaves nothing behind") {
    const auto path = scratch("whole");
    write_file(path, "one");
    write_file(path, "two");
    CHECK(read_file(path) == "two");
    CHECK_THROWS_WITH(write_file("/dev/full", "x"), Catch::Contains("No space left on device"));
    CHECK_THROWS_WITH(write_file("/nowhere/x", "x"), Catch::Contains("No such file or directory"));
    const auto folder = std::filesystem::directory_iterator(path.parent_path());
    for (const auto& entry : folder) { CHECK(entry.path().extension() != ".part"); }
}

TEST_CASE("a growing file keeps what was flushed") {
    const auto path = scratch("growing");
    AppendedFile file(path);
    file.append("line\n");
    CHECK(read_file(path).empty());
    file.flush();
    CHECK(read_file(path) == "line\n");
    AppendedFile full("/dev/full");
    full.append("x");
    CHECK_THROWS_AS(full.flush(), Error);
}

TEST_CASE("a growing file with an end has it after each flush, and where the disk is full") {
    const auto path = scratch("ended");
    {
        AppendedFile file(path, "]");
        file.append("[1");
        file.flush();
        CHECK(read_file(path) == "[1]");
        file.flush();
        CHECK(read_file(path) == "[1]");
        file.append(",22");
        CHECK(read_file(path) == "[1]");
        file.flush();
        CHECK(read_file(path) == "[1,22]");
        file.append(",3");
    }
    CHECK(read_file(path) == "[1,22,3]");
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{10, before.rlim_max};
    {
        AppendedFile file(path, "]");
        file.append("[1");
        file.flush();
        file.append(",2,3,4,5,6,7,8,9");
        setrlimit(RLIMIT_FSIZE, &limit);
        CHECK_THROWS_WITH(file.flush(), path.string() + ": cannot be written: File too large");
        setrlimit(RLIMIT_FSIZE, &before);
        CHECK(read_file(path) == "[1]");
    }
    std::signal(SIGXFSZ, handler);
    CHECK(read_file(path) == "[1]");
}

TEST_CASE("a hash sees every byte and its place, whole or by quarters") {
    const auto whole = [](std::span<const std::byte> bytes) { return checksum_of(bytes); };
    const auto by_quarters = [](std::span<const std::byte> bytes) { return hash_by_quarters(bytes); };
    const auto check = [](const auto& hash_of) {
        std::array<std::byte, 75> bytes{}; // two words a quarter, and eleven bytes
        std::set<std::uint64_t> seen{hash_of(bytes)};
        for (auto& byte : bytes) {
            byte = std::byte{1};
            CHECK(seen.insert(hash_of(bytes)).second);
            byte = std::byte{0};
        }
    };
    check(whole);
    check(by_quarters);
    std::array<std::byte, 11> shorter_than_a_word_each{};
    const std::uint64_t reference = hash_by_quarters(shorter_than_a_word_each);
    shorter_than_a_word_each.back() = std::byte{1};
    CHECK(hash_by_quarters(shorter_than_a_word_each) != reference);
}

TEST_CASE("text from outside is made printable and short") {
    CHECK(printable("a\nb\x1b") == "a?b?");
    CHECK(printable(std::string(80, 'x')) == std::string(60, 'x') + "...");
}

TEST_CASE("what could not be written is refused before the work, and nothing is written") {
    const auto folder = tests::scratch_folder();
    const auto file = folder / "to-be-written";
    check_can_write(file);
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK_THROWS_AS(check_can_write(folder), Error);
    CHECK_THROWS_AS(check_can_write(folder / "none" / "file"), Error);
}

TEST_CASE("base64 of every remainder is as RFC 4648 has it, comes back, and what is none is refused") {
    CHECK(base64_of("") == "");
    CHECK(base64_of("f") == "Zg==");
    CHECK(base64_of("fo") == "Zm8=");
    CHECK(base64_of("foo") == "Zm9v");
    CHECK(base64_of("foobar") == "Zm9vYmFy");
    CHECK(base64_of("\xFF\xFE") == "//4=");
    for (const std::string text : {"", "a", "ab", "abc", "abcd"}) { CHECK(from_base64(base64_of(text)) == text); }
    CHECK(base64_of("Man") == "TWFu");
    CHECK(base64_of("Ma") == "TWE=");
    CHECK(from_base64("TWE") == "Ma");
    CHECK_FALSE(from_base64("T").has_value());
    CHECK_FALSE(from_base64("TW*u").has_value());
}

TEST_CASE("values written one behind the other are read back, and what is cut or too long is refused with its place") {
    BinaryWriter out;
    out.put(std::uint16_t{0x1234});
    out.put_list(std::vector<float>{1.5F, -2.0F});
    out.put_text("end");
    CHECK(out.bytes().substr(0, 3) == std::string("\x34\x12\x02", 3));
    CHECK(BinaryReader(out.bytes(), {}, 0, std::endian::big).take<std::uint16_t>() == 0x3412);
    BinaryReader in(out.bytes(), "a.bin");
    CHECK(in.take<std::uint16_t>() == 0x1234);
    CHECK(in.take_list<float>() == std::vector<float>{1.5F, -2.0F});
    CHECK_THROWS_WITH(in.expect_end(), "a.bin: at byte 18: expected the end of the file, got 11 more bytes");
    CHECK(in.take_text() == "end");
    in.expect_end();
    CHECK_THROWS_WITH(
        in.take<int>("a side"), "a.bin: at byte 29: expected a side (4 bytes), got 0 to the end of the file");
    BinaryReader cut(std::string_view(out.bytes()).substr(0, 17));
    cut.take<std::uint16_t>();
    CHECK_THROWS_WITH(cut.take_list<float>("heights"), "at byte 2: expected heights of at most 1 times 4 bytes, got 2");
}

TEST_CASE("an archive is read back, and another kind, version, size or byte is refused") {
    const ArchiveKind kind{.content = "a thing", .signature = "octthing", .version = 7, .max_bytes = 100};
    const std::filesystem::path file = scratch("thing");
    const auto text = [](BinaryReader& in) { return std::string(in.take_text()); };
    BinaryWriter body;
    body.put_text("body");
    write_archive(file, kind, body.bytes());
    CHECK(read_archive(file, kind, text) == "body");
    const std::string bytes = read_file(file);
    const auto fault_with = [&](const std::string& changed) {
        write_file(file, changed);
        try {
            read_archive(file, kind, text);
        } catch (const Error& fault) { return std::string(fault.what()).substr(file.string().size()); }
        return std::string();
    };
    const auto fault_of = [&](std::size_t byte, char value) {
        std::string changed = bytes;
        changed[byte] = value;
        return fault_with(changed);
    };
    for (std::size_t byte = 0; byte < bytes.size(); ++byte) {
        CHECK(fault_of(byte, static_cast<char>(bytes[byte] ^ 4)).starts_with(": at byte "));
        CHECK(fault_with(bytes.substr(0, byte)).starts_with(": at byte "));
    }
    CHECK(fault_with(bytes + "x") == ": at byte 16: expected 13 bytes behind the head, got 12");
    CHECK(fault_of(0, 'O') == ": at byte 0: expected a thing, got another file");
    CHECK(fault_of(8, 8) == ": at byte 8: expected version 7, got 8");
    CHECK(fault_of(12, 1) == ": at byte 12: expected 0, got 1");
    CHECK(fault_of(16, 13) == ": at byte 16: expected 12 bytes behind the head, got 13");
    CHECK_THAT(fault_of(43, 'Y'), Catch::StartsWith(": at byte 24: expected the checksum "));
    CHECK_THROWS_WITH(write_archive(file, kind, std::string(101, 'x')), Catch::Contains("expected at most 100 bytes"));
}

TEST_CASE("a text is read word by word, and errors name file, line, what was expected and what was found") {
    TextScanner text("words", "\xef\xbb\xbf  a,1.5 # one, two\r\n{ \"b } \\\" c\"\r -7 2e3 x",
        {.separators = ",", .marks = "{}", .comment = '#', .has_strings = true, .max_number = 1000.0});
    CHECK(text.peek_second() == "1.5");
    CHECK(text.word("a name") == "a");
    CHECK(text.number("a length") == 1.5);
    CHECK(text.peek() == "{");
    CHECK(text.offset() == 23);
    CHECK(text.line_number() == 2);
    CHECK(text.skip("{"));
    CHECK_FALSE(text.skip("}"));
    CHECK(text.word_or_end() == "\"b } \\\" c\"");
    CHECK_THROWS_WITH(text.integer("a count", 0, 9), "words:3: expected a count of 0 to 9, got '-7'");
    CHECK(text.integer("a count") == -7);
    CHECK_THROWS_WITH(text.number("a length"), "words:3: expected a length, got '2e3'");
    CHECK_THROWS_WITH(text.refuse_last("a length"), "words:3: expected a length, got '-7'");
    CHECK(text.rest_of_line() == "2e3 x");
    CHECK_THROWS_WITH(text.word("a name"), "words:3: expected a name, got the end of the file");
    TextScanner open("words", "\"a", {.has_strings = true});
    CHECK_THROWS_WITH(open.peek(), "words:1: expected a quote at the end of a string, got the end of the file");
}

TEST_CASE("a text is read line by line; a backslash joins lines, but not behind a comment") {
    TextScanner text("lines", "\n f 1 \\\r\n2\n # a \\\nname  of it ", {.joins_lines = true});
    REQUIRE((text.next_line() && text.next_line()));
    CHECK(text.skip("f"));
    CHECK(text.words() == std::vector<std::string_view>{"1", "2"});
    CHECK(text.line_number() == 2);
    REQUIRE(text.next_line());
    CHECK(text.line() == " # a \\");
    CHECK_FALSE(text.is_truncated());
    REQUIRE(text.next_line());
    CHECK(text.line_number() == 5);
    CHECK(text.is_truncated());
    text.word_or_end();
    CHECK(text.rest_of_line() == "of it");
    CHECK_THROWS_WITH(text.number("a length"), "lines:5: expected a length, got none");
    CHECK_FALSE(text.next_line());
}

TEST_CASE("a text that comes in pieces has the same words and lines as a text in memory") {
    std::string whole;
    for (int i = 0; i < 5000; ++i) {
        whole += std::string(static_cast<std::size_t>(i % 61), ' ') + fmt::format("{}\r\n", i);
    }
    const auto path = scratch("pieces");
    write_file(path, whole);
    TextScanner lines = TextScanner::of_file(path);
    TextScanner words(path, [&, at = std::size_t{0}](char* to, std::size_t size) mutable {
        const std::size_t taken = whole.copy(to, std::min<std::size_t>(size, 7), at);
        at += taken;
        return taken;
    });
    for (int i = 0; i < 5000; ++i) {
        REQUIRE(lines.next_line());
        REQUIRE(lines.integer("a number") == i);
        REQUIRE(words.integer("a number") == i);
        REQUIRE(words.line_number() == i + 1);
    }
    CHECK_FALSE(lines.next_line());
    CHECK(words.word_or_end().empty());
    write_file(path, "a\n" + std::string(65536, 'b'));
    TextScanner longer = TextScanner::of_file(path);
    CHECK(longer.next_line());
    CHECK_THROWS_WITH(longer.next_line(), path.string() + ":2: expected at most 65535 bytes, got more");
    write_file(path, std::string_view("a\n\0b", 4));
    TextScanner binary = TextScanner::of_file(path);
    CHECK(binary.next_line());
    CHECK_THROWS_WITH(binary.next_line(), path.string() + ": expected text, got binary data");
    write_file(path, "\xef\xbb\xbf"
                     "a\n\xef\xbb\xbf");
    TextScanner marked = TextScanner::of_file(path);
    REQUIRE(marked.next_line());
    CHECK(marked.line() == "a");
    REQUIRE(marked.next_line());
    CHECK(marked.line() == "\xef\xbb\xbf");
}

TEST_CASE("tables are read by the names of their columns, and damage is named by line") {
    const std::string text = "# feet, degrees\n\nName;Height;other\r\n\"a;b\"; 1.5 ;x\n# comment\nc;2;;\nd;e;f\ng;3\n";
    ColumnReader table(TextScanner("t.csv", text));
    REQUIRE(table.next_row());
    CHECK(table.comment() == "# feet, degrees");
    constexpr std::array<TableColumn, 3> columns{{{"name", true}, {"height", true}, {"speed"}}};
    table.find(columns);
    CHECK(table.reaches(1));
    CHECK_FALSE(table.reaches(2));
    CHECK_FALSE(table.has(2));
    REQUIRE(table.next_row());
    CHECK(table.text(0) == "a;b");
    CHECK(table.number(1) == 1.5);
    REQUIRE(table.next_row());
    table.check_field_count(); // one more field, which is empty
    CHECK(table.line_number() == 6);
    REQUIRE(table.next_row());
    CHECK_THROWS_WITH(table.number(1), "t.csv:7: expected a finite number in column height, got 'e'");
    REQUIRE(table.next_row());
    CHECK_THROWS_WITH(table.check_field_count(), "t.csv:8: expected 3 fields, got 2");
    CHECK_FALSE(table.next_row());
}

TEST_CASE("a table without a required column, or with one twice, is refused") {
    constexpr std::array<TableColumn, 1> columns{{{"a", true}}};
    ColumnReader without(TextScanner("t.csv", "b,c\n"));
    REQUIRE(without.next_row());
    CHECK_THROWS_WITH(without.find(columns), "t.csv:1: expected a column a, got 'b,c'");
    ColumnReader twice(TextScanner("t.csv", "a,A\n"));
    REQUIRE(twice.next_row());
    CHECK_THROWS_WITH(twice.find(columns), "t.csv:1: expected column a once, got it twice");
}
