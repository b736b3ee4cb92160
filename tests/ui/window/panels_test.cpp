#include "sim/aircraft_kind.h"
#include "sim/flight_models.h"
#include "ui/settings/settings_fields.h"
#include "ui/window/key_map.h"
#include "ui/window/panels.h"
#include "ui/window/setting_widgets.h"

#include <catch2/catch.hpp>

#include <array>

#include "headless_gui.h"

using namespace octant;
using namespace octant::tests;
using ui::window::ViewState;

namespace {

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

ui::report::FrameRecord record_of(int frame, double frame_ms) {
    ui::report::FrameRecord record;
    record.frame = frame;
    record.wall_s = 0.02 * frame;
    record.frame_ms = frame_ms;
    record.overrun = frame_ms > ui::report::overrun_16_ms ? 1 : 0;
    return record;
}

std::vector<std::string> texts_of(const std::vector<ui::window::StatusMark>& marks) {
    std::vector<std::string> texts;
    for (const ui::window::StatusMark& mark : marks) { texts.push_back(mark.text); }
    return texts;
}

} // namespace

TEST_CASE("a panel draws where it is open and nothing where it is closed") {
    struct Case {
        void (*panel)(ViewState&);
        bool ui::window::OpenPanels::*open;
    };

    const std::array cases{Case{ui::window::timing_panel, &ui::window::OpenPanels::timing},
        Case{ui::window::settings_panel, &ui::window::OpenPanels::settings},
        Case{ui::window::help_panel, &ui::window::OpenPanels::help},
        Case{ui::window::first_steps_panel, &ui::window::OpenPanels::first_steps}};
    for (const Case& each : cases) {
        HeadlessGui gui;
        ViewState state;
        state.open.*each.open = false;
        CHECK(gui.settled([&] { each.panel(state); }) == 0);
        state.open.*each.open = true;
        CHECK(gui.settled([&] { each.panel(state); }) > 100);
        CHECK(state.open.*each.open);
    }
}

TEST_CASE("every setting is to be found in one of the groups of the settings panel") {
    const auto& groups = ui::settings::enum_names<ui::settings::SettingGroup>;
    HeadlessGui gui;
    ViewState state;
    const std::string texts = gui.texts([&] {
        for (const auto& [group, headline] : groups) { ui::window::edit_group(state.next_settings, group); }
    });
    ui::settings::visit_settings(state.next_settings, [&](const ui::settings::FieldInfo& info, const auto&) {
        CAPTURE(info.name);
        CHECK(contains(texts, info.name));
    });
    CHECK(state.next_settings == ui::settings::RunSettings{});
    state.open.settings = true;
    const std::string titles = gui.texts([&] { ui::window::settings_panel(state); });
    for (const auto& [group, headline] : groups) { CHECK(contains(titles, headline)); }
}

TEST_CASE("only the settings that are asked for are shown, in that order") {
    HeadlessGui gui;
    ui::settings::RunSettings settings;
    constexpr std::array<std::string_view, 2> names{"visibility", "sky"};
    const std::string texts = gui.texts([&] { ui::window::edit_settings(settings, names); });
    CHECK(texts.find("visibility") < texts.find("sky"));
    CHECK(contains(texts, "sky"));
    CHECK_FALSE(contains(texts, "triangles"));
}

TEST_CASE("a check mark changes its setting, and one beside a number sets and unsets it") {
    HeadlessGui gui;
    ui::settings::RunSettings settings;
    const auto widgets = [&](std::string_view name) {
        return [&settings, name] {
            const std::array names{name};
            ImGui::Begin("window");
            ui::window::edit_settings(settings, names);
            ImGui::End();
        };
    };
    CHECK(gui.click("window", "sky", "##value", widgets("sky")));
    CHECK_FALSE(settings.air.sky);
    CHECK(gui.click("window", "fov", "auto", widgets("fov")));
    CHECK(settings.view.fov_deg == 45.0);
    CHECK(gui.click("window", "fov", "auto", widgets("fov")));
    CHECK_FALSE(settings.view.fov_deg.has_value());
}

TEST_CASE("the help names every key") {
    HeadlessGui gui;
    ViewState state;
    state.open.help = true;
    const std::string texts = gui.texts([&] { ui::window::help_panel(state); });
    for (const ui::window::ViewKey& key : ui::window::view_keys()) { CHECK(contains(texts, key.meaning)); }
    for (const ui::window::HeldKey& key : ui::window::held_keys()) {
        CHECK(contains(texts, key.meaning));
        CHECK(contains(texts, state.keys.name_of(key.chosen_action)));
    }
}

TEST_CASE("the first steps close by their button and the vsync box follows a click") {
    HeadlessGui gui;
    ViewState state;
    state.open.first_steps = true;
    CHECK(gui.click("First steps", "Begin", [&] { ui::window::first_steps_panel(state); }));
    CHECK_FALSE(state.open.first_steps);
    state.open.timing = true;
    state.history.add(record_of(0, 10.0));
    CHECK(gui.click("Frame times", "wait for the display (vsync)", [&] { ui::window::timing_panel(state); }));
    CHECK_FALSE(state.vsync);
}

TEST_CASE("the timing panel tells rate and overruns of the frames it holds") {
    HeadlessGui gui;
    ViewState state;
    state.open.timing = true;
    for (int frame = 0; frame < 100; ++frame) { state.history.add(record_of(frame, frame % 10 == 0 ? 25.0 : 10.0)); }
    const std::string texts = gui.texts([&] { ui::window::timing_panel(state); });
    CHECK(contains(texts, "50.0 frames/s"));
    CHECK(contains(texts, "overruns 10"));
}

TEST_CASE("what is always to be seen is said in a fixed order, and nothing in plain flight") {
    ViewState state;
    CHECK(ui::window::status_marks(state, std::nullopt).empty());
    state.recording = "flight-1";
    state.playback.playing = false;
    state.playback.speed = 0.5;
    ui::window::ManualFlightStatus manual_flight;
    manual_flight.warnings.stalled = true;
    CHECK(texts_of(ui::window::status_marks(state, manual_flight)) ==
          std::vector<std::string>{"REC flight-1", "paused", "x0.5", "by hand", "STALL"});
    manual_flight.ended = true;
    CHECK(texts_of(ui::window::status_marks(state, manual_flight)).back() == "MET THE GROUND");
}

using ui::window::flight_readouts;

TEST_CASE("a pilot is told throttle, speed, height, climb, angle of attack and load factor") {
    const sim::AircraftKind& f15 = sim::aircraft_kind("f15");
    const sim::AircraftState level = sim::trimmed_state(f15, {0, 0, 1000}, 0.0, 200.0);
    const auto numbers = flight_readouts(f15, level, {.throttle = 0.256});
    REQUIRE(numbers.size() == 6);
    CHECK(numbers[0].name == "throttle");
    CHECK(numbers[0].value == "26 %");
    CHECK(numbers[1].value == "389 kt");
    CHECK(numbers[2].value == "3281 ft");
    CHECK(numbers[3].value == "+0 ft/min");
    CHECK(numbers[4].value == "1.9 deg");
    CHECK(numbers[5].value == "1.00 g");
    CHECK(flight_readouts(sim::aircraft_kind("500md"), level, {}).front().name == "collective");
}
