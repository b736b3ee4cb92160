#include "sim/base/random_generator.h"
#include "sim/base/text_file.h"
#include "sim/links/dis_entity.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/line_input.h"
#include "sim/links/live_traffic.h"
#include "sim/links/mavlink.h"
#include "tests/sim/links/mavlink_frames.h"
#include "tests/sim/links/receiver.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

using namespace octant;
using namespace octant::sim;
using namespace octant::sim::links;

namespace {

using PacketOutcome = LiveTraffic::PacketOutcome;

WorldPosition flat(const VehicleKey&, const Fix& fix) {
    if (fix.local_m) { return {.at_m = glm::dvec3(*fix.local_m, fix.altitude_m)}; }
    return {.at_m = {fix.longitude_deg * 1e5, fix.latitude_deg * 1e5, fix.altitude_m}};
}

Datagram line(std::string_view text, double arrival_s = 0.0) {
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    return {Protocol::Lines, {}, arrival_s, {bytes.begin(), bytes.end()}};
}

} // namespace

TEST_CASE("lines of named columns move aircraft, each by its id") {
    LiveTraffic traffic(flat);
    CHECK(traffic.take(line("t_s,id,north_m,east_m,alt_m,yaw_deg")) == PacketOutcome::Right);
    CHECK(traffic.take(line("0,1,100,200,300,90")) == PacketOutcome::Moved);
    CHECK(traffic.take(line("0,2,5,6,7,0")) == PacketOutcome::Moved);
    CHECK(traffic.take(line("0.1,1,110,200,300,90", 0.1)) == PacketOutcome::Moved);
    std::vector<AircraftState> states(3);
    REQUIRE(traffic.show_newest(0.1, states) == 2);
    CHECK(states[0].position_m == glm::dvec3(200.0, 110.0, 300.0));
    CHECK(states[1].position_m == glm::dvec3(6.0, 5.0, 7.0));
}

TEST_CASE("a sender that begins anew by another port goes on as the same aircraft") {
    LiveTraffic traffic(flat);
    const auto begin = [&](std::uint16_t port, double arrival_s) {
        Datagram head = line("t_s,id,north_m,east_m,alt_m,yaw_deg", arrival_s);
        Datagram fix = line("0,1,100,200,300,90", arrival_s);
        head.source.port = port;
        fix.source.port = port;
        traffic.take(head);
        traffic.take(fix);
    };
    begin(5000, 0.0);
    begin(5001, 1.0); // the first one may go on: two aircraft
    CHECK(traffic.vehicles().size() == 2);
    begin(5002, 2.5);
    REQUIRE(traffic.vehicles().size() == 2);
    CHECK(traffic.vehicles()[0].key().source.port == 5002);
    CHECK(traffic.vehicles()[1].key().source.port == 5001);
}

TEST_CASE("lines that are wrong are refused with the reason and change nothing") {
    LiveTraffic traffic(flat);
    CHECK(traffic.take(line("1,2,3")) == PacketOutcome::Wrong);
    CHECK(traffic.take(line("t_s,north_m,alt_m")) == PacketOutcome::Wrong);
    traffic.take(line("t_s\tlat_deg\tlon_deg\talt_m\twhatever"));
    CHECK(traffic.take(line("0\t1\t2")) == PacketOutcome::Wrong);
    CHECK(traffic.take(line("0\t1\tx\t3\ty")) == PacketOutcome::Wrong);
    CHECK(traffic.take(line("0\t91\t2\t3\t4")) == PacketOutcome::Wrong);
    CHECK(traffic.counts().accepted == 0);
    CHECK(traffic.counts().wrong == 5);
    const std::vector<std::string> news = traffic.take_new_messages();
    CHECK(news.size() == 5);
    CHECK(news[0].find("expected a line of names") != std::string::npos);
    CHECK(traffic.take(line("0\t1\t2\t3\ty")) == PacketOutcome::Moved);
}

TEST_CASE("a stream is cut into lines, whatever pieces it comes in") {
    const std::string stream = "one\r\ntwo\n\nthree";
    for (std::size_t piece = 1; piece < stream.size(); ++piece) {
        LineSplitter splitter;
        std::vector<std::string> lines;
        const auto take = [&](const std::vector<std::byte>& bytes) {
            std::string text;
            for (const std::byte byte : bytes) { text += std::to_integer<char>(byte); }
            lines.push_back(text);
        };
        for (std::size_t at = 0; at < stream.size(); at += piece) {
            const std::string part = stream.substr(at, piece);
            splitter.add(std::as_bytes(std::span(part.data(), part.size())), take);
        }
        splitter.finish(take);
        CHECK(lines == std::vector<std::string>{"one", "two", "three"});
    }
}

