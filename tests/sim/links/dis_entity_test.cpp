#include "sim/base/units.h"
#include "sim/links/dis_entity.h"
#include "sim/links/fix.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <vector>

using namespace octant;
using namespace octant::sim::links;

namespace {

DisEntity some_entity() {
    DisEntity entity;
    entity.site = 1;
    entity.application = 2;
    entity.entity = 3;
    entity.type = {1, 2, 0, 225, 1, 3, 0, 0};
    entity.reckoning = DeadReckoning::Rvw;
    entity.fix.latitude_deg = 47.5;
    entity.fix.longitude_deg = 8.25;
    entity.fix.altitude_m = 1500.0;
    entity.fix.attitude = {1.0, 0.2, -0.5};
    entity.fix.velocity_ned_mps = glm::dvec3(120.0, 60.0, -4.0);
    entity.fix.acceleration_ned_mps2 = glm::dvec3(1.0, -2.0, 3.0);
    entity.fix.body_rates_radps = glm::dvec3(0.1, 0.2, 0.3);
    return entity;
}

} // namespace

TEST_CASE("places on the ellipsoid and around the earth's centre agree") {
    // Published pair: 45 N, 0 E on the ellipsoid.
    const glm::dvec3 at = ecef_from_geodetic({rad_from_deg(45.0), 0.0, 0.0});
    CHECK(at.x == Approx(4517590.8788).epsilon(1e-10));
    CHECK(at.z == Approx(4487348.4088).epsilon(1e-10));
    for (const double latitude : {-90.0, -89.9, -30.0, 0.0, 47.3, 90.0}) {
        for (const double height_m : {-1000.0, 0.0, 12000.0, 500000.0}) {
            CAPTURE(latitude, height_m);
            const Geodetic place{rad_from_deg(latitude), rad_from_deg(-122.4), height_m};
            const Geodetic back = geodetic_from_ecef(ecef_from_geodetic(place));
            CHECK(back.height_m == Approx(height_m).margin(1e-6));
            CHECK(back.latitude_rad == Approx(place.latitude_rad).margin(1e-12));
        }
    }
}

TEST_CASE("a DIS entity state gives back what was written") {
    DisEntity read;
    const auto bytes = encode_dis(some_entity(), 12.5);
    const DecodeResult result = decode_dis(bytes, read);
    REQUIRE(result.fault == PacketError::None);
    const DisEntity expected = some_entity();
    CHECK(read.entity == 3);
    CHECK(read.type == expected.type);
    CHECK(read.fix.latitude_deg == Approx(47.5).margin(1e-9));
    CHECK(read.fix.longitude_deg == Approx(8.25).margin(1e-9));
    CHECK(read.fix.altitude_m == Approx(1500.0).margin(1e-3));
    CHECK(read.fix.attitude.heading_rad == Approx(1.0).margin(1e-5));
    CHECK(read.fix.attitude.pitch_rad == Approx(0.2).margin(1e-5));
    CHECK(read.fix.attitude.roll_rad == Approx(-0.5).margin(1e-5));
    CHECK(glm::length(*read.fix.velocity_ned_mps - *expected.fix.velocity_ned_mps) < 1e-3);
    CHECK(glm::length(read.fix.acceleration_ned_mps2 - expected.fix.acceleration_ned_mps2) < 1e-4);
    CHECK(*read.fix.ticks * read.fix.tick_s == Approx(12.5).margin(1e-5));
}

TEST_CASE("the five ways of dead reckoning take what belongs to them") {
    for (const auto reckoning :
        {DeadReckoning::Static, DeadReckoning::Fpw, DeadReckoning::Rpw, DeadReckoning::Rvw, DeadReckoning::Fvw}) {
        DisEntity entity = some_entity();
        entity.reckoning = reckoning;
        DisEntity read;
        REQUIRE(decode_dis(encode_dis(entity, 0.0), read).fault == PacketError::None);
        const int number = static_cast<int>(reckoning);
        CAPTURE(number);
        CHECK((glm::length(*read.fix.velocity_ned_mps) > 0.0) == (number >= 2));
        CHECK((glm::length(*read.fix.body_rates_radps) > 0.0) == (number == 3 || number == 4));
        CHECK((glm::length(read.fix.acceleration_ned_mps2) > 0.0) == (number >= 4));
    }
}

TEST_CASE("what is no entity state is said") {
    const auto whole = encode_dis(some_entity(), 0.0);
    std::vector<std::byte> bytes(whole.begin(), whole.end());
    DisEntity read;
    bytes[2] = std::byte{2};
    CHECK(dis_text(decode_dis(bytes, read)) == "DIS PDU of type 2: passed over");
    bytes[0] = std::byte{99};
    CHECK(dis_text(decode_dis(bytes, read)) == "expected a DIS PDU of version 1 to 7, got 99");
    for (std::size_t length = 0; length < whole.size(); ++length) {
        CHECK(decode_dis(Bytes(whole).first(length), read).fault != PacketError::None);
    }
    // The centre of the earth has no latitude that means anything, but is far below any aircraft.
    WireWriter writer(ByteOrder::Big);
    for (const std::byte byte : whole) { writer.add(std::to_integer<std::uint8_t>(byte)); }
    for (const std::size_t at : {std::size_t{48}, std::size_t{56}, std::size_t{64}}) { writer.set(at, 0.0); }
    CHECK(decode_dis(writer.bytes(), read).fault == PacketError::OutOfRange);
}
