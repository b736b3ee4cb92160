#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <octant/octant.h>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#pragma GCC visibility push(default)

/// Flights along paths and by hand, beside the pictures of octant.h.
namespace octant {

/// A setting of `octant fly`, as WorldSettings::settings and FlightSettings::settings take it.
struct SettingDescription {
    std::string name;    ///< without dashes before it, as "near-detail"
    std::string form;    ///< what its value is, as "METRES"; empty for settings that are true or false
    std::string meaning; ///< one line
};

/// All settings, in the order of the help of `octant fly`.
std::vector<SettingDescription> known_settings();

/// A flight as `octant fly` makes it.
struct FlightSettings {
    /// By name without dashes before it; several entries of one name where it takes several words, as "aircraft".
    std::vector<std::pair<std::string, std::string>> settings = {};
    /// The folder of a recording of the flight; empty = none.
    std::string record = {};
    /// Told about what is guessed or mended while loading; null = std::clog.
    std::function<void(std::string_view)> on_note = {};
};

/// What the stages of a picture took, milliseconds of wall time. These differ from run to run.
struct FrameTiming {
    double frame_ms = 0.0; ///< all of it
    double sim_ms = 0.0;   ///< moving the aircraft
    double plan_ms = 0.0;  ///< finding out what is drawn, and in which order
    double draw_ms = 0.0;
    double read_ms = 0.0; ///< copying the picture
};

/// Flies a path picture by picture, with the pictures and states of `octant fly` with the same settings. For one thread
/// at a time, of the process that made it: a forked child can only destroy it.
class Flight {
public:
    /// Loads everything. Throws Error.
    explicit Flight(const FlightSettings& settings);
    /// A recording that finish() did not end stays what it is, as that of a killed flight.
    ~Flight();
    Flight(const Flight&) = delete;
    Flight& operator=(const Flight&) = delete;
    Flight(Flight&&) noexcept;
    Flight& operator=(Flight&&) noexcept;

    std::size_t frame_count() const;
    int width() const;
    int height() const;

    /// Draws the next frame, which the functions below then tell about; false after the last one. Throws Error.
    bool next();
    /// Ends the recording, if there is one, after the last frame or before, and writes its report. Nothing may be drawn
    /// after it. Throws Error.
    void finish();

    /// The number of the frame, from 0.
    std::size_t frame() const;
    double time_s() const;
    /// Three bytes a pixel, rows from the top, `width() * height() * 3` in all.
    std::span<const std::uint8_t> rgb() const;
    /// Of all aircraft.
    std::span<const State> states() const;
    const FrameTiming& timing() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Writes one page of one or several recordings, as `octant report` does. A recording is a folder, a packed recording
/// or a file of frame times that another program captured. Throws Error.
void write_report(std::span<const std::string> recordings, const std::string& file);

/// The path of the first aircraft of a world, as its settings `path`, `place` and `heading` lay it over the ground: a
/// state each 1 / rate_hz seconds from its start, and the one at its end. Throws Error for a world without a path
/// and for a rate that is not above 0 and at most 1,000.
std::vector<State> path_states(const World& world, double rate_hz);

/// What a pilot asks of the aircraft. Values outside their range are clamped; not-a-numbers count as 0.
struct Controls {
    double roll = 0.0;     ///< from -1, left, to 1, right
    double pitch = 0.0;    ///< from -1, pushed, to 1, pulled
    double throttle = 0.0; ///< from 0, idle or the lowest collective, to 1, full
    double yaw = 0.0;      ///< from -1, left, to 1, right
};

/// An aircraft that is flown by hand, in fixed steps of 1/120 s. The same start and controls give the same states.
class PilotedAircraft {
public:
    /// `aircraft` is the name of a built-in one, as "f15". It goes on from `start` as that is: position, velocity,
    /// attitude and load factor. Throws Error for another name.
    PilotedAircraft(const std::string& aircraft, const State& start);
    ~PilotedAircraft();
    PilotedAircraft(const PilotedAircraft&) = delete;
    PilotedAircraft& operator=(const PilotedAircraft&) = delete;
    PilotedAircraft(PilotedAircraft&&) noexcept;
    PilotedAircraft& operator=(PilotedAircraft&&) noexcept;

    /// Flies on for this many steps with these controls.
    void advance(const Controls& controls, int steps = 1);
    State state() const;
    /// The throttle that holds speed and height from the start on with centred controls.
    double trim_throttle() const;
    /// Whether more lift is asked for than the wing has.
    bool is_stalled() const;
    /// Whether load factor, roll rate, bank, speed or climb is held at its limit.
    bool is_at_limit() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

inline constexpr int steps_per_second = 120;

} // namespace octant

#pragma GCC visibility pop
