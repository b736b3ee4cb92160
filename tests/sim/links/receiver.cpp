#include "tests/sim/links/receiver.h"

#include "sim/base/random_generator.h"
#include "sim/links/flightgear_fdm.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <fstream>
#include <thread>

/// Of a sanitizer's allocator, which keeps what was freed for a while; absent without one.
extern "C" __attribute__((weak)) std::size_t __sanitizer_get_current_allocated_bytes();

namespace octant::tests {

using namespace sim::links;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t loopback = 0x7f000001;

void wait_until(Clock::time_point begin, double after_s) {
    std::this_thread::sleep_until(
        begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(after_s)));
}

} // namespace

double used_bytes() {
    if (__sanitizer_get_current_allocated_bytes != nullptr) {
        return static_cast<double>(__sanitizer_get_current_allocated_bytes());
    }
    std::ifstream file("/proc/self/statm");
    double total_pages = 0.0;
    double resident_pages = 0.0;
    file >> total_pages >> resident_pages;
    constexpr double page_bytes = 4096.0;
    return resident_pages * page_bytes;
}

void attack(Protocol protocol, std::uint16_t port, int packets, double per_s) {
    constexpr int together = 500;
    RandomGenerator dice(static_cast<std::uint64_t>(protocol));
    const auto right = encode_fdm({});
    UdpPort socket(loopback, 0);
    const Clock::time_point begin = Clock::now();
    for (int i = 0; i < packets; ++i) {
        if (per_s > 0.0 && i % together == 0) { wait_until(begin, i / per_s); }
        std::vector<std::byte> bytes(right.begin(), right.end());
        bytes[dice.next() < 0.5 ? 3 : 0] = static_cast<std::byte>(dice.between(26.0, 256.0));
        bytes.resize(static_cast<std::size_t>(dice.between(0.0, 408.0)));
        socket.send({loopback, port}, bytes);
    }
}

void Receiver::look() {
    packets_.clear();
    const std::chrono::duration<double> now = std::chrono::steady_clock::now() - begin_;
    socket_.drain(protocol_, now.count(), packets_);
    for (const Datagram& packet : packets_) {
        if (limit_.admits(packet.source, packet.arrival_s)) { traffic_.take(packet); }
    }
}

void Receiver::work() {
    look();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

double growth_under_attack(Receiver& receiver, Protocol protocol, int packets, double per_s) {
    receiver.work();
    const double before = used_bytes();
    double most = before;
    std::atomic<bool> done = false;
    std::thread attacker([&] {
        attack(protocol, receiver.port(), packets, per_s);
        done = true;
    });
    while (!done) {
        receiver.work();
        most = std::max(most, used_bytes());
    }
    attacker.join();
    receiver.work();
    return most - before;
}

ValidFlood flood_validly(int packets) {
    constexpr int senders = 20; // of which each is a vehicle
    Receiver receiver(Protocol::Fdm);
    std::atomic<bool> done = false;
    std::thread sender([&] {
        std::vector<UdpPort> sockets;
        for (int i = 0; i < senders; ++i) { sockets.emplace_back(loopback, std::uint16_t{0}); }
        const Clock::time_point begin = Clock::now();
        constexpr double rate_hz = 20'000.0;
        for (int i = 0; i < packets; ++i) {
            if (i % senders == 0) { wait_until(begin, i / rate_hz); }
            Fix fix;
            fix.latitude_deg = 1e-7 * (i / senders);
            fix.velocity_ned_mps = glm::dvec3(10.0, 0.0, 0.0);
            fix.ticks = static_cast<std::uint32_t>(i / senders * 1000);
            sockets[static_cast<std::size_t>(i % senders)].send({loopback, receiver.port()}, encode_fdm(fix));
        }
        done = true;
    });
    ValidFlood flood;
    while (!done) {
        const Clock::time_point begin = Clock::now();
        receiver.look();
        flood.longest_look_s =
            std::max(flood.longest_look_s, std::chrono::duration<double>(Clock::now() - begin).count());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    sender.join();
    receiver.look();
    flood.counts = receiver.counts();
    return flood;
}

} // namespace octant::tests
