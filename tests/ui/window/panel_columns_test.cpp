#include "ui/window/panel_columns.h"
#include "ui/window/panels.h"

#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "headless_gui.h"

using namespace octant;
using namespace octant::ui::window;

namespace {

constexpr std::array<std::string_view, 7> side_panels{
    "Flight", "Frame times", "Scene", "Terrain", "Draw order", "Aircraft", "Settings"};
constexpr std::array<std::string_view, 3> middle_panels{"Leave?", "Keys", "First steps"};

OpenPanels all_open() { return {true, true, true, true, true, true, true, true, true, true, true}; }

/// The places of panels that want so much, after the window has seen them once.
std::vector<PanelRect> places_of(PanelColumns& columns, const PanelArea& area, float wanted_height) {
    for (const std::string_view title : side_panels) { columns.report_height(title, wanted_height); }
    for (const std::string_view title : middle_panels) { columns.report_height(title, wanted_height); }
    columns.lay_out(all_open(), area);
    std::vector<PanelRect> places;
    const auto take = [&](std::string_view title) {
        const auto rect = columns.take_new_rect(title);
        REQUIRE(rect);
        columns.report_rect(title, *rect);
        places.push_back(*rect);
    };
    for (const std::string_view title : side_panels) { take(title); }
    for (const std::string_view title : middle_panels) { take(title); }
    return places;
}

bool overlap(const PanelRect& a, const PanelRect& b) {
    return a.at.x < b.at.x + b.size.x && b.at.x < a.at.x + a.size.x && a.at.y < b.at.y + b.size.y &&
           b.at.y < a.at.y + a.size.y;
}

} // namespace

TEST_CASE("all panels at once lie in the window, none over another, and leave the middle free") {
    for (const glm::vec2& size : {glm::vec2(1280, 720), glm::vec2(800, 500), glm::vec2(1920, 1080)}) {
        for (const float wanted_height : {60.0F, 300.0F, 2000.0F}) {
            for (const float inset : {0.0F, size.y / 3.0F}) {
                CAPTURE(size.x, wanted_height, inset);
                PanelColumns columns;
                const auto places =
                    places_of(columns, {size, 1.0F, 40.0F, {inset * size.x / size.y, inset}}, wanted_height);
                for (std::size_t i = 0; i < places.size(); ++i) {
                    const PanelRect& place = places[i];
                    CHECK(place.at.x >= 0.0F);
                    CHECK(place.at.y >= 0.0F);
                    CHECK(place.at.x + place.size.x <= size.x);
                    CHECK(place.at.y + place.size.y <= size.y);
                    CHECK(place.size.y <= wanted_height);
                    CHECK(place.size.y >= 48.0F);
                    for (std::size_t j = i + 1; j < places.size(); ++j) { CHECK_FALSE(overlap(place, places[j])); }
                    if (i < side_panels.size()) {
                        CHECK((place.at.x + place.size.x <= 0.4F * size.x || place.at.x >= 0.6F * size.x));
                    }
                    const glm::vec2 corner = size - glm::vec2(inset * size.x / size.y, inset);
                    CHECK_FALSE(overlap(place, {corner, size - corner}));
                }
            }
        }
    }
}

TEST_CASE("a panel is as high as what it shows where there is room for all") {
    PanelColumns columns;
    columns.report_height("Flight", 310.0F);
    columns.report_height("Frame times", 250.0F);
    OpenPanels open;
    open.timing = true;
    columns.lay_out(open, {{1280, 720}});
    CHECK(columns.take_new_rect("Flight")->size.y == 310.0F);
    CHECK(columns.take_new_rect("Frame times")->size.y == 250.0F);
    CHECK(columns.take_new_rect("Frame times")->at.y > columns.take_new_rect("Flight")->at.y + 310.0F);
}

TEST_CASE("a panel that a person moves stays there until panels are put back") {
    PanelColumns columns;
    const PanelArea area{{1280, 720}};
    const OpenPanels open;
    columns.lay_out(open, area);
    const PanelRect first = *columns.take_new_rect("Flight");
    columns.report_rect("Flight", first);
    columns.lay_out(open, area);
    CHECK_FALSE(columns.take_new_rect("Flight"));
    CHECK(columns.user_placed().empty());
    const PanelRect moved{{500, 300}, first.size};
    columns.report_rect("Flight", moved);
    columns.lay_out(open, area);
    CHECK_FALSE(columns.take_new_rect("Flight"));
    CHECK(columns.user_placed().at("Flight") == moved);

    PanelColumns next_run;
    next_run.restore_user_placed(layout_from(text_of_layout(columns.user_placed())));
    next_run.lay_out(open, area);
    CHECK(next_run.take_new_rect("Flight") == moved);
    next_run.report_rect("Flight", moved);
    next_run.lay_out(open, {{400, 200}});
    CHECK(next_run.take_new_rect("Flight")->at.x < 400);

    columns.reset_layout();
    columns.lay_out(open, area);
    CHECK(columns.take_new_rect("Flight") == first);
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
