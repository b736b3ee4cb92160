// What twenty thousand valid packets a second cost the pictures of octant listen.

#include "sim/links/dis_entity.h"
#include "sim/links/udp_port.h"
#include "tests/scratch.h"
#include "tests/ui/commands/command_line.h"
#include "ui/report/frame_csv.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <vector>

using namespace octant;

namespace {

namespace fs = std::filesystem;
namespace links = sim::links;

constexpr std::uint32_t near_by = 0x7f000001;
constexpr double flood_s = 6.0;
constexpr int vehicles = 200;
constexpr int packets_a_ms = 20;

double children_cpu_s() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Entity states of 200 aircraft, evenly, 100 of each a second. Returns how many were sent.
long send_flood(std::uint16_t port, const std::atomic<bool>& stops) {
    links::UdpPort socket(near_by, 0);
    const auto begin = std::chrono::steady_clock::now();
    long sent = 0;
    for (int ms = 0; ms < static_cast<int>(1000.0 * flood_s) && !stops; ++ms) {
        std::this_thread::sleep_until(begin + std::chrono::milliseconds(ms));
        for (int i = 0; i < packets_a_ms; ++i) {
            const int number = static_cast<int>(sent % vehicles);
            links::DisEntity entity;
            entity.site = 1;
            entity.application = 1;
            entity.entity = static_cast<std::uint16_t>(number + 1);
            entity.type = {1, 2, 0, 0, 0, 0, 0, 0};
            entity.reckoning = links::DeadReckoning::Fpw;
            entity.fix.latitude_deg = 47.0 + 0.001 * (number / 20);
            entity.fix.longitude_deg = 8.0 + 0.001 * (number % 20);
            entity.fix.altitude_m = 1500.0;
            entity.fix.velocity_ned_mps = glm::dvec3(0.0);
            sent += socket.send({near_by, port}, links::encode_dis(entity, 0.001 * ms)) ? 1 : 0;
        }
    }
    return sent;
}

struct Flown {
    long taken = 0;
    long late_packets = 0;
    long wrong = 0;
    int late_pictures = 0;
    std::size_t pictures = 0;
    long sent = 0;
    double cpu_s = 0.0;
};

Flown flown(bool flooded) {
    const fs::path record = tests::empty_folder("flood") / "flight";
    const std::uint16_t port = links::UdpPort(near_by, 0).port();
    Flown found;
    std::atomic<bool> stops = false;
    std::thread sender([&] {
        std::this_thread::sleep_for(std::chrono::seconds(2)); // the program begins
        found.sent = flooded ? send_flood(port, stops) : 0;
    });
    const double before_s = children_cpu_s();
    const tests::ProgramRun run = tests::run_octant({"listen", "--headless", "--ports", "fdm=-1,mavlink=-1", "--ports",
        "dis=" + std::to_string(port), "--ports", "cigi=-1,xplane=-1", "--terrain", "none", "--size", "160x90",
        "--rate", "30", "--pictures", "0", "--seconds", "10", "--record", record.string()});
    stops = true;
    sender.join();
    found.cpu_s = children_cpu_s() - before_s;
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    for (const ui::report::FrameRecord& row : ui::report::read_frame_csv(record / "frames.csv").records) {
        found.taken += row.packets;
        found.late_packets += row.packets_late;
        found.wrong += row.packets_wrong;
        found.late_pictures += row.missed;
        ++found.pictures;
    }
    return found;
}

} // namespace

TEST_CASE("twenty thousand packets a second leave pictures more than nine tenths of a core") {
    const Flown quiet = flown(false);
    const Flown flooded = flown(true);
    const double cost_s = flooded.cpu_s - quiet.cpu_s;
    std::printf("%ld packets in %.0f s cost %.2f s of CPU; late pictures: %d of %zu, without packets %d\n",
        flooded.sent, flood_s, cost_s, flooded.late_pictures, flooded.pictures, quiet.late_pictures);
    CHECK(flooded.sent == static_cast<long>(1000.0 * flood_s) * packets_a_ms);
    CHECK(flooded.taken + flooded.late_packets == flooded.sent);
    CHECK(flooded.wrong == 0);
    CHECK(cost_s < 0.1 * flood_s);
}
