#include "sim/base/dice.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/live_traffic.h"
#include "sim/links/source_limit.h"
#include "sim/links/udp_port.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <thread>
#include <vector>

using namespace octant::sim;
using namespace octant::sim::links;

namespace {

constexpr std::uint32_t loopback = 0x7f000001;
constexpr int hostile_packets = 20000;

/// Memory of this process that is in use, bytes.
double resident_bytes() {
    std::ifstream file("/proc/self/statm");
    double total_pages = 0.0;
    double resident_pages = 0.0;
    file >> total_pages >> resident_pages;
    constexpr double page_bytes = 4096.0;
    return resident_pages * page_bytes;
}

/// Packets that are nearly right, and some that are anything.
void attack(Protocol protocol, std::uint16_t port) {
    octant::Dice dice(static_cast<std::uint64_t>(protocol));
    const auto right = encode_fdm({});
    UdpPort socket(loopback, 0);
    for (int i = 0; i < hostile_packets; ++i) {
        std::vector<std::byte> bytes(right.begin(), right.end());
        bytes[dice.next() < 0.5 ? 3 : 0] = static_cast<std::byte>(dice.between(26.0, 256.0));
        bytes.resize(static_cast<std::size_t>(dice.between(0.0, 408.0)));
        socket.send({loopback, port}, bytes);
    }
}

/// A receiver as a program has it, looked after a thousand times a second.
class Receiver {
public:
    explicit Receiver(Protocol protocol)
        : protocol_(protocol) {}

    std::uint16_t port() const { return socket_.port(); }

    void work() {
        packets_.clear();
        const std::chrono::duration<double> now = std::chrono::steady_clock::now() - begin_;
        socket_.drain(protocol_, now.count(), packets_);
        for (const Datagram& packet : packets_) {
            if (limit_.admits(packet.source, packet.arrival_s)) {
                traffic_.take(packet);
            }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

    const TrafficCounts& counts() const { return traffic_.counts(); }

private:
    Protocol protocol_;
    UdpPort socket_{loopback, 0};
    SourceLimit limit_;
    LiveTraffic traffic_{
        [](const VehicleKey&, const Fix& fix) { return glm::dvec3(fix.latitude_deg * 1e5); }};
    std::vector<Datagram> packets_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

} // namespace

TEST_CASE("floods of hostile packets on any port cost bounded memory and move nothing") {
    for (const Protocol protocol :
         {Protocol::Fdm, Protocol::MavLink, Protocol::Dis, Protocol::Cigi}) {
        Receiver receiver(protocol);
        receiver.work();
        const double before = resident_bytes();
        double most = before;
        std::atomic<bool> done = false;
        std::thread attacker([&] {
            attack(protocol, receiver.port());
            done = true;
        });
        while (!done) {
            receiver.work();
            most = std::max(most, resident_bytes());
        }
        attacker.join();
        receiver.work();
        CAPTURE(static_cast<int>(protocol));
        CHECK(receiver.counts().accepted == 0);
        CHECK(receiver.counts().wrong > 100);
        CHECK(most - before < 16.0 * 1024.0 * 1024.0);
    }
}

TEST_CASE("a good sender is heard again as soon as a flood ends") {
    Receiver receiver(Protocol::Fdm);
    std::atomic<bool> done = false;
    std::thread attacker([&] {
        attack(Protocol::Fdm, receiver.port());
        done = true;
    });
    while (!done) {
        receiver.work();
    }
    attacker.join();
    UdpPort good(loopback, 0);
    Fix fix;
    fix.velocity_ned_mps = glm::dvec3(10.0, 0.0, 0.0);
    const long before = receiver.counts().accepted;
    for (int i = 0; i < 10; ++i) {
        fix.latitude_deg = 1e-5 * i;
        good.send({loopback, receiver.port()}, encode_fdm(fix));
        receiver.work();
    }
    for (int i = 0; i < 500 && receiver.counts().accepted < before + 9; ++i) {
        receiver.work();
    }
    CHECK(receiver.counts().accepted >= before + 9);
}
