#pragma once

#include <deque>

namespace octant::ui::window {

/// How much of the last two seconds a window flew. Turns that take very long count only in part, so
/// that the flight does not jump; time is lost then.
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

} // namespace octant::ui::window
