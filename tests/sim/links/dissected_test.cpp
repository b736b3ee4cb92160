// What is sent, as Wireshark's dissectors read it: code that shares nothing with ours.

#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "sim/links/cigi_host.h"
#include "sim/links/dis_entity.h"
#include "tests/scratch.h"
#include "tests/sim/links/cigi_samples.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

using namespace octant;
using namespace octant::sim::links;

namespace {

namespace fs = std::filesystem;

bool has_tshark() {
    return std::system("command -v tshark >/dev/null 2>&1") == 0; // NOLINT
}

/// A capture file with one UDP datagram from and to a port, as raw IPv4.
std::string capture_of(Bytes datagram, std::uint16_t port) {
    const auto udp_bytes = static_cast<std::uint16_t>(8 + datagram.size());
    const auto ip_bytes = static_cast<std::uint16_t>(20 + udp_bytes);
    WireWriter file(ByteOrder::Big);
    file.add(std::uint32_t{0xa1b2c3d4});
    file.add(std::uint32_t{0x00020004});
    file.add_zeros(8);
    file.add(std::uint32_t{65535});
    file.add(std::uint32_t{101}); // raw IP
    file.add_zeros(8);
    file.add(std::uint32_t{ip_bytes});
    file.add(std::uint32_t{ip_bytes});
    file.add(std::uint16_t{0x4500});
    file.add(ip_bytes);
    file.add_zeros(4);
    file.add(std::uint16_t{0x4011}); // time to live, UDP
    file.add_zeros(2);
    file.add(std::uint32_t{0x7f000001});
    file.add(std::uint32_t{0x7f000001});
    file.add(port);
    file.add(port);
    file.add(udp_bytes);
    file.add_zeros(2);
    std::string text(reinterpret_cast<const char*>(file.bytes().data()), file.size()); // NOLINT
    text.append(reinterpret_cast<const char*>(datagram.data()), datagram.size());      // NOLINT
    return text;
}

/// What the dissector gives for these fields, in their order.
std::vector<std::string> dissected(
    Bytes datagram, std::uint16_t port, const std::string& protocol, const std::vector<std::string>& fields) {
    const fs::path file = tests::scratch_folder() / fmt::format("dissected-{}.pcap", protocol);
    write_file(file, capture_of(datagram, port));
    const std::string command =
        fmt::format("tshark -r '{}' -d udp.port=={},{} -T fields -E separator=';' -E occurrence=a -e {} "
                    "2>/dev/null",
            file.string(), port, protocol, fmt::join(fields, " -e "));
    std::string out;
    FILE* const pipe = popen(command.c_str(), "r"); // NOLINT
    REQUIRE(pipe != nullptr);
    std::array<char, 4096> piece{};
    while (std::fgets(piece.data(), static_cast<int>(piece.size()), pipe) != nullptr) { out += piece.data(); }
    REQUIRE(pclose(pipe) == 0);
    fs::remove(file);
    if (!out.empty() && out.back() == '\n') { out.pop_back(); }
    std::vector<std::string> values;
    for (const std::string_view field : split_fields(out, ';')) { values.emplace_back(field); }
    REQUIRE(values.size() == fields.size());
    return values;
}

double number(const std::string& text) {
    INFO(text);
    const auto value = finite_number(text);
    REQUIRE(value.has_value());
    return *value;
}

} // namespace

