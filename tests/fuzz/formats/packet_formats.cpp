// Packets of live links, and files of them.
#include "sim/base/text_file.h"
#include "sim/links/cigi_host.h"
#include "sim/links/cigi_image_generator.h"
#include "sim/links/dis_entity.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/line_input.h"
#include "sim/links/live_traffic.h"
#include "sim/links/mavlink.h"
#include "sim/links/named_columns.h"
#include "sim/links/packet_kind.h"
#include "sim/links/wire_bytes.h"
#include "sim/links/xplane.h"
#include "tests/fuzz/formats/target.h"
#include "tests/sim/links/mavlink_frames.h"
#include "ui/flight/packet_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace octant::tests::formats {

namespace {

namespace links = sim::links;

std::string text_of(std::span<const std::byte> packet) {
    return {reinterpret_cast<const char*>(packet.data()), packet.size()}; // NOLINT
}

void expect_plausible(const links::Fix& fix) {
    expect(links::error_of_fix(fix) == links::PacketError::None, "a fix that can be believed");
}

/// Decoding a packet is cheap: more of them are tried than files.
constexpr std::uint64_t packet_mutations = 50'000;

links::Fix some_fix() {
    links::Fix fix;
    fix.latitude_deg = 47.0;
    fix.altitude_m = 1000.0;
    return fix;
}

namespace cigi {

void decode(std::span<const std::byte> packet) {
    links::start_of_frame_of(packet);
    links::CigiImageGenerator generator(nullptr);
    std::vector<links::Fix> moved;
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
        generator.take(packet, moved, frame);
        std::ranges::for_each(moved, expect_plausible);
        expect(generator.parts().turned(frame).size() <= links::CigiArticulatedParts::max_parts, "bounded parts");
        for (const auto& [number, view] : generator.definitions()) {
            for (const double side_rad : {view.left_rad, view.right_rad, view.top_rad, view.bottom_rad}) {
                expect(std::abs(side_rad) < 1.5, "a side ahead");
            }
        }
        const auto answer = generator.message_for(frame, 1.0);
        expect(answer.size() <= links::CigiImageGenerator::max_message_bytes, "a message that fits");
    }
}

std::vector<std::string> seeds() {
    std::vector<std::string> all;
    for (const links::ByteOrder order : {links::ByteOrder::Big, links::ByteOrder::Little}) {
        links::WireWriter message(order);
        message.add(std::uint8_t{1});
        message.add(std::uint8_t{24});
        message.add(std::uint8_t{3});
        message.add_zeros(3);
        message.add(std::uint16_t{0x8000});
        message.add_zeros(16);
        for (const auto& [opcode, bytes] : {std::pair(2, 48), {3, 24}, {6, 32}, {8, 32}, {9, 16}, {10, 32}, {16, 32},
                 {21, 32}, {24, 32}, {25, 64}, {26, 56}, {27, 8}}) {
            message.add(static_cast<std::uint8_t>(opcode));
            message.add(static_cast<std::uint8_t>(bytes));
            message.add_zeros(static_cast<std::size_t>(bytes) - 2);
        }
        all.push_back(text_of(message.bytes()));
        links::WireWriter begin(order);
        begin.add_zeros(24);
        begin.set(0, std::uint8_t{101});
        begin.set(1, std::uint8_t{24});
        begin.set(2, std::uint8_t{3});
        begin.set(6, std::uint16_t{0x8000});
        all.push_back(text_of(begin.bytes()));
    }
    return all;
}

const Registered target({.name = "cigi", .decode = decode, .seeds = seeds, .mutations = packet_mutations});

} // namespace cigi

namespace dis {

void decode(std::span<const std::byte> packet) {
    links::DisEntity entity;
    const links::DecodeResult result = links::decode_dis(packet, entity);
    expect(!links::dis_text(result).empty(), "words for every result");
    if (result.fault == links::PacketError::None) { expect_plausible(entity.fix); }
}

std::vector<std::string> seeds() {
    links::DisEntity entity;
    entity.reckoning = links::DeadReckoning::Rvw;
    entity.fix = some_fix();
    return {text_of(links::encode_dis(entity, 12.0))};
}

const Registered target({.name = "dis", .decode = decode, .seeds = seeds, .mutations = packet_mutations});

} // namespace dis

