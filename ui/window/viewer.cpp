#include "ui/window/viewer.h"

#include "sim/base/error.h"
#include "ui/base/data_files.h"
#include "ui/flight/renderer_choice.h"
#include "ui/settings/settings_change.h"
#include "ui/window/camera_control.h"
#include "ui/window/gui.h"
#include "ui/window/panels.h"
#include "ui/world/sun_at_time.h"
#include "visuals/gl/make_renderer.h"
#include "visuals/gl/picture_painter.h"
#include "visuals/gl/window_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <fmt/format.h>
#include <thread>
#include <utility>

namespace octant::ui::window {

namespace scene = visuals::scene;
namespace gl = visuals::gl;

namespace {

/// Longer turns count as this long, so that the flight does not jump.
constexpr double max_frame_s = 0.25;
constexpr double message_s = 5.0;
constexpr double save_layout_every_s = 5.0;

std::unique_ptr<gl::WindowContext> open_window(const ViewOptions& options) {
    return gl::make_window_context({.size = options.settings.view.size_px, .title = "Octant"});
}

double refresh_hz_of(GLFWmonitor* monitor) {
    const GLFWvidmode* const mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    return mode == nullptr || mode->refreshRate <= 0 ? 60.0 : mode->refreshRate;
}

/// Where the settings ask for OpenGL or a GPU draws in the window; else the raster renderer does.
bool gl_draws(const gl::WindowContext& context, const settings::RunSettings& settings) {
    using settings::RendererKind;
    const RendererKind next_settings = settings.drawing.renderer;
    const bool gpu_draws = !context.info().is_software;
    return next_settings == RendererKind::Gl || (next_settings == RendererKind::Auto && gpu_draws);
}

} // namespace

Viewer::Viewer(const ViewOptions& options) : options_(options), sender_(options.send) {
    std::shared_ptr<gl::WindowContext> context = open_window(options);
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
        settings, flight::PictureContent::World, make_renderer(std::move(context), settings));
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
    clock_ = base::Stopwatch();
}

std::unique_ptr<scene::Renderer> Viewer::make_renderer(
    std::shared_ptr<gl::WindowContext> context, const settings::RunSettings& settings) {
    if (gl_draws(*context, settings)) {
        return gl::make_renderer(std::move(context), settings.view.size_px, settings.view.samples.value_or(1));
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
    if (state_.playback.advance(wall_s, open_ended) == Playback::TimeChange::Restarted) {
        go_to(state_.playback.begin_s);
    }
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
    const auto is_down = [&](A chosen_action) { return input_->is_down(state_.keys.key_of(chosen_action)); };
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
        world::with_sun_updated(std::move(next_settings), session_->settings(), session_->world().ground_place);
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
    const double time_s = ahead ? shown_s_ : next_s;
    session_->pictures().set_window_target(input_->size_px());
    report::FrameRecord record = session_->draw_at(time_s, ahead ? std::optional(next_s) : std::nullopt);
    const double now_s = clock_.s();
    record.latency_ms = 1000.0 * (now_s - (ahead ? shown_input_s_ : input_of_next_s));
    record.missed = presented_s_ > 0.0 && now_s - presented_s_ > 1.5 / refresh_hz_ ? 1 : 0;
    presented_s_ = now_s;
    sender_.send(*session_);
    shown_s_ = next_s;
    shown_input_s_ = input_of_next_s;
    state_.history.add(record);
    record_frame(record);
}

/// Waits for the display's next refresh where the driver does not do so itself.
void Viewer::wait_for_display(double turn_began_s) const {
    if (!state_.vsync) { return; }
    const double left_s = 1.0 / refresh_hz_ - (clock_.s() - turn_began_s);
    if (left_s > 0.0) { std::this_thread::sleep_for(std::chrono::duration<double>(left_s)); }
}

} // namespace octant::ui::window
