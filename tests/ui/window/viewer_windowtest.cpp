#include "tests/ui/window/driven_viewer.h"
#include "ui/flight/session.h"
#include "ui/window/gui.h"

#include <catch2/catch.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <imgui_internal.h>
#include <optional>
#include <utility>
#include <vector>

using namespace octant;
using namespace octant::tests;
using ui::settings::RunSettings;
using visuals::scene::View;

namespace {

/// Share of pixels that differ by more than rounding.
double difference(const visuals::scene::Picture& a, const visuals::scene::Picture& b) {
    if (a.rgba.size() != b.rgba.size()) { return 1.0; }
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        const bool same = std::abs(a.rgba[i] - b.rgba[i]) < 8 && std::abs(a.rgba[i + 1] - b.rgba[i + 1]) < 8 &&
                          std::abs(a.rgba[i + 2] - b.rgba[i + 2]) < 8;
        differing += same ? 0 : 1;
    }
    return 4.0 * static_cast<double>(differing) / static_cast<double>(a.rgba.size());
}

/// Where on the display a panel has the widget of this name, found with the pointer.
std::optional<glm::ivec2> place_of(DrivenViewer& driven, const char* panel, const char* widget) {
    const ImGuiWindow* const window = ImGui::FindWindowByName(panel);
    if (window == nullptr) { return std::nullopt; }
    const ImGuiID id = ImGui::FindWindowByName(panel)->GetID(widget);
    glm::ivec2 corner{0};
    glfwGetWindowPos(driven.viewer().window(), &corner.x, &corner.y);
    constexpr int step = 8;
    const int left = static_cast<int>(window->Pos.x) + 4 * step;
    for (int y = 0; y < static_cast<int>(window->Size.y); y += step) {
        const glm::ivec2 at = corner + glm::ivec2(left, static_cast<int>(window->Pos.y) + y);
        driven.display().move_pointer(at);
        driven.turns(2);
        if (ImGui::GetHoveredID() == id) { return at; }
    }
    return std::nullopt;
}

} // namespace

TEST_CASE("keys 1 to 5 show the five views, each another picture of the paused flight") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->strike("space");
    REQUIRE_FALSE(driven->state().playback.playing);
    const std::array<std::pair<const char*, View>, 5> views{
        {{"1", View::Cockpit}, {"2", View::Chase}, {"3", View::Tower}, {"4", View::Orbit}, {"5", View::Free}}};
    std::vector<visuals::scene::Picture> pictures;
    for (const auto& [key, view] : views) {
        driven->strike(key);
        CHECK(driven->settings().view.kind == view);
        pictures.push_back(driven->picture());
    }
    for (std::size_t i = 0; i + 1 < 4; ++i) {
        INFO("view " << i + 1);
        CHECK(difference(pictures[i], pictures[i + 1]) > 0.02);
    }
    INFO("the free camera begins where the view before it stood");
    CHECK(difference(pictures[3], pictures[4]) < 0.02);
}

TEST_CASE("a paused window shows the same picture again and again") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->turns(20);
    driven->strike("space");
    const visuals::scene::Picture before = driven->picture();
    driven->turns(5);
    CHECK(driven->picture().rgba == before.rgba);
    driven->strike("period");
    CHECK(driven->picture().rgba != before.rgba);
}

TEST_CASE("the window's picture is that of a flight without a window") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->strike("space");
    driven->strike("Home");
    driven->turns(3);
    RunSettings settings = driven->settings();
    settings.drawing.context = ui::settings::ContextKind::OsMesa;
    const visuals::scene::Picture shown = driven->picture();
    ui::flight::Session session(settings);
    session.draw(0);
    CHECK(difference(session.picture(), shown) < 0.001);
}

TEST_CASE("dragging turns the eye around the aircraft, the wheel comes nearer, V looks straight") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->strike("space");
    const visuals::scene::Picture straight = driven->picture();
    driven->drag({240, 180}, {320, 200});
    CHECK(std::abs(driven->settings().view.azimuth_deg) > 20.0);
    CHECK(driven->settings().view.elevation_deg > 5.0);
    CHECK(difference(driven->picture(), straight) > 0.02);
    driven->display().turn_wheel();
    driven->turns(3);
    CHECK(driven->settings().view.zoom > 1.1);
    driven->strike("v");
    CHECK(driven->settings().view.zoom == 1.0);
    CHECK(difference(driven->picture(), straight) < 0.001);
}

