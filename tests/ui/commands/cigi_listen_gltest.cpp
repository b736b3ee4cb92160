// octant listen as the image generator of a host that is no octant, over real sockets.

#include "sim/base/output_file.h"
#include "sim/base/units.h"
#include "sim/links/cigi_host.h"
#include "sim/links/cigi_packets.h"
#include "sim/links/udp_port.h"
#include "tests/scratch.h"
#include "tests/ui/commands/cigi_bench.h"
#include "tests/ui/commands/command_line.h"
#include "ui/report/frame_csv.h"
#include "ui/report/png_file.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

using namespace octant;
using Catch::Contains;
using tests::CigiBench;
using tests::generate_for;
using tests::StartOfFrame;
using ui::report::FrameRecord;

namespace {

namespace fs = std::filesystem;
namespace links = sim::links;
using Clock = std::chrono::steady_clock;

constexpr std::uint16_t helicopter = 9;
constexpr std::uint16_t jet = 1;

/// From a frustum's middle to its sides.
struct Sides {
    double left_deg = -30.0;
    double right_deg = 30.0;
};

/// What a host of the other byte order says in a frame: entity 0 of that type stands so high over the middle of the map
/// and is seen from behind.
links::WireWriter frame_of(std::uint32_t number, std::uint16_t type, const Sides& sides = {}, double height_m = 700.0) {
    links::WireWriter message(links::ByteOrder::Little);
    links::CigiIgControl control;
    control.mode = links::CigiMode::Operate;
    control.host_frame = number;
    links::add_ig_control(message, control);
    links::CigiEntityControl entity;
    entity.state = 1;
    entity.type = type;
    entity.attitude.heading_rad = 0.5 * pi;
    entity.place = {0.0, 0.0, height_m};
    links::add_entity(message, entity);
    links::CigiViewDefinition frustum;
    frustum.left_rad = rad_from_deg(sides.left_deg);
    frustum.right_rad = rad_from_deg(sides.right_deg);
    frustum.top_rad = rad_from_deg(20.0);
    frustum.bottom_rad = -frustum.top_rad;
    links::add_view_definition(message, frustum);
    links::CigiViewControl view;
    view.offset_m = {-18.0, 0.0, -4.0};
    view.angles.pitch_rad = rad_from_deg(-10.0);
    links::add_view_control(message, view);
    return message;
}

void rotate_part_to_body(links::WireWriter& message, std::uint8_t part, float yaw_deg) {
    const std::size_t at = links::add_cigi_packet_header(message, 6, 32);
    message.set(at + 4, part);
    message.set(at + 5, std::uint8_t{0x71}); // enabled; roll, pitch and yaw are set
    message.set(at + 28, yaw_deg);
}

void set_visibility(links::WireWriter& message, float visibility_m) {
    message.set(links::add_cigi_packet_header(message, 10, 32) + 8, visibility_m);
}

/// Of the longest day, by universal time.
void set_hour(links::WireWriter& message, std::uint8_t hour) {
    const std::size_t at = links::add_cigi_packet_header(message, 9, 16);
    message.set(at + 2, hour);
    message.set(at + 4, std::uint8_t{0x13}); // date and time are valid
    message.set(at + 8, std::uint32_t{6212026});
}

void look_back(links::WireWriter& message) {
    links::CigiViewControl view;
    view.offset_m = {30.0, 0.0, 0.0};
    view.angles.heading_rad = pi;
    links::add_view_control(message, view);
}

} // namespace

TEST_CASE("a CIGI host's entity types, parts, air, time and views are seen") {
    const fs::path folder = tests::empty_folder("cigi-host");
    const fs::path table = folder / "entities.toml";
    write_file(table, "[[entity]]\ntype = 1\naircraft = \"f15\"\n[[entity]]\ntype = 9\naircraft = \"500md\"\n");
    std::vector<links::WireWriter> script;
    const auto next = [&](std::uint16_t type, float rotor_deg) -> links::WireWriter& {
        script.push_back(frame_of(static_cast<std::uint32_t>(script.size() + 1), type));
        rotate_part_to_body(script.back(), 1, rotor_deg);
        rotate_part_to_body(script.back(), 0, 0.0F);
        return script.back();
    };
    next(helicopter, 0.0F);
    next(helicopter, 0.0F); // as before
    next(helicopter, 30.0F);
    set_visibility(next(helicopter, 30.0F), 800.0F);
    set_hour(next(helicopter, 30.0F), 17);
    next(jet, 30.0F);
    look_back(next(jet, 30.0F));
    CigiBench host;
    const tests::ProgramRun run = generate_for(host,
        {"--step", "--vehicles", table.string(), "--size", "240x160", "--pictures", "1", "--frames",
            std::to_string(script.size()), "--record", (folder / "seen").string()},
        [&] {
            CHECK(host.await([](const StartOfFrame&) { return true; }));
            for (std::size_t i = 0; i < script.size(); ++i) {
                host.send(script[i]);
                CHECK(host.await([i](const StartOfFrame& heard) { return heard.host_frame == i + 1; }));
            }
        });
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const std::vector<FrameRecord> rows = ui::report::read_frame_csv(folder / "seen" / "frames.csv").records;
    REQUIRE(rows.size() == script.size());
    CHECK(rows[0].picture_hash == rows[1].picture_hash);
    for (std::size_t i = 2; i < rows.size(); ++i) {
        CAPTURE(i);
        CHECK(rows[i].picture_hash != rows[i - 1].picture_hash);
    }
    const tests::ProgramRun replay = tests::run_octant({"fly", "--replay", (folder / "seen").string()});
    CHECK_THAT(replay.out, Contains("same states, same pictures"));

    const fs::path packets = folder / "seen" / "packets.bin";
    std::string bytes = read_file(packets);
    const std::size_t shapes = bytes.find("1=0,9=1");
    REQUIRE(shapes < bytes.find('\n'));
    bytes.replace(shapes, 7, "1=0,9=2");
    write_file(packets, bytes);
    const tests::ProgramRun wrong = tests::run_octant({"fly", "--replay", (folder / "seen").string()});
    CHECK(wrong.exit_code == 2);
    CHECK_THAT(
        wrong.err, Contains("packets.bin:1: expected entity type 9 to be one of 2 aircraft from 0, got number 2"));
}

