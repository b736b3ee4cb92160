#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_file.h"
#include "ui/settings/settings_text.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

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

TEST_CASE("keys of the terrain mesh of earlier versions are read as --terrain-lod") {
    const std::string rest = R"("propagation": "crack-free", "fans": "partial", "resolution-c": 0.0, "control-r": 4)";
    const auto text_of = [&](const std::string& keys) {
        const RunSettings read = ui::settings::read_settings(settings_file("{" + keys + ", " + rest + "}"));
        const std::string text = ui::settings::text_of(read.ground.lod);
        CHECK(ui::settings::settings_json(read).at("terrain-lod") == text);
        CHECK_FALSE(ui::settings::settings_json(read).contains("mesh"));
        visuals::terrain::TerrainLod again;
        ui::settings::read_setting({"terrain-lod", "", ""}, text, again);
        CHECK(ui::settings::text_of(again) == text);
        return text;
    };
    const auto keys = [](const char* mesh, const char* control, const char* a, const char* c) {
        return fmt::format(R"("mesh": {}, "detail": "{}", "control-a": {}, "roughness-c": {})", mesh, control, a, c);
    };
    CHECK(text_of(keys("null", "exact", "0.0", "null")) == "screen-error");
    CHECK(text_of(keys("\"screen-error\"", "exact", "0.0", "null")) == "screen-error");
    CHECK(text_of(keys("\"midpoint\"", "exact", "0.0", "null")) == "exact");
    CHECK(text_of(keys("\"printed\"", "damped", "1000.0", "null")) == "paper");
    CHECK(text_of(keys("null", "damped", "0.0", "null")) == "paper:roughness=midpoint,control-a=0");
    CHECK(text_of(keys("null", "exact", "0.0", "12.5")) == "exact:roughness-c=12.5");
    CHECK(text_of(keys("\"printed\"", "literal", "0.0", "null")) == "paper:control=literal,control-a=0");
}

TEST_CASE("the option terrain-lod is a kind with keys, and anything else is refused") {
    const auto refusal_of = [](const char* text) {
        visuals::terrain::TerrainLod lod;
        try {
            ui::settings::read_setting({"--terrain-lod", "", ""}, text, lod);
        } catch (const Error& fault) { return std::string(fault.what()); }
        return std::string();
    };
    CHECK(refusal_of("screen-error").empty());
    CHECK(refusal_of("paper:fans=full,propagation=printed,control-r=2").empty());
    CHECK(refusal_of("best") == "--terrain-lod: expected one of screen-error, exact, paper, got 'best'");
    CHECK(
        refusal_of("screen-error:fans=full") == "--terrain-lod: expected no key after screen-error, got ':fans=full'");
    CHECK(refusal_of("paper:fan=full").starts_with("--terrain-lod: expected KEY=VALUE with a key of roughness, "));
    CHECK(refusal_of("paper:fans=all") == "--terrain-lod paper: fans: expected one of partial, full, got 'all'");
    CHECK(refusal_of("paper:").starts_with("--terrain-lod: expected KEY=VALUE"));
    CHECK(refusal_of("exact:roughness=screen-error").find("roughness=midpoint or printed") != std::string::npos);
    CHECK(refusal_of("paper:control-r=65").starts_with("--terrain-lod paper: control-r: expected a whole number"));
}

TEST_CASE("a change of settings costs what has to be made anew for it") {
    using ui::settings::change_between;
    using ui::settings::SettingsChange;
    const RunSettings before;
    CHECK(change_between(before, before) == SettingsChange::None);
    RunSettings after = before;
    after.time.rate_hz = 30.0;
    CHECK(change_between(before, after) == SettingsChange::Recording);
    after.view.azimuth_deg = 10.0;
    CHECK(change_between(before, after) == SettingsChange::Look);
    after.ground.triangles = 5000;
    CHECK(change_between(before, after) == SettingsChange::Picture);
    after.air.drape = "photo.tif";
    CHECK(change_between(before, after) == SettingsChange::World);
    after.path.aircraft.emplace_back("f15");
    CHECK(change_between(before, after) == SettingsChange::Flight);
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
