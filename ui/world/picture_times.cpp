#include "ui/world/picture_times.h"

#include "sim/base/error.h"
#include "sim/trajectory.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::ui::world {

using settings::RunSettings;

namespace {

double first_time_s(const RunSettings& settings, const sim::Trajectory& path) {
    const double length_s = path.end_s() - path.start_s();
    if (settings.time.start_s > 0.0 && settings.time.start_s >= length_s) {
        throw Error(
            fmt::format("--start: expected less than the path's {} s, got {}", length_s, settings.time.start_s));
    }
    return path.start_s() + settings.time.start_s;
}

} // namespace

void PictureTimes::truncate_to(std::size_t frames) {
    if (frames < times_s.size()) {
        times_s.resize(frames);
        last_step_s = times_s.back();
    }
}

PictureTimes picture_times_of(const RunSettings& settings, const PlacedFlight& flight) {
    const sim::Trajectory& path = flight.trajectory;
    const double from_s = first_time_s(settings, path);
    PictureTimes times;
    times.rate_hz = settings.time.frame_per_sample ? flight.rate_hz : settings.time.rate_hz;
    times.last_step_s = settings.time.seconds ? std::min(path.end_s(), from_s + *settings.time.seconds) : path.end_s();
    if (settings.time.frame_per_sample) {
        const double half_frame_s = 0.5 / times.rate_hz;
        for (const sim::AircraftState& sample : path.samples()) {
            if (sample.time_s >= from_s && sample.time_s <= times.last_step_s + half_frame_s) {
                times.times_s.push_back(sample.time_s);
            }
        }
    } else {
        const auto count = static_cast<long>(std::floor((times.last_step_s - from_s) * times.rate_hz + 1e-6)) + 1;
        for (long frame = 0; frame < count; ++frame) {
            times.times_s.push_back(from_s + static_cast<double>(frame) / times.rate_hz);
        }
    }
    if (settings.time.frames) { times.truncate_to(static_cast<std::size_t>(*settings.time.frames)); }
    return times;
}

} // namespace octant::ui::world
