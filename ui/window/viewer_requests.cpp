#include "sim/base/error.h"
#include "sim/base/file_status.h"
#include "ui/base/data_files.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/id_comparison.h"
#include "ui/report/png_file.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/window/camera_control.h"
#include "ui/window/view_keys.h"
#include "ui/window/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::window {

namespace fs = std::filesystem;
namespace scene = visuals::scene;

namespace {

constexpr double skip_s = 2.0;

void next_inset(settings::RunSettings& settings) {
    using scene::View;
    constexpr std::array<std::optional<View>, 4> turns{std::nullopt, View::Chase, View::Cockpit, View::Tower};
    const auto at = std::ranges::find(turns, settings.view.inset);
    settings.view.inset = at == turns.end() || at + 1 == turns.end() ? turns.front() : *(at + 1);
}

void next_mesh_look(settings::RunSettings& settings) {
    using scene::MeshDisplay;
    settings.ground.show_mesh = settings.ground.show_mesh == MeshDisplay::None    ? MeshDisplay::Edges
                                : settings.ground.show_mesh == MeshDisplay::Edges ? MeshDisplay::Levels
                                                                                  : MeshDisplay::None;
}

} // namespace

void Viewer::press(const WindowEvents::Key& key) {
    if (const auto what = state_.keys.command_of(key.key, key.repeats)) { command(*what); }
}

/// Whoever uses a key has begun: the first steps no longer cover the picture.
void Viewer::command(ViewCommand what) {
    state_.open.first_steps = false;
    if (!view_command(what) && !panel_command(what)) { flight_command(what); }
}

/// Carries out a command that changes the view. Returns false for any other command.
bool Viewer::view_command(ViewCommand what) {
    using C = ViewCommand;
    using scene::View;
    constexpr std::array<std::pair<C, View>, 5> views{{{C::Cockpit, View::Cockpit}, {C::Chase, View::Chase},
        {C::Tower, View::Tower}, {C::Orbit, View::Orbit}, {C::Free, View::Free}}};
    const auto view = std::ranges::find(views, what, &std::pair<C, View>::first);
    if (view != views.end()) {
        state_.next_settings = with_view(state_.next_settings, view->second, session_->camera());
    } else if (what == C::NextInset) {
        next_inset(state_.next_settings);
    } else if (what == C::ResetLook) {
        state_.next_settings = with_straight_look(state_.next_settings);
    } else if (what == C::ShowMesh) {
        next_mesh_look(state_.next_settings);
    } else {
        return false;
    }
    return true;
}

/// Carries out a command that opens or closes panels. Returns false for any other command.
bool Viewer::panel_command(ViewCommand what) {
    using C = ViewCommand;
    constexpr std::array<std::pair<C, bool OpenPanels::*>, 8> panels{{{C::FlightPanel, &OpenPanels::flight},
        {C::TimingPanel, &OpenPanels::timing}, {C::TerrainPanel, &OpenPanels::terrain},
        {C::DrawOrderPanel, &OpenPanels::draw_order}, {C::AircraftPanel, &OpenPanels::aircraft},
        {C::ScenePanel, &OpenPanels::scene}, {C::SettingsPanel, &OpenPanels::settings}, {C::Help, &OpenPanels::help}}};
    OpenPanels& open = state_.open;
    const auto panel = std::ranges::find(panels, what, &std::pair<C, bool OpenPanels::*>::first);
    if (panel != panels.end()) {
        bool& is_open = open.*panel->second;
        is_open = !(is_open && open.shown);
        open.shown = open.shown || is_open;
    } else if (what == C::Panels) {
        open.shown = !open.shown;
    } else {
        return false;
    }
    return true;
}

void Viewer::flight_command(ViewCommand what) {
    using C = ViewCommand;
    Playback& playback = state_.playback;
    ViewRequests& requests = state_.requests;
    const bool at_the_end = playback.time_s >= playback.end_s && !session_->simulation().by_hand();
    switch (what) {
    case C::PlayOrPause:
        playback.playing = !playback.playing;
        if (playback.playing && at_the_end) { requests.go_to_s = playback.begin_s; }
        return;
    case C::StepFrame:
        requests.step_frame = true;
        return;
    case C::Slower:
        return playback.change_speed(-1);
    case C::Faster:
        return playback.change_speed(1);
    case C::Loop:
        playback.loops = !playback.loops;
        return;
    case C::ToBeginning:
        requests.go_to_s = playback.begin_s;
        return;
    case C::Back:
        requests.go_to_s = playback.time_s - skip_s;
        return;
    case C::Forward:
        requests.go_to_s = playback.time_s + skip_s;
        return;
    case C::ManualFlight:
        requests.toggle_manual_flight = true;
        return;
    case C::LevelOff:
        requests.level_off = true;
        return;
    case C::Record:
        requests.toggle_recording = true;
        return;
    case C::Screenshot:
        requests.screenshot = true;
        return;
    case C::FullScreen:
        requests.toggle_full_screen = true;
        return;
    case C::Leave:
        requests.leave = !std::exchange(state_.open.leave_question, false) && !std::exchange(state_.open.help, false);
        return;
    default:
        return;
    }
}