TEST_CASE("Wireshark reads CIGI answers as they are meant") {
    if (!has_tshark()) {
        std::cout << "SKIPPED: tshark is not installed\n";
        return;
    }
    WireWriter message(ByteOrder::Big);
    add_start_of_frame(message, {77, 1234, 250000, CigiMode::Operate, 5});
    const CigiResponseHeader head{11, true, 9};
    const CigiSurfacePoint surface{{47.5, 8.25, 600.25}, rad_from_deg(123.0), rad_from_deg(80.0)};
    add_height_response(message, head, CigiHeightKind::Hot, 600.25);
    add_extended_height_response(message, {12, true, 9}, 400.5, surface);
    add_los_response(message, {13, true, 9}, false, {true, 1500.5, {}});
    add_los_response(message, {14, true, 9}, true, {false, 2500.5, surface});
    add_position(message, 42, {47.5, 8.25, 700.0}, {rad_from_deg(90.0), 0.0, rad_from_deg(-10.0)});

    const auto sof = dissected(message.bytes(), 8005, "cigi",
        {"cigi.sof.ig_frame_number", "cigi.sof.last_host_frame_number", "cigi.sof.db_number", "cigi.sof.minor_version",
            "cigi.sof.ig_mode"});
    CHECK(number(sof[0]) == 77);
    CHECK(number(sof[1]) == 1234);
    CHECK(number(sof[2]) == 5);
    CHECK(number(sof[3]) == 3);
    CHECK(number(sof[4]) == 1);

    const auto heights = dissected(message.bytes(), 8005, "cigi",
        {"cigi.hat_hot_response.hat_hot_id", "cigi.hat_hot_response.height",
            "cigi.hat_hot_response.host_frame_number_lsn", "cigi.hat_hot_ext_response.hat",
            "cigi.hat_hot_ext_response.hot", "cigi.hat_hot_ext_response.normal_vector_azimuth",
            "cigi.hat_hot_ext_response.normal_vector_elevation"});
    CHECK(number(heights[0]) == 11);
    CHECK(number(heights[1]) == 600.25);
    CHECK(number(heights[2]) == 9);
    CHECK(number(heights[3]) == 400.5);
    CHECK(number(heights[4]) == 600.25);
    CHECK(number(heights[5]) == Approx(123.0));
    CHECK(number(heights[6]) == Approx(80.0));

    const auto sights = dissected(message.bytes(), 8005, "cigi",
        {"cigi.los_response.los_id", "cigi.los_response.range", "cigi.3_2_los_ext_response.los_id",
            "cigi.3_2_los_ext_response.range", "cigi.3_2_los_ext_response.lat_xoff",
            "cigi.3_2_los_ext_response.alt_zoff", "cigi.3_2_los_ext_response.host_frame_number_lsn",
            "cigi.pos_response.object_id", "cigi.pos_response.alt_zoff", "cigi.pos_response.roll",
            "cigi.pos_response.yaw"});
    CHECK(number(sights[0]) == 13);
    CHECK(number(sights[1]) == 1500.5);
    CHECK(number(sights[2]) == 14);
    CHECK(number(sights[3]) == 2500.5);
    CHECK(number(sights[4]) == 47.5);
    CHECK(number(sights[5]) == 600.25);
    CHECK(number(sights[6]) == 9);
    CHECK(number(sights[7]) == 42);
    CHECK(number(sights[8]) == 700.0);
    CHECK(number(sights[9]) == Approx(-10.0));
    CHECK(number(sights[10]) == Approx(90.0));
}

TEST_CASE("Wireshark reads what a CIGI host sends as it is meant, in both byte orders") {
    if (!has_tshark()) {
        std::cout << "SKIPPED: tshark is not installed\n";
        return;
    }
    for (const ByteOrder order : {ByteOrder::Big, ByteOrder::Little}) {
        WireWriter message(order);
        test::HostScene().add_to(message, {2, CigiMode::Operate, true, 4321, 250000, 99});
        const auto values = dissected(message.bytes(), 8004, "cigi",
            {"cigi.ig_control.host_frame_number", "cigi.ig_control.last_ig_frame_number",
                "cigi.ig_control.minor_version", "cigi.entity_control.entity_id", "cigi.entity_control.entity_type",
                "cigi.entity_control.roll", "cigi.entity_control.pitch", "cigi.entity_control.yaw",
                "cigi.entity_control.lat_xoff", "cigi.entity_control.lon_yoff", "cigi.entity_control.alt_zoff",
                "cigi.view_def.left", "cigi.view_def.right", "cigi.view_def.top", "cigi.view_def.bottom",
                "cigi.view_control.entity_id", "cigi.view_control.xoff", "cigi.view_control.zoff",
                "cigi.view_control.yaw", "cigi.view_control.pitch"});
        const std::vector<double> meant{4321, 99, 3, 3, 12, -30.0, 5.0, 275.0, 47.25, -8.5, 1234.5, -31.0, 32.0, 20.0,
            -21.0, 3, -40.5, -8.0, 10.0, -12.0};
        for (std::size_t i = 0; i < meant.size(); ++i) {
            CAPTURE(i);
            CHECK(number(values[i]) == Approx(meant[i]));
        }
    }
}

TEST_CASE("Wireshark reads DIS entity states as they are meant") {
    if (!has_tshark()) {
        std::cout << "SKIPPED: tshark is not installed\n";
        return;
    }
    DisEntity entity;
    entity.site = 1;
    entity.application = 2;
    entity.entity = 3;
    entity.reckoning = DeadReckoning::Fpw;
    entity.fix.latitude_deg = 45.0;
    entity.fix.velocity_ned_mps = glm::dvec3(0.0, 100.0, 0.0);
    const auto values = dissected(encode_dis(entity, 1800.0), 3000, "dis",
        {"dis.entity_id_site", "dis.entity_id_application", "dis.entity_id_entity", "dis.entity_location.x",
            "dis.entity_location.z", "dis.entity_linear_velocity.y"});
    CHECK(number(values[0]) == 1);
    CHECK(number(values[1]) == 2);
    CHECK(number(values[2]) == 3);
    CHECK(number(values[3]) == Approx(4517590.8788));
    CHECK(number(values[4]) == Approx(4487348.4088));
    CHECK(number(values[5]) == Approx(100.0));
}
