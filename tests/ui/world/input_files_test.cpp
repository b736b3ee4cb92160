#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/settings/setting_rows.h"
#include "ui/world/input_files.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::world;
namespace fs = std::filesystem;

namespace {

using tests::empty_folder;

std::string model(const std::string& materials) {
    return "mtllib " + materials + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
}

ui::settings::RunSettings aircraft_shown_by(const std::vector<fs::path>& aircraft) {
    ui::settings::RunSettings settings;
    settings.path.name = "straight";
    settings.path.terrain = "none";
    settings.path.aircraft.clear();
    for (const fs::path& file : aircraft) { settings.path.aircraft.push_back(file.string()); }
    return settings;
}

} // namespace

TEST_CASE("materials are kept only where they lie beside their model or below") {
    const fs::path folder = empty_folder("inputs-beside");
    fs::create_directories(folder / "m/below");
    write_file(folder / "above.mtl", "newmtl a\n");
    write_file(folder / "m/below/in.mtl", "newmtl a\n");
    for (const char* const way : {"../above.mtl", "./../above.mtl", "below/../../above.mtl"}) {
        CAPTURE(way);
        write_file(folder / "m/m.obj", model(way));
        CHECK(files_to_copy(aircraft_shown_by({folder / "m/m.obj"}), {}).size() == 1);
    }
    write_file(folder / "m/m.obj", model("./below/in.mtl"));
    const auto location = files_to_copy(aircraft_shown_by({folder / "m/m.obj"}), {});
    REQUIRE(location.size() == 2);
    CHECK(location[1].first == "inputs/below/in.mtl");
}

TEST_CASE("pictures, buffers and sub-models of an aircraft are inputs of the run") {
    const fs::path folder = empty_folder("inputs-named");
    fs::create_directories(folder / "m/sub");
    write_file(folder / "m/skin.png", "1");
    write_file(folder / "m/sub/wing.png", "2");
    write_file(folder / "shared.ac", "AC3Db\ntexture \"m/sub/wing.png\"\n");
    write_file(folder / "m/body.ac", "AC3Db\ntexture \"skin.png\"\ntexture \"none.png\"\n");
    write_file(
        folder / "m/jet.xml", "<PropertyList><path>body.ac</path><model><path>shared.ac</path></model></PropertyList>");
    const auto hash = [&] { return input_hashes(aircraft_shown_by({folder / "m/jet.xml"})); };
    const auto before = hash();
    std::set<std::string> names;
    for (const auto& [name, value] : before) { names.insert(fs::path(name).filename().string()); }
    for (const char* const name : {"jet.xml", "body.ac", "skin.png", "shared.ac", "wing.png"}) {
        CHECK(names.contains(name));
    }
    write_file(folder / "m/skin.png", "3");
    CHECK(hash() != before);
    write_file(folder / "m/skin.png", "1");
    CHECK(hash() == before);
    const auto location = files_to_copy(aircraft_shown_by({folder / "m/jet.xml"}), {});
    CHECK(location.size() == 4); // shared.ac lies above, and is only hashed
    fs::create_directories(folder / "m/Textures");
    write_file(folder / "m/Textures/skin.png", "5");
    write_file(folder / "m/jet.xml",
        "<PropertyList><path>body.ac</path><texture-path>/Textures/</texture-path></PropertyList>");
    CHECK(files_to_copy(aircraft_shown_by({folder / "m/jet.xml"}), {}).size() == 4); // both pictures
    write_file(folder / "m/part.bin", "4");
    write_file(folder / "m/a.gltf", R"({"buffers":[{"uri":"part.bin"},{"uri":"data:x"}]})");
    CHECK(files_to_copy(aircraft_shown_by({folder / "m/a.gltf"}), {}).size() == 2);
}

TEST_CASE("pictures elsewhere, in another case or behind backslashes are kept beside their model, where readers look") {
    const fs::path folder = tests::empty_folder("pictures-elsewhere");
    fs::create_directories(folder / "models");
    fs::create_directories(folder / "textures");
    write_file(folder / "textures/Skin.PNG", "skin");
    write_file(folder / "textures/fin.jpg", "fin");
    write_file(folder / "models/jet.ac", "AC3Db\ntexture \"..\\textures\\skin.png\"\n");
    write_file(folder / "models/jet.dae", "<library_images><init_from>C:/work/fin.jpg</init_from></library_images>");
    const auto names_of = [&](const char* model) {
        std::vector<std::string> names;
        for (const auto& [name, bytes] : files_to_copy(aircraft_shown_by({folder / "models" / model}), {})) {
            names.push_back(name);
        }
        return names;
    };
    CHECK(names_of("jet.ac") == std::vector<std::string>{"inputs/jet.ac", "inputs/Skin.PNG"});
    CHECK(names_of("jet.dae") == std::vector<std::string>{"inputs/jet.dae", "inputs/fin.jpg"});
}

TEST_CASE("a file that names the ground's coordinate system is kept with the run") {
    const fs::path folder = empty_folder("inputs-system");
    write_file(folder / "utm.prj", "PROJCS");
    ui::settings::RunSettings settings = aircraft_shown_by({"f15"});
    settings.path.terrain_system = "EPSG:4326";
    CHECK(files_to_copy(settings, {}).empty());
    CHECK(settings_in_recording(settings, folder).path.terrain_system == "EPSG:4326");
    settings.path.terrain_system = (folder / "utm.prj").string();
    const auto location = files_to_copy(settings, {});
    REQUIRE(location.size() == 1);
    CHECK(location[0].first == "inputs/utm.prj");
    ui::settings::RunSettings repeat_option = settings_in_recording(settings, folder);
    CHECK(repeat_option.path.terrain_system == "inputs/utm.prj");
    fs::create_directories(folder / "inputs");
    write_file(folder / "inputs/utm.prj", "PROJCS");
    ui::settings::resolve_paths_from(folder, repeat_option);
    CHECK(repeat_option.path.terrain_system == (folder / "inputs/utm.prj").string());
}

TEST_CASE("models whose materials have one name keep their own") {
    const fs::path folder = empty_folder("inputs-two");
    for (const char* const name : {"a", "b"}) {
        fs::create_directories(folder / name);
        write_file(folder / name / (std::string(name) + ".obj"), model("m.mtl"));
        write_file(folder / name / "m.mtl", std::string("newmtl ") + name + "\n");
    }
    const auto location = files_to_copy(aircraft_shown_by({folder / "a/a.obj", folder / "b/b.obj"}), {});
    std::set<std::string> names;
    for (const auto& [name, bytes] : location) { names.insert(name); }
    CHECK(names == std::set<std::string>{"inputs/a.obj", "inputs/m.mtl", "inputs/2/b.obj", "inputs/2/m.mtl"});
}

TEST_CASE("a recording does not take the place of the terrain that it flies over") {
    const fs::path folder = empty_folder("inputs-terrain");
    fs::create_directories(folder / "rec/inputs/terrain");
    ui::settings::RunSettings settings = aircraft_shown_by({"f15"});
    settings.path.terrain = (folder / "rec/inputs/terrain/t.asc").string();
    write_file(settings.path.terrain, "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2\n3 4\n");
    CHECK_THROWS_WITH(
        settings_in_recording(settings, folder / "rec"), Catch::Contains("--record: expected another folder"));
    CHECK_NOTHROW(settings_in_recording(settings, folder / "other"));
}
