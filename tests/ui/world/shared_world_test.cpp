// Worlds that share what is loaded of the same inputs.
#include "models/heights/height_field_export.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/world/world.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace octant;
using ui::settings::RunSettings;
using ui::world::RenderDevice;
using ui::world::World;

namespace {

/// Rolling ground of 26 by 26 km as a file.
std::string rolling_ground(const std::string& name, double lift_m) {
    constexpr int side = 257;
    std::vector<float> heights_m;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            heights_m.push_back(static_cast<float>(lift_m + 60.0 * std::sin(column / 9.0) + row / 13.0));
        }
    }
    const std::filesystem::path file = tests::scratch_folder() / name;
    models::heights::write_height_field(file, {side, side, 101.5625, heights_m});
    return file.string();
}

const std::string corners = "v 0 0 -4\nv 2 0 4\nv -2 0 4\nv 0 1 4\n";

std::filesystem::path wedge(const std::string& head) {
    std::filesystem::path shape = tests::scratch_folder() / "wedge.obj";
    write_file(shape, head + corners + "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    return shape;
}

/// As if the file had been written two seconds from now.
void age(const std::filesystem::path& file) {
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(2));
}

World shared_world(const RunSettings& settings, const World& other) {
    return ui::world::load_world(settings, RenderDevice::Cpu, &other);
}

} // namespace

TEST_CASE("a world shares with another what is loaded of the same inputs, and loads the rest") {
    const std::filesystem::path shape = wedge("");
    RunSettings settings;
    settings.path.terrain = rolling_ground("rolling.tif", 0.0);
    settings.path.aircraft = {shape.string()};
    const World first = ui::world::load_world(settings);

    settings.path.name = "turn";
    const World turn = shared_world(settings, first);
    CHECK(turn.scene.ground == first.scene.ground);
    CHECK(turn.scene.models.front() == first.scene.models.front());
    CHECK(turn.ground_name == first.ground_name);

    RunSettings elsewhere = settings;
    elsewhere.path.terrain = "none";
    const World over_none = shared_world(elsewhere, first);
    CHECK(over_none.scene.ground != first.scene.ground);
    CHECK(over_none.scene.models.front() == first.scene.models.front());
    CHECK(shared_world(settings, over_none).scene.ground != over_none.scene.ground);

    RunSettings textured = settings;
    textured.air.ground_shading = visuals::scene::GroundShading::Texture;
    CHECK(shared_world(textured, first).scene.ground_texture);

    settings.path.axes = "back,up,left";
    CHECK(shared_world(settings, first).scene.models.front() != first.scene.models.front());
    settings.path.axes = "auto";
    settings.path.terrain_height_scale = 2.0;
    CHECK(shared_world(settings, first).scene.ground != first.scene.ground);
    settings.path.terrain_height_scale.reset();

    write_file(shape, corners + "f 1 2 3\n");
    age(shape);
    age(settings.path.terrain);
    const World rewritten = shared_world(settings, first);
    CHECK(rewritten.scene.model_of(0).polygons.polygons.size() == 1);
    CHECK(rewritten.scene.ground != first.scene.ground);
}

TEST_CASE("what a shared world's files name is loaded anew once it is written anew") {
    const std::filesystem::path materials = tests::scratch_folder() / "wedge.mtl";
    write_file(materials, "newmtl one\nKd 1 0 0\n");
    const std::filesystem::path shape = wedge("mtllib wedge.mtl\nusemtl one\n");
    const std::filesystem::path heights = rolling_ground("behind.tif", 0.0);
    const std::filesystem::path map = tests::scratch_folder() / "map.vrt";
    write_file(map, "<VRTDataset rasterXSize=\"257\" rasterYSize=\"257\"><GeoTransform>0, 101.5625, 0, 0, 0, "
                    "-101.5625</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
                    "<SourceFilename relativeToVRT=\"1\">behind.tif</SourceFilename><SourceBand>1</SourceBand>"
                    "</SimpleSource></VRTRasterBand></VRTDataset>\n");
    RunSettings settings;
    settings.path.terrain = map.string();
    settings.path.aircraft = {shape.string()};
    const World first = ui::world::load_world(settings);
    const World same = shared_world(settings, first);
    CHECK(same.scene.ground == first.scene.ground);
    CHECK(same.scene.models.front() == first.scene.models.front());

    write_file(materials, "newmtl one\nKd 0 0 1\n");
    age(materials);
    rolling_ground("behind.tif", 500.0);
    age(heights);
    const World anew = shared_world(settings, first);
    CHECK(anew.scene.models.front() != first.scene.models.front());
    CHECK(*anew.scene.ground->height_at(0.0, 0.0) > *first.scene.ground->height_at(0.0, 0.0) + 400.0);
}
