#include "sim/base/units.h"
#include "sim/links/mavlink.h"
#include "tests/sim/links/mavlink_frames.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <vector>

using namespace octant;
using namespace octant::sim::links;
using octant::tests::encode_mavlink;

namespace {

std::vector<std::byte> bytes_of(const std::vector<int>& numbers) {
    std::vector<std::byte> bytes;
    for (const int number : numbers) { bytes.push_back(static_cast<std::byte>(number)); }
    return bytes;
}

MavLinkFrame attitude(std::uint32_t ms, float roll, float pitch, float yaw) {
    WireWriter writer(ByteOrder::Little);
    writer.add(ms);
    for (const float value : {roll, pitch, yaw, 0.1F, 0.2F, 0.3F}) { writer.add(value); }
    return {MavLinkKind::Attitude, 7, writer.take()};
}

MavLinkFrame position(std::uint32_t ms, double lat_deg, double lon_deg, double alt_m) {
    WireWriter writer(ByteOrder::Little);
    writer.add(ms);
    writer.add(static_cast<std::int32_t>(lat_deg * 1e7));
    writer.add(static_cast<std::int32_t>(lon_deg * 1e7));
    writer.add(static_cast<std::int32_t>(alt_m * 1e3));
    writer.add(std::int32_t{12500}); // above home
    writer.add(std::int16_t{2000});  // north, cm/s
    writer.add(std::int16_t{0});
    writer.add(std::int16_t{-100});
    writer.add(std::uint16_t{9000});
    return {MavLinkKind::GlobalPositionInt, 7, writer.take()};
}

MavLinkFrame hil_state() {
    WireWriter writer(ByteOrder::Little);
    writer.add(std::uint64_t{2000000});
    for (const float value : {0.70710678F, 0.0F, 0.0F, 0.70710678F, 0.0F, 0.0F, 0.5F}) {
        writer.add(value); // a quarter turn to the right; then rates
    }
    writer.add(std::int32_t{470000000});
    writer.add(std::int32_t{80000000});
    writer.add(std::int32_t{123000});
    for (int i = 0; i < 8; ++i) { writer.add(std::int16_t{0}); }
    return {MavLinkKind::HilStateQuaternion, 1, writer.take()};
}

} // namespace

TEST_CASE("the heartbeat that ArduPilot's pages show is read") {
    const auto bytes = bytes_of({0xFE, 9, 0x4E, 1, 1, 0, 0, 0, 0, 0, 2, 3, 0x51, 4, 3, 0x1C, 0x7F});
    const MavLinkParse parse = parse_mavlink(bytes);
    REQUIRE(parse.result.fault == PacketError::None);
    CHECK(parse.length == bytes.size());
    CHECK(parse.frame->kind == MavLinkKind::Heartbeat);
    CHECK(parse.frame->system == 1);
    CHECK(parse.sequence == 0x4E);
    CHECK(parse.component == 1);
    CHECK_FALSE(MavLinkPose().take(*parse.frame).has_value());
}

TEST_CASE("a MAVLink frame with a wrong bit anywhere is refused") {
    const auto packed = encode_mavlink(attitude(1, 0.1F, 0.2F, 0.3F), 9);
    for (std::size_t i = 1; i < packed.size(); ++i) {
        auto wrong = packed;
        wrong[i] ^= std::byte{0x10};
        CHECK(parse_mavlink(wrong).result.fault != PacketError::None);
    }
}

TEST_CASE("zeros that MAVLink 2 cuts off the end of a message stand there again") {
    MavLinkFrame frame = attitude(5, 0.5F, 0.0F, 0.0F);
    for (std::size_t i = 16; i < 28; ++i) { frame.payload[i] = std::byte{0}; }
    MavLinkFrame cut = frame;
    cut.payload.resize(8);
    const MavLinkParse parse = parse_mavlink(encode_mavlink(cut, 0));
    REQUIRE(parse.frame.has_value());
    CHECK(parse.frame->payload.size() == 28);
    CHECK(std::equal(cut.payload.begin(), cut.payload.end(), parse.frame->payload.begin()));
}

