#include "ui/flight/session.h"
#include "ui/window/panels.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

#include "headless_gui.h"

using namespace octant;
using namespace octant::tests;
using ui::window::ViewState;

namespace {

ui::settings::RunSettings small_settings() {
    ui::settings::RunSettings settings;
    settings.path.terrain = "none";
    settings.view.size_px = {64, 64};
    settings.path.heading_deg = 0.0;
    return settings;
}

/// A session after its first picture, with what a window knows beside it.
struct Shown {
    ui::flight::Session session{small_settings()};
    ViewState state;

    Shown() {
        state.wanted = session.settings();
        state.playback.end_s = 10.0;
        state.history.add(session.draw_at(0.0, std::nullopt));
    }
};

int background_vertices() {
    return ImGui::GetBackgroundDrawList()->VtxBuffer.Size;
}

} // namespace

TEST_CASE("panels of a session draw where they are open and change nothing by themselves") {
    Shown shown;
    ViewState& state = shown.state;
    const std::array<bool ui::window::OpenPanels::*, 5> panels{
        &ui::window::OpenPanels::flight,
        &ui::window::OpenPanels::terrain,
        &ui::window::OpenPanels::draw_order,
        &ui::window::OpenPanels::aircraft,
        &ui::window::OpenPanels::scene};
    for (const auto panel : panels) {
        HeadlessGui gui;
        state.open = {.flight = false};
        const auto widgets = [&] { ui::window::all_panels(state, shown.session, 0.0); };
        CHECK(gui.settled(widgets) == 0);
        state.open.*panel = true;
        CHECK(gui.settled(widgets) > 100);
        state.open.shown = false;
        CHECK(gui.settled(widgets) == 0);
    }
    CHECK(state.wanted == shown.session.settings());
    CHECK_FALSE(state.requests.step_frame);
    CHECK_FALSE(state.requests.go_to_s.has_value());
}

TEST_CASE("the flight panel pauses, changes the view and asks for the rest") {
    Shown shown;
    ViewState& state = shown.state;
    HeadlessGui gui;
    const auto widgets = [&] { ui::window::flight_panel(state, shown.session); };
    CHECK(gui.click("Flight", "###play", widgets));
    CHECK_FALSE(state.playback.playing);
    CHECK(gui.click("Flight", "###play", widgets));
    CHECK(state.playback.playing);
    CHECK(gui.click("Flight", "One frame", widgets));
    CHECK(state.requests.step_frame);
    CHECK(gui.click("Flight", "5 free", widgets));
    CHECK(state.wanted.view.kind == visuals::scene::View::Free);
    CHECK(state.wanted.view.eye_m == shown.session.camera().eye_m);
    state.playback.time_s = 5.0;
    CHECK(gui.click("Flight", "time", widgets));
    REQUIRE(state.requests.go_to_s.has_value());
    state.requests.go_to_s.reset();
    state.recording = "flight-1";
    gui.click("Flight", "time", widgets);
    CHECK_FALSE(state.requests.go_to_s.has_value());
    CHECK(gui.click("Flight", "###record", widgets));
    CHECK(state.requests.toggle_recording);
}

TEST_CASE("by hand the flight panel shows what the aircraft does and the status line says so") {
    Shown shown;
    HeadlessGui gui;
    ui::flight::Simulation& simulation = shown.session.simulation();
    simulation.advance_to(simulation.time_s());
    simulation.take_over(sim::aircraft_kind("f15"));
    const std::string texts =
        gui.texts([&] { ui::window::flight_panel(shown.state, shown.session); });
    const std::string marks =
        gui.texts([&] { ui::window::status_line(shown.state, shown.session, 0.0); });
    CHECK(marks.find("by hand") != std::string::npos);
    for (const char* const part : {"throttle", " kt", " ft", "Level off"}) {
        CAPTURE(part);
        CHECK(texts.find(part) != std::string::npos);
    }
}

TEST_CASE("a message is shown for its time") {
    Shown shown;
    HeadlessGui gui;
    shown.state.message = {"hello", 2.0};
    const auto at = [&](double now_s) {
        return gui.texts(
            [&, now_s] { ui::window::status_line(shown.state, shown.session, now_s); });
    };
    CHECK(at(1.0).find("hello") != std::string::npos);
    CHECK(at(2.0).find("hello") == std::string::npos);
}

TEST_CASE("painting order is written on the polygons in the middle of the chase view") {
    Shown shown;
    HeadlessGui gui;
    gui.settled([&] { ui::window::write_order_numbers(shown.session); });
    const ImDrawList& list = *ImGui::GetBackgroundDrawList();
    REQUIRE(background_vertices() > 100);
    ImVec2 sum(0.0F, 0.0F);
    for (const ImDrawVert& vertex : list.VtxBuffer) {
        sum = {sum.x + vertex.pos.x, sum.y + vertex.pos.y};
    }
    const auto count = static_cast<float>(background_vertices());
    // The chase camera keeps the aircraft near the middle of 1280x720.
    CHECK(std::abs(sum.x / count - 640.0F) < 100.0F);
    CHECK(std::abs(sum.y / count - 360.0F) < 200.0F);
}
