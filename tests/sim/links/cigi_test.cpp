#include "tests/sim/links/cigi_samples.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <optional>
#include <vector>

using namespace octant;
using namespace octant::sim::links;
using namespace octant::sim::links::test;

TEST_CASE("a host's entities are read in both byte orders") {
    const FlatGround ground;
    for (const ByteOrder order : {ByteOrder::Big, ByteOrder::Little}) {
        CigiImageGenerator generator(&ground);
        HostMessage message(order, 77);
        message.entity(0, 1.5, -0.5, 900.0).set(12, 10.0F).set(16, -5.0F);
        std::vector<Fix> moved;
        REQUIRE(generator.take(message.bytes(), moved).fault == PacketError::None);
        CHECK(generator.host_frame() == 77);
        CHECK(generator.mode() == CigiMode::Operate);
        REQUIRE(moved.size() == 1);
        CHECK(moved[0].latitude_deg == 1.5);
        CHECK(moved[0].longitude_deg == -0.5);
        CHECK(moved[0].altitude_m == 900.0);
        CHECK(moved[0].attitude.heading_rad == Approx(0.5 * pi));
        CHECK(moved[0].attitude.roll_rad == Approx(rad_from_deg(10.0)));
        CHECK(moved[0].attitude.pitch_rad == Approx(rad_from_deg(-5.0)));
    }
}

TEST_CASE("an attached entity lies along its parent's axes") {
    const FlatGround ground;
    CigiImageGenerator generator(&ground);
    HostMessage message(ByteOrder::Big, 1);
    message.entity(0, 1.0, 0.0, 900.0); // nose to the east
    message.entity(5, 100.0, 0.0, 20.0).set(4, std::uint8_t{5}).set(10, std::uint16_t{0});
    std::vector<Fix> moved;
    REQUIRE(generator.take(message.bytes(), moved).fault == PacketError::None);
    REQUIRE(moved.size() == 2);
    CHECK(moved[1].latitude_deg == Approx(1.0));
    CHECK(moved[1].longitude_deg == Approx(100.0 / m_per_degree));
    CHECK(moved[1].altitude_m == Approx(880.0));
    CHECK(moved[1].attitude.heading_rad == Approx(pi));
}

TEST_CASE("rates move an entity in its own axes or in those of the ground") {
    const FlatGround ground;
    for (const bool local : {false, true}) {
        CigiImageGenerator generator(&ground);
        HostMessage message(ByteOrder::Little, 1);
        message.entity(0, 1.0, 0.0, 900.0);
        message.begin(8, 32).set(5, std::uint8_t{local ? std::uint8_t{2} : std::uint8_t{0}});
        message.set(8, 50.0F).set(28, 10.0F);
        std::vector<Fix> moved;
        REQUIRE(generator.take(message.bytes(), moved).fault == PacketError::None);
        const Fix& fix = moved.back();
        CHECK(fix.velocity_ned_mps->x == Approx(local ? 0.0 : 50.0).margin(1e-9));
        CHECK(fix.velocity_ned_mps->y == Approx(local ? 50.0 : 0.0).margin(1e-9));
        CHECK(fix.body_rates_radps->z == Approx(rad_from_deg(10.0)));
    }
}

TEST_CASE("a message begins with Start of Frame, whose numbers are the frames'") {
    CigiImageGenerator generator(nullptr);
    std::vector<Fix> moved;
    generator.take(HostMessage(ByteOrder::Big, 1234).bytes(), moved);
    const auto message = generator.message_for(99, 2.5);
    const auto parts = parts_of(message);
    REQUIRE(parts.size() == 1);
    CHECK(parts[0].opcode == 101);
    CHECK(parts[0].reader.at<std::uint16_t>(6) == 0x8000);
    CHECK(parts[0].reader.at<std::uint32_t>(8) == 99);
    CHECK(parts[0].reader.at<std::uint32_t>(12) == 250000);
    CHECK(parts[0].reader.at<std::uint32_t>(16) == 1234);
}

TEST_CASE("values that nothing can have are left out of a message, the rest of it counts") {
    const auto packets_of = [](const HostMessage& message) {
        std::vector<CigiPacket> packets;
        REQUIRE(decode_cigi(message.bytes(), packets).fault == PacketError::None);
        return packets.size() - 1; // without IG Control
    };
    for (const float value : {-1.0F, 2e6F, std::nanf("")}) {
        HostMessage message(ByteOrder::Big, 1);
        message.begin(10, 32).set(2, std::uint8_t{1}).set(8, value);
        CHECK(packets_of(message) == 0);
    }
    HostMessage hour(ByteOrder::Big, 1);
    hour.begin(9, 16).set(2, std::uint8_t{24});
    CHECK(packets_of(hour) == 0);
    HostMessage rate(ByteOrder::Little, 1);
    rate.begin(8, 32).set(8, 30000.0F);
    rate.begin(8, 32).set(20, 6000.0F);
    rate.begin(8, 32).set(8, 300.0F);
    CHECK(packets_of(rate) == 1);
    HostMessage view(ByteOrder::Big, 1);
    view.begin(16, 32).set(8, 1e7F);
    CHECK(packets_of(view) == 0);
}

TEST_CASE("what is no message of a CIGI 3 host is refused, and unknown packets are counted") {
    CigiImageGenerator generator(nullptr);
    std::vector<Fix> moved;
    HostMessage message(ByteOrder::Big, 1);
    message.begin(200, 16).begin(24, 16);
    CHECK(generator.take(message.bytes(), moved).fault == PacketError::None);
    CHECK(generator.unknown()[200] == 1);
    CHECK(generator.unknown()[24] == 1);
    const Bytes whole = message.bytes();
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const PacketError fault = generator.take(whole.first(length), moved).fault;
        CHECK((fault == PacketError::None) == (length == 24 || length == 40));
    }
    std::vector<std::byte> zero_size(whole.begin(), whole.end());
    zero_size[25] = std::byte{0};
    CHECK(generator.take(zero_size, moved).fault == PacketError::WrongSize);
}

TEST_CASE("caps hold whatever a host asks for") {
    const FlatGround ground;
    CigiImageGenerator generator(&ground);
    std::vector<Fix> moved;
    for (int i = 0; i < 3000; ++i) {
        const auto id = static_cast<std::uint16_t>(i);
        HostMessage message(ByteOrder::Big, 1);
        message.entity(id, 1.0, 0.0, 100.0).height(id, 0, 1, 1.0);
        message.begin(16, 32).set(2, id).begin(21, 32).set(2, id).set(16, -30.0F).set(20, 30.0F);
        message.set(24, 20.0F).set(28, -20.0F);
        generator.take(message.bytes(), moved);
    }
    CHECK(generator.views().size() == CigiImageGenerator::max_views);
    CHECK(generator.definitions().size() == CigiImageGenerator::max_views);
    CHECK(generator.message_for(1, 0.0).size() <= CigiImageGenerator::max_message_bytes);
}
