#include "sim/base/units.h"
#include "sim/links/cigi_image_generator.h"
#include "tests/sim/links/cigi_samples.h"

#include <catch2/catch.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>

using namespace octant;
using namespace octant::sim::links;
using octant::sim::links::test::HostMessage;

namespace {

/// How far a part is turned about z, in degrees.
double yaw_of(const CigiPartPose& part) { return deg_from_rad(2.0 * std::atan2(part.turn.z, part.turn.w)); }

/// A message of a host that turns part 3 of entity 0, which is there.
HostMessage turning(std::uint8_t flags, float yaw_deg) {
    HostMessage message(ByteOrder::Big, 1);
    message.entity(0, 0.0, 0.0, 500.0);
    message.begin(6, 32).set(4, std::uint8_t{3}).set(5, flags).set(28, yaw_deg);
    return message;
}

constexpr std::uint8_t with_yaw = 0x41;
constexpr std::uint8_t with_nothing = 0x01;
constexpr std::uint8_t disabled = 0x40;

} // namespace

TEST_CASE("an articulated part keeps the angles that its host set, and goes on by its rates") {
    CigiImageGenerator generator(nullptr);
    std::vector<Fix> moved;
    const auto yaw_at = [&](double time_s) {
        const auto parts = generator.parts().turned(time_s);
        REQUIRE(parts.size() == 1);
        CHECK(parts.front().entity == 0);
        CHECK(parts.front().part == 3);
        return yaw_of(parts.front());
    };
    generator.take(turning(with_yaw, 30.0F).bytes(), moved, 1.0);
    CHECK(yaw_at(9.0) == Approx(30.0));
    generator.take(turning(with_nothing, 80.0F).bytes(), moved, 2.0);
    CHECK(yaw_at(9.0) == Approx(30.0));
    HostMessage rate(ByteOrder::Little, 2);
    rate.begin(8, 32).set(4, std::uint8_t{3}).set(5, std::uint8_t{1}).set(28, 10.0F);
    generator.take(rate.bytes(), moved, 3.0);
    CHECK(moved.empty());
    CHECK(yaw_at(5.0) == Approx(50.0));
    CHECK(yaw_at(0.0) == Approx(30.0)); // not back
    generator.take(turning(with_yaw, 5.0F).bytes(), moved, 6.0);
    CHECK(yaw_at(7.0) == Approx(15.0));
    generator.take(turning(disabled, 5.0F).bytes(), moved, 8.0);
    CHECK(generator.parts().turned(8.0).empty());
}

TEST_CASE("an articulated part keeps the offsets that its host set, and goes on by its rates") {
    CigiImageGenerator generator(nullptr);
    std::vector<Fix> moved;
    const auto offset_at = [&](double time_s) {
        const auto parts = generator.parts().turned(time_s);
        REQUIRE(parts.size() == 1);
        return parts.front().offset_m;
    };
    const auto move = [&](std::uint8_t flags, float x, float y, float z, double at_s) {
        HostMessage message(ByteOrder::Little, 1);
        message.entity(0, 0.0, 0.0, 500.0);
        message.begin(6, 32).set(4, std::uint8_t{3}).set(5, flags);
        message.set(8, x).set(12, y).set(16, z);
        generator.take(message.bytes(), moved, at_s);
    };
    move(0x0b, 1.0F, 7.0F, -2.0F, 1.0); // enabled; x and z are set
    CHECK(offset_at(1.0) == glm::dvec3(1.0, 0.0, -2.0));
    move(0x05, 9.0F, 7.0F, 9.0F, 2.0); // y alone
    CHECK(offset_at(2.0) == glm::dvec3(1.0, 7.0, -2.0));
    HostMessage rate(ByteOrder::Big, 2);
    rate.begin(8, 32).set(4, std::uint8_t{3}).set(5, std::uint8_t{1}).set(16, 0.5F);
    generator.take(rate.bytes(), moved, 3.0);
    CHECK(offset_at(5.0) == glm::dvec3(1.0, 7.0, -1.0));
    move(0x05, 0.0F, 1e9F, 0.0F, 6.0); // nothing has such a part
    CHECK(offset_at(5.0) == glm::dvec3(1.0, 7.0, -1.0));
}

