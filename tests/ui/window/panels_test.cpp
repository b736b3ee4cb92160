#include "sim/aircraft_kind.h"
#include "sim/flight_models.h"
#include "ui/settings/setting_rows.h"
#include "ui/window/key_map.h"
#include "ui/window/panel_columns.h"
#include "ui/window/panels.h"
#include "ui/window/setting_widgets.h"

#include <catch2/catch.hpp>
#include <glm/vector_relational.hpp>

#include <array>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "headless_gui.h"

using namespace octant;
using namespace octant::tests;
using namespace octant::ui::window;
using ui::settings::RunSettings;
using ui::settings::SettingInfo;
using ui::window::flight_readouts;
using ui::window::NumberStyle;
using ui::window::ViewState;

namespace {

/// What the list of settings says of one.
SettingInfo info_of(std::string_view name) {
    SettingInfo found{};
    RunSettings settings;
    ui::settings::visit_settings(settings, [&](const SettingInfo& info, const auto&) {
        if (info.name == name) { found = info; }
    });
    REQUIRE(found.name == name);
    return found;
}

template <class Value>
struct OptionalNumber : std::false_type {};

template <>
struct OptionalNumber<std::optional<int>> : std::true_type {};

template <>
struct OptionalNumber<std::optional<double>> : std::true_type {};

} // namespace

TEST_CASE("numbers over many decades get logarithmic sliders, wide ones around zero are dragged") {
    CHECK(ui::window::number_style(info_of("triangles")) == NumberStyle::LogSlider);
    CHECK(ui::window::number_style(info_of("visibility")) == NumberStyle::LogSlider);
    CHECK(ui::window::number_style(info_of("error-px")) == NumberStyle::LogSlider);
    CHECK(ui::window::number_style(info_of("smooth-share")) == NumberStyle::Slider);
    CHECK(ui::window::number_style(info_of("sun-azimuth")) == NumberStyle::Slider);
    CHECK(ui::window::number_style(info_of("sun-elevation")) == NumberStyle::Slider);
    CHECK(ui::window::number_style(info_of("water-level")) == NumberStyle::Drag);
}

TEST_CASE("numbers that load the world anew wait for Enter") {
    CHECK(ui::window::number_style(info_of("heading")) == NumberStyle::Typed);
    CHECK(ui::window::number_style(info_of("terrain-spacing")) == NumberStyle::Typed);
}

TEST_CASE("optional numbers begin within their bounds") {
    RunSettings settings;
    ui::settings::visit_settings(settings, [](const SettingInfo& info, const auto& value) {
        if constexpr (OptionalNumber<std::decay_t<decltype(value)>>::value) {
            CAPTURE(info.name);
            CHECK(ui::window::start_value(info) >= info.min_value);
            CHECK(ui::window::start_value(info) <= info.max_value);
        }
    });
    CHECK(ui::window::start_value(info_of("fov")) == 45.0);
    CHECK(ui::window::start_value(info_of("triangles")) == 20000.0);
}

TEST_CASE("what an unset setting means is read from its brackets") {
    CHECK(ui::window::unset_meaning(info_of("place")) == "map centre");
    CHECK(ui::window::unset_word(info_of("place")) == "auto");
    CHECK(ui::window::unset_word(info_of("inset")) == "none");
    CHECK(ui::window::unset_word(info_of("drape")) == "none");
    CHECK(ui::window::unset_meaning(info_of("drape")).empty());
}

TEST_CASE("a tooltip says meaning, option and bounds") {
    CHECK(ui::window::tooltip_of(info_of("zoom")) ==
          "chase, orbit: factor by which the eye is nearer; other views: magnification\n--zoom FACTOR, 0.05 to 100");
    CHECK(ui::window::tooltip_of(info_of("sky")) == "sky, and a plain beyond the edge of the map\n--sky");
}

TEST_CASE("names go into one line of text and come back") {
    const std::vector<std::string> names{"f15", "my model.obj"};
    CHECK(ui::window::comma_separated(names) == "f15, my model.obj");
    CHECK(ui::window::split_at_commas(ui::window::comma_separated(names)) == names);
    CHECK(ui::window::split_at_commas(" f15 ,, 500md,") == std::vector<std::string>{"f15", "500md"});
    CHECK(ui::window::split_at_commas(" , ").empty());
}

