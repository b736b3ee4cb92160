#include "sim/links/dis_entity.h"
#include "tests/fuzz/links/packet_target.h"

using namespace octant::sim::links;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    DisEntity entity;
    const DecodeResult verdict = decode_dis(std::as_bytes(std::span(data, size)), entity);
    octant::tests::expect(!dis_text(verdict).empty(), "words for every verdict");
    if (verdict.fault == PacketError::None) {
        octant::tests::expect(error_of_fix(entity.fix) == PacketError::None, "a fix that can be believed");
    }
    return 0;
}

std::vector<std::vector<std::byte>> octant::tests::packet_seeds() {
    DisEntity entity;
    entity.reckoning = DeadReckoning::Rvw;
    entity.fix.latitude_deg = 47.0;
    entity.fix.altitude_m = 1000.0;
    const auto packet = encode_dis(entity, 12.0);
    return {{packet.begin(), packet.end()}};
}