TEST_CASE("any bytes on any port leave what flies as it is, and memory bounded") {
    LiveTraffic traffic(flat);
    RandomGenerator dice(3);
    for (int i = 0; i < 20000; ++i) {
        Datagram packet;
        packet.protocol = static_cast<Protocol>(1 + i % 6);
        packet.source = {static_cast<std::uint32_t>(i), 1};
        packet.arrival_s = i * 1e-4;
        packet.bytes.resize(static_cast<std::size_t>(dice.between(0.0, 600.0)));
        for (std::byte& byte : packet.bytes) { byte = static_cast<std::byte>(dice.between(0.0, 256.0)); }
        traffic.take(packet);
    }
    CHECK(traffic.vehicles().empty());
    CHECK(traffic.counts().accepted == 0);
    CHECK(traffic.take_new_messages().size() <= 1600); // 200 for each fault
    CHECK(traffic.packet_reports().size() <= 1600);
}

TEST_CASE("garbage of many kinds does not hide what another sender is, and all of it is counted") {
    LiveTraffic traffic(flat);
    const auto take = [&](Protocol protocol, PacketSource source, std::vector<std::byte> bytes) {
        traffic.take({protocol, source, 0.0, std::move(bytes)});
    };
    const auto garbage = [&](PacketSource source) {
        for (std::uint8_t i = 0; i < 200; ++i) {
            take(Protocol::Fdm, source, std::vector<std::byte>(i + 1U, std::byte{0xee}));
            std::vector<std::byte> message(12);
            message[0] = std::byte{0xfd}; // MAVLink of another kind each time
            message[8] = std::byte{i};
            message[9] = std::byte{1};
            take(Protocol::MavLink, source, message);
            std::vector<std::byte> pdu(12);
            pdu[0] = std::byte{static_cast<std::uint8_t>(i + 8)}; // a version of DIS
            take(Protocol::Dis, source, pdu);
        }
    };
    std::vector<std::byte> cigi_4(24);
    cigi_4[1] = std::byte{24};
    cigi_4[4] = std::byte{4};
    const auto told_of_cigi_4 = [&](PacketSource source) {
        traffic.take_new_messages();
        take(Protocol::Cigi, source, cigi_4);
        const auto news = traffic.take_new_messages();
        return news.size() == 1 && news[0].find("CIGI 4 host, which") != std::string::npos;
    };
    garbage({1, 1});
    CHECK(traffic.packet_reports().size() < 40);
    CHECK(told_of_cigi_4({2, 1}));
    for (std::uint16_t port = 2; port < 150; ++port) { garbage({1, port}); }
    CHECK(told_of_cigi_4({3, 1}));
    long counted = traffic.counts().unreported;
    for (const PacketReport& report : traffic.packet_reports()) { counted += report.packets; }
    CHECK(counted == 149 * 600 + 2);
}

TEST_CASE("DIS over another planet is told once to count from the centre of the earth") {
    LiveTraffic traffic(flat, nullptr, Ellipsoid{1737400.0, 0.0});
    for (int i = 0; i < 2; ++i) {
        const auto bytes = encode_dis({}, 0.1 * i);
        traffic.take({Protocol::Dis, {1, 3000}, 0.1 * i, {bytes.begin(), bytes.end()}});
    }
    const auto news = traffic.take_new_messages();
    REQUIRE(news.size() == 2);
    CHECK(news[0].find("WGS 84") != std::string::npos);
    CHECK(news[0].find("on the Moon") != std::string::npos);
    CHECK(news[1].find("entity state of 144 bytes: fine") != std::string::npos);
}

TEST_CASE("DIS entities are named site:application:entity with their marking, all of ten thousand") {
    LiveTraffic traffic(flat);
    constexpr int count = 10000;
    for (int round = 0; round < 2; ++round) {
        for (int i = 0; i < count; ++i) {
            DisEntity entity;
            entity.site = static_cast<std::uint16_t>(1 + i / 5000);
            entity.application = 20;
            entity.entity = static_cast<std::uint16_t>(i);
            const std::string marking = "UNIT" + std::to_string(i);
            std::ranges::copy(marking, entity.marking.begin());
            entity.fix.latitude_deg = 47.0;
            entity.fix.altitude_m = 100.0;
            const auto bytes = encode_dis(entity, round);
            traffic.take({Protocol::Dis, {1, 3000}, 1.0 * round, {bytes.begin(), bytes.end()}});
        }
    }
    const std::vector<VehicleReport> reports = traffic.vehicle_reports();
    REQUIRE(reports.size() == count);
    CHECK(reports[0].name == "1:20:0");
    CHECK(reports[0].marking == "UNIT0");
    CHECK(reports[9999].name == "2:20:9999");
    CHECK(reports[9999].marking == "UNIT9999");
    CHECK(reports[9999].packets == 2);
    CHECK(reports[9999].latitude_deg == Approx(47.0));
    CHECK(traffic.vehicles().size() == LiveTraffic::max_vehicles);
    const std::vector<std::string> lines = traffic.lines();
    CHECK(std::ranges::any_of(
        lines, [](const std::string& told) { return told.find("1:20:0 UNIT0") != std::string::npos; }));
    CHECK(lines.back().starts_with("10000 vehicles in all, 256 are followed"));
}

