#include "flightpaths/recorded_track.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/udp_port.h"
#include "sim/links/wire_bytes.h"
#include "sim/links/xplane.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "tests/ui/commands/json_schema.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
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
std::uint16_t free_port() { return links::UdpPort(loopback, 0).port(); }

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

/// Runs the program with one port open, for packets of a protocol, and calls `send(i, seconds)` about 60 times a second
/// meanwhile.
tests::ProgramRun run_beside(std::vector<std::string> arguments, const std::string& open, std::uint16_t port,
    const std::function<void(int, double)>& send) {
    for (const std::string each : {"fdm", "mavlink", "dis", "xplane", "cigi"}) {
        arguments.push_back("--" + each + "-port");
        arguments.push_back(each == open ? std::to_string(port) : "-1");
    }
    std::atomic<bool> done = false;
    std::thread sender([&] {
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; !done; ++i) {
            std::this_thread::sleep_until(begin + i * std::chrono::microseconds(16667));
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
            send(i, passed.count());
        }
    });
    const tests::ProgramRun run = run_octant(arguments);
    done = true;
    sender.join();
    return run;
}

/// Runs the program while somebody sends FDM packets to its port, and now and then a wrong one.
tests::ProgramRun run_with_packets(const std::vector<std::string>& arguments) {
    const std::uint16_t port = free_port();
    links::UdpPort socket(loopback, 0);
    return run_beside(arguments, "fdm", port, [&](int i, double passed_s) {
        auto packet = links::encode_fdm(fix_at(passed_s));
        socket.send({loopback, port}, packet);
        if (i % 30 == 0) {
            std::swap(packet[0], packet[3]);
            socket.send({loopback, port}, packet);
        }
    });
}

