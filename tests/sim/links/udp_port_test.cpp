#include "sim/base/error.h"
#include "sim/links/udp_port.h"

#include <catch2/catch.hpp>

#include <array>
#include <chrono>
#include <thread>
#include <vector>

using namespace octant;
using namespace octant::sim::links;

namespace {

constexpr std::uint32_t own_address = 0x7f000001;

/// Drains until so many packets are there, for at most two seconds.
std::vector<Datagram> wait_for(UdpPort& port, std::size_t count) {
    std::vector<Datagram> got;
    for (int i = 0; i < 2000 && got.size() < count; ++i) {
        port.drain(Protocol::Fdm, 100.0, got);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return got;
}

} // namespace

TEST_CASE("packets come through a real socket with their sender and their time") {
    UdpPort ours(own_address, 0);
    UdpPort theirs(own_address, 0);
    const std::array<std::byte, 3> bytes{std::byte{1}, std::byte{2}, std::byte{3}};
    for (int i = 0; i < 200; ++i) { REQUIRE(theirs.send({own_address, ours.port()}, bytes)); }
    const auto got = wait_for(ours, 200);
    REQUIRE(got.size() == 200);
    for (const Datagram& packet : got) {
        CHECK(packet.source == PacketSource{own_address, theirs.port()});
        CHECK(packet.bytes == std::vector<std::byte>(bytes.begin(), bytes.end()));
        CHECK(packet.arrival_s <= 100.0);
        CHECK(packet.arrival_s > 90.0);
    }
}

TEST_CASE("a port that is taken is an error that names it") {
    UdpPort ours(own_address, 0);
    REQUIRE_THROWS_WITH(UdpPort(own_address, ours.port()),
        Catch::Contains("127.0.0.1:" + std::to_string(ours.port())) && Catch::Contains("expected a free UDP port"));
}

TEST_CASE("addresses are read from text or refused") {
    CHECK(address_from_text("--bind", "127.0.0.1") == own_address);
    CHECK(peer_from_text("--send", "127.0.0.1:5550") == PacketSource{own_address, 5550});
    CHECK(text_of(peer_from_text("--send", "localhost:8005")) == "127.0.0.1:8005");
    CHECK_THROWS_WITH(address_from_text("--from", "127.0.0"), Catch::Contains("--from: expected an IPv4 address"));
    for (const char* wrong : {"127.0.0.1", "127.0.0.1:0", "127.0.0.1:70000", ":5", "127.0.0.1:x"}) {
        CHECK_THROWS_WITH(peer_from_text("--send", wrong), Catch::Contains("--send: expected HOST:PORT"));
    }
}
