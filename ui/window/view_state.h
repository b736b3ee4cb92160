#pragma once

#include "ui/flight/id_comparison.h"
#include "ui/report/frame_record.h"
#include "ui/report/statistics.h"
#include "ui/settings/settings.h"
#include "ui/window/key_map.h"
#include "ui/window/panel_columns.h"
#include "visuals/scene/camera.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::window {

/// Holds the last frames of a window, oldest first.
class FrameHistory {
public:
    static constexpr std::size_t max_frames = 300;

    void add(const report::FrameRecord& record);

    bool empty() const { return records_.empty(); }

    const report::FrameRecord& last() const { return records_.back(); }

    std::span<const report::FrameRecord> records() const { return records_; }

    /// Returns the statistics of the frames that it holds, which are computed at every 30th frame.
    const report::Statistics& statistics() const { return statistics_; }

private:
    std::vector<report::FrameRecord> records_;
    report::Statistics statistics_;
    std::size_t added_ = 0;
};

/// How much of the last two seconds a window flew. Turns that take very long count only in part, so that the flight
/// does not jump; time is lost then.
class RealTimeFactor {
public:
    /// Adds a turn that took `passed_s`, of which `flown_s` count.
    void add(double passed_s, double flown_s);

    /// Returns the share of the time that was flown, from 0 to 1; 1 before any turn.
    double share() const;

private:
    struct Turn {
        double passed_s = 0.0;
        double flown_s = 0.0;
    };

    std::deque<Turn> turns_;
    double passed_s_ = 0.0;
    double flown_s_ = 0.0;
};

/// Below this share a person should know that the flight is slower than real time.
inline constexpr double full_speed_share = 0.97;

/// The state of playing a path: its time, speed and limits. It reads no clock; callers hand in how much wall time has
/// passed.
struct Playback {
    static constexpr double slowest = 0.1;
    static constexpr double fastest = 10.0;

    double begin_s = 0.0;
    double end_s = 0.0;
    /// Lies between begin_s and end_s. In a flight by hand it may pass the end.
    double time_s = 0.0;
    /// Simulated seconds in a second of wall time.
    double speed = 1.0;
    bool playing = true;
    bool loops = true;

    /// Lets `wall_s` seconds of wall time pass. At its end the path begins anew or stops, unless the flight is
    /// `open_ended`, as one by hand is. Returns whether it began anew.
    bool advance(double wall_s, bool open_ended);

    /// Advances by one frame of `frame_s` simulated seconds and pauses.
    void step_frame(double frame_s, bool open_ended);

    /// Doubles the speed `steps` times, or halves it for negative `steps`, within its limits.
    void change_speed(int steps);
};

/// What panels and keys ask for beside settings. The viewer fulfils requests before the next frame and clears them.
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

/// What a window knows beside its session: everything that keys, mouse and panels change.
struct ViewState {
    /// The settings of the next frame.
    settings::RunSettings next_settings;
    Playback playback;
    OpenPanels open;
    PanelColumns columns;
    KeyMap keys;
    /// Where a person's own keys are read from, and what was wrong in it; empty where nothing is kept.
    std::filesystem::path keys_file;
    bool keys_file_exists = false;
    std::vector<std::string> key_errors;
    ViewRequests requests;
    FrameHistory history;
    ViewMessage message;
    /// The painting order is written on the polygons of the first aircraft.
    bool order_numbers = false;
    /// Pixels of the last picture that the draw order got wrong, once counted.
    std::optional<flight::PixelCheck> pixel_check;
    bool vsync = true;
    RealTimeFactor real_time_factor;
    /// The file in which the settings panel saves settings and from which it loads them.
    std::string settings_file = "settings.json";
    /// The folder of the recording that is being made, if any.
    std::optional<std::filesystem::path> recording;
};

// What mouse and keys change of the camera's settings.

/// The directions in which the free camera is asked to move, each -1, 0 or 1, in its own axes.
struct FreeMove {
    int right = 0;
    int up = 0;
    int ahead = 0;
    bool fast = false;
};

/// Returns the settings after the pointer was dragged by these shares of the picture's height. The direction of view
/// turns, or the eye moves around the aircraft. Dragging right shows more of what is on the left, as a map is dragged.
settings::RunSettings dragged(const settings::RunSettings& settings, const glm::vec2& share_of_height);

/// Returns the settings after the wheel was turned by `clicks` towards the screen.
settings::RunSettings zoomed(const settings::RunSettings& settings, double clicks);

/// Returns the settings with the view turned straight ahead and a zoom of 1.
settings::RunSettings with_straight_look(const settings::RunSettings& settings);

/// Returns the settings with another view. A view that becomes the free one begins at the place of `camera`.
settings::RunSettings with_view(
    const settings::RunSettings& settings, visuals::scene::View view, const visuals::scene::Camera& camera);

/// Returns the settings after the free camera moved for `wall_s` seconds.
settings::RunSettings moved(const settings::RunSettings& settings, const FreeMove& move, double wall_s);

} // namespace octant::ui::window
