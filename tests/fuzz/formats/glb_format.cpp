#include "models/meshfile/mesh_file.h"
#include "tests/fuzz/formats/mesh_use.h"
#include "tests/fuzz/formats/target.h"

#include <cstdint>
#include <cstring>

namespace octant::tests::formats::glb_format {

namespace {

/// The length in the head and those of both chunks, the first as the file has it where it fits.
void seal(std::string& bytes) {
    constexpr std::size_t head = 12;
    constexpr std::size_t chunk_head = 8;
    const auto put = [&](std::size_t at, std::size_t value) {
        const auto number = static_cast<std::uint32_t>(value);
        std::memcpy(bytes.data() + at, &number, sizeof number);
    };
    if (bytes.size() < head + chunk_head) { return; }
    put(8, bytes.size());
    std::uint32_t json = 0;
    std::memcpy(&json, bytes.data() + head, sizeof json);
    const std::size_t second = head + chunk_head + json;
    if (second + chunk_head <= bytes.size()) {
        put(second, bytes.size() - second - chunk_head);
    } else {
        put(head, bytes.size() - head - chunk_head);
    }
}

const Registered target({
    .name = "glb",
    .file = "input.glb",
    .use = [](const auto& file) { use_mesh(models::meshfile::read_mesh(file)); },
    .seeds = [] { return mesh_seeds(".glb"); },
    .words = {"\"mode\":5", "\"count\":", "\"componentType\":5121", "\"byteStride\":", "\"byteOffset\":", "BIN",
        "JSON"},
    .seal = seal,
});

} // namespace

} // namespace octant::tests::formats::glb_format
