#include "tests/sim/links/cigi_samples.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <optional>
#include <vector>

using namespace octant;
using namespace octant::sim::links;
using namespace octant::sim::links::test;

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
        if (parts.size() > 1) { CHECK(parts[1].reader.at<std::uint8_t>(4) >> 4U == ((2 + frame) & 0xfU)); }
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
    for (std::uint16_t id = 0; id < 100; ++id) { message.height(id, 2, 0, 1.0); }
    std::vector<Fix> moved;
    generator.take(message.bytes(), moved);
    std::size_t answers = 0;
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        const auto answer = generator.message_for(frame, 0.0);
        CHECK(answer.size() <= CigiImageGenerator::max_message_bytes);
        answers += parts_of(answer).size() - 1;
    }
    CHECK(answers == 100);
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
            message.begin(24, 32).set(2, i).set(4, std::uint8_t{2}).set(8, 1.0).set(16, 1.0).set(24, 500.0);
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