/// The value of a name in printed JSON, from the first object that has it.
std::string json_value(const std::string& text, const std::string& name) {
    const std::size_t at = text.find('"' + name + "\":");
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
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
    const tests::ProgramRun run = run_with_packets({"listen", "--headless", "--size", "160x90", "--rate", "30",
        "--seconds", "4", "--record", (folder / "flight").string(), "--pictures", "30"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.err, Contains("waits on UDP 127.0.0.1:"));
    CHECK_THAT(run.err, Contains("FDM version 24 of 408 bytes: fine"));
    CHECK_THAT(run.err, Contains("this is FlightGear FDM in little-endian byte order, which is not supported"));
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
    CHECK_THAT(read_text_file(folder / "flight" / "report.html"), Contains("packets taken, lost, late, wrong"));
    CHECK_THAT(read_text_file(folder / "flight" / "track.acmi"), Contains("ReferenceLatitude"));

    const tests::ProgramRun replay =
        run_octant({"fly", "--replay", (folder / "flight").string(), "--record", (folder / "again").string()});
    INFO(replay.err);
    REQUIRE(replay.exit_code == 0);
    CHECK_THAT(replay.out, Contains("same states, same pictures"));
}

TEST_CASE("a recorded live flight holds every aircraft that was flown, and says which leave their limits") {
    const fs::path folder = tests::empty_folder("listen-two");
    const std::uint16_t port = free_port();
    links::UdpPort first(loopback, 0);
    links::UdpPort second(loopback, 0);
    const tests::ProgramRun run =
        run_beside({"listen", "--aircraft", "f15", "--aircraft", "500md", "--headless", "--size", "64x36", "--seconds",
                       "3", "--record", (folder / "flight").string()},
            "fdm", port, [&](int i, double passed_s) {
                first.send({loopback, port}, links::encode_fdm(fix_at(passed_s)));
                if (i < 5) { return; } // the first vehicle is the first aircraft
                links::Fix beside = fix_at(passed_s);
                beside.longitude_deg += 0.001;
                second.send({loopback, port}, links::encode_fdm(beside));
            });
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    for (const char* name : {"track.csv", "track.acmi"}) {
        const fs::path file = folder / "flight" / name;
        const auto recording = flightpaths::parse_track_recording(read_text_file(file), file);
        REQUIRE(recording.aircraft.size() == 2);
        for (const auto& aircraft : recording.aircraft) { CHECK(aircraft.samples.size() > 30); }
        const auto apart_m =
            recording.aircraft[1].samples.back().position_m.x - recording.aircraft[0].samples.back().position_m.x;
        CHECK(apart_m == Approx(76.0).margin(10.0));
    }
    // 100 m/s are 194 kt.
    CHECK_THAT(read_text_file(folder / "flight" / "run.json"), Contains("aircraft 2, a 500md is flown beyond"));
    CHECK_THAT(read_text_file(folder / "flight" / "report.html"), Contains("aircraft 2, a 500md is flown beyond"));
}

TEST_CASE("octant listen sends on what comes, and nothing while nobody flies") {
    links::UdpPort receiver(loopback, 0);
    const std::vector<std::string> arguments{"listen", "--headless", "--size", "64x36", "--seconds", "1", "--send",
        "fdm:127.0.0.1:" + std::to_string(receiver.port())};
    std::vector<std::string> alone = arguments;
    alone.insert(alone.end(), {"--ports", "fdm=0,mavlink=-1,dis=-1,xplane=-1,cigi=-1"});
    REQUIRE(run_octant(alone).exit_code == 0);
    std::vector<links::Datagram> packets;
    receiver.drain(links::Protocol::Fdm, 0.0, packets);
    CHECK(packets.empty());

    REQUIRE(run_with_packets(arguments).exit_code == 0);
    receiver.drain(links::Protocol::Fdm, 0.0, packets);
    CHECK_FALSE(packets.empty());
    for (const links::Datagram& packet : packets) {
        links::Fix fix;
        REQUIRE(links::decode_fdm(packet.bytes, fix).fault == links::PacketError::None);
        CHECK(fix.latitude_deg == Approx(47.0).margin(0.1));
        CHECK(fix.longitude_deg == Approx(8.0).margin(0.1));
    }
}

TEST_CASE("octant listen reads X-Plane's DATA, and octant's own is read as that") {
    const std::uint16_t port = free_port();
    links::UdpPort socket(loopback, 0);
    const sim::links::Geodetic origin{rad_from_deg(47.0), rad_from_deg(8.0), 0.0};
    const tests::ProgramRun run = run_beside({"listen", "--headless", "--size", "64x36", "--seconds", "2", "--json"},
        "xplane", port, [&](int, double passed_s) {
            socket.send({loopback, port}, links::encode_xplane(fix_at(passed_s), origin, passed_s));
        });
    INFO(run.err << run.out);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.err, Contains("X-Plane: waits on UDP 127.0.0.1:"));
    CHECK_THAT(run.err, Contains("X-Plane DATA: fine"));
    CHECK(json_value(run.out, "protocol") == "\"protocol\": \"X-Plane\",");
    CHECK_THAT(json_value(run.out, "latitude_deg"), Contains("47.0"));
    CHECK(json_value(run.out, "shown") == "\"shown\": true");
    const auto faults = tests::schema_faults(run.out, fs::path(OCTANT_SOURCE_DIR) / "ui/schemas/fly.json");
    CHECK(faults.empty());
}

TEST_CASE("octant listen asks an X-Plane for its motion, again when it is silent, and ends that") {
    const std::uint16_t port = free_port();
    links::UdpPort xplane(loopback, 0);
    std::map<std::int32_t, std::string> asked;
    int requests = 0;
    std::vector<links::Datagram> packets;
    const auto take = [&] {
        packets.clear();
        xplane.drain(links::Protocol::XPlane, 0.0, packets);
        for (const links::Datagram& packet : packets) {
            const links::WireReader reader(packet.bytes, links::ByteOrder::Little);
            const auto number = reader.at<std::int32_t>(9);
            ++requests;
            if (reader.at<std::int32_t>(5) == 0) {
                asked.erase(number);
                continue;
            }
            std::string& name = asked[number];
            name.clear();
            for (std::size_t at = 13; reader.at<char>(at) != '\0'; ++at) { name += reader.at<char>(at); }
        }
    };
    const std::map<std::string, float> world{{"sim/flightmodel/position/latitude", 47.25F},
        {"sim/flightmodel/position/longitude", 8.5F}, {"sim/flightmodel/position/elevation", 1500.0F}};
    const tests::ProgramRun run = run_beside({"listen", "--headless", "--size", "64x36", "--seconds", "5", "--json",
                                                 "--xplane", "127.0.0.1:" + std::to_string(xplane.port())},
        "xplane", port, [&](int, double) {
            take();
            if (requests < 2 * 17) {
                return; // An X-Plane that loads is silent, and is asked again.
            }
            links::WireWriter answer(links::ByteOrder::Little);
            for (const char letter : std::string("RREF,")) { answer.add(letter); }
            for (const auto& [number, name] : asked) {
                const auto value = world.find(name);
                answer.add(number);
                answer.add(value == world.end() ? 0.0F : value->second);
            }
            xplane.send({loopback, port}, answer.bytes());
        });
    INFO(run.err << run.out);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.err, Contains("X-Plane RREF: fine"));
    CHECK_THAT(json_value(run.out, "latitude_deg"), Contains("47.25"));
    CHECK_THAT(json_value(run.out, "altitude_m"), Contains("1500"));
    take();
    CHECK(asked.empty());
    CHECK(requests >= 3 * 17);
}

