#pragma once

namespace octant::ui::window {

/// Where a path is being played. A value; wall time is handed in.
struct Playback {
    static constexpr double slowest = 0.1;
    static constexpr double fastest = 10.0;

    double begin_s = 0.0;
    double end_s = 0.0;
    double time_s = 0.0; ///< between begin_s and end_s; by hand it may pass the end
    double speed = 1.0;  ///< simulated seconds a second of wall time
    bool playing = true;
    bool loops = true;

    /// What happened to the time.
    enum class Moved {
        On,      ///< forward, or not at all
        Restarts ///< it jumped back to the beginning
    };

    /// Wall time passes. At the end it begins anew or stops. `open_ended`: there is no end, as by
    /// hand.
    Moved pass(double wall_s, bool open_ended);

    /// One frame of `frame_s` simulated seconds on, then paused.
    void step_frame(double frame_s, bool open_ended);

    /// `speed` doubled or halved `steps` times, within its limits.
    void change_speed(int steps);
};

} // namespace octant::ui::window
