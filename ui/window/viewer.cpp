#include "ui/window/viewer.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/id_comparison.h"
#include "ui/flight/renderer_choice.h"
#include "ui/report/png_file.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_file.h"
#include "ui/window/gui.h"
#include "ui/window/key_map.h"
#include "ui/window/panels.h"
#include "ui/window/view_state.h"
#include "ui/world/input_files.h"
#include "ui/world/scene_ground.h"
#include "visuals/gl/gl_renderer.h"
#include "visuals/gl/picture_painter.h"
#include "visuals/gl/window_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <exception>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

namespace octant::ui::window {

namespace fs = std::filesystem;
namespace gl = visuals::gl;
namespace scene = visuals::scene;

namespace {

/// Longer turns count as this long, so that the flight does not jump.
constexpr double max_frame_s = 0.25;
constexpr double message_s = 5.0;
constexpr double save_layout_every_s = 5.0;

double refresh_hz_of(GLFWmonitor* monitor) {
    const GLFWvidmode* const mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    return mode == nullptr || mode->refreshRate <= 0 ? 60.0 : mode->refreshRate;
}

/// Where the settings ask for OpenGL or a GPU draws in the window; else the raster renderer does.
bool gl_draws(const gl::WindowContext& context, const settings::RunSettings& settings) {
    using settings::RendererKind;
    const RendererKind wanted = settings.drawing.renderer;
    const bool gpu_draws = !context.info().is_software;
    return wanted == RendererKind::Gl || (wanted == RendererKind::Auto && gpu_draws);
}

} // namespace

Viewer::Viewer(const ViewOptions& options) : options_(options), sender_(options.send) {
    std::shared_ptr<gl::WindowContext> context =
        gl::make_window_context({.size = options.settings.view.size_px, .title = "Octant"});
    context_ = context.get();
    input_.emplace(context_->window());
    settings::RunSettings settings = options.settings;
    settings.drawing.context = settings::ContextKind::Window;
    if (options.listener) {
        listener_ = std::make_unique<flight::Listener>(*options.listener);
        settings.path.name = settings::live_path;
    }
    settings.view.size_px = input_->size_px();
    session_ = std::make_unique<flight::Session>(
        settings, flight::PictureContent::World, make_window_renderer(std::move(context), settings));
    session_->pictures().set_presenter([this](scene::Renderer& renderer) { present(renderer); });
    read_layout();
    read_keys();
    gui_ = std::make_unique<Gui>(*context_);
    refresh_hz_ = refresh_hz_of(glfwGetPrimaryMonitor());
    state_.next_settings = settings;
    state_.vsync = options.vsync;
    state_.open.shown = options.panels;
    state_.open.flight = !options.listener;
    restart_playback();
    restart_live_flight();
    if (options.by_hand) {
        toggle_manual_flight();
        session_->simulation().start_level();
    }
    if (options.full_screen) { toggle_full_screen(); }
    for (const std::string& note : session_->world().notes) { show_message(note); }
    if (options.record) { start_recording(*options.record); }
    clock_ = Stopwatch();
}

std::unique_ptr<scene::Renderer> Viewer::make_window_renderer(
    std::shared_ptr<gl::WindowContext> context, const settings::RunSettings& settings) {
    if (gl_draws(*context, settings)) {
        return gl::make_gl_renderer(std::move(context), settings.view.size_px, settings.view.samples.value_or(1));
    }
    painter_ = std::make_shared<gl::PicturePainter>(std::move(context));
    return flight::make_raster_renderer(settings, painter_);
}

void Viewer::present(scene::Renderer& renderer) {
    const glm::ivec2 size_px = input_->size_px();
    if (painter_ && renderer.is_drawn_to_window() && painter_->presents_directly(size_px)) {
        gui_->draw_into(painter_->pixels(), size_px);
        renderer.copy_to_window(size_px);
        return;
    }
    if (painter_ ? renderer.is_drawn_to_window() : !renderer.is_drawn_to_window()) { renderer.copy_to_window(size_px); }
    gui_->draw(size_px);
    context_->swap_buffers();
}

GLFWwindow* Viewer::window() const { return context_->window(); }

Viewer::~Viewer() {
    save_layout();
    try {
        finish_recording();
    } catch (const std::exception&) {
        // The frames so far are on the disk: octant report makes the rest of them.
    }
}

void Viewer::show_message(const std::string& text) { state_.message = {text, clock_.s() + message_s}; }

void Viewer::restart_playback() {
    const sim::Trajectory& path = session_->world().flight.trajectory;
    Playback& playback = state_.playback;
    playback.begin_s = path.start_s();
    playback.end_s = path.end_s();
    playback.time_s = session_->simulation().time_s();
    shown_s_ = playback.time_s;
}

/// Lets others fly what is loaded now, where there are others.
void Viewer::restart_live_flight() {
    if (listener_) {
        listener_->attach(*session_);
        state_.playback.playing = true;
    }
}

void Viewer::run(const std::optional<int>& frames, bool quiet) {
    const base::StopSignals stop_signals;
    int shown = 0;
    while (run_frame() && !base::StopSignals::received()) {
        if (frames && ++shown >= *frames) { break; }
    }
    if (const auto report = finish_recording()) { base::print_note(quiet, *report); }
}

bool Viewer::run_frame() {
    const double now_s = clock_.s();
    const double passed_s = now_s - last_frame_s_;
    const double wall_s = std::min(passed_s, max_frame_s);
    if (state_.playback.playing) { state_.real_time_factor.add(passed_s, wall_s); }
    last_frame_s_ = now_s;
    if (std::exchange(vsync_is_active_, state_.vsync) != state_.vsync) { context_->wait_for_refresh(state_.vsync); }
    glfwPollEvents();
    fit_to_window();
    gui_->begin_frame();
    handle_input(wall_s);
    all_panels(state_, *session_, now_s);
    gui_->end_frame();
    handle_requests();
    apply_next_settings();
    if (state_.playback.playing && session_->simulation().end_of_flight()) {
        state_.playback.playing = false;
        show_message(session_->simulation().end_of_flight() == flight::Simulation::End::OffTheMap
                         ? "the edge of the map ends the flight: H goes back to the path"
                         : "the ground ends the flight: T flies on above it, H goes back to the path");
    }
    const bool open_ended = session_->simulation().by_hand() || listener_ != nullptr;
    if (state_.playback.advance(wall_s, open_ended)) { go_to(state_.playback.begin_s); }
    if (listener_) {
        draw_live();
    } else {
        draw();
    }
    wait_for_display(now_s);
    if (now_s - layout_saved_s_ > save_layout_every_s && state_.columns.user_placed() != saved_layout_) {
        save_layout();
    }
    return !should_close();
}

/// Whether the window was told to close. While a recording is being made, the first time only asks.
bool Viewer::should_close() {
    const bool by_display = glfwWindowShouldClose(window()) != GLFW_FALSE;
    if (!by_display && !state_.requests.leave && !state_.requests.leave_recording) { return false; }
    const bool asked = state_.open.leave_question && by_display;
    if ((!recording_ && !live_recorder_) || asked || state_.requests.leave_recording) { return true; }
    state_.requests.leave = false;
    state_.open.leave_question = true;
    glfwSetWindowShouldClose(window(), GLFW_FALSE);
    return false;
}

/// Makes the picture as large as the window. Nothing changes while the window is minimised.
void Viewer::fit_to_window() {
    const glm::ivec2 size_px = input_->size_px();
    if (size_px.x > 0 && size_px.y > 0) {
        constexpr glm::ivec2 min_px(16);
        state_.next_settings.view.size_px = glm::max(size_px, min_px);
    }
}

void Viewer::handle_input(double wall_s) {
    const WindowEvents events = input_->take();
    input_s_ = clock_.s();
    const bool typing = gui_->wants_keys();
    if (!typing) {
        for (const WindowEvents::Key& key : events.keys) { press(key); }
        move_free_camera(wall_s);
    }
    const GamepadButtons pressed = input_->pad_buttons();
    for (const ViewCommand what : pad_commands(state_.keys, previous_pad_buttons_, pressed)) { command(what); }
    previous_pad_buttons_ = pressed;
    fly_by_hand(wall_s, typing);
    if (!gui_->wants_pointer()) {
        const auto height = static_cast<float>(std::max(input_->size().y, 1));
        if (events.dragged != glm::vec2(0.0F)) {
            state_.next_settings = dragged(state_.next_settings, events.dragged / height);
        }
        if (events.wheel_clicks != 0.0) { state_.next_settings = zoomed(state_.next_settings, events.wheel_clicks); }
    }
}

void Viewer::move_free_camera(double wall_s) {
    using A = HeldAction;
    const auto is_down = [&](A action) { return input_->is_down(state_.keys.key_of(action)); };
    const auto sense = [&](A more, A less) {
        return static_cast<int>(is_down(more)) - static_cast<int>(is_down(less));
    };
    const FreeMove move{.right = sense(A::CameraRight, A::CameraLeft),
        .up = sense(A::CameraUp, A::CameraDown),
        .ahead = sense(A::CameraAhead, A::CameraBack),
        .fast = is_down(A::CameraFast)};
    state_.next_settings = moved(state_.next_settings, move, wall_s);
}

void Viewer::fly_by_hand(double wall_s, bool typing) {
    flight::Simulation& simulation = session_->simulation();
    if (!simulation.by_hand()) { return; }
    PilotDevices devices = input_->pilot_devices(state_.keys);
    if (typing) { devices.keys = {}; }
    if (simulation.is_levelling() && !moves_controls(devices)) { return; }
    simulation.set_controls(controls_after(simulation.controls(), devices, wall_s));
}

void Viewer::apply_next_settings() {
    using scene::View;
    settings::RunSettings& next_settings = state_.next_settings;
    if (next_settings.view.kind != session_->settings().view.kind &&
        (next_settings.view.kind == View::Free) != (next_settings.view.eye_m && next_settings.view.look_m)) {
        next_settings = with_view(next_settings, next_settings.view.kind, session_->camera());
    }
    if (live_recorder_) { // A replay knows one view.
        next_settings = session_->settings();
        return;
    }
    if (listener_) { next_settings.path.name = settings::live_path; }
    next_settings =
        world::with_sun_updated(std::move(next_settings), session_->settings(), session_->world().ground.place);
    if (next_settings == session_->settings()) { return; }
    const bool other_flight =
        settings::change_between(session_->settings(), state_.next_settings) >= settings::SettingsChange::World;
    try {
        if (other_flight && recording_) { throw Error("a recording keeps what is loaded: stop it first (F9)"); }
        session_->apply(state_.next_settings);
    } catch (const Error& fault) {
        show_message(fault.what());
        const glm::ivec2 size_px = state_.next_settings.view.size_px;
        state_.next_settings = session_->settings();
        state_.next_settings.view.size_px = size_px;
        return;
    }
    state_.next_settings.air = session_->settings().air; // another place has another sun at its time
    if (other_flight) {
        restart_playback();
        restart_live_flight();
    }
}

/// Shows the picture whose time was chosen a turn ago, and begins the ground of the next one, where the ground is
/// meshed ahead.
void Viewer::draw() {
    const double next_s = state_.playback.time_s;
    const bool ahead = session_->settings().ground.mesh_async;
    const double input_of_next_s = input_s_;
    session_->pictures().set_window_target(input_->size_px());
    report::FrameRecord record =
        session_->draw_at(ahead ? shown_s_ : next_s, ahead ? std::optional(next_s) : std::nullopt);
    record.latency_ms = 1000.0 * (clock_.s() - (ahead ? shown_input_s_ : input_of_next_s));
    shown_s_ = next_s;
    shown_input_s_ = input_of_next_s;
    finish_picture(record);
}

/// Shows what other programs have sent up to now.
void Viewer::draw_live() {
    const double time_s = receive_packets();
    for (const std::string& line : listener_->take_new_messages()) { base::print_note(options_.quiet, line); }
    state_.next_settings.air = session_->settings().air; // a host may have told another
    const bool records = live_recorder_.has_value();
    session_->pictures().set_reads_before_presenting(records);
    session_->pictures().set_window_target(records && !painter_ ? glm::ivec2(0) : input_->size_px());
    report::FrameRecord record = session_->draw_at(time_s, std::nullopt);
    listener_->finish_picture(record);
    finish_picture(record);
}

/// Sends and records what was drawn.
void Viewer::finish_picture(report::FrameRecord& record) {
    const double now_s = clock_.s();
    record.missed = presented_s_ > 0.0 && now_s - presented_s_ > 1.5 / refresh_hz_ ? 1 : 0;
    presented_s_ = now_s;
    sender_.send(*session_);
    state_.history.add(record);
    record_frame(record);
}

/// Returns the time of the next picture. A recording that can no longer be written ends; the window does not.
double Viewer::receive_packets() {
    try {
        return *listener_->take(*session_); // not in steps: always a picture
    } catch (const Error& fault) {
        if (!live_recorder_) { throw; }
        drop_recording();
        show_message(fault.what());
        return *listener_->take(*session_);
    }
}

/// Waits for the display's next refresh where the driver does not do so itself.
void Viewer::wait_for_display(double turn_began_s) const {
    if (!state_.vsync) { return; }
    const double left_s = 1.0 / refresh_hz_ - (clock_.s() - turn_began_s);
    if (left_s > 0.0) { std::this_thread::sleep_for(std::chrono::duration<double>(left_s)); }
}

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
    constexpr std::array<std::pair<C, bool ViewRequests::*>, 6> requested{
        {{C::StepFrame, &ViewRequests::step_frame}, {C::ManualFlight, &ViewRequests::toggle_manual_flight},
            {C::LevelOff, &ViewRequests::level_off}, {C::Record, &ViewRequests::toggle_recording},
            {C::Screenshot, &ViewRequests::screenshot}, {C::FullScreen, &ViewRequests::toggle_full_screen}}};
    const auto request = std::ranges::find(requested, what, &std::pair<C, bool ViewRequests::*>::first);
    if (request != requested.end()) {
        requests.*request->second = true;
        return;
    }
    switch (what) {
    case C::PlayOrPause:
        playback.playing = !playback.playing;
        if (playback.playing && at_the_end) { requests.go_to_s = playback.begin_s; }
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
        state_.pixel_check = flight::check_pixels(*session_);
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

/// Before the first picture: a replay begins there, too. Pictures are drawn again without a window.
void Viewer::start_live_recording(const fs::path& folder) {
    settings::RunSettings settings = world::with_absolute_paths(session_->settings());
    settings.drawing.context = settings::ContextKind::OsMesa;
    live_recorder_.emplace(flight::RecordOptions{.folder = folder, .video = {}, .replay_of = {}, .machine_sharing = {}},
        settings, *session_);
    listener_->start_packet_recording(folder);
    state_.recording = folder;
    show_message(fmt::format("recording into {}: the view stays as it is", folder.string()));
}

std::string Viewer::finish_live_recording() {
    listener_->finish();
    const flight::FlightResult end = live_recorder_->finish(*session_);
    live_recorder_.reset();
    state_.recording.reset();
    return end.notes.back();
}

void Viewer::start_recording(const fs::path& folder) {
    if (listener_) {
        start_live_recording(folder);
        return;
    }
    recording_.emplace(folder, *session_);
    state_.recording = recording_->folder();
    show_message(fmt::format("recording into {}", folder.string()));
}

std::optional<std::string> Viewer::finish_recording() {
    if (live_recorder_) { return finish_live_recording(); }
    if (!recording_) { return std::nullopt; }
    const std::string line = recording_->finish(*session_);
    recording_.reset();
    state_.recording.reset();
    return line;
}

void Viewer::toggle_recording() {
    if (listener_ && !live_recorder_) {
        show_message("flights of others are recorded from their first picture on: octant listen --record");
        return;
    }
    try {
        if (const auto report = finish_recording()) {
            show_message(*report);
        } else {
            start_recording(unused_path("flight", ""));
        }
    } catch (const Error& fault) {
        drop_recording();
        show_message(fault.what());
    }
}

/// Gives up the recording. The files that it has written so far stay.
void Viewer::drop_recording() {
    recording_.reset();
    live_recorder_.reset();
    if (listener_) { listener_->drop_recording(); }
    state_.recording.reset();
    session_->simulation().stop_log();
}

void Viewer::record_frame(const report::FrameRecord& record) {
    try {
        if (recording_) { recording_->add(record, *session_); }
        if (live_recorder_) {
            session_->read_picture();
            live_recorder_->add(record, *session_);
        }
    } catch (const Error& fault) {
        drop_recording();
        show_message(fault.what());
    }
}

namespace {

constexpr std::size_t largest_layout_bytes = std::size_t{64} << 10;

} // namespace

/// Shows the first steps once for each user. Where the user's folder cannot be written, nothing is kept and the viewer
/// works all the same.
void Viewer::read_layout() {
    if (options_.config_folder.empty()) { return; }
    const fs::path file = options_.config_folder / "layout.ini";
    try {
        make_folder(options_.config_folder);
        state_.open.first_steps = !path_exists(file);
        if (!state_.open.first_steps) {
            saved_layout_ = layout_from(read_text_file(file, largest_layout_bytes));
            state_.columns.restore_user_placed(*saved_layout_);
        }
    } catch (const Error&) {
        // Panels lie where they lie for a new user; the file is written anew.
    }
}

/// Lines of the file of keys that are wrong are told and left out.
void Viewer::read_keys() {
    if (options_.config_folder.empty()) { return; }
    state_.keys_file = options_.config_folder / "keys";
    state_.keys_file_exists = path_exists(state_.keys_file);
    KeyMapFile read = read_key_map(state_.keys_file);
    state_.keys = std::move(read.keys);
    state_.key_errors = std::move(read.errors);
    input_->set_look_button(state_.keys.look_button);
    for (const std::string& fault : state_.key_errors) { base::print_note(false, fault); }
}

void Viewer::save_layout() noexcept {
    layout_saved_s_ = last_frame_s_;
    if (options_.config_folder.empty()) { return; }
    try {
        saved_layout_ = state_.columns.user_placed();
        write_file(options_.config_folder / "layout.ini", text_of_layout(*saved_layout_));
    } catch (const std::exception&) { options_.config_folder.clear(); }
}

void Viewer::handle_file_requests(const ViewRequests& requests) {
    try {
        if (requests.write_keys) {
            write_file(state_.keys_file, text_of_key_map(state_.keys));
            state_.keys_file_exists = true;
            show_message(fmt::format("keys: {}", state_.keys_file.string()));
        }
        if (requests.save_settings) {
            settings::RunSettings saved = world::with_absolute_paths(session_->settings());
            saved.drawing.context = settings::ContextKind::OsMesa;
            write_file(*requests.save_settings, settings::settings_json(saved).dump(2) + "\n");
            show_message(fmt::format("settings: {}", requests.save_settings->string()));
        }
        if (requests.load_settings) {
            std::vector<std::string> notes;
            state_.next_settings = settings::read_settings(*requests.load_settings, &notes);
            for (const std::string& note : notes) { show_message(note); }
            state_.next_settings.drawing.context = settings::ContextKind::Window;
            fit_to_window();
        }
    } catch (const Error& fault) { show_message(fault.what()); }
}

} // namespace octant::ui::window
