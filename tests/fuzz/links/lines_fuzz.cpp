#include "sim/links/line_input.h"
#include "sim/links/named_columns.h"
#include "tests/fuzz/links/packet_target.h"

#include <string_view>

using namespace octant::sim::links;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    NamedColumns columns;
    LineSplitter splitter;
    const auto take = [&columns](const std::vector<std::byte>& line) {
        Fix fix;
        const DecodeResult verdict = columns.take(line, fix);
        octant::tests::expect(!NamedColumns::text_of(verdict).empty(), "words for every verdict");
        if (verdict.fault == PacketError::None) {
            octant::tests::expect(error_of_fix(fix) == PacketError::None, "a fix that can be believed");
        }
    };
    splitter.add(std::as_bytes(std::span(data, size)), take);
    splitter.finish(take);
    return 0;
}

std::vector<std::vector<std::byte>> octant::tests::packet_seeds() {
    std::vector<std::vector<std::byte>> seeds;
    for (const std::string_view text : {"t_s,lat_deg,lon_deg,alt_m,yaw_deg\n0,47,8,1000,90\n0.1,47.001,8,1000,90\n",
             "id\tnorth_m\teast_m\talt_m\r\n1\t10\t20\t30\r\n2\t-1e3\t+4\t.5\n"}) {
        const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
        seeds.emplace_back(bytes.begin(), bytes.end());
    }
    return seeds;
}