void Viewer::handle_requests() {
    const ViewRequests requests = std::exchange(state_.requests, ViewRequests());
    state_.requests.leave = requests.leave;
    state_.requests.leave_recording = requests.leave_recording;
    handle_flight_requests(requests);
    if (requests.toggle_recording) { toggle_recording(); }
    if (requests.screenshot) { take_screenshot(); }
    if (requests.toggle_full_screen) { toggle_full_screen(); }
    if (requests.count_wrong_pixels) { count_wrong_pixels(); }
    handle_file_requests(requests);
}

void Viewer::handle_flight_requests(const ViewRequests& requests) {
    if (listener_) {
        if (requests.toggle_manual_flight || requests.go_to_s) { show_message("others fly this aircraft"); }
        return;
    }
    if (requests.toggle_manual_flight) { toggle_manual_flight(); }
    flight::Simulation& simulation = session_->simulation();
    if (requests.level_off && simulation.by_hand()) {
        simulation.level_off();
        state_.playback.playing = true;
    }
    if (requests.step_frame) { state_.playback.step_frame(1.0 / session_->rate_hz(), simulation.by_hand()); }
    if (requests.go_to_s && recording_) {
        show_message("a recording goes on in time: stop it first (F9)");
    } else if (requests.go_to_s && simulation.by_hand()) {
        show_message("by hand there is no path to go along: H gives it back to its path");
    } else if (requests.go_to_s) {
        go_to(*requests.go_to_s);
    }
}

void Viewer::go_to(double time_s) {
    Playback& playback = state_.playback;
    playback.time_s = std::clamp(time_s, playback.begin_s, playback.end_s);
    if (recording_) { toggle_recording(); }
    session_->begin_at(playback.time_s);
    shown_s_ = playback.time_s;
}

/// Gives the aircraft to the pilot or back to the path, which goes on from where it is at that time.
void Viewer::toggle_manual_flight() {
    flight::Simulation& simulation = session_->simulation();
    if (!simulation.by_hand()) {
        simulation.advance_to(simulation.time_s());
        const std::string aircraft = settings::aircraft_shape(session_->settings().path.aircraft.front());
        const sim::AircraftKind& kind = base::aircraft_kind_of(aircraft);
        simulation.take_over(kind);
        state_.playback.playing = true;
        const KeyMap& keys = state_.keys;
        show_message(fmt::format("by hand{}: {}, {}, {} and {} are the stick, {} and {} the throttle, {} gives it back",
            aircraft == kind.name ? "" : fmt::format(" as an {}", kind.name), keys.name_of(HeldAction::Pull),
            keys.name_of(HeldAction::Push), keys.name_of(HeldAction::RollLeft), keys.name_of(HeldAction::RollRight),
            keys.name_of(HeldAction::ThrottleUp), keys.name_of(HeldAction::ThrottleDown),
            keys.name_of(ViewCommand::ManualFlight)));
        return;
    }
    go_to(state_.playback.time_s);
}

/// Returns the first of the paths stem-1, stem-2, ... that does not exist yet.
fs::path Viewer::unused_path(const std::string& stem, const std::string& ending) const {
    for (int number = 1;; ++number) {
        const fs::path path = options_.recordings_folder / fmt::format("{}-{}{}", stem, number, ending);
        if (!path_exists(path)) { return path; }
    }
}

void Viewer::take_screenshot() {
    const fs::path file = unused_path("picture", ".png");
    try {
        session_->read_picture();
        report::write_png(file, flight::pixel_view_of(session_->picture()));
        show_message(fmt::format("picture: {}", file.string()));
    } catch (const Error& fault) { show_message(fault.what()); }
}

void Viewer::count_wrong_pixels() {
    try {
        const flight::PixelCheck check = flight::check_pixels(*session_);
        state_.wrong_pixels = {check.wrong, check.differing, check.pixels};
    } catch (const Error& fault) { show_message(fault.what()); }
}

void Viewer::toggle_full_screen() {
    GLFWwindow* const window = this->window();
    if (glfwGetWindowMonitor(window) != nullptr) {
        glfwSetWindowMonitor(window, nullptr, windowed_position_.x, windowed_position_.y, windowed_size_.x,
            windowed_size_.y, GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* const mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    if (mode == nullptr) {
        show_message("expected a monitor to fill, got none");
        return;
    }
    glfwGetWindowPos(window, &windowed_position_.x, &windowed_position_.y);
    glfwGetWindowSize(window, &windowed_size_.x, &windowed_size_.y);
    glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

} // namespace octant::ui::window
