#pragma once

#include "sim/base/stopwatch.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/listener.h"
#include "ui/flight/sender.h"
#include "ui/flight/session.h"
#include "ui/settings/settings.h"
#include "ui/window/key_map.h"
#include "ui/window/panel_columns.h"
#include "ui/window/pilot_input.h"
#include "ui/window/view_state.h"
#include "ui/window/window_input.h"
#include "ui/window/window_recording.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace octant::visuals::gl {
class PicturePainter;
class WindowContext;
} // namespace octant::visuals::gl

namespace octant::ui::window {

class Gui;

/// How a viewer begins.
struct ViewOptions {
    /// Their view.size_px is the size of the window in the display's units.
    settings::RunSettings settings;
    bool full_screen = false;
    /// Pictures wait for the display's refresh; otherwise they follow each other at once.
    bool vsync = true;
    bool panels = true;
    /// The aircraft is flown by hand from the beginning, where it is level and in trim.
    bool by_hand = false;
    /// The folder of a recording that begins with the first frame.
    std::optional<std::filesystem::path> record;
    /// The folder in which recordings and pictures get folders of their own.
    std::filesystem::path recordings_folder;
    /// The user's own folder for the layout of panels and the mark that the first steps were shown; an empty path keeps
    /// nothing.
    std::filesystem::path config_folder;
    /// Others fly, by packets.
    std::optional<flight::ListenerOptions> listener;
    /// Does not say on standard error what comes from them.
    bool quiet = true;
    /// To whom pictures' aircraft are sent, as flight::Sender has it.
    std::vector<std::string> send;
};

/// A window in which a flight is seen and flown: keys, mouse and panels change a ViewState, the session draws what it
/// asks for.
class Viewer {
public:
    /// Opens the window and loads the world. Throws Error.
    explicit Viewer(const ViewOptions& options);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;
    Viewer(Viewer&&) = delete;
    Viewer& operator=(Viewer&&) = delete;

    /// Handles all input since the last turn and shows the next picture. Returns false when the window is to be closed.
    /// Throws Error (driver, disk full).
    bool run_frame();

    /// Shows frames until the window is closed, a stop signal comes or `frames` are shown. Completes the recording, of
    /// which a note says where it is, unless `quiet`.
    void run(const std::optional<int>& frames, bool quiet);

    /// Ends the recording, if there is one, and returns the line that says where its report is. Throws Error.
    std::optional<std::string> finish_recording();

    const Gui& gui() const { return *gui_; }

    flight::Session& session() { return *session_; }

    ViewState& state() { return state_; }

    GLFWwindow* window() const;

private:
    void handle_input(double wall_s);
    void read_layout();
    void read_keys();
    void save_layout() noexcept;
    bool should_close();
    void press(const WindowEvents::Key& key);
    void command(ViewCommand what);
    bool view_command(ViewCommand what);
    bool panel_command(ViewCommand what);
    void flight_command(ViewCommand what);
    void fly_by_hand(double wall_s, bool typing);
    void move_free_camera(double wall_s);
    void fit_to_window();
    void handle_requests();
    void handle_flight_requests(const ViewRequests& requests);
    void handle_file_requests(const ViewRequests& requests);
    void count_wrong_pixels();
    void toggle_manual_flight();
    void go_to(double time_s);
    void toggle_recording();
    void start_recording(const std::filesystem::path& folder);
    void take_screenshot();
    std::unique_ptr<visuals::scene::Renderer> make_window_renderer(
        std::shared_ptr<visuals::gl::WindowContext> context, const settings::RunSettings& settings);
    void present(visuals::scene::Renderer& renderer);
    void toggle_full_screen();
    void apply_next_settings();
    void restart_playback();
    void draw();
    void draw_live();
    void finish_picture(report::FrameRecord& record);
    void restart_live_flight();
    void start_live_recording(const std::filesystem::path& folder);
    std::string finish_live_recording();
    double receive_packets();
    void record_frame(const report::FrameRecord& record);
    void drop_recording();
    void show_message(const std::string& text);
    std::filesystem::path unused_path(const std::string& stem, const std::string& ending) const;
    void wait_for_display(double turn_began_s) const;

    ViewOptions options_;
    /// The session owns it.
    visuals::gl::WindowContext* context_ = nullptr;
    /// Shows the raster renderer's pictures; null where OpenGL draws.
    std::shared_ptr<visuals::gl::PicturePainter> painter_;
    std::unique_ptr<flight::Session> session_;
    /// Null where nobody else flies.
    std::unique_ptr<flight::Listener> listener_;
    flight::Sender sender_;
    std::optional<WindowInput> input_;
    std::unique_ptr<Gui> gui_;
    ViewState state_;
    std::optional<WindowRecording> recording_;
    /// Records a flight that other programs fly.
    std::optional<flight::FlightRecorder> live_recorder_;
    Stopwatch clock_;
    double last_frame_s_ = 0.0;
    /// Simulated time of the next picture.
    double shown_s_ = 0.0;
    /// When the input of the picture after the next was read.
    double input_s_ = 0.0;
    /// When the input of the next picture was read.
    double shown_input_s_ = 0.0;
    /// Buttons of the gamepad that were pressed a turn ago.
    GamepadButtons previous_pad_buttons_{};
    /// When the last picture was shown.
    double presented_s_ = 0.0;
    double refresh_hz_ = 60.0;
    /// What the file has; nothing where there is none yet.
    std::optional<PanelLayout> saved_layout_;
    double layout_saved_s_ = 0.0;
    /// The driver waits for the display's refresh.
    bool vsync_is_active_ = false;
    /// Place and size of the window before it filled the screen.
    glm::ivec2 windowed_position_{0};
    glm::ivec2 windowed_size_{0};
};

} // namespace octant::ui::window
