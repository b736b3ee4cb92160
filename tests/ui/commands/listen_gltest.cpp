#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/udp_port.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

using namespace octant;
using Catch::Contains;
using octant::tests::run_octant;

namespace {

namespace fs = std::filesystem;
namespace links = sim::links;

constexpr std::uint32_t loopback = 0x7f000001;

/// A UDP port that nobody has just now.
std::uint16_t free_port() {
    return links::UdpPort(loopback, 0).port();
}

/// North at 100 m/s from 47 N, 8 E, 1,000 m up and 600 m above its own ground.
links::Fix fix_at(double time_s) {
    links::Fix fix;
    fix.latitude_deg = 47.0 + 100.0 * time_s / 111177.0;
    fix.longitude_deg = 8.0;
    fix.altitude_m = 1000.0;
    fix.above_ground_m = 600.0;
    fix.velocity_ned_mps = glm::dvec3(100.0, 0.0, 0.0);
    fix.ticks = static_cast<std::uint32_t>(time_s * 1e6);
    return fix;
}

/// Runs the program while somebody sends FDM packets to its port at about 60 Hz, and now and then a
/// wrong one.
tests::ProgramRun run_with_packets(std::vector<std::string> arguments) {
    const std::uint16_t port = free_port();
    arguments.insert(
        arguments.end(),
        {"--fdm-port",
         std::to_string(port),
         "--mavlink-port",
         "-1",
         "--dis-port",
         "-1",
         "--cigi-port",
         "-1"});
    std::atomic<bool> done = false;
    std::thread sender([&] {
        links::UdpPort socket(loopback, 0);
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; !done; ++i) {
            std::this_thread::sleep_until(begin + i * std::chrono::microseconds(16667));
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
            auto packet = links::encode_fdm(fix_at(passed.count()));
            socket.send({loopback, port}, packet);
            if (i % 30 == 0) {
                std::swap(packet[0], packet[3]);
                socket.send({loopback, port}, packet);
            }
        }
    });
    const tests::ProgramRun run = run_octant(arguments);
    done = true;
    sender.join();
    return run;
}

struct Sums {
    int packets = 0;
    int wrong = 0;
};

Sums sums_of(const std::vector<ui::report::FrameRecord>& rows) {
    Sums sums;
    for (const ui::report::FrameRecord& row : rows) {
        sums.packets += row.packets;
        sums.wrong += row.packets_wrong;
    }
    return sums;
}

} // namespace

