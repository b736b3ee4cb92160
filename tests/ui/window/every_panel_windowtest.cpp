#include "tests/ui/window/driven_viewer.h"

#include <catch2/catch.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <imgui_internal.h>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::tests;
using ui::window::OpenPanels;

namespace {

struct Shown {
    const char* name;
    OpenPanels open;
};

std::vector<Shown> what_is_shown() {
    return {{"flight", {}}, {"frame-times", {.flight = false, .timing = true}},
        {"terrain", {.flight = false, .terrain = true}}, {"draw-order", {.flight = false, .draw_order = true}},
        {"aircraft", {.flight = false, .aircraft = true}}, {"scene", {.flight = false, .scene = true}},
        {"settings", {.flight = false, .settings = true}}, {"keys", {.flight = false, .help = true}},
        {"first-steps", {.first_steps = true}},
        {"all", {true, true, true, true, true, true, true, true, false, false, true}}};
}

std::vector<const ImGuiWindow*> seen_windows() {
    std::vector<const ImGuiWindow*> seen;
    for (const ImGuiWindow* const window : ImGui::GetCurrentContext()->Windows) {
        const bool ours = std::string_view(window->Name).substr(0, 5) != "Debug";
        if (window->Active && window->ParentWindow == nullptr && !window->Hidden && ours) { seen.push_back(window); }
    }
    return seen;
}

/// Where a person asks for the pictures: a folder of OCTANT_SCREENS.
void keep_picture(DrivenViewer& driven, const std::string& name) {
    const char* const folder = std::getenv("OCTANT_SCREENS");
    if (folder == nullptr) { return; }
    glm::ivec2 at{0};
    glm::ivec2 size{0};
    glfwGetWindowPos(driven.viewer().window(), &at.x, &at.y);
    glfwGetWindowSize(driven.viewer().window(), &size.x, &size.y);
    const auto file = std::filesystem::path(folder) / (name + ".png");
    ui::report::write_png(file, driven.display().picture(at, size).view());
}

/// Each panel in the window, none over another, nothing cut off at its right side.
void check_places(const glm::ivec2& size) {
    const auto windows = seen_windows();
    CHECK_FALSE(windows.empty());
    const ImRect display(0.0F, 0.0F, static_cast<float>(size.x), static_cast<float>(size.y));
    for (std::size_t i = 0; i < windows.size(); ++i) {
        const ImGuiWindow& window = *windows[i];
        CAPTURE(window.Name);
        CHECK(display.Contains(window.Rect()));
        CHECK(window.ContentSize.x + 2.0F * window.WindowPadding.x <= window.Size.x + 1.0F);
        for (std::size_t j = i + 1; j < windows.size(); ++j) {
            CAPTURE(windows[j]->Name);
            CHECK_FALSE(window.Rect().Overlaps(windows[j]->Rect()));
        }
    }
}

} // namespace

TEST_CASE("every panel lies in a window of each size, none over another, and nothing is cut off") {
    for (const glm::ivec2& size : {glm::ivec2(800, 500), glm::ivec2(1280, 720), glm::ivec2(1920, 1080)}) {
        ui::settings::RunSettings settings = small_flight();
        settings.view.size_px = size;
        const auto driven = DrivenViewer::open(settings);
        if (!driven) { return; }
        for (const Shown& shown : what_is_shown()) {
            CAPTURE(size.x, shown.name);
            driven->state().open = shown.open;
            driven->turns(6);
            check_places(size);
            keep_picture(*driven, fmt::format("{}-{}", size.x, shown.name));
        }
    }
}
