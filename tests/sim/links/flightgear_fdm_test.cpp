#include "sim/base/units.h"
#include "sim/links/flightgear_fdm.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <limits>
#include <vector>

using namespace octant;
using namespace octant::sim::links;

namespace {

Fix some_fix() {
    Fix fix;
    fix.latitude_deg = 47.25;
    fix.longitude_deg = -122.5;
    fix.altitude_m = 1234.5;
    fix.above_ground_m = 800.0;
    fix.attitude = {1.25, 0.1, -0.4};
    fix.velocity_ned_mps = glm::dvec3(100.0, -50.0, 5.0);
    fix.body_rates_radps = glm::dvec3(0.1, -0.05, 0.2);
    fix.ticks = 123456;
    return fix;
}

std::vector<std::byte> packet() {
    const auto bytes = encode_fdm(some_fix());
    return {bytes.begin(), bytes.end()};
}

/// The packet as version 25 has it: 144 bytes of tanks at 304.
std::vector<std::byte> packet_25() {
    std::vector<std::byte> bytes = packet();
    bytes[3] = std::byte{25};
    bytes.insert(bytes.begin() + 304, 144, std::byte{0x55});
    return bytes;
}

} // namespace

TEST_CASE("an FDM packet of either version gives back what was written") {
    for (const auto& bytes : {packet(), packet_25()}) {
        Fix fix;
        const DecodeResult result = decode_fdm(bytes, fix);
        const Fix expected = some_fix();
        REQUIRE(result.fault == PacketError::None);
        CHECK(fix.latitude_deg == Approx(expected.latitude_deg).epsilon(1e-15));
        CHECK(fix.longitude_deg == Approx(expected.longitude_deg).epsilon(1e-15));
        CHECK(fix.altitude_m == expected.altitude_m);
        CHECK(fix.above_ground_m == expected.above_ground_m);
        CHECK(fix.attitude.heading_rad == Approx(1.25));
        CHECK(fix.attitude.roll_rad == Approx(-0.4));
        CHECK(fix.velocity_ned_mps->y == Approx(-50.0));
        CHECK(fix.body_rates_radps->x == Approx(0.1));
        CHECK(fix.body_rates_radps->y == Approx(-0.05));
        CHECK(fix.body_rates_radps->z == Approx(0.2));
        CHECK(fix.ticks == expected.ticks);
    }
}

TEST_CASE("the bytes of an FDM packet stand where FlightGear reads them") {
    const auto bytes = packet();
    REQUIRE(bytes.size() == 408);
    CHECK(std::to_integer<int>(bytes[3]) == 24);
    // Latitude: 47.25 degrees as the big-endian bits of 0.8246680715673207 rad.
    const WireReader reader(bytes, ByteOrder::Big);
    CHECK(reader.at<double>(16) == Approx(0.8246680715673207).epsilon(1e-15));
    CHECK(reader.at<float>(76) == Approx(100.0 / 0.3048)); // north, feet a second
    CHECK(reader.at<std::uint32_t>(356) == 123456U);
}

TEST_CASE("what is wrong with an FDM packet is said with numbers") {
    Fix fix;
    CHECK(fdm_text(decode_fdm(packet_25(), fix)) == "FDM version 25 of 552 bytes: fine");

    auto swapped = packet();
    std::swap(swapped[0], swapped[3]);
    CHECK(fdm_text(decode_fdm(swapped, fix)) == "expected FDM version 24 or 25, got 402653184 in 408 bytes");

    auto old = packet();
    old[3] = std::byte{23};
    CHECK(fdm_text(decode_fdm(old, fix)) == "expected FDM version 24 or 25, got 23 in 408 bytes");

    auto cut = packet();
    cut.resize(400);
    CHECK(fdm_text(decode_fdm(cut, fix)) == "FDM version 24: expected 408 bytes, got 400");
    cut.resize(3);
    CHECK(fdm_text(decode_fdm(cut, fix)) == "expected an FDM packet, got 3 bytes");
}

TEST_CASE("an FDM packet with numbers that no aircraft has is refused") {
    Fix wrong = some_fix();
    Fix fix;
    wrong.altitude_m = std::numeric_limits<double>::quiet_NaN();
    CHECK(decode_fdm(encode_fdm(wrong), fix).fault == PacketError::NotFinite);
    wrong.altitude_m = 1e9;
    CHECK(decode_fdm(encode_fdm(wrong), fix).fault == PacketError::OutOfRange);
    wrong = some_fix();
    wrong.latitude_deg = 91.0;
    CHECK(decode_fdm(encode_fdm(wrong), fix).fault == PacketError::OutOfRange);
}

TEST_CASE("a height above ground that the sender does not know is none") {
    Fix unknown = some_fix();
    unknown.above_ground_m.reset();
    Fix fix;
    REQUIRE(decode_fdm(encode_fdm(unknown), fix).fault == PacketError::None);
    CHECK_FALSE(fix.above_ground_m.has_value());
}

TEST_CASE("no packet of any length makes the FDM decoder read beyond it") {
    const auto whole = packet_25();
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const std::vector<std::byte> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        Fix fix;
        CHECK(decode_fdm(part, fix).fault != PacketError::None);
    }
}