TEST_CASE("octant listen shows what comes by UDP, says what is wrong, and is replayed") {
    const fs::path folder = tests::empty_folder("listen");
    const tests::ProgramRun run = run_with_packets(
        {"listen",
         "--headless",
         "--size",
         "160x90",
         "--rate",
         "30",
         "--seconds",
         "4",
         "--record",
         (folder / "flight").string(),
         "--pictures",
         "30"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.err, Contains("waits on UDP 127.0.0.1:"));
    CHECK_THAT(run.err, Contains("FDM version 24 of 408 bytes: fine"));
    CHECK_THAT(
        run.err, Contains("402653184: this is an FDM packet with its bytes the other way round"));
    CHECK_THAT(run.err, Contains("made ground, placed at the first position 47.0"));

    const auto rows = ui::report::read_frame_csv(folder / "flight" / "frames.csv").records;
    const Sums sums = sums_of(rows);
    REQUIRE(rows.size() > 20);
    CHECK(sums.packets > 60);
    CHECK(sums.wrong > 1);
    const auto& last = rows.back();
    const auto& middle = rows[rows.size() / 2];
    const double flown_m = last.aircraft_m.y - middle.aircraft_m.y;
    CHECK(flown_m == Approx(100.0 * (last.sim_time_s - middle.sim_time_s)).margin(3.0));
    CHECK(std::abs(last.aircraft_m.x) < 1.0);
    CHECK(fs::exists(folder / "flight" / "report.html"));
    CHECK_THAT(
        read_text_file(folder / "flight" / "report.html"),
        Contains("packets taken, lost, late, wrong"));
    CHECK_THAT(read_text_file(folder / "flight" / "track.acmi"), Contains("ReferenceLatitude"));

    const tests::ProgramRun replay = run_octant(
        {"fly", "--replay", (folder / "flight").string(), "--record", (folder / "again").string()});
    INFO(replay.err);
    REQUIRE(replay.exit_code == 0);
    CHECK_THAT(replay.out, Contains("same states, same pictures"));
}

TEST_CASE("octant listen sends on what comes, and nothing while nobody flies") {
    links::UdpPort receiver(loopback, 0);
    const std::vector<std::string> arguments{
        "listen",
        "--headless",
        "--size",
        "64x36",
        "--seconds",
        "1",
        "--send",
        "fdm:127.0.0.1:" + std::to_string(receiver.port())};
    std::vector<std::string> alone = arguments;
    for (const std::string port : {"--fdm-port", "--mavlink-port", "--dis-port", "--cigi-port"}) {
        alone.insert(alone.end(), {port, port == "--fdm-port" ? "0" : "-1"});
    }
    REQUIRE(run_octant(alone).exit_code == 0);
    std::vector<links::Datagram> packets;
    receiver.drain(links::Protocol::Fdm, 0.0, packets);
    CHECK(packets.empty());

    REQUIRE(run_with_packets(arguments).exit_code == 0);
    receiver.drain(links::Protocol::Fdm, 0.0, packets);
    CHECK_FALSE(packets.empty());
    for (const links::Datagram& packet : packets) {
        links::Fix fix;
        REQUIRE(links::decode_fdm(packet.bytes, fix).fault == links::Fault::None);
        CHECK(fix.latitude_deg == Approx(47.0).margin(0.1));
        CHECK(fix.longitude_deg == Approx(8.0).margin(0.1));
    }
}

TEST_CASE("a live recording cannot be flown like a path") {
    for (const std::vector<std::string>& line :
         {std::vector<std::string>{"fly", "live"}, {"view", "live"}}) {
        const tests::ProgramRun run = run_octant(line);
        CHECK(run.exit_code == 2);
        CHECK_THAT(run.err, Contains("'live', which others fly: octant listen"));
    }
}

TEST_CASE("octant listen refuses what it cannot do in one line") {
    struct Case {
        std::vector<std::string> arguments;
        std::string expected;
    };

    const std::vector<Case> cases{
        {{"--bind", "nowhere"}, "expected an IPv4 address"},
        {{"--bind", "192.0.2.1"}, "192.0.2.1:"},
        {{"--height", "low"}, "--height: expected msl, agl or offset, got 'low'"},
        {{"--from", "here"}, "expected an IPv4 address"},
        {{"--channel", "up"}, "--channel: expected left, front or right, got 'up'"},
        {{"--cigi-host", "there"}, "--cigi-host: expected HOST:PORT, got 'there'"},
        {{"--send", "fdm:there"}, "--send: expected HOST:PORT, got 'there'"},
        {{"--delay", "-1"}, "--delay"}};
    const std::filesystem::path record = tests::scratch_folder() / "refused";
    for (const Case& wrong : cases) {
        std::vector<std::string> line{
            "listen", "--headless", "--seconds", "1", "--record", record.string()};
        line.insert(line.end(), wrong.arguments.begin(), wrong.arguments.end());
        const tests::ProgramRun run = run_octant(line);
        CHECK(run.exit_code == 2);
        CHECK_THAT(run.err, Contains(wrong.expected));
        CHECK(tests::lines_in(run.err) == 1);
        CHECK(!std::filesystem::exists(record));
    }
}

TEST_CASE("a flight that is sent to nobody ends before anything is loaded or written") {
    const std::filesystem::path record = tests::scratch_folder() / "sent-nowhere";
    const tests::ProgramRun run =
        run_octant({"fly", "straight", "--send", "fdm:there", "--record", record.string()});
    CHECK(run.exit_code == 2);
    CHECK(run.err == "octant: --send: expected HOST:PORT, got 'there'\n");
    CHECK(!std::filesystem::exists(record));
}