TEST_CASE("a frustum beside straight ahead shows that part of the whole picture") {
    const fs::path folder = tests::empty_folder("cigi-frusta");
    constexpr double low_m = 380.0; // 60 m over the hills: there is near detail
    const auto picture_of = [&](const Sides& sides, const std::string& size) {
        const fs::path record = folder / size;
        CigiBench host;
        const tests::ProgramRun run = generate_for(host,
            {"--step", "--terrain", "hills", "--error-px", "1", "--size", size, "--pictures", "1", "--frames", "1",
                "--record", record.string()},
            [&] {
                CHECK(host.await([](const StartOfFrame&) { return true; }));
                host.send(frame_of(1, jet, sides, low_m));
                CHECK(host.await([](const StartOfFrame& heard) { return heard.host_frame == 1; }));
            });
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return ui::report::read_png(record / "picture-00000.png");
    };
    // 20 degrees up and 30 to a side: 960 pixels are as wide as 605.5 high ones; 240 of them are the left quarter.
    const double middle_deg = deg_from_rad(std::atan(0.5 * std::tan(rad_from_deg(30.0))));
    const auto whole = picture_of({-30.0, 30.0}, "960x606");
    const auto part = picture_of({-30.0, -middle_deg}, "240x606");
    const auto centre = picture_of({-middle_deg, middle_deg}, "480x606");
    const auto level = [](const ui::report::Picture& picture, int x, int y, int channel) {
        const int at = (y * picture.width_px + x) * picture.channels + channel;
        return std::to_integer<int>(picture.bytes[static_cast<std::size_t>(at)]);
    };
    const auto different = [&](const ui::report::Picture& small, int first_x) {
        int count = 0;
        for (int i = 0; i < small.width_px * small.height_px; ++i) {
            const int x = i % small.width_px;
            const int y = i / small.width_px;
            bool same = true;
            for (int c = 0; c < 3; ++c) {
                constexpr int most = 6;
                same = same && std::abs(level(small, x, y, c) - level(whole, first_x + x, y, c)) <= most;
            }
            count += same ? 0 : 1;
        }
        return static_cast<double>(count) / (small.width_px * small.height_px);
    };
    CHECK(different(part, 0) < 0.005);
    CHECK(different(centre, 240) < 0.005);
    CHECK(different(part, 360) > 0.1); // elsewhere it is another picture
}

TEST_CASE("an entity table says how many aircraft there are: --vehicles is refused beside it") {
    const fs::path table = tests::empty_folder("cigi-table") / "entities.toml";
    write_file(table, "[[entity]]\ntype = 1\naircraft = \"f15\"\n");
    const tests::ProgramRun run =
        tests::run_octant({"listen", "--headless", "--frames", "1", "--entities", table.string(), "--vehicles", "3"});
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains("--vehicles: expected no --entities beside it"));
}

TEST_CASE("Start of Frame comes at the pictures' rate, and while a host is silent") {
    constexpr double rate_hz = 60.0;
    CigiBench host;
    const tests::ProgramRun run =
        generate_for(host, {"--size", "64x36", "--pictures", "0", "--rate", "60", "--seconds", "8"}, [&] {
            CHECK(host.await([](const StartOfFrame&) { return true; }));
            for (std::uint32_t frame = 1; frame <= 30; ++frame) {
                host.send(frame_of(frame, jet));
                std::this_thread::sleep_for(std::chrono::milliseconds(16));
                host.listen();
            }
            const Clock::time_point end = Clock::now() + std::chrono::milliseconds(5500);
            while (Clock::now() < end) { // Silent.
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
                host.listen();
            }
        });
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const std::vector<StartOfFrame>& heard = host.heard();
    REQUIRE(heard.size() > 60);
    CHECK(heard.back().host_frame == 30);
    int missing = 0;
    for (std::size_t i = 1; i < heard.size(); ++i) {
        missing += static_cast<int>(heard[i].ig_frame - heard[i - 1].ig_frame) - 1;
    }
    CHECK(missing == 0);
    // By the generator's own clock, over those two seconds in which the machine was left to it most.
    constexpr std::size_t some = 120;
    REQUIRE(heard.size() > some);
    double min_wrong = 1.0;
    for (std::size_t i = some; i < heard.size(); ++i) {
        const double passed_s = (heard[i].timestamp - heard[i - some].timestamp) * 1e-5;
        min_wrong = std::min(min_wrong, std::abs(passed_s * rate_hz / some - 1.0));
    }
    CHECK(min_wrong < 0.03);
}
