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
    bool shown = true; ///< false: all are hidden for now
    bool flight = true;
    bool timing = false;
    bool terrain = false;
    bool draw_order = false;
    bool aircraft = false;
    bool scene = false;
    bool settings = false;
    bool help = false;
    bool first_steps = false; ///< three lines on how to begin
};

/// What panels and keys ask for beside settings; taken up before the next frame and then cleared.
struct ViewRequests {
    std::optional<double> go_to_s; ///< a time of the path
    bool step_frame = false;
    bool toggle_hand = false;
    bool level_off = false;
    bool toggle_recording = false;
    bool screenshot = false;
    bool toggle_full_screen = false;
    bool leave = false;
    bool count_wrong_pixels = false; ///< against the depth buffer, once
    std::optional<std::filesystem::path> save_settings;
    std::optional<std::filesystem::path> load_settings;
};

/// A line for a person, shown for some seconds.
struct ViewMessage {
    std::string text;
    double until_s = 0.0; ///< of the window's clock
};

/// Pixels of the last picture that the draw order got wrong.
struct WrongPixels {
    long wrong = 0;
    long differing = 0; ///< with those along edges, where two right pictures may differ
    long pixels = 0;
};

/// What a window knows beside its session: everything that keys, mouse and panels change.
struct ViewState {
    settings::Settings wanted; ///< what the next frame shows
    Playback playback;
    OpenPanels open;
    ViewRequests requests;
    FrameHistory history;
    ViewMessage message;
    bool order_numbers = false; ///< on the polygons of the first aircraft
    std::optional<WrongPixels> wrong_pixels;
    bool vsync = true;
    std::string settings_file = "settings.json"; ///< where the panel saves settings and loads them
    std::optional<std::filesystem::path> recording; ///< where one is being written
};

} // namespace octant::ui::window
