#include "tests/ui/window/driven_viewer.h"

#include "sim/base/output_file.h"
#include "tests/ui/flight/small_ground.h"

#include <cstdio>
#include <unistd.h>

namespace octant::tests {

namespace fs = std::filesystem;

ui::settings::RunSettings small_flight() {
    ui::settings::RunSettings settings;
    settings.view.size_px = {480, 360};
    settings.ground.triangles = 2000;
    settings.path.terrain = small_map();
    return settings;
}

std::unique_ptr<DrivenViewer> DrivenViewer::open(const ui::settings::RunSettings& settings, const std::string& layout) {
    std::unique_ptr<VirtualDisplay> display = VirtualDisplay::start();
    if (!display) {
        std::puts("SKIPPED: Xvfb is not installed");
        return nullptr;
    }
    return std::unique_ptr<DrivenViewer>(new DrivenViewer(std::move(display), settings, layout));
}

DrivenViewer::DrivenViewer(
    std::unique_ptr<VirtualDisplay> display, const ui::settings::RunSettings& settings, const std::string& layout)
    : display_(std::move(display)), folder_(fs::temp_directory_path() / ("octant-window-" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "kept");
    ui::window::ViewOptions options;
    options.settings = settings;
    options.panels = false;
    options.vsync = false;
    options.recordings_folder = folder_;
    options.config_folder = folder_ / "kept";
    if (!layout.empty()) { write_file(options.config_folder / "layout.ini", layout); }
    viewer_ = std::make_unique<ui::window::Viewer>(options);
    turns(3);
    display_->focus();
    turns(2);
}

DrivenViewer::~DrivenViewer() {
    viewer_.reset();
    fs::remove_all(folder_);
}

void DrivenViewer::turns(int count) {
    for (int i = 0; i < count; ++i) { viewer_->run_frame(); }
}

bool DrivenViewer::until(const std::function<bool()>& holds) {
    constexpr int most = 2000;
    for (int i = 0; i < most; ++i) {
        if (holds()) { return true; }
        viewer_->run_frame();
    }
    return false;
}

void DrivenViewer::strike(const std::string& key) {
    display_->strike(key);
    turns(3);
}

void DrivenViewer::hold(const std::string& key, double simulated_s) {
    const double until_s = viewer_->session().simulation().time_s() + simulated_s;
    display_->press(key);
    until([&] { return viewer_->session().simulation().time_s() >= until_s; });
    display_->release(key);
    turns(2);
}

void DrivenViewer::click(const glm::ivec2& at) {
    display_->move_pointer(at);
    turns(2);
    display_->press_button(1);
    turns(2);
    display_->release_button(1);
    turns(2);
}

void DrivenViewer::drag(const glm::ivec2& from, const glm::ivec2& to) {
    display_->move_pointer(from);
    turns(2);
    display_->press_button(1);
    turns(2);
    display_->move_pointer((from + to) / 2);
    turns(2);
    display_->move_pointer(to);
    turns(2);
    display_->release_button(1);
    turns(2);
}

const visuals::scene::Picture& DrivenViewer::picture() {
    viewer_->session().read_picture();
    return viewer_->session().picture();
}

} // namespace octant::tests
