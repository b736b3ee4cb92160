// Layouts of packets here are written by hand from Laminar Research's description, not by ours.

#include "sim/base/units.h"
#include "sim/links/xplane.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace octant;
using namespace octant::sim::links;

namespace {

using Row = std::pair<std::int32_t, std::vector<float>>;

std::vector<std::byte> packet(std::string_view head, const std::vector<Row>& rows) {
    WireWriter writer(ByteOrder::Little);
    for (const char letter : head) { writer.add(letter); }
    for (const auto& [number, values] : rows) {
        writer.add(number);
        for (const float value : values) { writer.add(value); }
    }
    return writer.take();
}

Row group(std::int32_t number, std::vector<float> values) {
    values.resize(8, -999.0F);
    return {number, std::move(values)};
}

/// 1,500 m (4,921.26 ft) up at 47.25 N, 8.5 E, 2,000 ft above ground.
const Row place = group(20, {47.25F, 8.5F, 4921.26F, 2000.0F, 0.0F, 4921.0F, 47.0F, 8.0F});
/// Pitch 5, roll -20, heading 90 true and 88 magnetic.
const Row angles = group(17, {5.0F, -20.0F, 90.0F, 88.0F});
/// 100 m/s east, 3 m/s up, 4 m/s south.
const Row local = group(21, {1000.0F, 200.0F, -50.0F, 100.0F, 3.0F, 4.0F, 0.0F, 0.0F});

std::optional<Fix> fix_of(XPlanePose& pose, Bytes bytes) {
    std::optional<Fix> fix;
    pose.take(bytes, fix);
    return fix;
}

} // namespace

TEST_CASE("groups of DATA say where an aircraft is, how it is turned and how it moves") {
    for (const std::string_view head : {"DATA*", "DATA@", "DATA "}) {
        XPlanePose pose;
        const auto fix = fix_of(pose, packet(head, {angles, place, local}));
        REQUIRE(fix);
        CHECK(fix->latitude_deg == Approx(47.25));
        CHECK(fix->longitude_deg == Approx(8.5));
        CHECK(fix->altitude_m == Approx(1500.0).margin(1e-3));
        CHECK(*fix->above_ground_m == Approx(609.6));
        CHECK(fix->attitude.pitch_rad == Approx(rad_from_deg(5.0)));
        CHECK(fix->attitude.roll_rad == Approx(rad_from_deg(-20.0)));
        CHECK(fix->attitude.heading_rad == Approx(rad_from_deg(90.0)));
        CHECK(*fix->velocity_ned_mps == glm::dvec3(-4.0, 100.0, -3.0));
        CHECK_FALSE(fix->sent_s);
    }
}

TEST_CASE("groups that come in packets of their own are put together") {
    XPlanePose pose;
    std::optional<Fix> fix;
    CHECK(pose.take(packet("DATA*", {angles}), fix).fault == PacketError::Unused);
    CHECK(pose.take(packet("DATA*", {local}), fix).fault == PacketError::Unused);
    CHECK_FALSE(fix);
    CHECK(pose.take(packet("DATA*", {place}), fix).fault == PacketError::None);
    REQUIRE(fix);
    CHECK(fix->velocity_ned_mps->y == 100.0);
    CHECK(fix->attitude.pitch_rad == Approx(rad_from_deg(5.0)));
    fix = fix_of(pose, packet("DATA*", {place}));
    REQUIRE(fix);
    CHECK_FALSE(fix->velocity_ned_mps); // the older one may be wrong by now
    CHECK(fix->attitude.pitch_rad == Approx(rad_from_deg(5.0)));
}

TEST_CASE("without group 21 speed and path say the velocity") {
    XPlanePose pose;
    // 194.384 kt over the ground are 100 m/s; path 30 degrees from north, 10 up.
    const auto fix = fix_of(pose,
        packet("DATA*", {group(3, {180.0F, 180.0F, 200.0F, 194.384F}), group(18, {3.0F, 0.5F, 30.0F, 10.0F}), place}));
    REQUIRE(fix);
    CHECK(fix->velocity_ned_mps->x == Approx(86.603).margin(1e-2));
    CHECK(fix->velocity_ned_mps->y == Approx(50.0).margin(1e-2));
    CHECK(fix->velocity_ned_mps->z == Approx(-17.633).margin(1e-2));
}

TEST_CASE("the clock of group 1 counts while it runs") {
    XPlanePose pose;
    const auto at = [&](float time_s) {
        const auto fix = fix_of(pose, packet("DATA*", {group(1, {9.0F, 9.0F, time_s, 9.0F}), place}));
        REQUIRE(fix);
        return fix->sent_s;
    };
    CHECK_FALSE(at(5.0F));
    CHECK(at(5.5F) == 5.5);
    CHECK_FALSE(at(5.5F));
    CHECK_FALSE(at(1.0F));
    // In single precision 8192 and the number after it are 0.98 ms apart.
    CHECK_FALSE(at(20000.0F));
    CHECK_FALSE(at(8191.0F));
    CHECK(at(8191.5F) == 8191.5);
    CHECK_FALSE(at(8192.0F));
}