TEST_CASE("wingmen come as copies of the leader and go from the end") {
    const std::vector<std::string> two{"f15", "500md"};
    CHECK(ui::window::with_aircraft_count(two, 4) == std::vector<std::string>{"f15", "500md", "f15", "f15"});
    CHECK(ui::window::with_aircraft_count(two, 1) == std::vector<std::string>{"f15"});
    CHECK(ui::window::with_aircraft_count(two, 0) == std::vector<std::string>{"f15"});
    CHECK(ui::window::with_lead_aircraft({"f15", "500md", "f15"}, "x.obj") ==
          std::vector<std::string>{"x.obj", "500md", "x.obj"});
}

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
        const auto widgets = [&] {
            state.columns.lay_out(state.open, {{1280, 720}});
            each.panel(state);
        };
        state.open.*each.open = false;
        CHECK(gui.settled(widgets) == 0);
        state.open.*each.open = true;
        CHECK(gui.settled(widgets) > 100);
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
        CHECK(contains(texts, state.keys.name_of(key.action)));
    }
}

TEST_CASE("the first steps close by their button and the vsync box follows a click") {
    HeadlessGui gui;
    ViewState state;
    const auto widgets = [&] {
        state.columns.lay_out(state.open, {{1280, 720}});
        first_steps_panel(state);
        timing_panel(state);
    };
    state.open.first_steps = true;
    CHECK(gui.click("First steps", "Begin", widgets));
    CHECK_FALSE(state.open.first_steps);
    state.open.timing = true;
    state.history.add(record_of(0, 10.0));
    CHECK(gui.click("Frame times", "wait for the display (vsync)", widgets));
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

namespace {

OpenPanels all_open() { return {true, true, true, true, true, true, true, true, true, true, true}; }

using Rects = std::map<std::string, PanelRect>;

/// Makes each open panel with a content of that height in ImGui windows until their places are settled.
Rects settled_panels(
    tests::HeadlessGui& gui, PanelColumns& columns, OpenPanels open, const PanelArea& area, float content_height) {
    Rects rects;
    const auto panel = [&](const char* title, bool& is_open) {
        if (!is_open) { return; }
        columns.begin_panel(title, is_open);
        ImGui::Dummy({10.0F, content_height});
        rects[title] = {
            {ImGui::GetWindowPos().x, ImGui::GetWindowPos().y}, {ImGui::GetWindowSize().x, ImGui::GetWindowSize().y}};
        ImGui::End();
    };
    const auto widgets = [&] {
        columns.lay_out(open, area);
        panel("Leave?", open.leave_question);
        panel("Flight", open.flight);
        panel("Frame times", open.timing);
        panel("Terrain", open.terrain);
        panel("Draw order", open.draw_order);
        panel("Aircraft", open.aircraft);
        panel("Scene", open.scene);
        panel("Settings", open.settings);
        panel("Keys", open.help);
        panel("First steps", open.first_steps);
    };
    gui.settled(widgets);
    gui.settled(widgets);
    return rects;
}

bool overlap(const PanelRect& a, const PanelRect& b) {
    return a.at.x < b.at.x + b.size.x && b.at.x < a.at.x + a.size.x && a.at.y < b.at.y + b.size.y &&
           b.at.y < a.at.y + a.size.y;
}

} // namespace

TEST_CASE("all panels at once lie in the window, none over another, and leave the middle free") {
    for (const glm::vec2& size : {glm::vec2(1280, 720), glm::vec2(800, 500), glm::vec2(1920, 1080)}) {
        for (const float content_height : {20.0F, 260.0F, 2000.0F}) {
            for (const float inset : {0.0F, size.y / 3.0F}) {
                CAPTURE(size.x, content_height, inset);
                tests::HeadlessGui gui(size.x, size.y);
                PanelColumns columns;
                const glm::vec2 inset_size(inset * size.x / size.y, inset);
                const PanelArea area{size, 1.0F, 40.0F, inset_size};
                const Rects rects = settled_panels(gui, columns, all_open(), area, content_height);
                REQUIRE(rects.size() == 10);
                for (auto i = rects.begin(); i != rects.end(); ++i) {
                    const auto& [title, rect] = *i;
                    CAPTURE(title);
                    CHECK(glm::all(glm::greaterThanEqual(rect.at, glm::vec2(0.0F))));
                    CHECK(glm::all(glm::lessThanEqual(rect.at + rect.size, size)));
                    CHECK(rect.size.y <= content_height + 60.0F);
                    CHECK(rect.size.y >= 48.0F);
                    for (auto j = std::next(i); j != rects.end(); ++j) { CHECK_FALSE(overlap(rect, j->second)); }
                    if (title != "Leave?" && title != "Keys" && title != "First steps") {
                        CHECK((rect.at.x + rect.size.x <= 0.4F * size.x || rect.at.x >= 0.6F * size.x));
                    }
                    CHECK_FALSE(overlap(rect, {size - inset_size, inset_size}));
                }
            }
        }
    }
}

TEST_CASE("a panel is as high as what it shows where there is room for all") {
    tests::HeadlessGui gui;
    PanelColumns columns;
    OpenPanels open;
    open.timing = true;
    const Rects rects = settled_panels(gui, columns, open, {{1280, 720}}, 250.0F);
    CHECK(rects.at("Flight").size.y == Approx(285.0F).margin(15.0F));
    CHECK(rects.at("Frame times").size.y == rects.at("Flight").size.y);
    CHECK(rects.at("Frame times").at.y > rects.at("Flight").at.y + rects.at("Flight").size.y);
}

TEST_CASE("a panel that a person moves stays there until panels are put back") {
    tests::HeadlessGui gui;
    PanelColumns columns;
    const PanelArea area{{1280, 720}};
    const PanelRect first = settled_panels(gui, columns, {}, area, 100.0F).at("Flight");
    CHECK(columns.user_placed().empty());
    ImGui::SetWindowPos("Flight", {500.0F, 300.0F});
    const PanelRect moved = settled_panels(gui, columns, {}, area, 100.0F).at("Flight");
    CHECK(moved == PanelRect{{500, 300}, first.size});
    CHECK(columns.user_placed().at("Flight") == moved);

    PanelColumns next_run;
    next_run.restore_user_placed(layout_from(text_of_layout(columns.user_placed())));
    CHECK(settled_panels(gui, next_run, {}, area, 100.0F).at("Flight") == moved);
    CHECK(settled_panels(gui, next_run, {}, {{400, 200}}, 100.0F).at("Flight").at.x < 400);

    columns.reset_layout();
    CHECK(settled_panels(gui, columns, {}, area, 100.0F).at("Flight") == first);
}

TEST_CASE("of a layout file only lines of our own with numbers of a window count") {
    const std::string head = text_of_layout({});
    CHECK(layout_from(head + "Flight = 10 20 300 200\n").at("Flight") == PanelRect{{10, 20}, {300, 200}});
    for (const std::string text : {"[Table][0x00000001,999999999]", "[Window][Flight]\nPos=99999999999,1",
             "Flight = 1 2 3", "Flight = 1 2 300 1e308", "Flight = nan 2 300 300", "Flight = 1 2 300 300 300",
             "Flight = 1 2 -300 300", "Flight = = 1 2 300 300"}) {
        CAPTURE(text);
        CHECK(layout_from(head + text + "\n").empty());
    }
    CHECK(layout_from("Flight = 10 20 300 200\n").empty()); // of an older program
    CHECK(layout_from("").empty());
    PanelColumns columns;
    columns.restore_user_placed(layout_from(head + "##status = 1 2 300 300\nNo such = 1 2 300 300\n"));
    CHECK(columns.user_placed().empty());
}

TEST_CASE("the window has its panels where the columns put them, and the help puts them back") {
    tests::HeadlessGui gui;
    ViewState state;
    state.open.help = true;
    state.open.timing = true;
    const auto widgets = [&] {
        state.columns.lay_out(state.open, {{1280, 720}});
        timing_panel(state);
        help_panel(state);
    };
    gui.settled(widgets);
    CHECK(state.columns.user_placed().empty());
    state.columns.restore_user_placed({{"Frame times", {{400, 300}, {300, 200}}}});
    gui.settled(widgets);
    CHECK(state.columns.user_placed().size() == 1);
    CHECK(gui.click("Keys", "Put panels back", widgets));
    gui.settled(widgets);
    CHECK(state.columns.user_placed().empty());
}