TEST_CASE("I opens a second view in a corner and leaves the rest of the picture") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->strike("space");
    const visuals::scene::Picture alone = driven->picture();
    driven->strike("i");
    REQUIRE(driven->settings().view.inset == View::Chase);
    driven->strike("i");
    REQUIRE(driven->settings().view.inset == View::Cockpit);
    const double changed = difference(driven->picture(), alone);
    CHECK(changed > 0.02);
    CHECK(changed < 0.13);
    driven->strike("i");
    driven->strike("i");
    CHECK_FALSE(driven->settings().view.inset.has_value());
    CHECK(difference(driven->picture(), alone) < 0.001);
}

TEST_CASE("each panel opens by its key and is seen in the window") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    const std::array<std::pair<const char*, bool ui::window::OpenPanels::*>, 7> panels{
        {{"F3", &ui::window::OpenPanels::timing}, {"F4", &ui::window::OpenPanels::terrain},
            {"F5", &ui::window::OpenPanels::draw_order}, {"F6", &ui::window::OpenPanels::aircraft},
            {"F7", &ui::window::OpenPanels::scene}, {"F8", &ui::window::OpenPanels::settings},
            {"F1", &ui::window::OpenPanels::help}}};
    driven->state().open.flight = false;
    for (const auto& [key, panel] : panels) {
        INFO(key);
        driven->strike(key);
        CHECK(driven->state().open.shown);
        CHECK(driven->state().open.*panel);
        driven->turns(2);
        CHECK(driven->viewer().gui().vertices() > 200);
        driven->strike(key);
        CHECK_FALSE(driven->state().open.*panel);
    }
}

TEST_CASE("a layout file that is damaged or another program's is read without harm, once and again") {
    for (const std::string& layout :
        {std::string("[Table][0x00000001,999999999]\n"),
            std::string("[Window][Flight]\nPos=1e9,nan\nSize=-1,-1\n[Table][0xFFFFFFFF,-1]\n"), std::string(1000, '\0'),
            std::string("# octant panels: title = x y width height\nFlight = 1e308 nan -5 0\n")}) {
        const auto driven = DrivenViewer::open(small_flight(), layout);
        if (!driven) { return; }
        driven->strike("F4");
        driven->turns(3);
        CHECK(driven->state().open.terrain);
        CHECK_FALSE(driven->state().open.first_steps);
    }
}

TEST_CASE("the first steps leave the picture free once a key was used") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    CHECK(driven->state().open.first_steps);
    driven->strike("3");
    CHECK_FALSE(driven->state().open.first_steps);
}

TEST_CASE("a click on the flight panel's button pauses the flight") {
    RunSettings settings = small_flight();
    settings.view.size_px = {1000, 700};
    const auto driven = DrivenViewer::open(settings);
    if (!driven) { return; }
    driven->strike("F2");
    driven->turns(3);
    const auto button = place_of(*driven, "Flight", "###play");
    REQUIRE(button.has_value());
    REQUIRE(driven->state().playback.playing);
    driven->click(*button);
    CHECK_FALSE(driven->state().playback.playing);
}

TEST_CASE("settings that do not go together are refused in the window as on the command line") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->state().next_settings.ground.lod.metric = visuals::terrain::GroundMetric::ScreenError;
    driven->state().next_settings.ground.lod.control = visuals::terrain::DetailControl::Damped;
    driven->turns(3);
    CHECK(driven->settings().ground.lod.control == visuals::terrain::DetailControl::Exact);
    CHECK(driven->state().message.text.find("--mesh screen-error") != std::string::npos);
}

TEST_CASE("M shows the edges of the ground's triangles, then their levels") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    driven->strike("space");
    const visuals::scene::Picture plain = driven->picture();
    driven->strike("m");
    const visuals::scene::Picture edges = driven->picture();
    CHECK(difference(edges, plain) > 0.02);
    driven->strike("m");
    CHECK(difference(driven->picture(), edges) > 0.05);
    driven->strike("m");
    CHECK(difference(driven->picture(), plain) < 0.001);
}

TEST_CASE("the window's picture follows the window's size") {
    const auto driven = DrivenViewer::open(small_flight());
    if (!driven) { return; }
    glfwSetWindowSize(driven->viewer().window(), 700, 300);
    CHECK(driven->until([&] { return driven->settings().view.size_px == glm::ivec2(700, 300); }));
    driven->turns(2);
    CHECK(driven->picture().width == 700);
    glfwSetWindowSize(driven->viewer().window(), 200, 500);
    CHECK(driven->until([&] { return driven->settings().view.size_px == glm::ivec2(200, 500); }));
    driven->strike("i");
    driven->turns(2);
    CHECK(driven->picture().height == 500);
}