TEST_CASE("what an X-Plane is asked for, it is believed in its answers") {
    const auto requests = xplane_requests(60);
    REQUIRE(requests.size() == 17);
    std::vector<std::pair<std::int32_t, std::string>> asked;
    for (const auto& request : requests) {
        REQUIRE(request.size() == 413); // 5 + 4 + 4 + 400
        const WireReader reader(request, ByteOrder::Little);
        CHECK(reader.at<char>(0) == 'R');
        CHECK(reader.at<char>(3) == 'F');
        CHECK(reader.at<char>(4) == '\0');
        CHECK(reader.at<std::int32_t>(5) == 60);
        std::string name;
        for (std::size_t at = 13; reader.at<char>(at) != '\0'; ++at) { name += reader.at<char>(at); }
        asked.emplace_back(reader.at<std::int32_t>(9), name);
    }
    const std::vector<std::pair<std::string, float>> world{{"latitude", 47.25F}, {"longitude", 8.5F},
        {"elevation", 1500.0F}, {"y_agl", 600.0F}, {"true_theta", 5.0F}, {"true_phi", -20.0F}, {"true_psi", 90.0F},
        {"local_x", 10.0F}, {"local_y", 20.0F}, {"local_z", 30.0F}, {"local_vx", 100.0F}, {"local_vy", 3.0F},
        {"local_vz", 4.0F}, {"P", 10.0F}, {"Q", 20.0F}, {"R", 30.0F}};
    std::vector<Row> answers;
    for (const auto& [number, name] : asked) {
        for (const auto& [end, value] : world) {
            if (name == "sim/flightmodel/position/" + end) { answers.push_back({number, {value}}); }
        }
    }
    REQUIRE(answers.size() == world.size());
    for (const std::string_view head : {"RREF,", "RREFO"}) {
        XPlanePose pose;
        const auto fix = fix_of(pose, packet(head, answers));
        REQUIRE(fix);
        CHECK(fix->latitude_deg == Approx(47.25));
        CHECK(fix->altitude_m == 1500.0);
        CHECK(*fix->above_ground_m == 600.0);
        CHECK(fix->attitude.heading_rad == Approx(rad_from_deg(90.0)));
        CHECK(fix->attitude.roll_rad == Approx(rad_from_deg(-20.0)));
        CHECK(*fix->velocity_ned_mps == glm::dvec3(-4.0, 100.0, -3.0));
        CHECK(fix->body_rates_radps->z == Approx(rad_from_deg(30.0)));
    }
    XPlanePose pose;
    std::optional<Fix> fix;
    const DecodeResult result = pose.take(packet("RREF,", {{0, {47.0F}}, {1, {8.0F}}}), fix);
    CHECK(result.fault == PacketError::Unused);
    CHECK(xplane_text(result) ==
          "X-Plane RREF lacks latitude, longitude and elevation under our request numbers; start "
          "listen with --xplane HOST");
}

TEST_CASE("answers that bring a place in parts give no place before all parts are there") {
    XPlanePose pose;
    std::optional<Fix> fix;
    const DecodeResult part = pose.take(packet("RREF,", {{7001, {47.25F}}}), fix);
    CHECK(part.fault == PacketError::Unused);
    CHECK(xplane_text(part) == "X-Plane RREF: a part of the answers; waits for latitude, longitude and elevation");
    CHECK(pose.take(packet("RREF,", {{7002, {8.5F}}, {7011, {100.0F}}}), fix).fault == PacketError::Unused);
    CHECK_FALSE(fix);
    CHECK(pose.take(packet("RREF,", {{7003, {1500.0F}}}), fix).fault == PacketError::None);
    REQUIRE(fix);
    CHECK(fix->latitude_deg == Approx(47.25));
    CHECK(fix->longitude_deg == Approx(8.5));
    CHECK(fix->altitude_m == Approx(1500.0));
    CHECK_FALSE(fix->velocity_ned_mps); // one component of three
}

TEST_CASE("local metres smooth places of single precision") {
    // 60 m/s north at 50 Hz: 1.2 m a packet, while latitudes come in steps of 0.42 m.
    constexpr double m_per_degree = 111177.0;
    const auto roughness = [&](bool with_local) {
        XPlanePose pose;
        double before_deg = 0.0;
        double worst_m = 0.0;
        for (int i = 0; i < 500; ++i) {
            const double north_m = 1.2 * i;
            const Row here = group(20, {static_cast<float>(47.25 + north_m / m_per_degree), 8.5F, 4921.26F, 2000.0F});
            const Row metres = group(21, {500.0F, 200.0F, static_cast<float>(-north_m), 0.0F, 0.0F, -60.0F});
            std::vector<Row> rows{here};
            if (with_local) { rows.push_back(metres); }
            const auto fix = fix_of(pose, packet("DATA*", rows));
            REQUIRE(fix);
            CHECK(std::abs(fix->latitude_deg - 47.25 - north_m / m_per_degree) < 5e-6);
            if (i > 0) {
                const double step_m = m_per_degree * (fix->latitude_deg - before_deg);
                worst_m = std::max(worst_m, std::abs(step_m - 1.2));
            }
            before_deg = fix->latitude_deg;
        }
        return worst_m;
    };
    CHECK(roughness(false) > 0.2);
    CHECK(roughness(true) < 0.03);
}

