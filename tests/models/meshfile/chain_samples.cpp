#include "tests/models/meshfile/chain_samples.h"

#include "sim/base/hash.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <cstring>
#include <span>

namespace octant::models::meshfile::test {

using tests::coloured_cube;
using tests::tetrahedron;

LevelChain sample_chain() {
    LevelChain chain;
    chain.name = "cube and less";
    chain.levels.push_back({coloured_cube(), 0.0});
    chain.levels.back().mesh.vertices_m[2].y = 1.0 / 3.0;
    chain.levels.back().mesh.notes = {"a.obj:3: something"};
    chain.levels.push_back({tetrahedron(), 0.125});
    polygons::PolygonModel model;
    model.name = "square";
    model.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
    model.corner_vertices = {0, 1, 2, 3};
    model.polygons = {{0, 4, 0, 1}};
    model.materials = {{"grey", {0.5F, 0.5F, 0.5F}}};
    model.parts = {"body", "rotor"};
    model.pivots = {{1, {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}, 6.5}};
    model.parents = {0};
    model.notes = {"a note"};
    chain.polygons = model;
    chain.polygons_error_m = 0.25;
    return chain;
}

std::string sealed(std::string bytes) {
    constexpr std::size_t head_bytes = 32;
    if (bytes.size() < head_bytes) { return bytes; }
    Hash hash;
    hash.add(std::as_bytes(std::span(bytes).subspan(head_bytes)));
    const std::uint64_t size = bytes.size() - head_bytes;
    const std::uint64_t value = hash.value();
    std::memcpy(bytes.data() + 16, &size, 8);
    std::memcpy(bytes.data() + 24, &value, 8);
    return bytes;
}

} // namespace octant::models::meshfile::test
