#include "models/heights/height_field_export.h"
#include "sim/base/error.h"
#include "tests/scratch.h"
#include "visuals/groundfile/damage_tally.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/ground_header.h"
#include "visuals/groundfile/ground_import.h"
#include "visuals/terrain/conformity.h"
#include "visuals/terrain/error_mesher.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace octant::visuals::groundfile {

namespace {

using std::filesystem::path;
using terrain::ConformityCheck;
using terrain::ErrorMesher;
using terrain::GroundMesh;
using terrain::GroundSamples;
using terrain::MeshView;

constexpr int columns = 300;
constexpr int rows = 200;
/// Beyond this a tile's mended heights are not those of smooth ground around it.
constexpr double smooth_m = 6.0;

/// Waves of 400 m height and 3 km length, whose finest samples lie within 2 m of their neighbours'
/// means.
models::heights::HeightField waves() {
    std::vector<float> heights_m;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            heights_m.push_back(static_cast<float>(
                std::lround(400.0 * std::sin(0.06 * column) * std::cos(0.05 * row))));
        }
    }
    return {columns, rows, 30.0, heights_m};
}

const std::string& sound_bytes() {
    static const std::string bytes = [] {
        const path tiff = tests::scratch_folder() / "waves.tif";
        const path ground = tests::scratch_folder() / "waves.ground";
        models::heights::write_height_field(tiff, waves());
        import_ground({tiff}, ground, {}, [](ImportStage, double) { return false; });
        std::ifstream in(ground, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    }();
    return bytes;
}

/// Numbers from a seed, the same everywhere.
class Numbers {
public:
    explicit Numbers(std::uint64_t seed)
        : state_(seed * 0x9e3779b97f4a7c15U + 1) {}

    std::size_t below(std::size_t end) {
        state_ ^= state_ << 13U;
        state_ ^= state_ >> 7U;
        state_ ^= state_ << 17U;
        return static_cast<std::size_t>(state_ % end);
    }

private:
    std::uint64_t state_;
};

/// One of seven kinds of damage: a bit, a byte, noise, zeros, a part of the file in another's
/// place, a cut, an end that is not its own.
std::string damaged(std::string bytes, Numbers& numbers) {
    const std::size_t kind = numbers.below(7);
    const std::size_t at = numbers.below(bytes.size());
    const std::size_t length = std::min(1 + numbers.below(40000), bytes.size() - at);
    switch (kind) {
    case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << numbers.below(8)));
        break;
    case 1:
        bytes[at] = static_cast<char>(numbers.below(256));
        break;
    case 2:
        for (std::size_t i = 0; i < length; ++i) {
            bytes[at + i] = static_cast<char>(numbers.below(256));
        }
        break;
    case 3:
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
        break;
    case 4: {
        const std::string part = bytes.substr(numbers.below(bytes.size()), length);
        bytes.replace(at, part.size(), part);
        break;
    }
    case 5:
        bytes.resize(at);
        break;
    default:
        bytes.append(length, 'x');
    }
    return bytes;
}

path written(const std::string& name, const std::string& bytes) {
    const path file = tests::scratch_folder() / name;
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    return file;
}

bool is_noted(const path& file) {
    const std::vector<std::string> lines = damage_lines();
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.starts_with(file.string() + ":");
    });
}

/// How far the ground's samples lie from those of the field at most.
double worst_m(const GroundTiles& ground, const models::heights::HeightField& field) {
    double worst = 0.0;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            worst = std::max(
                worst,
                std::abs(static_cast<double>(
                    ground.height_m(column, row) - field.height_m(column, row))));
        }
    }
    return worst;
}

std::string faults_of_mesh(const GroundTiles& ground) {
    MeshView view;
    view.eye_m = {500.0, -700.0, 600.0};
    view.focal_px = 800.0;
    ErrorMesher mesher(ground);
    const GroundMesh mesh = mesher.mesh(view, {0.5, terrain::any_triangles, true});
    const terrain::Conformity found = ConformityCheck(GroundSamples(ground)).check(mesh, view);
    return found.is_whole() ? "" : found.text();
}

/// The sound file with noise over one tile.
std::string with_bad_tile(int level, std::size_t tile) {
    std::string bytes = sound_bytes();
    const GroundLayout layout(columns, rows);
    const GroundLayout::Level& at = layout.level(level);
    const std::size_t start = GroundHeader::bytes + at.first_tile + tile * at.tile_bytes;
    Numbers numbers(static_cast<std::uint64_t>(level) + 1);
    for (std::size_t i = 0; i < at.tile_bytes; ++i) {
        bytes[start + i] = static_cast<char>(numbers.below(256));
    }
    return bytes;
}

} // namespace

TEST_CASE("of 200 damaged grounds each is refused, named, or the same to the last sample") {
    const models::heights::HeightField field = waves();
    int refused = 0;
    int named = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Numbers numbers(seed);
        const path file =
            written("damaged" + std::to_string(seed) + ".ground", damaged(sound_bytes(), numbers));
        INFO("seed " << seed);
        try {
            const GroundTiles ground = open_ground(file);
            const double off_m = worst_m(ground, field);
            const std::string faults = faults_of_mesh(ground);
            CHECK(faults.empty());
            CHECK((off_m == 0.0 || is_noted(file)));
            named += is_noted(file) ? 1 : 0;
        } catch (const Error&) {
            ++refused;
        }
        std::filesystem::remove(file);
    }
    CHECK(refused > 50);
    CHECK(named > 50);
}

TEST_CASE("a damaged tile of any level is drawn from its neighbours, without cracks, and counted") {
    const models::heights::HeightField field = waves();
    const GroundLayout layout(columns, rows);
    for (int level = 0; level < layout.levels(); ++level) {
        const path file =
            written("level" + std::to_string(level) + ".ground", with_bad_tile(level, 0));
        INFO("level " << level);
        const GroundTiles ground = open_ground(file);
        CHECK_FALSE(is_noted(file));
        CHECK(worst_m(ground, field) < smooth_m);
        CHECK(is_noted(file));
        CHECK(faults_of_mesh(ground).empty());
    }
}

TEST_CASE("with all tiles damaged a ground still has heights and no cracks") {
    std::string bytes = sound_bytes();
    const GroundLayout layout(columns, rows);
    for (int level = 0; level < layout.levels(); ++level) {
        const GroundLayout::Level& at = layout.level(level);
        const auto tiles =
            static_cast<std::size_t>(at.tiles_across) * static_cast<std::size_t>(at.tiles_up);
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