TEST_CASE("a jump of the place or of the local axes is followed at once") {
    XPlanePose pose;
    fix_of(pose, packet("DATA*", {place, local}));
    const Row moved = group(21, {-40000.0F, 200.0F, 9000.0F, 100.0F, 3.0F, 4.0F, 0.0F, 0.0F});
    auto fix = fix_of(pose, packet("DATA*", {place, moved})); // X-Plane shifts its local axes
    REQUIRE(fix);
    CHECK(fix->longitude_deg == Approx(8.5));
    const Row elsewhere = group(20, {-33.9F, 151.2F, 100.0F, 100.0F});
    fix = fix_of(pose, packet("DATA*", {elsewhere, moved}));
    REQUIRE(fix);
    CHECK(fix->longitude_deg == Approx(151.2));
}

TEST_CASE("what is wrong with a packet of X-Plane is said") {
    XPlanePose pose;
    std::optional<Fix> fix;
    const auto said = [&](Bytes bytes) { return xplane_text(pose.take(bytes, fix)); };
    auto cut = packet("DATA*", {place});
    cut.pop_back();
    CHECK(said(cut) == "X-Plane DATA: expected 5 bytes and 36 for each group, got 40");
    CHECK(said(packet("DATA*", {})) == "X-Plane DATA: expected 5 bytes and 36 for each group, got 5");
    CHECK(said(packet("RREF,", {{1, {}}})) == "X-Plane RREF: expected 5 bytes and 8 for each answer, got 9");
    CHECK(said(packet("DATA*", {group(20, {std::nanf(""), 8.0F, 0.0F, 0.0F})})) ==
          "X-Plane DATA: expected numbers, got one that is none");
    CHECK(said(packet("DATA*", {group(20, {100.0F, 8.0F, 0.0F, 0.0F})})) ==
          "X-Plane DATA: expected an aircraft near the earth, got none");
    CHECK(said(packet("BECN", {})) == "expected X-Plane DATA or RREF, got 4 bytes of something else");
    CHECK_FALSE(fix);
    CHECK(said(packet("DATA*", {place})) == "X-Plane DATA: fine");
}

TEST_CASE("a packet that is sent is X-Plane's, and comes back as it was") {
    Fix sent;
    sent.latitude_deg = 47.5;
    sent.longitude_deg = 8.25;
    sent.altitude_m = 1524.0;
    sent.above_ground_m = 304.8;
    sent.attitude = {rad_from_deg(45.0), rad_from_deg(3.0), rad_from_deg(-7.0)};
    sent.velocity_ned_mps = glm::dvec3(60.0, 80.0, -5.0);
    const Geodetic origin{rad_from_deg(47.49), rad_from_deg(8.25), 1524.0};
    const auto bytes = encode_xplane(sent, origin, 2.5);
    REQUIRE(bytes.size() == 5 + 6 * 36);
    const WireReader reader(bytes, ByteOrder::Little);
    CHECK(reader.at<char>(4) == '*');
    const auto value = [&](std::size_t row, std::size_t number) {
        return static_cast<double>(reader.at<float>(5 + 36 * row + 4 + 4 * number));
    };
    const std::array<std::int32_t, 6> groups{1, 3, 17, 18, 20, 21};
    for (std::size_t row = 0; row < groups.size(); ++row) {
        CHECK(reader.at<std::int32_t>(5 + 36 * row) == groups[row]);
    }
    CHECK(value(1, 3) == Approx(194.384).margin(1e-2)); // kt over the ground
    CHECK(value(2, 2) == Approx(45.0));
    CHECK(value(3, 2) == Approx(53.1301).margin(1e-3)); // path from north
    CHECK(value(3, 3) == Approx(2.8624).margin(1e-3));  // and up
    CHECK(value(4, 2) == Approx(5000.0));               // ft above the sea
    CHECK(value(4, 3) == Approx(1000.0));
    CHECK(value(5, 2) == Approx(-1111.8).margin(1.0)); // 0.01 degrees north of the origin: z is south
    CHECK(value(5, 3) == Approx(80.0));
    CHECK(value(5, 5) == Approx(-60.0));
    XPlanePose pose;
    const auto fix = fix_of(pose, bytes);
    REQUIRE(fix);
    CHECK(fix->latitude_deg == Approx(47.5));
    CHECK(fix->attitude.roll_rad == Approx(rad_from_deg(-7.0)));
    CHECK(glm::distance(*fix->velocity_ned_mps, *sent.velocity_ned_mps) < 1e-4);
}
