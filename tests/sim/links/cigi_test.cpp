#include "sim/base/units.h"
#include "sim/links/cigi_image_generator.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <optional>
#include <vector>

using namespace octant;
using namespace octant::sim::links;

namespace {

constexpr double m_per_degree = 1e5; ///< on this flat earth

/// A flat ground at 100 m with a wall 300 m high from 2 E on; its edge is at 3 degrees.
class FlatGround final : public CigiGround {
public:
    std::optional<CigiSurface> below(const glm::dvec3& place) const override {
        if (std::abs(place.x) > 3.0 || std::abs(place.y) > 3.0) {
            return std::nullopt;
        }
        return CigiSurface{{place.x, place.y, place.y < 2.0 ? 100.0 : 300.0}, 0.0, 0.5 * pi};
    }

    std::optional<Met> first_met(const glm::dvec3& from, const glm::dvec3& to) const override {
        constexpr int steps = 10000;
        for (int i = 0; i <= steps; ++i) {
            const glm::dvec3 at = from + (static_cast<double>(i) / steps) * (to - from);
            const auto surface = below(at);
            if (surface && at.z < surface->place.z) {
                return Met{distance_m(from, at), *surface};
            }
        }
        return std::nullopt;
    }

    double distance_m(const glm::dvec3& from, const glm::dvec3& to) const override {
        const glm::dvec3 scale(m_per_degree, m_per_degree, 1.0);
        return glm::length((to - from) * scale);
    }

    glm::dvec3 moved(const glm::dvec3& place, const glm::dvec3& ned_m) const override {
        return place + glm::dvec3(ned_m.x / m_per_degree, ned_m.y / m_per_degree, -ned_m.z);
    }
};

/// A host's message in either byte order.
class HostMessage {
public:
    HostMessage(ByteOrder order, std::uint32_t host_frame)
        : writer_(order) {
        begin(1, 24);
        set(2, std::uint8_t{3});
        set(4, std::uint8_t{0x31}); // operate, minor version 3
        set(6, std::uint16_t{0x8000});
        set(8, host_frame);
    }

    HostMessage& begin(std::uint8_t opcode, std::uint8_t size) {
        at_ = writer_.size();
        writer_.add_zeros(size);
        writer_.set(at_, opcode);
        writer_.set(at_ + 1, size);
        return *this;
    }

    template <class Number>
    HostMessage& set(std::size_t offset, Number value) {
        writer_.set(at_ + offset, value);
        return *this;
    }

    HostMessage& entity(std::uint16_t number, double lat, double lon, double alt) {
        return begin(2, 48)
            .set(2, number)
            .set(4, std::uint8_t{1})
            .set(20, 90.0F)
            .set(24, lat)
            .set(32, lon)
            .set(40, alt);
    }

    HostMessage& height(std::uint16_t id, std::uint8_t kind, std::uint8_t period, double lat) {
        return begin(24, 32).set(2, id).set(4, kind).set(5, period).set(8, lat).set(24, 500.0);
    }

    Bytes bytes() const { return writer_.bytes(); }

private:
    WireWriter writer_;
    std::size_t at_ = 0;
};

struct Packet {
    int opcode = 0;
    WireReader reader;
};

/// The packets of an answer.
std::vector<Packet> parts_of(const std::vector<std::byte>& message) {
    std::vector<Packet> parts;
    for (Bytes rest = message; rest.size() >= 2;) {
        const auto size = std::to_integer<std::size_t>(rest[1]);
        REQUIRE(size <= rest.size());
        parts.push_back(
            {std::to_integer<int>(rest[0]), WireReader(rest.first(size), ByteOrder::Big)});
        rest = rest.subspan(size);
    }
    return parts;
}

} // namespace

