#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/settings/settings_file.h"
#include "ui/settings/settings_text.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace octant;
using ui::settings::RunSettings;

namespace {

std::filesystem::path settings_file(const std::string& text) {
    const auto path = tests::scratch_folder() / "settings.json";
    write_file(path, text);
    return path;
}

} // namespace

TEST_CASE("settings survive the way to a file and back") {
    RunSettings settings;
    settings.path.aircraft = {"500md", "f15"};
    settings.path.heading_deg = 0.1 + 0.2;
    settings.view.eye_m = glm::dvec3(1.5, -2.25, 1e-3);
    settings.view.size_px = {320, 200};
    settings.air.sky = false;
    settings.adapt.terrain = true;
    settings.path.height_mode = sim::HeightMode::Follow;
    settings.air.background = {0.0F, 1.0F, 128.0F / 255.0F};
    const auto json = ui::settings::settings_json(settings);
    CHECK(ui::settings::settings_json(ui::settings::read_settings(settings_file(json.dump(2)))) == json);
    CHECK(ui::settings::settings_json(
              ui::settings::read_settings(settings_file(nlohmann::ordered_json{{"settings", json}}.dump()))) == json);
    CHECK(ui::settings::read_settings(settings_file(json.dump())).path.heading_deg == settings.path.heading_deg);
    CHECK_FALSE(ui::settings::settings_json(RunSettings{}) == json);
}

TEST_CASE("stored numbers that mean no data are a list, with none in front the only ones") {
    const auto voids_of = [](const std::string& json) {
        return ui::settings::read_settings(settings_file("{\"void\": " + json + "}")).path.terrain_voids;
    };
    using models::heights::VoidValues;
    CHECK(voids_of("\"-9999,0.5\"") == VoidValues{{-9999.0, 0.5}, false});
    CHECK(voids_of("\"none\"") == VoidValues{{}, true});
    CHECK(voids_of("\"none,-3.4028235e+38\"") == VoidValues{{-3.4028235e+38}, true});
    CHECK(voids_of("\"common\"") == VoidValues{});
    CHECK(voids_of("null") == VoidValues{}); // as files of before had it
    CHECK(voids_of("-9999.0") == VoidValues{{-9999.0}, false});
    for (const char* const wrong : {"\"nothing\"", "\"0,\"", "\"\"", "\"nan\"", "\"common,0\""}) {
        CHECK_THROWS_WITH(
            voids_of(wrong), Catch::Contains("void: expected numbers with commas between them, or none, got '"));
    }
}

TEST_CASE("old names of the painting order's methods are read as the exact one, which is written") {
    for (const char* method : {"tree", "cells", "bsp", "exact"}) {
        const auto read =
            ui::settings::read_settings(settings_file(fmt::format("{{\"order-method\": \"{}\"}}", method)));
        CHECK(read.surface.order_method == visuals::draworder::OrderMethod::Exact);
        CHECK(ui::settings::text_of(read.surface.order_method) == "exact");
    }
}

TEST_CASE("a missing key keeps its default and a wrong one is refused with its line") {
    CHECK(ui::settings::read_settings(settings_file("{}")).ground.triangles == RunSettings{}.ground.triangles);
    const auto expect = [](const std::string& text, const std::string& message) {
        const auto path = settings_file(text);
        CHECK_THROWS_WITH(ui::settings::read_settings(path), path.string() + message);
    };
    expect("{\n\"viev\": \"chase\"\n}", ":2: expected the name of a setting, got 'viev'");
    expect("{\n\n\"view\": \"roof\"}", ":3: view: expected one of chase, cockpit, tower, orbit, free, got 'roof'");
    expect("{\"fov\": 0}", ":1: fov: expected a number from 1 to 150, got '0'");
    expect("{\"warm-up\": 1.5}", ":1: warm-up: expected a whole number from 0 to 1000000, got '1.5'");
    expect("{\"aircraft\": []}", ":1: aircraft: expected a list of names, got []");
    expect("{\n\"samples\": 2}", ":2: samples: expected 1, 4 or 16, got 2");
    CHECK(ui::settings::read_settings(settings_file("{\"adapt\": \"none\"}")).adapt == RunSettings{}.adapt);
    expect("{\"adapt\": \"terrain,sound\"}",
        ":1: adapt: expected none or a list of terrain, shading, got 'terrain,sound'");
    expect("{\"sky\": 1}", ":1: sky: expected true or false, got '1'");
    expect("{\"background\": \"red\"}", ":1: background: expected six hexadecimal digits RRGGBB, got 'red'");
    expect("{\"fov\": 1e400}", ": expected JSON with numbers that fit into 64 bits, got others");
    expect(std::string(100000, '['), ": expected at most 64 levels of nesting, got more");
    expect("[]", ":1: expected a JSON object of settings, got array");
    expect("{\n\"fov\": ", ":2: expected JSON, got something else or a part of it");
}