TEST_CASE("streams that come and go do not push out one that stays") {
    LiveTraffic traffic(flat);
    const auto from = [](PacketSource source, std::string_view text, double arrival_s) {
        Datagram datagram = line(text, arrival_s);
        datagram.source = source;
        return datagram;
    };
    constexpr PacketSource stays{1, 1}; // the first by its address
    traffic.take(from(stays, "t_s,north_m,east_m,alt_m", 0.0));
    for (std::uint16_t i = 0; i < 500; ++i) {
        traffic.take(from({2, i}, "t_s,north_m,east_m,alt_m", i));
        CHECK(traffic.take(from(stays, "0,1,2,3", i)) != PacketOutcome::Wrong);
    }
}

TEST_CASE("MAVLink systems beyond the cap wait until one has been silent for ten seconds") {
    LiveTraffic traffic(flat);
    WireWriter payload(ByteOrder::Little);
    payload.add_zeros(28);
    payload.set(4, std::int32_t{470000000});
    payload.set(12, std::int32_t{100000});
    const auto packet = [&](std::uint16_t port, double arrival_s) {
        const auto bytes = octant::tests::encode_mavlink(
            {MavLinkKind::GlobalPositionInt, 1, {payload.bytes().begin(), payload.bytes().end()}}, 0);
        return Datagram{Protocol::MavLink, {1, port}, arrival_s, bytes};
    };
    for (std::uint16_t port = 0; port < 200; ++port) { traffic.take(packet(port, 0.0)); }
    CHECK(traffic.vehicles().size() == 64);
    traffic.take(packet(300, 9.0));
    CHECK(traffic.vehicles().size() == 64);
    CHECK(traffic.take(packet(300, 11.0)) == PacketOutcome::Moved);
}

TEST_CASE("a sender of twenty thousand packets a second is remembered in bounded memory") {
    LiveTraffic traffic(flat);
    std::vector<AircraftState> states(1);
    const double before = octant::tests::used_bytes();
    for (int i = 0; i < 200'000; ++i) {
        const double time_s = 5e-5 * i;
        Fix fix;
        fix.latitude_deg = 1e-3 * time_s;
        fix.altitude_m = 500.0;
        fix.velocity_ned_mps = glm::dvec3(100.0, 0.0, 0.0);
        fix.ticks = static_cast<std::uint32_t>(50 * i);
        const auto bytes = encode_fdm(fix);
        REQUIRE(traffic.take({Protocol::Fdm, {1, 1}, time_s, {bytes.begin(), bytes.end()}}) == PacketOutcome::Moved);
    }
    constexpr double mebibyte = 1048576.0;
    CHECK(octant::tests::used_bytes() - before < 4.0 * mebibyte);
    REQUIRE(traffic.show(10.0, 4.0, states) == 1);
    CHECK(states[0].position_m.y == Approx(600.0).margin(1.0)); // 4 s ago it was there
}

TEST_CASE("no more vehicles are kept than the cap, and silent ones make room") {
    LiveTraffic traffic(flat);
    Fix fix;
    fix.altitude_m = 100.0;
    const auto bytes = encode_fdm(fix);
    for (std::uint16_t i = 0; i < 400; ++i) {
        traffic.take({Protocol::Fdm, {1, i}, 0.0, {bytes.begin(), bytes.end()}});
    }
    CHECK(traffic.vehicles().size() == LiveTraffic::max_vehicles);
    CHECK(traffic.counts().unused == 400 - static_cast<long>(LiveTraffic::max_vehicles));
    const Datagram later{Protocol::Fdm, {2, 9}, 20.0, {bytes.begin(), bytes.end()}};
    CHECK(traffic.take(later) == PacketOutcome::Moved);
    CHECK(traffic.vehicles().size() == LiveTraffic::max_vehicles);
}