namespace fdm {

void decode(std::span<const std::byte> packet) {
    links::Fix fix;
    const links::DecodeResult result = links::decode_fdm(packet, fix);
    expect(!links::fdm_text(result).empty(), "words for every result");
    if (result.fault == links::PacketError::None) { expect_plausible(fix); }
}

std::vector<std::string> seeds() {
    const std::string version_24 = text_of(links::encode_fdm(some_fix()));
    std::string version_25 = version_24;
    version_25[3] = 25;
    version_25.resize(links::fdm_25_bytes);
    return {version_24, version_25};
}

const Registered target({.name = "fdm", .decode = decode, .seeds = seeds, .mutations = packet_mutations});

} // namespace fdm

namespace lines {

void decode(std::span<const std::byte> packet) {
    links::NamedColumns columns;
    links::LineSplitter splitter;
    const auto take = [&columns](const std::vector<std::byte>& line) {
        links::Fix fix;
        const links::DecodeResult result = columns.take(line, fix);
        expect(!links::NamedColumns::text_of(result).empty(), "words for every result");
        if (result.fault == links::PacketError::None) { expect_plausible(fix); }
    };
    splitter.add(packet, take);
    splitter.finish(take);
}

std::vector<std::string> seeds() {
    return {"t_s,lat_deg,lon_deg,alt_m,yaw_deg\n0,47,8,1000,90\n0.1,47.001,8,1000,90\n",
        "id\tnorth_m\teast_m\talt_m\r\n1\t10\t20\t30\r\n2\t-1e3\t+4\t.5\n"};
}

const Registered target({.name = "lines", .decode = decode, .seeds = seeds, .mutations = packet_mutations});

} // namespace lines

namespace mavlink {

void decode(std::span<const std::byte> packet) {
    links::MavLinkPose pose;
    for (links::Bytes rest = packet; !rest.empty();) {
        const links::MavLinkParse parse = links::parse_mavlink(rest);
        expect(parse.length > 0 && parse.length <= rest.size(), "a length within the bytes");
        if (parse.frame) {
            if (const auto fix = pose.take(*parse.frame)) { expect_plausible(*fix); }
        }
        rest = rest.subspan(parse.length);
    }
}

std::vector<std::string> seeds() {
    std::vector<std::string> all;
    std::string joined;
    for (const auto& [kind, length] :
        {std::pair(links::MavLinkKind::Attitude, 28), std::pair(links::MavLinkKind::GlobalPositionInt, 28),
            std::pair(links::MavLinkKind::HilStateQuaternion, 64)}) {
        links::MavLinkFrame frame{kind, 1, {}};
        frame.payload.resize(static_cast<std::size_t>(length), std::byte{0x11});
        all.push_back(text_of(tests::encode_mavlink(frame, 1)));
        joined += all.back();
    }
    all.push_back(joined);
    return all;
}

const Registered target({.name = "mavlink", .decode = decode, .seeds = seeds, .mutations = packet_mutations});

} // namespace mavlink

namespace xplane {

void decode(std::span<const std::byte> packet) {
    links::XPlanePose pose;
    for (int i = 0; i < 3; ++i) {
        std::optional<links::Fix> fix;
        const links::DecodeResult result = pose.take(packet, fix);
        expect(!links::xplane_text(result).empty(), "words for every result");
        if (fix) { expect_plausible(*fix); }
    }
    if (const auto kind = links::packet_kind(packet)) {
        expect(!links::text_of(*kind).empty(), "words for every kind");
    }
}

std::vector<std::string> seeds() {
    return {text_of(links::xplane_requests(60).front()),
        text_of(links::encode_xplane(some_fix(), {0.82, 0.0, 1000.0}, 1.0))};
}

const Registered target({.name = "xplane", .decode = decode, .seeds = seeds, .mutations = packet_mutations});

} // namespace xplane

