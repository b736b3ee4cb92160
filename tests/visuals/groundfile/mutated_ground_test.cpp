#include "sim/base/error.h"
#include "tests/damaged_grounds.h"
#include "tests/scratch.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/terrain/bisection_mesher.h"
#include "visuals/terrain/mesh_measurement.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace octant::visuals::groundfile {

namespace {

using std::filesystem::path;
using terrain::BisectionMesher;
using terrain::check_conformity;
using terrain::GroundMesh;
using terrain::GroundSamples;
using terrain::MeshView;

using tests::damaged;
using tests::is_noted;
using tests::Numbers;
using tests::sound_ground;
using tests::wave_columns;
using tests::wave_rows;
using tests::waves;

/// Beyond this a tile's mended heights are not those of smooth ground around it.
constexpr double smooth_m = 6.0;

path written(const std::string& name, const std::string& bytes) {
    const path file = tests::scratch_folder() / name;
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    return file;
}

/// How far the ground's samples lie from those of the field at most.
double worst_m(const GroundTiles& ground, const models::heights::HeightField& field) {
    double worst = 0.0;
    for (int row = 0; row < wave_rows; ++row) {
        for (int column = 0; column < wave_columns; ++column) {
            worst = std::max(
                worst, std::abs(static_cast<double>(ground.height_m(column, row) - field.height_m(column, row))));
        }
    }
    return worst;
}

std::string faults_of_mesh(const GroundTiles& ground) {
    MeshView view;
    view.eye_m = {500.0, -700.0, 600.0};
    view.focal_px = 800.0;
    BisectionMesher mesher(ground);
    const GroundMesh mesh = mesher.mesh(view, {0.5, terrain::unlimited_triangles, true});
    const terrain::Conformity found = check_conformity(GroundSamples(ground), mesh, view);
    return found.is_conforming() ? "" : found.text();
}

/// The sound file with noise over one tile.
std::string with_bad_tile(int level, std::size_t tile) {
    std::string bytes = sound_ground();
    const GroundLayout layout(wave_columns, wave_rows);
    const GroundLayout::Level& at = layout.level(level);
    const std::size_t start = GroundHeader::bytes + at.first_tile + tile * at.tile_bytes;
    Numbers numbers(static_cast<std::uint64_t>(level) + 1);
    for (std::size_t i = 0; i < at.tile_bytes; ++i) { bytes[start + i] = static_cast<char>(numbers.below(256)); }
    return bytes;
}

} // namespace

TEST_CASE("of 200 damaged grounds each is refused, named, or the same to the last sample") {
    const models::heights::HeightField field = waves();
    int refused = 0;
    int named = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Numbers numbers(seed);
        const path file = written("damaged" + std::to_string(seed) + ".ground", damaged(sound_ground(), numbers));
        INFO("seed " << seed);
        try {
            const GroundTiles ground = open_ground(file);
            const double off_m = worst_m(ground, field);
            const std::string faults = faults_of_mesh(ground);
            CHECK(faults.empty());
            CHECK((off_m == 0.0 || is_noted(file)));
            named += is_noted(file) ? 1 : 0;
        } catch (const Error&) { ++refused; }
        std::filesystem::remove(file);
    }
    CHECK(refused > 50);
    CHECK(named > 50);
}

TEST_CASE("a damaged tile of any level is drawn from its neighbours, without cracks, and counted") {
    const models::heights::HeightField field = waves();
    const GroundLayout layout(wave_columns, wave_rows);
    for (int level = 0; level < layout.levels(); ++level) {
        const path file = written("level" + std::to_string(level) + ".ground", with_bad_tile(level, 0));
        INFO("level " << level);
        const GroundTiles ground = open_ground(file);
        CHECK_FALSE(is_noted(file));
        CHECK(worst_m(ground, field) < smooth_m);
        CHECK(is_noted(file));
        CHECK(faults_of_mesh(ground).empty());
    }
}

TEST_CASE("with all tiles damaged a ground still has heights and no cracks") {
    std::string bytes = sound_ground();
    const GroundLayout layout(wave_columns, wave_rows);
    for (int level = 0; level < layout.levels(); ++level) {
        const GroundLayout::Level& at = layout.level(level);
        const auto tiles = static_cast<std::size_t>(at.tiles_across) * static_cast<std::size_t>(at.tiles_up);
        for (std::size_t tile = 0; tile < tiles; ++tile) {
            bytes[GroundHeader::bytes + at.first_tile + tile * at.tile_bytes] ^= '\x55';
        }
    }
    const path file = written("all.ground", bytes);
    const GroundTiles ground = open_ground(file);
    CHECK(faults_of_mesh(ground).empty());
    CHECK(worst_m(ground, waves()) <= 800.0);
    CHECK(is_noted(file));
}

} // namespace octant::visuals::groundfile
