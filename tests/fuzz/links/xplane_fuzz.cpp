#include "sim/links/packet_kind.h"
#include "sim/links/xplane.h"
#include "tests/fuzz/links/packet_target.h"

using namespace octant::sim::links;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Bytes bytes = std::as_bytes(std::span(data, size));
    XPlanePose pose;
    for (int i = 0; i < 3; ++i) {
        std::optional<Fix> fix;
        const DecodeResult verdict = pose.take(bytes, fix);
        octant::tests::expect(!xplane_text(verdict).empty(), "words for every verdict");
        octant::tests::expect(!fix || error_of_fix(*fix) == PacketError::None, "a fix to be believed");
    }
    if (const auto kind = packet_kind(bytes)) {
        octant::tests::expect(!text_of(*kind).empty(), "words for every kind");
    }
    return 0;
}

std::vector<std::vector<std::byte>> octant::tests::packet_seeds() {
    Fix fix;
    fix.latitude_deg = 47.0;
    fix.altitude_m = 1000.0;
    std::vector<std::vector<std::byte>> seeds = xplane_requests(60);
    seeds.resize(1);
    seeds.push_back(encode_xplane(fix, {0.82, 0.0, 1000.0}, 1.0));
    return seeds;
}
