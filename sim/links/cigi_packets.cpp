// Layouts: CIGI 3.3 interface control document (SISO, 2008); each was checked against Wireshark's dissector.
#include "sim/links/cigi_packets.h"

#include "sim/base/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace octant::sim::links {

namespace {

constexpr std::uint8_t ig_control = 1;
constexpr std::size_t ig_control_bytes = 24;
constexpr std::size_t magic_at = 6;
constexpr std::size_t header_bytes = 2;

double rad_at(const WireReader& reader, std::size_t at) {
    return rad_from_deg(static_cast<double>(reader.at<float>(at)));
}

glm::dvec3 doubles(const WireReader& reader, std::size_t at) {
    return {reader.at<double>(at), reader.at<double>(at + 8), reader.at<double>(at + 16)};
}

/// Roll, pitch and yaw in degrees.
EulerAngles angles_at(const WireReader& reader, std::size_t at) {
    return {rad_at(reader, at + 8), rad_at(reader, at + 4), rad_at(reader, at)};
}

unsigned bits(const WireReader& reader, std::size_t at, unsigned first, unsigned count) {
    return static_cast<unsigned>(reader.at<std::uint8_t>(at)) >> first & ((1U << count) - 1U);
}

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool finite(const EulerAngles& angles) {
    return finite(glm::dvec3(angles.heading_rad, angles.pitch_rad, angles.roll_rad));
}

bool within(const glm::dvec3& v, double most) {
    return finite(v) && std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= most;
}

constexpr double furthest_m = 1e6;
constexpr double furthest_part_m = 1000.0;
constexpr double fastest_mps = 20000.0;
constexpr double fastest_turn_radps = 100.0;

using Read = std::optional<CigiPacket> (*)(const WireReader&);

std::optional<CigiPacket> read_ig_control(const WireReader& reader) {
    CigiIgControl control;
    control.database = reader.at<std::int8_t>(3);
    control.mode = static_cast<CigiMode>(std::min(bits(reader, 4, 0, 2), 2U));
    control.timestamp_valid = bits(reader, 4, 2, 1) != 0;
    control.host_frame = reader.at<std::uint32_t>(8);
    control.timestamp = reader.at<std::uint32_t>(12);
    control.last_ig_frame = reader.at<std::uint32_t>(16);
    return control;
}

std::optional<CigiPacket> read_entity(const WireReader& reader) {
    CigiEntityControl entity;
    entity.entity = reader.at<std::uint16_t>(2);
    entity.state = static_cast<int>(bits(reader, 4, 0, 2));
    entity.attached = bits(reader, 4, 2, 1) != 0;
    entity.clamp = static_cast<int>(bits(reader, 4, 5, 2));
    entity.type = reader.at<std::uint16_t>(8);
    entity.parent = reader.at<std::uint16_t>(10);
    entity.attitude = angles_at(reader, 12);
    entity.place = doubles(reader, 24);
    return finite(entity.attitude) && finite(entity.place) ? std::optional<CigiPacket>(entity) : std::nullopt;
}

std::optional<CigiPacket> read_clamped(const WireReader& reader) {
    const CigiClampedEntity clamped{
        reader.at<std::uint16_t>(2), rad_at(reader, 4), {reader.at<double>(8), reader.at<double>(16), 0.0}};
    return finite(clamped.place) && std::isfinite(clamped.heading_rad) ? std::optional<CigiPacket>(clamped)
                                                                       : std::nullopt;
}

std::optional<CigiPacket> read_rate(const WireReader& reader) {
    CigiRateControl rate;
    rate.entity = reader.at<std::uint16_t>(2);
    rate.part = reader.at<std::uint8_t>(4);
    rate.of_part = bits(reader, 5, 0, 1) != 0;
    rate.local = bits(reader, 5, 1, 1) != 0;
    rate.mps = reader.floats(8);
    rate.radps = {rad_at(reader, 20), rad_at(reader, 24), rad_at(reader, 28)};
    return within(rate.mps, fastest_mps) && within(rate.radps, fastest_turn_radps) ? std::optional<CigiPacket>(rate)
                                                                                   : std::nullopt;
}

std::optional<CigiPacket> read_part(const WireReader& reader) {
    CigiArticulatedPart part;
    part.entity = reader.at<std::uint16_t>(2);
    part.part = reader.at<std::uint8_t>(4);
    part.enabled = bits(reader, 5, 0, 1) != 0;
    for (unsigned i = 0; i < 3; ++i) {
        constexpr unsigned x = 1;
        constexpr unsigned roll = 4;
        part.moves[static_cast<int>(i)] = bits(reader, 5, x + i, 1) != 0;
        part.sets[static_cast<int>(i)] = bits(reader, 5, roll + i, 1) != 0;
    }
    part.offset_m = reader.floats(8);
    part.angles = angles_at(reader, 20);
    return finite(part.angles) && within(part.offset_m, furthest_part_m) ? std::optional<CigiPacket>(part)
                                                                         : std::nullopt;
}

std::optional<CigiPacket> read_celestial(const WireReader& reader) {
    const CigiCelestial celestial{bits(reader, 4, 4, 1) != 0, reader.at<std::uint8_t>(2), reader.at<std::uint8_t>(3),
        reader.at<std::uint32_t>(8)};
    const bool is_time = celestial.hour < 24 && celestial.minute < 60;
    return is_time ? std::optional<CigiPacket>(celestial) : std::nullopt;
}

std::optional<CigiPacket> read_atmosphere(const WireReader& reader) {
    const auto visibility_m = static_cast<double>(reader.at<float>(8));
    return visibility_m >= 0.0 && visibility_m <= furthest_m
               ? std::optional<CigiPacket>(CigiAtmosphere{bits(reader, 2, 0, 1) != 0, visibility_m})
               : std::nullopt;
}

/// Components that are not enabled are left at zero.
std::optional<CigiPacket> read_view_control(const WireReader& reader) {
    CigiViewControl view;
    view.view = reader.at<std::uint16_t>(2);
    view.group = reader.at<std::uint8_t>(4);
    view.entity = reader.at<std::uint16_t>(6);
    const auto enabled = [&reader](unsigned bit) { return bits(reader, 5, bit, 1) != 0 ? 1.0 : 0.0; };
    const glm::dvec3 offset_m = reader.floats(8);
    const EulerAngles angles = angles_at(reader, 20);
    if (!within(offset_m, furthest_m) || !finite(angles)) { return std::nullopt; }
    view.offset_m = offset_m * glm::dvec3(enabled(0), enabled(1), enabled(2));
    view.angles = {enabled(5) * angles.heading_rad, enabled(4) * angles.pitch_rad, enabled(3) * angles.roll_rad};
    return view;
}

std::optional<CigiPacket> read_view_definition(const WireReader& reader) {
    CigiViewDefinition view;
    view.view = reader.at<std::uint16_t>(2);
    view.group = reader.at<std::uint8_t>(4);
    view.parallel = bits(reader, 6, 3, 1) != 0;
    std::array<double, 4> sides_rad{};
    double max_rad = 0.0;
    for (unsigned i = 0; i < sides_rad.size(); ++i) {
        constexpr unsigned left = 2;
        view.sets[static_cast<int>(i)] = bits(reader, 5, left + i, 1) != 0;
        if (view.sets[static_cast<int>(i)]) {
            sides_rad[i] = rad_at(reader, 16 + 4 * std::size_t{i});
            max_rad = std::isfinite(sides_rad[i]) ? std::max(max_rad, std::abs(sides_rad[i])) : furthest_m;
        }
    }
    view.left_rad = sides_rad[0];
    view.right_rad = sides_rad[1];
    view.top_rad = sides_rad[2];
    view.bottom_rad = sides_rad[3];
    const bool turned_round = (view.sets.x && view.sets.y && view.left_rad >= view.right_rad) ||
                              (view.sets.z && view.sets.w && view.bottom_rad >= view.top_rad);
    constexpr double widest_rad = 1.5;
    return !turned_round && max_rad < widest_rad ? std::optional<CigiPacket>(view) : std::nullopt;
}

std::optional<CigiPacket> read_height_request(const WireReader& reader) {
    CigiHeightRequest request;
    request.id = reader.at<std::uint16_t>(2);
    request.kind = static_cast<CigiHeightKind>(std::min(bits(reader, 4, 0, 2), 2U));
    request.from_entity = bits(reader, 4, 2, 1) != 0;
    request.period = reader.at<std::uint8_t>(5);
    request.entity = reader.at<std::uint16_t>(6);
    request.place = doubles(reader, 8);
    return finite(request.place) ? std::optional<CigiPacket>(request) : std::nullopt;
}

std::optional<CigiPacket> read_sight_segment(const WireReader& reader) {
    CigiLosRequest request;
    request.id = reader.at<std::uint16_t>(2);
    request.extended = bits(reader, 4, 0, 1) != 0;
    request.from_entity = bits(reader, 4, 1, 1) != 0;
    request.to_entity = bits(reader, 4, 2, 1) != 0;
    request.to_is_given = bits(reader, 4, 4, 1) != 0;
    request.entity = reader.at<std::uint16_t>(6);
    request.source = doubles(reader, 8);
    request.destination = doubles(reader, 32);
    request.period = reader.at<std::uint8_t>(60);
    request.to = reader.at<std::uint16_t>(62);
    return finite(request.source) && finite(request.destination) ? std::optional<CigiPacket>(request) : std::nullopt;
}

std::optional<CigiPacket> read_sight_vector(const WireReader& reader) {
    CigiLosRequest request;
    request.is_vector = true;
    request.id = reader.at<std::uint16_t>(2);
    request.extended = bits(reader, 4, 0, 1) != 0;
    request.from_entity = bits(reader, 4, 1, 1) != 0;
    request.entity = reader.at<std::uint16_t>(6);
    request.azimuth_rad = rad_at(reader, 8);
    request.elevation_rad = rad_at(reader, 12);
    request.min_m = static_cast<double>(reader.at<float>(16));
    request.max_m = static_cast<double>(reader.at<float>(20));
    request.source = doubles(reader, 24);
    request.period = reader.at<std::uint8_t>(52);
    return finite(request.source) && std::isfinite(request.azimuth_rad) && std::isfinite(request.elevation_rad) &&
                   std::isfinite(request.min_m) && std::isfinite(request.max_m)
               ? std::optional<CigiPacket>(request)
               : std::nullopt;
}

std::optional<CigiPacket> read_position_request(const WireReader& reader) {
    return CigiPositionRequest{
        reader.at<std::uint16_t>(2), bits(reader, 5, 0, 1) != 0, static_cast<int>(bits(reader, 5, 1, 3))};
}

struct Known {
    std::uint8_t opcode;
    std::size_t size;
    Read read;
};

constexpr std::array<Known, 13> known_packets{{{ig_control, ig_control_bytes, read_ig_control}, {2, 48, read_entity},
    {3, 24, read_clamped}, {6, 32, read_part}, {8, 32, read_rate}, {9, 16, read_celestial}, {10, 32, read_atmosphere},
    {16, 32, read_view_control}, {21, 32, read_view_definition}, {24, 32, read_height_request},
    {25, 64, read_sight_segment}, {26, 56, read_sight_vector}, {27, 8, read_position_request}}};

DecodeResult check_head(Bytes message, ByteOrder& order) {
    const auto size = static_cast<std::uint32_t>(message.size());
    const WireReader big(message, ByteOrder::Big);
    if (size < ig_control_bytes) { return {PacketError::WrongSize, size, size}; }
    const auto word = big.at<std::uint16_t>(magic_at);
    if (big.at<std::uint8_t>(0) != ig_control || big.at<std::uint8_t>(1) != ig_control_bytes ||
        (word != cigi_magic && word != swapped_cigi_magic)) {
        return {PacketError::NotOurs, big.at<std::uint8_t>(0), size};
    }
    order = word == cigi_magic ? ByteOrder::Big : ByteOrder::Little;
    const auto major = big.at<std::uint8_t>(2);
    constexpr std::uint8_t ours = 3;
    return {major == ours ? PacketError::None : PacketError::WrongVersion, major, size};
}

} // namespace

