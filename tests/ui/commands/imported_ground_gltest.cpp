#include "models/heights/height_field_export.h"
#include "models/procedural/procedural_terrain.h"
#include "tests/scratch.h"
#include "ui/flight/session.h"
#include "ui/report/png_file.h"
#include "visuals/groundfile/ground_import.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

using namespace octant;
using octant::visuals::scene::GroundShading;
using octant::visuals::scene::View;
using ui::settings::RunSettings;

namespace {

/// A map of 1025 x 1025 samples and the ground imported from it.
struct Map {
    Map() {
        const models::heights::HeightField field = models::procedural::procedural_canyon();
        REQUIRE(field.columns() == 1025);
        models::heights::write_height_field(file, field);
        visuals::groundfile::import_ground(
            {file}, ground, {}, [](visuals::groundfile::ImportStage, double) { return false; });
    }

    std::filesystem::path file = tests::scratch_folder() / "map.tif";
    std::filesystem::path ground = tests::scratch_folder() / "map.ground";
};

const Map& map() {
    static const Map made;
    return made;
}

/// Bright and dark bands, from edge to edge of the map.
std::filesystem::path made_drape() {
    constexpr int side = 64;
    std::vector<std::byte> bytes;
    for (int pixel = 0; pixel < side * side; ++pixel) {
        const std::byte grey{pixel % side / 8 % 2 == 0 ? std::uint8_t{220} : std::uint8_t{40}};
        bytes.insert(bytes.end(), 3, grey);
    }
    const auto file = tests::scratch_folder() / "bands.png";
    ui::report::write_png(file, {side, side, 3, bytes});
    return file;
}

std::vector<std::uint8_t> drawn(RunSettings settings, const std::filesystem::path& terrain) {
    settings.path.terrain = terrain.string();
    settings.path.name = "straight";
    settings.path.aircraft = {"f15"};
    settings.view.kind = View::Free;
    settings.view.eye_m = glm::dvec3(0.0, -9000.0, 6000.0);
    settings.view.look_m = glm::dvec3(0.0, 0.0, 0.0);
    settings.view.size_px = {320, 180};
    settings.time.frames = 1;
    ui::flight::Session session(settings);
    session.draw(0);
    const auto& rgba = session.picture().rgba;
    return {rgba.begin(), rgba.end()};
}

void check_alike(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    REQUIRE(a.size() == b.size());
    std::size_t off = 0;
    for (std::size_t i = 0; i < a.size(); ++i) { off += std::abs(a[i] - b[i]) > 2 ? 1U : 0U; }
    CHECK(off == 0);
}

} // namespace

TEST_CASE("an imported ground is textured and draped as the map that it was imported from") {
    RunSettings textured;
    textured.air.ground_shading = GroundShading::Texture;
    const auto bare = drawn(textured, map().ground);
    check_alike(bare, drawn(textured, map().file));
    CHECK(bare != drawn({}, map().ground));
    RunSettings draped;
    draped.air.drape = made_drape().string();
    const auto with_drape = drawn(draped, map().ground);
    check_alike(with_drape, drawn(draped, map().file));
    CHECK(with_drape != bare);
}
