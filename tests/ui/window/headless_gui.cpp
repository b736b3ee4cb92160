#include "headless_gui.h"

#include <imgui_internal.h>

namespace octant::tests {

HeadlessGui::HeadlessGui(float width_px, float height_px) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {width_px, height_px};
    io.DeltaTime = 1.0F / 60.0F;
    unsigned char* texels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
}

HeadlessGui::~HeadlessGui() { ImGui::DestroyContext(); }

int HeadlessGui::frame(const Widgets& widgets) {
    ImGui::NewFrame();
    widgets();
    ImGui::Render();
    return ImGui::GetDrawData()->TotalVtxCount;
}

int HeadlessGui::settled(const Widgets& widgets) {
    frame(widgets);
    frame(widgets);
    return frame(widgets);
}

std::string HeadlessGui::texts(const Widgets& widgets) {
    settled(widgets);
    ImGui::NewFrame();
    ImGui::LogToClipboard(10);
    widgets();
    ImGui::LogFinish();
    ImGui::Render();
    return ImGui::GetClipboardText();
}

bool HeadlessGui::click(const char* window, const char* label, const Widgets& widgets) {
    return click_on(window, ImHashStr(label, 0, ImHashStr(window)), widgets);
}

bool HeadlessGui::click(const char* window, const char* within, const char* label, const Widgets& widgets) {
    const ImGuiID scope = ImHashStr(within, 0, ImHashStr(window));
    return click_on(window, ImHashStr(label, 0, scope), widgets);
}

bool HeadlessGui::click_on(const char* window, unsigned widget, const Widgets& widgets) {
    settled(widgets);
    const ImGuiWindow* const found = ImGui::FindWindowByName(window);
    if (found == nullptr) { return false; }
    const ImRect place = found->Rect();
    ImGuiIO& io = ImGui::GetIO();
    constexpr float step_px = 6.0F;
    for (float y = place.Min.y; y < place.Max.y; y += step_px) {
        for (float x = place.Min.x; x < place.Max.x; x += step_px) {
            io.MousePos = {x, y};
            frame(widgets);
            if (ImGui::GetCurrentContext()->HoveredId != widget) { continue; }
            io.MouseDown[0] = true;
            frame(widgets);
            io.MouseDown[0] = false;
            frame(widgets);
            return true;
        }
    }
    return false;
}

} // namespace octant::tests
