#pragma once

namespace octant::ui::window {

/// The state of playing a path: its time, speed and limits. It reads no clock; callers hand in how
/// much wall time has passed.
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

    /// How the time changed.
    enum class TimeChange {
        /// It went forward or stayed.
        Advanced,
        /// It jumped back to the beginning.
        Restarted
    };

    /// Lets `wall_s` seconds of wall time pass. At its end the path begins anew or stops, unless
    /// the flight is `open_ended`, as one by hand is.
    TimeChange advance(double wall_s, bool open_ended);

    /// Advances by one frame of `frame_s` simulated seconds and pauses.
    void step_frame(double frame_s, bool open_ended);

    /// Doubles the speed `steps` times, or halves it for negative `steps`, within its limits.
    void change_speed(int steps);
};

} // namespace octant::ui::window
