// Forms: those of the decoders of this folder; CIGI 4.0: SISO-STD-013-2014, IG Control (16-bit size and packet id, no
// word for the byte order); CIGI 1 and 2: interface control documents, Boeing.

#include "sim/links/packet_kind.h"

#include "sim/links/cigi_packets.h"
#include "sim/links/dis_entity.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/mavlink.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace octant::sim::links {

namespace {

struct Beginning {
    std::string_view text;
    PacketKind kind;
};

constexpr std::array<Beginning, 17> beginnings{
    {{"DREF", PacketKind::OtherXPlane}, {"BECN", PacketKind::OtherXPlane}, {"RPOS", PacketKind::OtherXPlane},
        {"RADR", PacketKind::OtherXPlane}, {"VEHX", PacketKind::OtherXPlane}, {"PREL", PacketKind::OtherXPlane},
        {"CMND", PacketKind::OtherXPlane}, {"DSEL", PacketKind::OtherXPlane}, {"POSI", PacketKind::OtherXPlane},
        {"XGPS", PacketKind::ForeFlight}, {"XATT", PacketKind::ForeFlight}, {"XTRAFFIC", PacketKind::ForeFlight},
        {"$GP", PacketKind::Nmea}, {"$GN", PacketKind::Nmea}, {"FileType=text/acmi", PacketKind::Acmi},
        {"\xef\xbb\xbf"
         "FileType=text/acmi",
            PacketKind::Acmi},
        {"XtraLib.Stream", PacketKind::Acmi}}};

struct KindText {
    PacketKind kind;
    std::optional<Protocol> protocol; ///< the one that reads such packets
    std::string_view text;            ///< what they are, and what to do
};

constexpr std::array<KindText, 12> kind_texts{{
    {PacketKind::Fdm, Protocol::Fdm, "this is FlightGear FDM; --ports fdm [5550] says where it is read"},
    {PacketKind::SwappedFdm, {},
        "this is FlightGear FDM in little-endian byte order, which is not supported: FGNetFDM is big-endian (network "
        "order), so its sender has to swap the bytes of each number"},
    {PacketKind::Cigi3, Protocol::Cigi, "this is a CIGI 3 host; --ports cigi [8004] says where it is read"},
    {PacketKind::OlderCigi, {}, "this is a host of CIGI 1 or 2, which is not supported: set it to CIGI 3.3"},
    {PacketKind::Cigi4, {}, "this is a CIGI 4 host, which is not supported: set it to CIGI 3.3"},
    {PacketKind::MavLink, Protocol::MavLink, "this is MAVLink; --ports mavlink [14550] says where it is read"},
    {PacketKind::Dis, Protocol::Dis, "this is DIS; --ports dis [3000] says where it is read"},
    {PacketKind::XPlane, Protocol::XPlane,
        "this is X-Plane DATA or RREF; --ports xplane [49003] says where it is read"},
    {PacketKind::OtherXPlane, {}, "this is an X-Plane message other than DATA and RREF, which is not supported"},
    {PacketKind::ForeFlight, {},
        "this is position output for tablets (XGPS, XATT), which is not supported: X-Plane sends DATA, too"},
    {PacketKind::Nmea, {}, "this is NMEA 0183, which is not supported: --ports lines takes lines of numbers"},
    {PacketKind::Acmi, {}, "this is Tacview text, which is not read live: octant fly FILE.acmi flies it"},
}};

bool begins(Bytes bytes, std::string_view text) {
    return bytes.size() >= text.size() && std::equal(text.begin(), text.end(), bytes.begin(),
                                              [](char a, std::byte b) { return static_cast<std::byte>(a) == b; });
}

bool is_fdm(Bytes datagram) {
    const auto version = WireReader(datagram, ByteOrder::Big).at<std::uint32_t>(0);
    return (version == 24 && datagram.size() == fdm_24_bytes) || (version == 25 && datagram.size() == fdm_25_bytes);
}

/// Of any size: compilers pad the structure in more than one way.
bool is_swapped_fdm(Bytes datagram) {
    constexpr std::size_t min_bytes = 396;
    const auto version = WireReader(datagram, ByteOrder::Little).at<std::uint32_t>(0);
    return (version == 24 || version == 25) && datagram.size() >= min_bytes;
}

std::optional<PacketKind> cigi_kind(Bytes datagram) {
    constexpr std::size_t ig_control_bytes = 24;
    constexpr std::uint8_t older_ig_control_bytes = 16;
    const WireReader big(datagram, ByteOrder::Big);
    const auto byte = [&big](std::size_t at) { return big.at<std::uint8_t>(at); };
    if (datagram.size() < ig_control_bytes || datagram.size() % 8 != 0) { return std::nullopt; }
    const auto magic = big.at<std::uint16_t>(6);
    if (byte(0) == 1 && byte(1) == ig_control_bytes && byte(2) == 3 &&
        (magic == cigi_magic || magic == swapped_cigi_magic)) {
        return PacketKind::Cigi3;
    }
    if (byte(0) == 1 && byte(1) == older_ig_control_bytes && (byte(2) == 1 || byte(2) == 2)) {
        return PacketKind::OlderCigi;
    }
    for (const ByteOrder order : {ByteOrder::Big, ByteOrder::Little}) {
        const WireReader reader(datagram, order);
        if (reader.at<std::uint16_t>(0) == ig_control_bytes && reader.at<std::uint16_t>(2) == 0 && byte(4) == 4) {
            return PacketKind::Cigi4;
        }
    }
    return std::nullopt;
}

/// A PDU with a correct length, or an entity state: some senders leave the length 0.
bool is_dis(Bytes datagram) {
    constexpr std::size_t header_bytes = 12;
    const WireReader reader(datagram, ByteOrder::Big);
    const auto version = reader.at<std::uint8_t>(0);
    DisEntity entity;
    return datagram.size() >= header_bytes && version >= 1 && version <= 7 &&
           (reader.at<std::uint16_t>(8) == datagram.size() || decode_dis(datagram, entity).fault == PacketError::None);
}

bool is_xplane(Bytes datagram) {
    constexpr std::size_t head_bytes = 5;
    const std::size_t rest = datagram.size() - std::min(datagram.size(), head_bytes);
    return rest > 0 && ((begins(datagram, "DATA") && rest % 36 == 0) || (begins(datagram, "RREF") && rest % 8 == 0));
}

/// True if the first frame is correct, or of an unknown message with a correct length.
bool is_mavlink(Bytes datagram) {
    const MavLinkParse parse = parse_mavlink(datagram);
    return parse.result.fault == PacketError::None ||
           (parse.result.fault == PacketError::Unused && parse.length == datagram.size());
}

} // namespace

std::optional<PacketKind> packet_kind(Bytes datagram) {
    if (is_fdm(datagram)) { return PacketKind::Fdm; }
    if (is_xplane(datagram)) { return PacketKind::XPlane; }
    const auto known =
        std::ranges::find_if(beginnings, [&](const Beginning& beginning) { return begins(datagram, beginning.text); });
    if (known != beginnings.end()) { return known->kind; }
    if (const auto cigi = cigi_kind(datagram)) { return cigi; }
    if (is_swapped_fdm(datagram)) { return PacketKind::SwappedFdm; }
    if (is_mavlink(datagram)) { return PacketKind::MavLink; }
    return is_dis(datagram) ? std::optional(PacketKind::Dis) : std::nullopt;
}

std::optional<Protocol> protocol_of(PacketKind kind) {
    return std::ranges::find(kind_texts, kind, &KindText::kind)->protocol;
}

std::string_view text_of(PacketKind kind) { return std::ranges::find(kind_texts, kind, &KindText::kind)->text; }

} // namespace octant::sim::links
