#include "models/simplify/simplify.h"
#include "sim/base/hash.h"
#include "tests/fuzz/formats/mesh_use.h"
#include "tests/fuzz/formats/target.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/progressive_file.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace octant::tests::formats::progressive_format {

namespace {

namespace refine = visuals::refine;

/// A square of hills with a boundary, 81 vertices.
models::TriangleMesh hills() {
    constexpr std::uint32_t side = 9;
    models::TriangleMesh mesh;
    mesh.name = "hills";
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const double x_m = i % side;
        const double y_m = i / side;
        mesh.vertices_m.emplace_back(x_m, y_m, std::sin(x_m) * std::cos(1.7 * y_m));
        mesh.colours.emplace_back(0.1F, 0.1F * static_cast<float>(i % side), 0.5F);
        if (i % side + 1 < side && i / side + 1 < side) {
            mesh.triangles.push_back({i, i + 1, i + side});
            mesh.triangles.push_back({i + 1, i + side + 1, i + side});
        }
    }
    return mesh;
}

std::string progressive_bytes(const models::TriangleMesh& mesh) {
    models::simplify::SimplifyOptions options;
    const refine::ProgressiveMesh made(models::simplify::fast_sequence(mesh, options));
    return bytes_written("seed.pm", [&](const auto& file) { refine::write_progressive(file, made); });
}

std::vector<std::string> seeds() { return {progressive_bytes(sample_cube()), progressive_bytes(hills())}; }

/// The checksum of each block that fits, and the file's length in the first one.
void seal(std::string& bytes) {
    constexpr std::size_t length_at = 4;
    std::size_t at = refine::progressive_signature.size();
    for (bool first = true; at + refine::block_header_bytes <= bytes.size(); first = false) {
        std::uint32_t count = 0;
        std::memcpy(&count, bytes.data() + at, sizeof count);
        if (count > bytes.size() - at - refine::block_header_bytes) { return; }
        char* const block = bytes.data() + at + sizeof count;
        const std::uint64_t length = bytes.size();
        if (first && count >= length_at + sizeof length) { std::memcpy(block + length_at, &length, sizeof length); }
        Hash hash;
        hash.add(std::as_bytes(std::span(block, count)));
        const std::uint64_t value = hash.value();
        std::memcpy(block + count, &value, sizeof value);
        at += refine::block_header_bytes + count;
    }
}

/// Refines all of it, and takes it back as far as that goes.
void use(const std::filesystem::path& file) {
    const auto mesh = std::make_shared<const refine::ProgressiveMesh>(refine::read_progressive(file));
    refine::SelectiveRefiner refiner(mesh);
    const std::vector<std::uint32_t> nodes = mesh->coarsest_first();
    for (const std::uint32_t node : nodes) { refiner.split(node); }
    expect(refiner.active_count() == mesh->leaf_count(), "all leaves active");
    expect(refiner.face_count() == mesh->face_count(), "all faces there");
    if (refiner.face_count() > 0) { use_mesh(refine::active_mesh(refiner).mesh); }
    refiner.repair();
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) { refiner.collapse(*node); }
}

const Registered target({.name = "progressive", .file = "input.pm", .use = use, .seeds = seeds, .seal = seal});

} // namespace

} // namespace octant::tests::formats::progressive_format
