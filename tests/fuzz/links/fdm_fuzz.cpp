#include "sim/links/flightgear_fdm.h"
#include "tests/fuzz/links/packet_target.h"

using namespace octant::sim::links;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Fix fix;
    const DecodeResult verdict = decode_fdm(std::as_bytes(std::span(data, size)), fix);
    octant::tests::expect(!fdm_text(verdict).empty(), "words for every verdict");
    if (verdict.fault == PacketError::None) {
        octant::tests::expect(error_of_fix(fix) == PacketError::None, "a fix that can be believed");
    }
    return 0;
}

std::vector<std::vector<std::byte>> octant::tests::packet_seeds() {
    Fix fix;
    fix.latitude_deg = 47.0;
    fix.altitude_m = 1000.0;
    const auto packet = encode_fdm(fix);
    std::vector<std::byte> old(packet.begin(), packet.end());
    std::vector<std::byte> longer = old;
    longer[3] = std::byte{25};
    longer.resize(fdm_25_bytes);
    return {old, longer};
}