namespace datagrams {

std::string seed_of(int packets) {
    std::string all;
    for (int i = 0; i < packets; ++i) {
        links::Fix fix;
        fix.latitude_deg = 47.25 + 1e-4 * i;
        fix.longitude_deg = -122.5;
        fix.altitude_m = 1234.5;
        fix.attitude = {1.25, 0.1, -0.4};
        fix.velocity_ned_mps = glm::dvec3(100.0, -50.0, 5.0);
        fix.ticks = 50U * static_cast<std::uint32_t>(i);
        const auto bytes = links::encode_fdm(fix);
        all.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    return all;
}

/// A file is packets of one size, 20 a second, the last one perhaps cut. Packets never throw, and whatever they say,
/// what is shown is finite.
void use(const std::filesystem::path& file) {
    const std::string bytes = read_file(file);
    links::LiveTraffic traffic([](const auto& /*key*/, const links::Fix& fix) {
        return links::WorldPosition{
            .at_m = 111000.0 * glm::dvec3(fix.longitude_deg, fix.latitude_deg, fix.altitude_m / 111000.0)};
    });
    std::array<sim::AircraftState, 4> states;
    double now_s = 0.0;
    for (std::size_t at = 0; at < bytes.size(); at += links::fdm_24_bytes) {
        links::Datagram packet;
        packet.arrival_s = now_s;
        const auto piece = std::as_bytes(std::span(bytes)).subspan(at);
        const auto own = piece.first(std::min(piece.size(), links::fdm_24_bytes));
        packet.bytes.assign(own.begin(), own.end());
        traffic.take(packet);
        now_s += 0.05;
        const std::size_t shown = traffic.show(now_s, 0.1, states);
        for (const sim::AircraftState& state : std::span(states).first(shown)) {
            for (int part = 0; part < 3; ++part) {
                expect(std::isfinite(state.position_m[part]), "a place");
                expect(std::isfinite(state.velocity_mps[part]), "a velocity");
            }
            expect(std::abs(glm::length(state.body_to_world) - 1.0) < 1e-6, "a unit attitude");
        }
    }
    traffic.lines();
}

const Registered target({
    .name = "datagrams",
    .file = "packets",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{seed_of(1), seed_of(6), std::string(552, 'U')};
        },
});

} // namespace datagrams

namespace packets {

void add_text(links::WireWriter& record, std::uint8_t kind, std::string_view text) {
    record.add(kind);
    record.add(static_cast<std::uint32_t>(text.size()));
    for (const char letter : text) { record.add(static_cast<std::uint8_t>(letter)); }
}

/// Two pictures: a packet and words for the first, a time of day for the second.
std::string seed() {
    links::WireWriter record(links::ByteOrder::Big);
    record.add(std::uint8_t{1});
    record.add(std::uint8_t{0});
    record.add(std::uint32_t{0x7f000001});
    record.add(std::uint16_t{5550});
    record.add(0.25);
    record.add(std::uint32_t{8});
    record.add_zeros(8);
    add_text(record, 2, "waits\nfor packets");
    record.add(std::uint8_t{3});
    record.add(0.5);
    add_text(record, 4, "2026-06-21T08:30");
    record.add(std::uint8_t{3});
    record.add(0.75);
    const auto bytes = record.bytes();
    return "octant packets 1 0 usual clock front - 1=0,9=1\n" +
           std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()); // NOLINT
}

void use(const std::filesystem::path& file) {
    const ui::flight::PacketFile read = ui::flight::read_packets(file.parent_path());
    double before_s = -1.0;
    for (const ui::flight::PacketFrame& frame : read.frames) {
        expect(frame.time_s > before_s, "pictures one after the other");
        before_s = frame.time_s;
        for (const links::Datagram& packet : frame.packets) {
            expect(std::isfinite(packet.arrival_s), "a time of arrival");
        }
    }
}

const Registered target({
    .name = "packets",
    .file = "packets.bin",
    .use = use,
    .seeds = [] { return std::vector<std::string>{seed()}; },
    .words = {"octant packets 1 ", " step ", " left ", "\n", "2026-06-21T08:30", "1=0"},
});

} // namespace packets

} // namespace

} // namespace octant::tests::formats
