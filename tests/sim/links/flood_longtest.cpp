// What the short tests of hostile packets show, at full length: a million on each port, 50,000 a second, beside a good
// sender.

#include "sim/links/flightgear_fdm.h"
#include "tests/sim/links/receiver.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <thread>
#include <vector>

using namespace octant::sim::links;
using octant::tests::attack;
using octant::tests::growth_under_attack;
using octant::tests::Receiver;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t loopback = 0x7f000001;
constexpr int million = 1'000'000;
constexpr double per_s = 50'000.0;
constexpr double mebibyte = 1024.0 * 1024.0;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// A good sender of the FDM, number `i` of its packets.
void send_good(UdpPort& socket, std::uint16_t port, int i) {
    Fix fix;
    fix.latitude_deg = 1e-5 * i;
    fix.velocity_ned_mps = glm::dvec3(60.0, 0.0, 0.0);
    fix.ticks = static_cast<std::uint32_t>(i * 16667);
    socket.send({loopback, port}, encode_fdm(fix));
}

} // namespace

TEST_CASE("a million hostile packets on each port cost bounded memory") {
    for (const Protocol protocol : {Protocol::Fdm, Protocol::MavLink, Protocol::Dis, Protocol::Cigi}) {
        Receiver receiver(protocol);
        const Clock::time_point begin = Clock::now();
        const double growth = growth_under_attack(receiver, protocol, million, per_s);
        std::cout << "protocol " << static_cast<int>(protocol) << ": " << million / seconds_since(begin)
                  << " packets/s, " << receiver.counts().wrong << " refused, memory grew by " << growth / mebibyte
                  << " MiB\n";
        CHECK(receiver.counts().accepted == 0);
        CHECK(receiver.counts().wrong > 1000);
        CHECK(growth < (protocol == Protocol::Cigi ? 32.0 : 16.0) * mebibyte);
    }
}

TEST_CASE("a good sender is heard again within half a second of a flood") {
    Receiver receiver(Protocol::Fdm);
    std::atomic<bool> done = false;
    std::thread attacker([&] {
        attack(Protocol::Fdm, receiver.port(), million / 10, per_s);
        done = true;
    });
    UdpPort good(loopback, 0);
    int sent = 0;
    const Clock::time_point begin = Clock::now();
    const auto send_what_is_due = [&] {
        for (constexpr double rate_hz = 60.0; sent < seconds_since(begin) * rate_hz; ++sent) {
            send_good(good, receiver.port(), sent);
        }
    };
    while (!done) {
        send_what_is_due();
        receiver.work();
    }
    attacker.join();
    const long before = receiver.counts().accepted;
    const Clock::time_point after = Clock::now();
    while (receiver.counts().accepted < before + 5 && seconds_since(after) < 10.0) {
        send_what_is_due();
        receiver.work();
    }
    std::cout << "during the flood " << before << " of " << sent << " good packets were taken, "
              << "five more within " << seconds_since(after) << " s after it\n";
    CHECK(seconds_since(after) < 0.5);
}

TEST_CASE("twenty thousand valid packets a second are all taken in time") {
    const octant::tests::ValidFlood flood = octant::tests::flood_validly(100'000);
    std::cout << flood.counts.accepted << " of 100000 taken, " << flood.counts.late << " late, the longest look took "
              << 1000.0 * flood.longest_look_s << " ms\n";
    CHECK(flood.counts.wrong == 0);
    CHECK(flood.counts.accepted + flood.counts.late == 100'000);
    CHECK(flood.longest_look_s < 1.0 / 60.0);
}