TEST_CASE("sides of a frustum that a host does not set stay as they were") {
    CigiImageGenerator generator(nullptr);
    std::vector<Fix> moved;
    const auto define = [&](std::uint8_t flags, float left, float right, std::uint8_t kind) {
        HostMessage message(ByteOrder::Big, 1);
        message.begin(21, 32).set(2, std::uint16_t{4}).set(5, flags).set(6, kind);
        message.set(16, left).set(20, right).set(24, 20.0F).set(28, NAN);
        generator.take(message.bytes(), moved);
    };
    define(0x14, -10.0F, NAN, 0); // left and top
    REQUIRE(generator.definitions().contains(4));
    const CigiViewDefinition& view = generator.definitions().at(4);
    CHECK(view.sets == glm::bvec4(true, false, true, false));
    CHECK(deg_from_rad(view.left_rad) == Approx(-10.0));
    CHECK_FALSE(view.parallel);
    define(0x08, 50.0F, 40.0F, 8); // right; orthographic
    CHECK(view.sets == glm::bvec4(true, true, true, false));
    CHECK(deg_from_rad(view.left_rad) == Approx(-10.0));
    CHECK(deg_from_rad(view.right_rad) == Approx(40.0));
    CHECK(deg_from_rad(view.top_rad) == Approx(20.0));
    CHECK(view.parallel);
    define(0x0c, 50.0F, 45.0F, 0); // turned round: passed over
    CHECK(deg_from_rad(view.left_rad) == Approx(-10.0));
    define(0x20, 0.0F, 0.0F, 0); // a bottom that is no number: passed over
    CHECK(view.sets == glm::bvec4(true, true, true, false));
}

TEST_CASE("parts of entities that are not there are passed over, and go with their entity") {
    CigiImageGenerator generator(nullptr);
    std::vector<Fix> moved;
    HostMessage alone(ByteOrder::Big, 1);
    alone.begin(6, 32).set(5, with_yaw);
    generator.take(alone.bytes(), moved);
    CHECK(generator.parts().turned(0.0).empty());
    generator.take(turning(with_yaw, 30.0F).bytes(), moved);
    CHECK(generator.type_of(0) == std::uint16_t{0});
    HostMessage gone(ByteOrder::Big, 2);
    gone.entity(0, 0.0, 0.0, 500.0).set(4, std::uint8_t{2});
    generator.take(gone.bytes(), moved);
    CHECK(generator.parts().turned(0.0).empty());
    CHECK_FALSE(generator.type_of(0));
}

TEST_CASE("parts are bounded") {
    CigiArticulatedParts parts;
    for (int i = 0; i < 3000; ++i) {
        CigiArticulatedPart part;
        part.entity = static_cast<std::uint16_t>(i / 256);
        part.part = static_cast<std::uint8_t>(i % 256);
        part.enabled = true;
        parts.take(part, 0.0);
    }
    CHECK(parts.turned(0.0).size() == CigiArticulatedParts::max_parts);
}

TEST_CASE("a view control of a group is one of each view that is in it") {
    CigiImageGenerator generator(nullptr);
    std::vector<Fix> moved;
    HostMessage message(ByteOrder::Little, 1);
    for (const std::uint16_t view : {std::uint16_t{2}, std::uint16_t{5}, std::uint16_t{7}}) {
        message.begin(21, 32)
            .set(2, view)
            .set(4, static_cast<std::uint8_t>(view == 7 ? 0 : 4))
            .set(16, -20.0F)
            .set(20, 20.0F)
            .set(24, 15.0F)
            .set(28, -15.0F);
    }
    message.begin(16, 32).set(4, std::uint8_t{4}).set(5, std::uint8_t{0x3f}).set(8, 12.0F);
    generator.take(message.bytes(), moved);
    REQUIRE(generator.views().size() == 2);
    CHECK(generator.views().at(2).offset_m.x == Approx(12.0));
    CHECK(generator.views().at(5).offset_m.x == Approx(12.0));
    CHECK(generator.definitions().size() == 3);
}