DecodeResult decode_cigi(Bytes message, std::vector<CigiPacket>& packets) {
    packets.clear();
    ByteOrder order = ByteOrder::Big;
    DecodeResult result = check_head(message, order);
    if (result.fault != PacketError::None) { return result; }
    for (Bytes rest = message; !rest.empty();) {
        const auto opcode = std::to_integer<std::uint8_t>(rest.front());
        const std::size_t size = rest.size() < header_bytes ? 0 : std::to_integer<std::size_t>(rest[1]);
        if (size < header_bytes || size > rest.size()) {
            packets.clear();
            result.fault = PacketError::WrongSize;
            return result;
        }
        const auto known = std::ranges::find(known_packets, opcode, &Known::opcode);
        if (known == known_packets.end() || known->size != size) {
            packets.emplace_back(CigiUnknownPacket{opcode});
        } else if (auto packet = known->read(WireReader(rest.first(size), order))) {
            packets.push_back(std::move(*packet));
        }
        rest = rest.subspan(size);
    }
    return result;
}

std::string cigi_text(const DecodeResult& result) {
    switch (result.fault) {
    case PacketError::None:
        return "CIGI 3 host: fine";
    case PacketError::WrongVersion:
        return fmt::format("expected CIGI 3, got major version {}", result.got);
    case PacketError::WrongSize:
        return fmt::format("CIGI: expected whole packets, got a message of {} bytes", result.size);
    default:
        return fmt::format("expected a CIGI 3 message that begins with IG Control, got opcode {} in {} bytes",
            result.got, result.size);
    }
}

} // namespace octant::sim::links