TEST_CASE("a host's entities are read in both byte orders") {
    const FlatGround ground;
    for (const ByteOrder order : {ByteOrder::Big, ByteOrder::Little}) {
        CigiImageGenerator generator(&ground);
        HostMessage message(order, 77);
        message.entity(0, 1.5, -0.5, 900.0).set(12, 10.0F).set(16, -5.0F);
        std::vector<Fix> moved;
        REQUIRE(generator.take(message.bytes(), moved).fault == Fault::None);
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
    REQUIRE(generator.take(message.bytes(), moved).fault == Fault::None);
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
        REQUIRE(generator.take(message.bytes(), moved).fault == Fault::None);
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

TEST_CASE("heights are answered with their ids, their host frame and no answer outside") {
    const FlatGround ground;
    CigiImageGenerator generator(&ground);
    HostMessage message(ByteOrder::Little, 0x25);
    message.height(11, 0, 0, 1.0).height(12, 1, 0, 1.0).height(13, 2, 0, 1.0);
    message.height(14, 0, 0, 45.0);
    std::vector<Fix> moved;
    generator.take(message.bytes(), moved);
    const auto answer = generator.message_for(1, 0.0);
    const auto parts = parts_of(answer);
    REQUIRE(parts.size() == 5);
    CHECK(parts[1].reader.at<std::uint16_t>(2) == 11);
    CHECK(parts[1].reader.at<std::uint8_t>(4) == 0x51); // valid, HAT, host frame ...5
    CHECK(parts[1].reader.at<double>(8) == 400.0);
    CHECK(parts[2].reader.at<std::uint8_t>(4) == 0x53);
    CHECK(parts[2].reader.at<double>(8) == 100.0);
    CHECK(parts[3].opcode == 103);
    CHECK(parts[3].reader.at<double>(8) == 400.0);
    CHECK(parts[3].reader.at<double>(16) == 100.0);
    CHECK(parts[3].reader.at<float>(32) == Approx(90.0F));
    CHECK(parts[4].reader.at<std::uint8_t>(4) == 0x50);         // not valid
    CHECK(parts_of(generator.message_for(2, 0.0)).size() == 1); // once
}

TEST_CASE("periodic questions are answered until they are asked once") {
    const FlatGround ground;
    CigiImageGenerator generator(&ground);
    std::vector<Fix> moved;
    generator.take(HostMessage(ByteOrder::Big, 1).height(7, 1, 2, 1.0).bytes(), moved);
    int answers = 0;
    for (std::uint32_t frame = 0; frame < 10; ++frame) {
        generator.take(HostMessage(ByteOrder::Big, 2 + frame).bytes(), moved);
        const auto message = generator.message_for(frame, 0.0);
        const auto parts = parts_of(message);
        answers += static_cast<int>(parts.size()) - 1;
        if (parts.size() > 1) {
            CHECK(parts[1].reader.at<std::uint8_t>(4) >> 4U == ((2 + frame) & 0xfU));
        }
    }
    CHECK(answers == 5);
    generator.take(HostMessage(ByteOrder::Big, 20).height(7, 1, 0, 1.0).bytes(), moved);
    CHECK(parts_of(generator.message_for(10, 0.0)).size() == 2);
    CHECK(parts_of(generator.message_for(11, 0.0)).size() == 1);
    CHECK(parts_of(generator.message_for(12, 0.0)).size() == 1);
}

TEST_CASE("lines of sight are open, or end where they meet the ground") {
    const FlatGround ground;
    CigiImageGenerator generator(&ground);
    HostMessage message(ByteOrder::Big, 1);
    const auto segment = [&message](std::uint16_t id, double to_lon, std::uint8_t flags) {
        message.begin(25, 64).set(2, id).set(4, flags).set(8, 1.0).set(24, 200.0);
        message.set(32, 1.0).set(40, to_lon).set(48, 200.0);
    };
    segment(1, 1.5, 0);
    segment(2, 2.5, 1);
    std::vector<Fix> moved;
    generator.take(message.bytes(), moved);
    const auto answer = generator.message_for(1, 0.0);
    const auto parts = parts_of(answer);
    REQUIRE(parts.size() == 3);
    CHECK(parts[1].opcode == 104);
    CHECK((parts[1].reader.at<std::uint8_t>(4) & 0x5U) == 0x5U); // valid and visible
    CHECK(parts[1].reader.at<double>(8) == Approx(150000.0));
    CHECK(parts[2].opcode == 105);
    CHECK((parts[2].reader.at<std::uint8_t>(4) & 0xfU) == 0x5U); // valid, with range, not visible
    CHECK(parts[2].reader.at<double>(8) == Approx(200000.0).epsilon(1e-3));
    CHECK(parts[2].reader.at<double>(24) == Approx(2.0).epsilon(1e-3));
}

TEST_CASE("answers that do not fit into a message wait for the next one") {
    const FlatGround ground;
    CigiImageGenerator generator(&ground);
    HostMessage message(ByteOrder::Big, 1);
    for (std::uint16_t id = 0; id < 100; ++id) {
        message.height(id, 2, 0, 1.0);
    }
    std::vector<Fix> moved;
    generator.take(message.bytes(), moved);
    std::size_t answers = 0;
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        const auto answer = generator.message_for(frame, 0.0);
        CHECK(answer.size() <= CigiImageGenerator::most_message_bytes);
        answers += parts_of(answer).size() - 1;
    }
    CHECK(answers == 100);
}

TEST_CASE("values that nothing can have are left out of a message, the rest of it counts") {
    const auto packets_of = [](const HostMessage& message) {
        std::vector<CigiPacket> packets;
        REQUIRE(decode_cigi(message.bytes(), packets).fault == Fault::None);
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

TEST_CASE("twenty heights and five lines of sight a frame are all answered within two frames") {
    const FlatGround ground;
    CigiImageGenerator generator(&ground);
    std::vector<Fix> moved;
    constexpr std::size_t questions = 25;
    std::size_t asked = 0;
    std::size_t answered = 0;
    for (std::uint32_t frame = 1; frame <= 60; ++frame) {
        HostMessage message(ByteOrder::Big, frame);
        for (std::uint16_t i = 0; i < 20; ++i) {
            message.begin(24, 32)
                .set(2, i)
                .set(4, std::uint8_t{2})
                .set(8, 1.0)
                .set(16, 1.0)
                .set(24, 500.0);
        }
        for (std::uint16_t i = 0; i < 5; ++i) {
            message.begin(25, 64)
                .set(2, i)
                .set(4, std::uint8_t{1})
                .set(8, 1.0)
                .set(16, 1.0)
                .set(24, 500.0)
                .set(32, 1.1)
                .set(40, 1.0)
                .set(48, 500.0);
        }
        generator.take(message.bytes(), moved);
        asked += questions;
        answered += parts_of(generator.message_for(frame, frame / 60.0)).size() - 1;
        CHECK(asked - answered <= questions);
    }
}

TEST_CASE("what is no message of a CIGI 3 host is refused, and unknown packets are counted") {
    CigiImageGenerator generator(nullptr);
    std::vector<Fix> moved;
    HostMessage message(ByteOrder::Big, 1);
    message.begin(200, 16).begin(24, 16);
    CHECK(generator.take(message.bytes(), moved).fault == Fault::None);
    CHECK(generator.unknown()[200] == 1);
    CHECK(generator.unknown()[24] == 1);
    const Bytes whole = message.bytes();
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const Fault fault = generator.take(whole.first(length), moved).fault;
        CHECK((fault == Fault::None) == (length == 24 || length == 40));
    }
    std::vector<std::byte> zero_size(whole.begin(), whole.end());
    zero_size[25] = std::byte{0};
    CHECK(generator.take(zero_size, moved).fault == Fault::WrongSize);
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
    CHECK(generator.views().size() == CigiImageGenerator::most_views);
    CHECK(generator.definitions().size() == CigiImageGenerator::most_views);
    CHECK(generator.message_for(1, 0.0).size() <= CigiImageGenerator::most_message_bytes);
}
