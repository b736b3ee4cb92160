#pragma once

#include "ui/settings/settings.h"
#include "ui/window/frame_history.h"
#include "ui/window/key_map.h"
#include "ui/window/open_panels.h"
#include "ui/window/real_time_factor.h"
#include "ui/window/panel_columns.h"
#include "ui/window/playback.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::window {

/// What panels and keys ask for beside settings. The viewer fulfils requests before the next frame
/// and clears them.
struct ViewRequests {
    /// Go to this time of the path.
    std::optional<double> go_to_s;
    bool step_frame = false;
    bool toggle_manual_flight = false;
    bool level_off = false;
    bool toggle_recording = false;
    bool screenshot = false;
    bool toggle_full_screen = false;
    bool write_keys = false;
    bool leave = false;
    /// Leave although a recording is being made, which is ended whole.
    bool leave_recording = false;
    /// Compare the picture once with one that a depth buffer gives.
    bool count_wrong_pixels = false;
    std::optional<std::filesystem::path> save_settings;
    std::optional<std::filesystem::path> load_settings;
};

/// A line for a person, shown for some seconds.
struct ViewMessage {
    std::string text;
    /// The time on the window's clock when it disappears.
    double until_s = 0.0;
};

/// Pixels of the last picture that the draw order got wrong.
struct WrongPixels {
    long wrong = 0;
    /// The wrong pixels and those along edges, where two right pictures may differ.
    long differing = 0;
    long pixels = 0;
};

/// What a window knows beside its session: everything that keys, mouse and panels change.
struct ViewState {
    /// The settings of the next frame.
    settings::RunSettings next_settings;
    Playback playback;
    OpenPanels open;
    PanelColumns columns;
    KeyMap keys;
    /// Where a person's own keys are read from, and what was wrong in it; empty where nothing is
    /// kept.
    std::filesystem::path keys_file;
    bool keys_file_exists = false;
    std::vector<std::string> key_errors;
    ViewRequests requests;
    FrameHistory history;
    ViewMessage message;
    /// The painting order is written on the polygons of the first aircraft.
    bool order_numbers = false;
    std::optional<WrongPixels> wrong_pixels;
    bool vsync = true;
    RealTimeFactor real_time_factor;
    /// The file in which the settings panel saves settings and from which it loads them.
    std::string settings_file = "settings.json";
    /// The folder of the recording that is being made, if any.
    std::optional<std::filesystem::path> recording;
};

} // namespace octant::ui::window
