#include "sim/links/wire_bytes.h"
#include "tests/fuzz/formats/target.h"
#include "ui/flight/packet_file.h"

#include <cmath>
#include <cstdint>
#include <string_view>

namespace octant::tests::formats {

namespace {

namespace links = sim::links;

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

} // namespace

} // namespace octant::tests::formats
