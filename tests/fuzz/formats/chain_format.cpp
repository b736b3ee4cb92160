#include "models/meshfile/level_chain.h"
#include "sim/base/hash.h"
#include "tests/fuzz/formats/mesh_use.h"
#include "tests/fuzz/formats/target.h"

#include <cstdint>
#include <cstring>

namespace octant::tests::formats::chain_format {

namespace {

using models::meshfile::LevelChain;

std::string chain_bytes(const LevelChain& chain) {
    return bytes_written("seed.chain", [&](const auto& file) { models::meshfile::write_chain(file, chain); });
}

std::vector<std::string> seeds() {
    LevelChain chain;
    chain.name = "cube and less";
    chain.levels.push_back({sample_cube(), 0.0});
    std::vector<std::string> all{chain_bytes(chain)};
    chain.levels.push_back({sample_tetrahedron(), 0.125});
    models::polygons::PolygonModel square;
    square.name = "square";
    square.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
    square.corner_vertices = {0, 1, 2, 3};
    square.polygons = {{0, 4, 0, 1}};
    square.materials = {{"grey", {0.5F, 0.5F, 0.5F}}};
    square.parts = {"body", "rotor"};
    square.pivots = {{1, {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}, 6.5}};
    chain.polygons = square;
    chain.polygons_error_m = 0.25;
    all.push_back(chain_bytes(chain));
    return all;
}

/// The size and the checksum in the head.
void seal(std::string& bytes) {
    constexpr std::size_t head = 32;
    if (bytes.size() < head) { return; }
    Hash hash;
    hash.add(std::as_bytes(std::span(bytes).subspan(head)));
    const std::uint64_t numbers[] = {bytes.size() - head, hash.value()};
    std::memcpy(bytes.data() + 16, numbers, sizeof numbers);
}

/// What was read is written and read again, to the same bytes.
void use(const std::filesystem::path& file) {
    const LevelChain chain = models::meshfile::read_chain(file);
    for (const models::meshfile::ChainLevel& level : chain.levels) { use_mesh(level.mesh); }
    const std::string written = chain_bytes(chain);
    const LevelChain again = models::meshfile::read_chain(input_folder() / "seed.chain");
    expect(chain_bytes(again) == written, "the same chain again");
}

const Registered target({.name = "chain", .file = "input.chain", .use = use, .seeds = seeds, .seal = seal});

} // namespace

} // namespace octant::tests::formats::chain_format
