#include "sim/base/text_file.h"
#include "sim/links/cigi_host.h"
#include "sim/links/udp_port.h"
#include "sim/links/wire_bytes.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/flight/small_ground.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace octant;
using Catch::Contains;
using ui::report::FrameRecord;

namespace {

namespace fs = std::filesystem;
namespace links = sim::links;

constexpr int frames = 24;
constexpr std::uint32_t channel_address = 0x7f000001;

/// A UDP port that nobody has just now.
std::uint16_t free_channel_port() { return links::UdpPort(channel_address, 0).port(); }

/// Runs the program, which prints to nowhere; several may run at a time.
int run_silently(const std::vector<std::string>& arguments) {
    std::string command = fmt::format("'{}'", OCTANT_PROGRAM);
    for (const std::string& word : arguments) { command += fmt::format(" '{}'", word); }
    return std::system((command + " >/dev/null 2>&1").c_str()); // NOLINT
}

std::vector<FrameRecord> frame_rows(const fs::path& folder) {
    return ui::report::read_frame_csv(folder / "frames.csv").records;
}

/// An image generator that draws nothing. It answers each message by a Start of Frame, from a port of its own, but what
/// `loses` says of the host's frame and how often it came before is lost on the way.
class Generator {
public:
    using Loses = std::function<bool(std::uint32_t host_frame, int times)>;

    Generator(std::uint16_t host_port, Loses loses)
        : host_port_(host_port), loses_(std::move(loses)), thread_([this] { work(); }) {}

    ~Generator() {
        done_ = true;
        thread_.join();
    }

    Generator(const Generator&) = delete;
    Generator& operator=(const Generator&) = delete;
    Generator(Generator&&) = delete;
    Generator& operator=(Generator&&) = delete;

    std::uint16_t port() const { return in_.port(); }

private:
    void answer(std::uint32_t host_frame) {
        links::WireWriter start(links::ByteOrder::Big);
        links::CigiStartOfFrame frame;
        frame.host_frame = host_frame;
        links::add_start_of_frame(start, frame);
        out_.send({channel_address, host_port_}, start.bytes());
    }

    void work() {
        std::vector<links::Datagram> packets;
        std::uint32_t last = 0;
        int times = 0;
        while (!done_) {
            packets.clear();
            in_.drain(links::Protocol::Cigi, 0.0, packets);
            for (const links::Datagram& packet : packets) {
                const auto host_frame = links::WireReader(packet.bytes, links::ByteOrder::Big).at<std::uint32_t>(8);
                times = host_frame == last ? times + 1 : 0;
                last = host_frame;
                if (!loses_(host_frame, times)) { answer(host_frame); }
            }
            if (last == 0) { answer(0); }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    std::uint16_t host_port_;
    Loses loses_;
    links::UdpPort in_{channel_address, 0};
    links::UdpPort out_{channel_address, 0};
    std::atomic<bool> done_ = false;
    std::thread thread_;
};

/// What a host records that sends twelve frames to two generators, the first of which loses some.
struct LossyRun {
    std::vector<FrameRecord> rows;
    std::string report;
    std::string err;
};

LossyRun lossy_run(const std::string& name, Generator::Loses loses) {
    const fs::path folder = tests::empty_folder(name) / "host";
    const std::uint16_t own = free_channel_port();
    const Generator first(own, std::move(loses));
    const Generator second(own, [](std::uint32_t, int) { return false; });
    const tests::ProgramRun run = tests::run_octant({"fly", "turn", "--frames", "12", "--size", "32x18", "--terrain",
        "none", "--pictures", "0", "--send", fmt::format("cigi:127.0.0.1:{}:{}", second.port(), own), "--send",
        fmt::format("cigi:127.0.0.1:{}:{}", first.port(), own), "--record", folder.string()});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return {frame_rows(folder), read_text_file(folder / "report.html"), run.err};
}

} // namespace

TEST_CASE("a frame that a channel did not show counts as skew in its own row") {
    const LossyRun run = lossy_run("channels-skew", [](std::uint32_t frame, int) { return frame == 5 || frame == 6; });
    REQUIRE(run.rows.size() == 12);
    for (std::size_t k = 0; k < run.rows.size(); ++k) {
        CAPTURE(k);
        CHECK(run.rows[k].skew_frames == (k == 4 ? 1 : k == 5 ? 2 : 0));
    }
    CHECK_THAT(run.report, Contains("2 frames, 2 of 12"));
    CHECK_THAT(run.err, Contains("2 of 12 frames not shown in time"));
}

TEST_CASE("a message to a channel that is lost is sent again, and no frame is missed") {
    const LossyRun run =
        lossy_run("channels-again", [](std::uint32_t frame, int times) { return frame % 3 == 0 && times == 0; });
    REQUIRE(run.rows.size() == 12);
    CHECK(std::ranges::all_of(run.rows, [](const FrameRecord& row) { return row.skew_frames == 0; }));
    CHECK_THAT(run.err, Contains("0 of 12 frames not shown in time; 4 messages sent again"));
}

TEST_CASE("three octants show one world in step from one host") {
    const fs::path folder = tests::empty_folder("channels");
    const std::array<std::string, 3> names{"left", "front", "right"};
    const std::uint16_t own = free_channel_port();
    const std::vector<std::string> world{"--size", "96x54", "--pictures", "0", "--aircraft", "f15", "--aircraft",
        "500md", "--terrain", tests::small_ground()};
    std::vector<std::string> host{
        "fly", "turn", "--frames", std::to_string(frames), "--record", (folder / "host").string()};
    std::vector<std::thread> channels;
    std::array<int, 3> exit_codes{-1, -1, -1};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::uint16_t port = free_channel_port();
        std::vector<std::string> arguments{"listen", "--headless", "--step", "--ports", "cigi=" + std::to_string(port),
            "--cigi", fmt::format("host=127.0.0.1:{}", own), "--channel", names[i], "--frames", std::to_string(frames),
            "--record", (folder / names[i]).string()};
        arguments.insert(arguments.end(), world.begin(), world.end());
        channels.emplace_back([&exit_codes, i, arguments] { exit_codes[i] = run_silently(arguments); });
        host.insert(host.end(), {"--send", fmt::format("cigi:127.0.0.1:{}:{}", port, own)});
    }
    host.insert(host.end(), world.begin(), world.end());
    const tests::ProgramRun run = tests::run_octant(host);
    std::ranges::for_each(channels, [](std::thread& channel) { channel.join(); });
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(exit_codes == std::array<int, 3>{0, 0, 0});

    const std::vector<FrameRecord> of_host = frame_rows(folder / "host");
    REQUIRE(of_host.size() == frames);
    CHECK(std::ranges::all_of(of_host, [](const FrameRecord& row) { return row.skew_frames == 0; }));
    CHECK_THAT(read_text_file(folder / "host" / "report.html"), Contains("0 frames, 0 of 24"));

    std::array<std::vector<FrameRecord>, 3> rows;
    for (std::size_t i = 0; i < names.size(); ++i) {
        rows[i] = frame_rows(folder / names[i]);
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
