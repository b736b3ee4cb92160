#pragma once

#include "ui/settings/settings.h"
#include "ui/window/frame_history.h"
#include "ui/window/playback.h"

#include <filesystem>
#include <optional>
#include <string>

namespace octant::ui::window {

/// Which panels are open.
struct OpenPanels {
    /// While this is false, no panel is shown.
    bool shown = true;
    bool flight = true;
    bool timing = false;
    bool terrain = false;
    bool draw_order = false;
    bool aircraft = false;
    bool scene = false;
    bool settings = false;
    bool help = false;
    /// A panel of three lines on how to begin.
    bool first_steps = false;
};

/// What panels and keys ask for beside settings. The viewer fulfils requests before the next frame
/// and clears them.
struct ViewRequests {
    /// Go to this time of the path.
    std::optional<double> go_to_s;
    bool step_frame = false;
    bool toggle_hand = false;
    bool level_off = false;
    bool toggle_recording = false;
    bool screenshot = false;
    bool toggle_full_screen = false;
    bool leave = false;
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
    settings::RunSettings wanted;
    Playback playback;
    OpenPanels open;
    ViewRequests requests;
    FrameHistory history;
    ViewMessage message;
    /// The painting order is written on the polygons of the first aircraft.
    bool order_numbers = false;
    std::optional<WrongPixels> wrong_pixels;
    bool vsync = true;
    /// The file in which the settings panel saves settings and from which it loads them.
    std::string settings_file = "settings.json";
    /// The folder of the recording that is being made, if any.
    std::optional<std::filesystem::path> recording;
};

} // namespace octant::ui::window
