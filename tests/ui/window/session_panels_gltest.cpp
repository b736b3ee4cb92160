#include "ui/flight/session.h"
#include "ui/window/gui.h"
#include "ui/window/panels.h"

#include <catch2/catch.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <imgui_internal.h>
#include <vector>

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
        state.next_settings = session.settings();
        state.playback.end_s = 10.0;
        state.history.add(session.draw_at(0.0, std::nullopt));
    }
};

/// Of one byte of a pixel, as screens show it: 0 to 1.
double luminance_of(std::uint8_t byte) {
    const double value = byte / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// How many times lighter the lightest pixel of a window is than its darkest one, as WCAG 2 counts contrast, where the
/// panels of the last frame lie over a white picture.
double contrast_over_white(const char* window) {
    ImGuiIO& io = ImGui::GetIO();
    const glm::ivec2 size(static_cast<int>(io.DisplaySize.x), static_cast<int>(io.DisplaySize.y));
    unsigned char* texels = nullptr;
    glm::ivec2 atlas_px(0);
    io.Fonts->GetTexDataAsAlpha8(&texels, &atlas_px.x, &atlas_px.y);
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(4 * size.x * size.y), 255);
    ui::window::PanelRasterizer(texels, atlas_px).draw(*ImGui::GetDrawData(), pixels.data(), size);
    const ImRect place = ImGui::FindWindowByName(window)->Rect();
    double lightest = 0.0;
    double darkest = 1.0;
    for (int y = static_cast<int>(place.Min.y); y < static_cast<int>(place.Max.y); ++y) {
        for (int x = static_cast<int>(place.Min.x); x < static_cast<int>(place.Max.x); ++x) {
            const std::uint8_t* const bgr = &pixels[static_cast<std::size_t>(4 * (y * size.x + x))];
            const double light =
                0.0722 * luminance_of(bgr[0]) + 0.7152 * luminance_of(bgr[1]) + 0.2126 * luminance_of(bgr[2]);
            lightest = std::max(lightest, light);
            darkest = std::min(darkest, light);
        }
    }
    return (lightest + 0.05) / (darkest + 0.05);
}

int background_vertices() { return ImGui::GetBackgroundDrawList()->VtxBuffer.Size; }

} // namespace

TEST_CASE("panels of a session draw where they are open and change nothing by themselves") {
    Shown shown;
    ViewState& state = shown.state;
    const std::array<bool ui::window::OpenPanels::*, 5> panels{&ui::window::OpenPanels::flight,
        &ui::window::OpenPanels::terrain, &ui::window::OpenPanels::draw_order, &ui::window::OpenPanels::aircraft,
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
    CHECK(state.next_settings == shown.session.settings());
    CHECK_FALSE(state.requests.step_frame);
    CHECK_FALSE(state.requests.go_to_s.has_value());
}

TEST_CASE("the flight panel pauses, changes the view and asks for the rest") {
    Shown shown;
    ViewState& state = shown.state;
    HeadlessGui gui;
    const auto widgets = [&] {
        state.columns.lay_out(state.open, {{1280, 720}});
        ui::window::flight_panel(state, shown.session);
    };
    CHECK(gui.click("Flight", "###play", widgets));
    CHECK_FALSE(state.playback.playing);
    CHECK(gui.click("Flight", "###play", widgets));
    CHECK(state.playback.playing);
    CHECK(gui.click("Flight", "One frame", widgets));
    CHECK(state.requests.step_frame);
    CHECK(gui.click("Flight", "5 free", widgets));
    CHECK(state.next_settings.view.kind == visuals::scene::View::Free);
    CHECK(state.next_settings.view.eye_m == shown.session.camera().eye_m);
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
    const std::string texts = gui.texts([&] { ui::window::flight_panel(shown.state, shown.session); });
    const std::string marks = gui.texts([&] { ui::window::status_line(shown.state, shown.session, 0.0); });
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
        return gui.texts([&, now_s] { ui::window::status_line(shown.state, shown.session, now_s); });
    };
    CHECK(at(1.0).find("hello") != std::string::npos);
    CHECK(at(2.0).find("hello") == std::string::npos);
}

TEST_CASE("what the status line warns of can be read over a white picture") {
    Shown shown;
    shown.state.recording = "flight-1";
    HeadlessGui gui(640.0F, 360.0F);
    ImGui::GetStyle().WindowBorderSize = 0.0F;
    gui.settled([&] { ui::window::status_line(shown.state, shown.session, 0.0); });
    CHECK(contrast_over_white("##status") >= 4.5);
}

TEST_CASE("painting order is written on the polygons in the middle of the chase view") {
    Shown shown;
    HeadlessGui gui;
    gui.settled([&] { ui::window::write_order_numbers(shown.session); });
    const ImDrawList& list = *ImGui::GetBackgroundDrawList();
    REQUIRE(background_vertices() > 100);
    ImVec2 sum(0.0F, 0.0F);
    for (const ImDrawVert& vertex : list.VtxBuffer) { sum = {sum.x + vertex.pos.x, sum.y + vertex.pos.y}; }
    const auto count = static_cast<float>(background_vertices());
    // The chase camera keeps the aircraft near the middle of 1280x720.
    CHECK(std::abs(sum.x / count - 640.0F) < 100.0F);
    CHECK(std::abs(sum.y / count - 360.0F) < 200.0F);
}
