#pragma once

#include <imgui.h>

#include <functional>
#include <string>

namespace octant::tests {

/// Dear ImGui without a window: frames are made and never drawn.
class HeadlessGui {
public:
    explicit HeadlessGui(float width_px = 1280.0F, float height_px = 720.0F);
    ~HeadlessGui();
    HeadlessGui(const HeadlessGui&) = delete;
    HeadlessGui& operator=(const HeadlessGui&) = delete;
    HeadlessGui(HeadlessGui&&) = delete;
    HeadlessGui& operator=(HeadlessGui&&) = delete;

    using Widgets = std::function<void()>;

    /// One frame; how many vertices it would draw.
    int frame(const Widgets& widgets);

    /// After the frames in which ImGui finds the sizes of new windows.
    int settled(const Widgets& widgets);

    /// All texts of a frame in its first window, those scrolled out of sight among them.
    std::string texts(const Widgets& widgets);

    /// Moves the pointer over a window until it is over the widget and clicks it. `within`: what ImGui::PushID was
    /// called with around it. False where it is not to be found.
    bool click(const char* window, const char* label, const Widgets& widgets);
    bool click(const char* window, const char* within, const char* label, const Widgets& widgets);

private:
    bool click_on(const char* window, unsigned widget, const Widgets& widgets);
};

} // namespace octant::tests