TEST_CASE("octant listen tells once and counts what it does not support") {
    const std::uint16_t port = free_port();
    links::UdpPort socket(loopback, 0);
    // IG Control of CIGI 4.0: 24 bytes, packet id 0, major version 4, little-endian.
    links::WireWriter cigi_4(links::ByteOrder::Little);
    cigi_4.add(std::uint16_t{24});
    cigi_4.add(std::uint16_t{0});
    cigi_4.add(std::uint8_t{4});
    cigi_4.add_zeros(19);
    const std::vector<std::byte> xplane = links::encode_xplane(fix_at(0.0), {rad_from_deg(47.0), 0.0, 0.0}, 0.0);
    const tests::ProgramRun run =
        run_beside({"listen", "--headless", "--size", "64x36", "--seconds", "2"}, "cigi", port, [&](int, double) {
            socket.send({loopback, port}, cigi_4.bytes());
            socket.send({loopback, port}, xplane);
        });
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    for (const std::string told : {"this is a CIGI 4 host, which is not supported: set it to CIGI 3.3",
             "this is X-Plane DATA or RREF; --ports xplane [49003] says where it is read"}) {
        const std::size_t first = run.err.find(told);
        REQUIRE(first != std::string::npos);
        const std::size_t counted = run.err.find(told, first + 1);
        REQUIRE(counted != std::string::npos);
        CHECK(run.err.find(told, counted + 1) == std::string::npos);
        const std::size_t line = run.err.rfind('\n', counted) + 1;
        CHECK_THAT(run.err.substr(line, counted - line), Contains(" packets from 127.0.0.1:"));
    }
}

TEST_CASE("a live recording cannot be flown like a path") {
    for (const std::vector<std::string>& line : {std::vector<std::string>{"fly", "live"}, {"view", "live"}}) {
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

    const std::vector<Case> cases{{{"--bind", "nowhere"}, "expected an IPv4 address"},
        {{"--bind", "192.0.2.1"}, "192.0.2.1:"},
        {{"--height", "low"}, "--height: expected one of msl, agl, offset, got 'low'"},
        {{"--from", "here"}, "expected an IPv4 address"},
        {{"--channel", "up"}, "--channel: expected one of left, front, right, got 'up'"},
        {{"--cigi", "host=there"}, "--cigi host: expected HOST:PORT, got 'there'"},
        {{"--send", "fdm:there"}, "--send: expected HOST:PORT, got 'there'"},
        {{"--xplane", "127.0.0.1:x"}, "--xplane: expected HOST:PORT, got '127.0.0.1:x'"},
        {{"--xplane", "127.0.0.1", "--ports", "xplane=-1"},
            "--xplane: expected an open port in --ports xplane, got -1"},
        {{"--delay", "-1"}, "--delay"}};
    const std::filesystem::path record = tests::scratch_folder() / "refused";
    for (const Case& wrong : cases) {
        std::vector<std::string> line{"listen", "--headless", "--seconds", "1", "--record", record.string()};
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
    const tests::ProgramRun run = run_octant({"fly", "straight", "--send", "fdm:there", "--record", record.string()});
    CHECK(run.exit_code == 2);
    CHECK(run.err == "octant: --send: expected HOST:PORT, got 'there'\n");
    CHECK(!std::filesystem::exists(record));
}
