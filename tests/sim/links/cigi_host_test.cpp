#include "sim/base/units.h"
#include "sim/links/cigi_host.h"
#include "tests/sim/links/cigi_samples.h"

#include <catch2/catch.hpp>

#include <variant>
#include <vector>

using namespace octant;
using namespace octant::sim::links;

TEST_CASE("what a host sends is read again as it was meant, in both byte orders") {
    for (const ByteOrder order : {ByteOrder::Big, ByteOrder::Little}) {
        WireWriter message(order);
        const test::HostScene scene;
        scene.add_to(message, {2, CigiMode::Operate, true, 77, 123456, 70});
        CigiRateControl rate;
        rate.entity = 3;
        rate.local = true;
        rate.mps = {100.0, -2.5, 0.25};
        rate.radps = {rad_from_deg(4.0), rad_from_deg(-2.0), rad_from_deg(1.0)};
        add_rate(message, rate);

        std::vector<CigiPacket> packets;
        REQUIRE(decode_cigi(message.bytes(), packets).fault == PacketError::None);
        REQUIRE(packets.size() == 5);
        const auto& control = std::get<CigiIgControl>(packets[0]);
        CHECK(control.host_frame == 77);
        CHECK(control.timestamp == 123456);
        CHECK(control.timestamp_valid);
        CHECK(control.mode == CigiMode::Operate);
        CHECK(control.database == 2);
        const auto& read = std::get<CigiEntityControl>(packets[1]);
        CHECK(read.entity == 3);
        CHECK(read.type == 12);
        CHECK(read.place == scene.entity.place);
        CHECK(deg_from_rad(read.attitude.heading_rad) == Approx(275.0));
        CHECK(deg_from_rad(read.attitude.roll_rad) == Approx(-30.0));
        const auto& sides = std::get<CigiViewDefinition>(packets[2]);
        CHECK(deg_from_rad(sides.right_rad) == Approx(32.0));
        CHECK(deg_from_rad(sides.bottom_rad) == Approx(-21.0));
        const auto& from = std::get<CigiViewControl>(packets[3]);
        CHECK(from.entity == 3);
        CHECK(from.offset_m == scene.view.offset_m);
        CHECK(deg_from_rad(from.angles.pitch_rad) == Approx(-12.0));
        const auto& rates = std::get<CigiRateControl>(packets[4]);
        CHECK(rates.local);
        CHECK_FALSE(rates.of_part);
        CHECK(rates.mps == rate.mps);
        CHECK(deg_from_rad(rates.radps.y) == Approx(-2.0));
    }
}

TEST_CASE("a Start of Frame is read in both byte orders, and nothing else is taken for one") {
    for (const ByteOrder order : {ByteOrder::Big, ByteOrder::Little}) {
        WireWriter message(order);
        add_start_of_frame(message, {9, 1234, 55, CigiMode::Operate, 0});
        const auto frame = start_of_frame_of(message.bytes());
        REQUIRE(frame);
        CHECK(frame->ig_frame == 9);
        CHECK(frame->host_frame == 1234);
        CHECK_FALSE(start_of_frame_of(message.bytes().first(23)));
    }
    WireWriter control(ByteOrder::Big);
    add_ig_control(control, {});
    CHECK_FALSE(start_of_frame_of(control.bytes()));
}
