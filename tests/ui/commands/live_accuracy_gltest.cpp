// How near to the truth octant listen shows what comes by real UDP: what its recording says was in each picture against
// where the sender's aircraft was then.

#include "sim/base/earth_frame.h"
#include "sim/base/random_generator.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/udp_port.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "ui/flight/packet_file.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>
#include <vector>

using namespace octant;
using ui::report::FrameRecord;

namespace {

namespace fs = std::filesystem;
namespace links = sim::links;

constexpr std::uint32_t sender_address = 0x7f000001;
constexpr double speed_mps = 150.0;
constexpr double rate_hz = 60.0;
constexpr double flown_s = 12.0;
constexpr GeoPosition origin{47.0, 8.0};

/// How a network treats packets.
struct Network {
    double jitter_s = 0.0; ///< up to so much later
    double loss = 0.0;     ///< share
    double reordered = 0.0;
};

struct Sending {
    double at_s = 0.0;
    double truth_s = 0.0; ///< of the flight
};

/// When the packets of a flight reach the receiver.
std::vector<Sending> schedule_of(const Network& network) {
    RandomGenerator dice(5);
    std::vector<Sending> schedule;
    for (int i = 0; i < static_cast<int>(flown_s * rate_hz); ++i) {
        const double truth_s = i / rate_hz;
        const double jitter_s = network.jitter_s * dice.next();
        const double late_s = jitter_s + (dice.next() < network.reordered ? 1.3 / rate_hz : 0.0);
        if (!(dice.next() < network.loss)) { schedule.push_back({truth_s + late_s, truth_s}); }
    }
    std::ranges::stable_sort(schedule, {}, &Sending::at_s);
    return schedule;
}

/// North from the origin, steadily.
std::vector<std::byte> packet_at(double truth_s) {
    const GeoPosition place = TransverseMercator(origin).geo_from_local({0.0, speed_mps * truth_s});
    links::Fix fix;
    fix.latitude_deg = place.latitude_deg;
    fix.longitude_deg = place.longitude_deg;
    fix.altitude_m = 1000.0;
    fix.velocity_ned_mps = glm::dvec3(speed_mps, 0.0, 0.0);
    fix.ticks = static_cast<std::uint32_t>(std::llround(truth_s * 1e6));
    const auto packet = links::encode_fdm(fix);
    return {packet.begin(), packet.end()};
}

/// What was shown, against the truth.
struct Accuracy {
    double rms_m = 0.0;
    double lag_s = 0.0;  ///< mean; negative: ahead
    double jump_m = 0.0; ///< largest of a frame, beyond what the flight moves
    std::size_t pictures = 0;
};

/// The sender's time zero on the program's clock, by the quickest of all packets.
double begun_s(const ui::flight::PacketFile& packets) {
    double min_s = std::numeric_limits<double>::infinity();
    for (const auto& frame : packets.frames) {
        for (const links::Datagram& packet : frame.packets) {
            links::Fix fix;
            REQUIRE(links::decode_fdm(packet.bytes, fix).fault == links::PacketError::None);
            min_s = std::min(min_s, packet.arrival_s - fix.ticks.value_or(0) * 1e-6);
        }
    }
    return min_s;
}

Accuracy accuracy_of(const fs::path& record, double delay_s, double settled_s) {
    const ui::flight::PacketFile packets = ui::flight::read_packets(record);
    const double zero_s = begun_s(packets);
    links::Fix first;
    const auto with_packets =
        std::ranges::find_if(packets.frames, [](const auto& frame) { return !frame.packets.empty(); });
    REQUIRE(with_packets != packets.frames.end());
    links::decode_fdm(with_packets->packets.front().bytes, first);
    const double first_m = speed_mps * first.ticks.value_or(0) * 1e-6; // lies at 0, 0 of the map
    Accuracy found;
    double sum_m2 = 0.0;
    double sum_m = 0.0;
    double before_m = 0.0;
    double before_s = 0.0;
    for (const FrameRecord& row : ui::report::read_frame_csv(record / "frames.csv").records) {
        const double flight_s = row.sim_time_s - zero_s;
        if (flight_s < settled_s || flight_s > flown_s - 0.1) { continue; }
        const double shown_m = row.aircraft_m.y + first_m;
        const double error_m = shown_m - speed_mps * (flight_s - delay_s);
        sum_m += error_m;
        sum_m2 += error_m * error_m + row.aircraft_m.x * row.aircraft_m.x;
        if (found.pictures > 0) {
            const double moved_m = shown_m - before_m - speed_mps * (row.sim_time_s - before_s);
            found.jump_m = std::max(found.jump_m, std::abs(moved_m));
        }
        before_m = shown_m;
        before_s = row.sim_time_s;
        ++found.pictures;
    }
    REQUIRE(found.pictures > 20);
    const auto count = static_cast<double>(found.pictures);
    found.rms_m = std::sqrt(sum_m2 / count);
    found.lag_s = -sum_m / count / speed_mps;
    return found;
}

/// Flies it through the program.
Accuracy flown(const std::string& name, const Network& network, double delay_s) {
    const fs::path record = tests::empty_folder(name) / "flight";
    const std::uint16_t port = links::UdpPort(sender_address, 0).port();
    std::atomic<bool> done = false;
    std::thread sender([&] {
        const std::vector<Sending> schedule = schedule_of(network);
        links::UdpPort socket(sender_address, 0);
        std::this_thread::sleep_for(std::chrono::seconds(2)); // the program begins
        const auto begin = std::chrono::steady_clock::now();
        for (const Sending& each : schedule) {
            std::this_thread::sleep_until(begin + std::chrono::duration<double>(each.at_s));
            socket.send({sender_address, port}, packet_at(each.truth_s));
            if (done) { return; }
        }
    });
    const tests::ProgramRun run = tests::run_octant({"listen", "--headless", "--ports", "fdm=" + std::to_string(port),
        "--ports", "mavlink=-1,dis=-1,xplane=-1,cigi=-1", "--terrain", "none", "--size", "64x36", "--samples", "1",
        "--pictures", "0", "--delay", std::to_string(delay_s), "--seconds", "15", "--record", record.string()});
    done = true;
    sender.join();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return accuracy_of(record, delay_s, 2.0);
}

void print(const std::string& what, const Accuracy& found) {
    std::printf("%s: %.2f m RMS, lag %.1f ms, jump %.2f m, %zu pictures\n", what.c_str(), found.rms_m,
        1000.0 * found.lag_s, found.jump_m, found.pictures);
}

} // namespace

TEST_CASE("pictures show a steady flight by UDP within a metre of the truth, without a jump") {
    const Accuracy found = flown("accuracy-steady", {}, 0.0);
    print("steady, no delay", found);
    CHECK(found.rms_m < 1.0);
    CHECK(std::abs(found.lag_s) < 0.05);
    CHECK(found.jump_m < 1.0);
}

TEST_CASE("pictures a tenth of a second behind stand jitter, losses and disorder within two metres") {
    const Network bad{0.02, 0.05, 0.02};
    const Accuracy found = flown("accuracy-bad", bad, 0.1);
    print("bad network, 0.1 s behind", found);
    CHECK(found.rms_m < 2.0);
    CHECK(found.jump_m < 1.0);
}

TEST_CASE("pictures of now stand jitter, losses and disorder within two metres") {
    const Network bad{0.02, 0.05, 0.02};
    const Accuracy found = flown("accuracy-now", bad, 0.0);
    print("bad network, no delay", found);
    CHECK(found.rms_m < 2.0);
    CHECK(found.jump_m < 1.0);
}
