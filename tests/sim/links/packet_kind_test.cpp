#include "sim/links/cigi_host.h"
#include "sim/links/dis_entity.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/live_traffic.h"
#include "sim/links/packet_kind.h"
#include "sim/links/xplane.h"
#include "tests/sim/links/mavlink_frames.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

using namespace octant::sim::links;

namespace {

using PacketBytes = std::vector<std::byte>;

template <class Bytes>
PacketBytes copied(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

PacketBytes text(std::string_view words) { return copied(std::as_bytes(std::span(words.data(), words.size()))); }

/// IG Control of CIGI 4.0 (16-bit size, packet id 0) and an Entity Position, in either byte order.
PacketBytes cigi_4(ByteOrder order, std::size_t more = 48) {
    WireWriter message(order);
    message.add(std::uint16_t{24});
    message.add(std::uint16_t{0});
    message.add(std::uint8_t{4});
    message.add_zeros(19);
    message.add(std::uint16_t{48});
    message.add(std::uint16_t{1});
    message.add_zeros(more - 4);
    return message.take();
}

PacketBytes cigi_3() {
    WireWriter message(ByteOrder::Big);
    add_ig_control(message, {});
    return message.take();
}

/// FGNetFDM of version 24 as a little-endian machine has it in memory.
PacketBytes swapped_fdm() {
    WireWriter packet(ByteOrder::Little);
    packet.add(std::uint32_t{24});
    packet.add_zeros(4);
    packet.add(0.14);
    packet.add(0.82);
    packet.add(1000.0);
    packet.add_zeros(fdm_24_bytes - packet.size());
    return packet.take();
}

Fix any_fix() {
    Fix fix;
    fix.latitude_deg = 47.0;
    fix.altitude_m = 900.0;
    return fix;
}

/// Packets that are read, each by its own protocol.
std::map<Protocol, PacketBytes> right_packets() {
    DisEntity entity;
    entity.fix = any_fix();
    MavLinkFrame frame{MavLinkKind::GlobalPositionInt, 1, {}};
    frame.payload.resize(28, std::byte{1});
    return {{Protocol::Fdm, copied(encode_fdm(any_fix()))},
        {Protocol::MavLink, octant::tests::encode_mavlink(frame, 0)}, {Protocol::Dis, copied(encode_dis(entity, 0.0))},
        {Protocol::Cigi, cigi_3()}, {Protocol::XPlane, encode_xplane(any_fix(), {0.82, 0.0, 900.0}, 0.0)}};
}

LiveTraffic traffic_of(Protocol port, const PacketBytes& packet, int count) {
    LiveTraffic traffic([](const VehicleKey&, const Fix&) { return WorldPosition(); });
    for (int i = 0; i < count; ++i) { traffic.take({port, {0x7f000001, 4000}, 0.01 * i, packet}); }
    return traffic;
}

} // namespace

TEST_CASE("what is not supported is told once, in a line of what it is, and counted") {
    const std::vector<std::pair<PacketBytes, std::string>> unsupported{
        {cigi_4(ByteOrder::Little), "this is a CIGI 4 host, which is not supported: set it to "
                                    "CIGI 3.3"},
        {cigi_4(ByteOrder::Big), "this is a CIGI 4 host"},
        {swapped_fdm(), "this is FlightGear FDM in little-endian byte order, which is not supported"},
        {text("BECN\x01\x02"), "this is an X-Plane message other than DATA and RREF"},
        {text("XGPSX-Plane,8.5,47.2,1500,90,50"), "this is position output for tablets"},
        {text("$GPGGA,120000,4715.0,N"), "this is NMEA 0183"},
        {text("FileType=text/acmi/tacview\n"), "this is Tacview text"}};
    for (const auto& [packet, line] : unsupported) {
        for (const Protocol port :
            {Protocol::Fdm, Protocol::MavLink, Protocol::Dis, Protocol::Cigi, Protocol::XPlane}) {
            LiveTraffic traffic = traffic_of(port, packet, 200);
            INFO(line << " at the port of " << name_of(port));
            const auto news = traffic.take_new_messages();
            REQUIRE(news.size() == 1);
            CHECK(news[0].starts_with("127.0.0.1:4000: " + line));
            CHECK(traffic.counts().wrong == 200);
            const auto reports = traffic.packet_reports();
            REQUIRE(reports.size() == 1);
            CHECK(reports[0].packets == 200);
            CHECK(reports[0].is_wrong);
        }
    }
}

TEST_CASE("messages of CIGI 4 that differ in length are one line") {
    LiveTraffic traffic([](const VehicleKey&, const Fix&) { return WorldPosition(); });
    for (std::size_t i = 0; i < 100; ++i) {
        const PacketBytes packet = cigi_4(ByteOrder::Little, 48 + 8 * i);
        traffic.take({Protocol::Cigi, {1, 1}, 0.01, packet});
    }
    CHECK(traffic.take_new_messages().size() == 1);
    CHECK(traffic.packet_reports().front().packets == 100);
}

TEST_CASE("a packet at another port than its own is told where it is read") {
    const std::map<Protocol, std::string> options{{Protocol::Fdm, "this is FlightGear FDM; --ports fdm [5550]"},
        {Protocol::MavLink, "this is MAVLink; --ports mavlink [14550]"},
        {Protocol::Dis, "this is DIS; --ports dis [3000]"},
        {Protocol::Cigi, "this is a CIGI 3 host; --ports cigi [8004]"},
        {Protocol::XPlane, "this is X-Plane DATA or RREF; --ports xplane [49003]"}};
    for (const auto& [own, packet] : right_packets()) {
        for (const auto& [port, unused] : options) {
            LiveTraffic traffic = traffic_of(port, packet, 3);
            INFO(name_of(own) << " at the port of " << name_of(port));
            const auto news = traffic.take_new_messages();
            REQUIRE(news.size() == 1);
            if (own == port) {
                CHECK(traffic.counts().wrong == 0);
                CHECK(news[0].find("this is") == std::string::npos);
            } else {
                CHECK(traffic.counts().wrong == 3);
                CHECK(news[0].find(options.at(own)) != std::string::npos);
            }
        }
    }
}

TEST_CASE("a packet of its own port that is wrong keeps what is wrong with it") {
    PacketBytes cut = right_packets().at(Protocol::Fdm);
    cut.resize(400);
    CHECK(traffic_of(Protocol::Fdm, cut, 1).take_new_messages() ==
          std::vector<std::string>{"127.0.0.1:4000: FDM version 24: expected 408 bytes, got 400"});
    CHECK_FALSE(packet_kind(text("")));
    CHECK_FALSE(packet_kind(text("hello")));
}
