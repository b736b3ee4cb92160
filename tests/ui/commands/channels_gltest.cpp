#include "sim/base/text_file.h"
#include "sim/links/udp_port.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/flight/small_ground.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <thread>
#include <vector>

using namespace octant;
using Catch::Contains;
using ui::report::FrameRecord;

namespace {

namespace fs = std::filesystem;
namespace links = sim::links;

constexpr int frames = 24;

/// A UDP port that nobody has just now.
std::uint16_t free_port() {
    constexpr std::uint32_t loopback = 0x7f000001;
    return links::UdpPort(loopback, 0).port();
}

/// Runs the program, which prints to nowhere; several may run at a time.
int run_silently(const std::vector<std::string>& arguments) {
    std::string command = fmt::format("'{}'", OCTANT_PROGRAM);
    for (const std::string& word : arguments) {
        command += fmt::format(" '{}'", word);
    }
    return std::system((command + " >/dev/null 2>&1").c_str()); // NOLINT
}

std::vector<FrameRecord> rows_of(const fs::path& folder) {
    return ui::report::read_frame_csv(folder / "frames.csv").records;
}

} // namespace

TEST_CASE("three octants show one world in step from one host") {
    const fs::path folder = tests::empty_folder("channels");
    const std::array<std::string, 3> names{"left", "front", "right"};
    const std::uint16_t own = free_port();
    const std::vector<std::string> world{
        "--size",
        "96x54",
        "--pictures",
        "0",
        "--aircraft",
        "f15",
        "--aircraft",
        "500md",
        "--terrain",
        tests::small_ground()};
    std::vector<std::string> host{
        "fly", "turn", "--frames", std::to_string(frames), "--record", (folder / "host").string()};
    std::vector<std::thread> channels;
    std::array<int, 3> exit_codes{-1, -1, -1};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::uint16_t port = free_port();
        std::vector<std::string> arguments{
            "listen",
            "--headless",
            "--step",
            "--cigi-port",
            std::to_string(port),
            "--cigi-host",
            fmt::format("127.0.0.1:{}", own),
            "--channel",
            names[i],
            "--frames",
            std::to_string(frames),
            "--record",
            (folder / names[i]).string()};
        arguments.insert(arguments.end(), world.begin(), world.end());
        channels.emplace_back(
            [&exit_codes, i, arguments] { exit_codes[i] = run_silently(arguments); });
        host.insert(host.end(), {"--send", fmt::format("cigi:127.0.0.1:{}:{}", port, own)});
    }
    host.insert(host.end(), world.begin(), world.end());
    const tests::ProgramRun run = tests::run_octant(host);
    std::ranges::for_each(channels, [](std::thread& channel) { channel.join(); });
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(exit_codes == std::array<int, 3>{0, 0, 0});

    const std::vector<FrameRecord> of_host = rows_of(folder / "host");
    REQUIRE(of_host.size() == frames);
    CHECK(
        std::ranges::all_of(of_host, [](const FrameRecord& row) { return row.skew_frames == 0; }));
    CHECK_THAT(read_text_file(folder / "host" / "report.html"), Contains("0 frames, 0 of 24"));

    std::array<std::vector<FrameRecord>, 3> rows;
    for (std::size_t i = 0; i < names.size(); ++i) {
        rows[i] = rows_of(folder / names[i]);
        REQUIRE(rows[i].size() == frames);
    }
    for (std::size_t k = 0; k < frames; ++k) {
        for (const std::vector<FrameRecord>& channel : rows) {
            CHECK(channel[k].host_frame == static_cast<int>(k) + 1);
            CHECK(channel[k].state_hash == rows[0][k].state_hash);
            CHECK(glm::distance(channel[k].aircraft_m, of_host[k].aircraft_m) < 0.01);
            CHECK(glm::distance(channel[k].eye_m, of_host[k].eye_m) < 0.01);
        }
        CHECK(rows[0][k].picture_hash != rows[1][k].picture_hash);
        CHECK(rows[2][k].picture_hash != rows[1][k].picture_hash);
    }
}
