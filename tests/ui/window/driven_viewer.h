#pragma once

#include "tests/ui/window/virtual_display.h"
#include "ui/window/viewer.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace octant::tests {

/// A window on a display of its own, driven as a person does.
class DrivenViewer {
public:
    /// A window of a user whose layout.ini holds `layout`, of a new user where that is empty. Returns nothing, and
    /// prints a line that says so, where no display can be started.
    static std::unique_ptr<DrivenViewer> open(
        const ui::settings::RunSettings& settings, const std::string& layout = "");

    ui::window::Viewer& viewer() { return *viewer_; }

    ui::window::ViewState& state() { return viewer_->state(); }

    const ui::settings::RunSettings& settings() { return viewer_->session().settings(); }

    VirtualDisplay& display() { return *display_; }

    /// Where recordings and pictures go; gone with the object.
    const std::filesystem::path& folder() const { return folder_; }

    void turns(int count);

    /// Turns until it holds; false after too many of them.
    bool until(const std::function<bool()>& holds);

    /// Strikes a key and turns until the window has seen it.
    void strike(const std::string& key);

    /// Holds a key for so much simulated time.
    void hold(const std::string& key, double simulated_s);

    void click(const glm::ivec2& at);
    void drag(const glm::ivec2& from, const glm::ivec2& to);

    /// The session's picture, top row first.
    const visuals::scene::Picture& picture();

    ~DrivenViewer();
    DrivenViewer(const DrivenViewer&) = delete;
    DrivenViewer& operator=(const DrivenViewer&) = delete;
    DrivenViewer(DrivenViewer&&) = delete;
    DrivenViewer& operator=(DrivenViewer&&) = delete;

private:
    DrivenViewer(
        std::unique_ptr<VirtualDisplay> display, const ui::settings::RunSettings& settings, const std::string& layout);

    std::unique_ptr<VirtualDisplay> display_;
    std::filesystem::path folder_;
    std::unique_ptr<ui::window::Viewer> viewer_;
};

/// A small, quick flight over hills.
ui::settings::RunSettings small_flight();

} // namespace octant::tests
