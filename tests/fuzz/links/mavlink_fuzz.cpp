#include "sim/links/mavlink.h"
#include "tests/fuzz/links/packet_target.h"
#include "tests/sim/links/mavlink_frames.h"

using namespace octant::sim::links;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    MavLinkPose pose;
    for (Bytes rest = std::as_bytes(std::span(data, size)); !rest.empty();) {
        const MavLinkParse parse = parse_mavlink(rest);
        octant::tests::expect(parse.length > 0 && parse.length <= rest.size(), "a length within the bytes");
        if (parse.frame) {
            const auto fix = pose.take(*parse.frame);
            octant::tests::expect(!fix || error_of_fix(*fix) == PacketError::None, "a fix to be believed");
        }
        rest = rest.subspan(parse.length);
    }
    return 0;
}

std::vector<std::vector<std::byte>> octant::tests::packet_seeds() {
    std::vector<std::byte> all;
    std::vector<std::vector<std::byte>> seeds;
    for (const auto& [kind, length] : {std::pair(MavLinkKind::Attitude, 28),
             std::pair(MavLinkKind::GlobalPositionInt, 28), std::pair(MavLinkKind::HilStateQuaternion, 64)}) {
        MavLinkFrame frame{kind, 1, {}};
        frame.payload.resize(static_cast<std::size_t>(length), std::byte{0x11});
        seeds.push_back(encode_mavlink(frame, 1));
        all.insert(all.end(), seeds.back().begin(), seeds.back().end());
    }
    seeds.push_back(all);
    return seeds;
}
