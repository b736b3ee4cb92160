#include "sim/links/flightgear_fdm.h"
#include "sim/links/udp_port.h"
#include "tests/sim/links/receiver.h"

#include <catch2/catch.hpp>

#include <cstdint>

using namespace octant::sim;
using namespace octant::sim::links;
using octant::tests::growth_under_attack;
using octant::tests::Receiver;

namespace {

constexpr std::uint32_t loopback = 0x7f000001;
constexpr int hostile_packets = 20000;

} // namespace

TEST_CASE("floods of hostile packets on any port cost bounded memory and move nothing") {
    for (const Protocol protocol : {Protocol::Fdm, Protocol::MavLink, Protocol::Dis, Protocol::Cigi}) {
        Receiver receiver(protocol);
        const double growth = growth_under_attack(receiver, protocol, hostile_packets, 0.0);
        CAPTURE(static_cast<int>(protocol));
        CHECK(receiver.counts().accepted == 0);
        CHECK(receiver.counts().wrong > 100);
        CHECK(growth < 16.0 * 1024.0 * 1024.0);
    }
}

TEST_CASE("a good sender is heard again as soon as a flood ends") {
    Receiver receiver(Protocol::Fdm);
    growth_under_attack(receiver, Protocol::Fdm, hostile_packets, 0.0);
    UdpPort good(loopback, 0);
    Fix fix;
    fix.velocity_ned_mps = glm::dvec3(10.0, 0.0, 0.0);
    const long before = receiver.counts().accepted;
    for (int i = 0; i < 10; ++i) {
        fix.latitude_deg = 1e-5 * i;
        good.send({loopback, receiver.port()}, encode_fdm(fix));
        receiver.work();
    }
    for (int i = 0; i < 500 && receiver.counts().accepted < before + 9; ++i) { receiver.work(); }
    CHECK(receiver.counts().accepted >= before + 9);
}

TEST_CASE("a flood of valid packets of many vehicles is taken whole") {
    constexpr int packets = 5000;
    const octant::tests::ValidFlood flood = octant::tests::flood_validly(packets);
    CHECK(flood.counts.wrong == 0);
    CHECK(flood.counts.accepted + flood.counts.late == packets);
}
