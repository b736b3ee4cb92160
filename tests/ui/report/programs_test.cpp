#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/child_program.h"
#include "ui/report/video_pipe.h"

#include <catch2/catch.hpp>

#include <iostream>

using namespace octant;
using namespace octant::ui::report;
using octant::tests::make_program;
using octant::tests::SearchPath;

TEST_CASE("a program is fed, and its output and its end are reported") {
    auto cat = ChildProgram::start({"cat", "-"});
    REQUIRE(cat);
    const std::string much(3'000'000, 'x');
    CHECK(cat->send(much));
    const ProgramResult ending = cat->finish();
    CHECK(ending.succeeded);
    CHECK(ending.output == much);
    auto failing = ChildProgram::start({"sh", "-c", "echo one >&2; echo two >&2; exit 4"});
    REQUIRE(failing);
    const ProgramResult failed = failing->finish();
    CHECK_FALSE(failed.succeeded);
    CHECK(failed.last_error_line == "two");
    auto silent = ChildProgram::start({"sh", "-c", "exit 4"});
    REQUIRE(silent);
    CHECK(silent->finish().last_error_line == "ended with exit code 4");
    auto killed = ChildProgram::start({"sh", "-c", "kill -9 $$"});
    REQUIRE(killed);
    CHECK(killed->finish().last_error_line == "ended by signal 9");
}

TEST_CASE("a program that is not there is nothing, and arguments meet no shell") {
    CHECK_FALSE(ChildProgram::start({"octant-has-no-such-program"}));
    auto echo = ChildProgram::start({"printf", "%s|", "a b", "$(id)", "'\";*"});
    REQUIRE(echo);
    CHECK(echo->finish().output == "a b|$(id)|'\";*|");
}

TEST_CASE("without ffmpeg a video is refused before anything is flown") {
    const ScratchFolder scratch;
    const SearchPath nothing(scratch.path().string());
    const auto file = scratch / "a.mp4";
    const std::string refused = file.string() + ": expected ffmpeg to make a video with, found none on PATH";
    CHECK_THROWS_WITH(check_video(file), refused);
    CHECK_THROWS_WITH(VideoPipe(file, {4, 4, 3, false, 60.0}), refused);
    CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("of what an ffmpeg that fails leaves only whole fragments are kept") {
    const ScratchFolder scratch;
    make_program(scratch / "bin", "ffmpeg", "for file; do :; done; cat \"$OCTANT_LEFT\" > \"${file#file:}\"; exit 1");
    const SearchPath only((scratch / "bin").string() + ":/usr/bin:/bin");
    const auto left = [&](const std::string& bytes) {
        write_file(scratch / "left", bytes);
        ::setenv("OCTANT_LEFT", (scratch / "left").c_str(), 1);
        VideoPipe video(scratch / "a.mp4", {4, 4, 3, false, 60.0});
        const auto fault = video.finish();
        REQUIRE(fault);
        const bool kept = std::filesystem::exists(scratch / "a.mp4");
        CHECK_THAT(*fault, Catch::StartsWith(kept ? "cut short: " : "not made: "));
        return kept ? read_file(scratch / "a.mp4") : "nothing";
    };
    const auto box = [](const std::string& kind, const std::string& content) {
        const auto size = static_cast<char>(8 + content.size());
        return std::string{0, 0, 0, size} + kind + content;
    };
    const std::string head = box("ftyp", "isom") + box("moov", "");
    const std::string fragment = box("moof", "abc") + box("mdat", "defgh");
    CHECK(left("") == "nothing");
    CHECK(left("no video") == "nothing");
    CHECK(left(head) == "nothing");
    CHECK(left(head + fragment) == head + fragment);
    const std::string two = head + fragment + fragment;
    for (std::size_t cut = 1; cut <= fragment.size(); ++cut) {
        CHECK(left(two.substr(0, two.size() - cut)) == head + fragment);
    }
    CHECK(left(head + fragment.substr(0, fragment.size() - 1)) == "nothing");
    ::unsetenv("OCTANT_LEFT");
}

TEST_CASE("an ffmpeg that complains is reported although it says that it succeeded") {
    const ScratchFolder scratch;
    make_program(scratch / "bin", "ffmpeg", "echo 'Error closing file: No space left on device' >&2");
    const SearchPath only((scratch / "bin").string());
    VideoPipe video(scratch / "a.mp4", {4, 4, 3, false, 60.0});
    CHECK(video.finish() == "not made: ffmpeg: Error closing file: No space left on device");
}

TEST_CASE("an ffmpeg that fails is reported with its last line and stops nobody") {
    const ScratchFolder scratch;
    make_program(scratch / "bin", "ffmpeg", "echo first >&2; echo 'no such codec' >&2; exit 1");
    const SearchPath only((scratch / "bin").string());
    const Picture picture = made_up_picture(640, 480, 3);
    VideoPipe video(scratch / "a.mp4", {640, 480, 3, false, 60.0});
    for (int i = 0; i < 20; ++i) {
        video.add(picture.view()); // more than the channel holds: would be SIGPIPE
    }
    CHECK_FALSE(video.running());
    CHECK(video.finish() == "not made: ffmpeg: no such codec");
}

TEST_CASE("ffmpeg is asked for a file that plays after a kill, by a name nobody misreads") {
    const ScratchFolder scratch;
    make_program(scratch / "bin", "ffmpeg", "for word; do echo \"$word\"; done > \"$0.words\"");
    const SearchPath only((scratch / "bin").string());
    VideoPipe video("-a: b.mp4", {5, 4, 4, true, 20.0});
    CHECK_FALSE(video.finish());
    const std::string words = read_file(scratch / "bin/ffmpeg.words");
    CHECK_THAT(words, Catch::Contains("-video_size\n5x4\n-framerate\n20\n-i\npipe:0\n"));
    CHECK_THAT(words, Catch::Contains("-pix_fmt\nrgba\n"));
    CHECK_THAT(words, Catch::Contains("-c:v\nlibx264\n-crf\n20\n-pix_fmt\nyuv420p\n"));
    CHECK_THAT(words, Catch::Contains("-g\n20\n"));
    CHECK_THAT(words, Catch::Contains("-movflags\n+frag_keyframe+empty_moov+default_base_moof\n"));
    CHECK_THAT(words, Catch::Contains("vflip,pad="));
    CHECK_THAT(words, Catch::EndsWith("file:-a: b.mp4\n"));
}

TEST_CASE("ffmpeg makes a fragmented video of odd size and odd name") {
    auto ffmpeg = ChildProgram::start({"ffmpeg", "-version"});
    if (!ffmpeg) {
        std::cout << "SKIPPED: ffmpeg is not installed\n";
        return;
    }
    ffmpeg->finish();
    const ScratchFolder scratch;
    const auto path = scratch / "odd: 'name' %d.mp4";
    const Picture picture = made_up_picture(63, 47, 4);
    VideoPipe video(path, {63, 47, 4, true, 10.0});
    PixelView view = picture.view();
    view.bottom_row_first = true;
    for (int i = 0; i < 25; ++i) { video.add(view); }
    REQUIRE_FALSE(video.finish());
    const std::string bytes = read_file(path);
    CHECK(bytes.substr(4, 4) == "ftyp");
    std::size_t fragments = 0;
    for (std::size_t at = 0; (at = bytes.find("moof", at)) != std::string::npos; ++at) { ++fragments; }
    CHECK(fragments == 3); // 25 frames, one fragment every 10
}