TEST_CASE("attitudes carry on the position of the last GLOBAL_POSITION_INT") {
    MavLinkPose pose;
    CHECK_FALSE(pose.take(attitude(900, 0.0F, 0.0F, 0.0F)).has_value());
    CHECK_FALSE(pose.take(position(1000, 47.0, 8.0, 500.0)).has_value());
    const auto fix = pose.take(attitude(1500, 0.1F, 0.2F, 1.5F));
    REQUIRE(fix.has_value());
    CHECK(fix->vehicle == 7);
    CHECK(fix->attitude.roll_rad == Approx(0.1));
    CHECK(fix->altitude_m == Approx(500.5));
    CHECK((fix->latitude_deg - 47.0) * 111195.0 == Approx(10.0).epsilon(0.01)); // 20 m/s, 0.5 s
    CHECK(*fix->sent_s == Approx(1.5));
}

TEST_CASE("attitudes carry a position on over the ellipsoid of the ground") {
    // 20 m/s north for half a second over the Moon, a sphere of 1,737.4 km: 30,323.3 m a degree.
    MavLinkPose pose;
    pose.take(position(1000, 47.0, 8.0, 0.0));
    const auto fix =
        pose.take(attitude(1500, 0.0F, 0.0F, 0.0F), Ellipsoid{.semi_major_m = 1737400.0, .flattening = 0.0});
    REQUIRE(fix.has_value());
    CHECK((fix->latitude_deg - 47.0) * 30323.3 == Approx(10.0).epsilon(1e-4));
}

TEST_CASE("an autopilot that does not know yet where it is is nowhere") {
    MavLinkPose pose;
    CHECK_FALSE(pose.take(position(1000, 0.0, 0.0, 500.0)).has_value());
    CHECK_FALSE(pose.take(attitude(1100, 0.0F, 0.0F, 0.0F)).has_value());
    pose.take(position(1200, 47.0, 8.0, 500.0));
    CHECK(pose.take(attitude(1300, 0.0F, 0.0F, 0.0F)).has_value());
}

TEST_CASE("positions without attitudes are poses of their own") {
    MavLinkPose pose;
    const auto fix = pose.take(position(1000, 47.0, 8.0, 500.0));
    REQUIRE(fix.has_value());
    CHECK(fix->attitude.heading_rad == Approx(rad_from_deg(90.0)));
    REQUIRE(fix->above_home_m.has_value());
    CHECK(*fix->above_home_m == Approx(12.5));
}

TEST_CASE("once HIL_STATE_QUATERNION comes it is the only source of a pose") {
    MavLinkPose pose;
    const auto fix = pose.take(hil_state());
    REQUIRE(fix.has_value());
    CHECK(fix->attitude.heading_rad == Approx(0.5 * pi));
    CHECK(fix->altitude_m == 123.0);
    CHECK(*fix->sent_s == 2.0);
    CHECK(fix->body_rates_radps->z == Approx(0.5));
    CHECK_FALSE(pose.take(position(3000, 1.0, 1.0, 1.0)).has_value());
    CHECK_FALSE(pose.take(attitude(3000, 0.0F, 0.0F, 0.0F)).has_value());
}

TEST_CASE("GLOBAL_POSITION_INT tells HIL_STATE_QUATERNION and ATTITUDE the height of home") {
    MavLinkPose pose;
    CHECK_FALSE(pose.take(hil_state())->above_home_m.has_value());
    pose.take(position(3000, 47.0, 8.0, 130.0)); // 12.5 m above home
    CHECK(*pose.take(hil_state())->above_home_m == Approx(123.0 - 117.5));
    MavLinkPose other;
    other.take(attitude(900, 0.0F, 0.0F, 0.0F));
    other.take(position(1000, 47.0, 8.0, 500.0));
    CHECK(*other.take(attitude(1500, 0.0F, 0.0F, 0.0F))->above_home_m == Approx(13.0)); // 1 m/s up
}

TEST_CASE("bytes that are no MAVLink are passed over up to the next frame") {
    auto bytes = bytes_of({1, 2, 3});
    const auto packed = encode_mavlink(attitude(1, 0.1F, 0.2F, 0.3F), 9);
    bytes.insert(bytes.end(), packed.begin(), packed.end());
    const MavLinkParse first = parse_mavlink(bytes);
    CHECK(first.result.fault == PacketError::NotOurs);
    REQUIRE(first.length == 3);
    CHECK(parse_mavlink(Bytes(bytes).subspan(3)).frame.has_value());
    for (std::size_t length = 0; length < packed.size(); ++length) {
        CHECK_FALSE(parse_mavlink(Bytes(packed).first(length)).frame.has_value());
        CHECK(parse_mavlink(Bytes(packed).first(length)).length > 0);
    }
}
