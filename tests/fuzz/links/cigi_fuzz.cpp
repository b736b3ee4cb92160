#include "sim/links/cigi_host.h"
#include "sim/links/cigi_image_generator.h"
#include "tests/fuzz/links/packet_target.h"

#include <cmath>

using namespace octant::sim::links;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    start_of_frame_of(std::as_bytes(std::span(data, size)));
    CigiImageGenerator generator(nullptr);
    std::vector<Fix> moved;
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
        generator.take(std::as_bytes(std::span(data, size)), moved, frame);
        for (const Fix& fix : moved) {
            octant::tests::expect(error_of_fix(fix) == PacketError::None, "a fix that can be believed");
        }
        octant::tests::expect(
            generator.parts().turned(frame).size() <= CigiArticulatedParts::max_parts, "bounded parts");
        for (const auto& [number, view] : generator.definitions()) {
            for (const double side_rad : {view.left_rad, view.right_rad, view.top_rad, view.bottom_rad}) {
                octant::tests::expect(std::abs(side_rad) < 1.5, "a side ahead");
            }
        }
        const auto answer = generator.message_for(frame, 1.0);
        octant::tests::expect(answer.size() <= CigiImageGenerator::max_message_bytes, "a message that fits");
    }
    return 0;
}

std::vector<std::vector<std::byte>> octant::tests::packet_seeds() {
    std::vector<std::vector<std::byte>> seeds;
    for (const ByteOrder order : {ByteOrder::Big, ByteOrder::Little}) {
        WireWriter message(order);
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
        seeds.push_back(message.take());
        WireWriter begin(order);
        begin.add_zeros(24);
        begin.set(0, std::uint8_t{101});
        begin.set(1, std::uint8_t{24});
        begin.set(2, std::uint8_t{3});
        begin.set(6, std::uint16_t{0x8000});
        seeds.push_back(begin.take());
    }
    return seeds;
}
