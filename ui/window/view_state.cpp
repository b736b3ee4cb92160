#include "ui/window/view_state.h"

#include "sim/base/units.h"
#include "ui/report/statistics.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace octant::ui::window {

namespace scene = visuals::scene;
using scene::View;
using settings::RunSettings;

void FrameHistory::add(const report::FrameRecord& record) {
    constexpr std::size_t renewed_every = 30;
    if (records_.size() == max_frames) { records_.erase(records_.begin()); }
    records_.push_back(record);
    if (added_++ % renewed_every == 0) { statistics_ = report::statistics_of(records_); }
}

void RealTimeFactor::add(double passed_s, double flown_s) {
    constexpr double looked_at_s = 2.0;
    turns_.push_back({passed_s, flown_s});
    passed_s_ += passed_s;
    flown_s_ += flown_s;
    while (turns_.size() > 1 && passed_s_ - turns_.front().passed_s >= looked_at_s) {
        passed_s_ -= turns_.front().passed_s;
        flown_s_ -= turns_.front().flown_s;
        turns_.pop_front();
    }
}

double RealTimeFactor::share() const { return passed_s_ > 0.0 ? std::clamp(flown_s_ / passed_s_, 0.0, 1.0) : 1.0; }

bool Playback::advance(double wall_s, bool open_ended) {
    if (!playing) { return false; }
    time_s += wall_s * speed;
    if (open_ended || time_s <= end_s) { return false; }
    time_s = loops ? begin_s : end_s;
    playing = loops;
    return loops;
}

void Playback::step_frame(double frame_s, bool open_ended) {
    playing = false;
    time_s = open_ended ? time_s + frame_s : std::min(time_s + frame_s, end_s);
}

void Playback::change_speed(int steps) { speed = std::clamp(speed * std::pow(2.0, steps), slowest, fastest); }

namespace {

/// How far the view turns for a drag over the whole height of the picture.
constexpr double drag_deg = 180.0;
constexpr double zoom_a_click = 1.15;
constexpr double steepest_deg = 89.0;
constexpr double move_mps = 60.0;
constexpr double fast_factor = 8.0;

double wrapped_deg(double deg) { return std::remainder(deg, 360.0); }

bool is_orbiting(View view) { return view == View::Chase || view == View::Orbit; }

/// Returns the direction in which the free camera looks, turned by azimuth and elevation.
glm::dvec3 ahead_of(const RunSettings& settings) {
    const glm::dvec3 straight = glm::normalize(*settings.view.look_m - *settings.view.eye_m);
    const double heading = std::atan2(straight.x, straight.y) + rad_from_deg(settings.view.azimuth_deg);
    const double up =
        std::clamp(std::asin(std::clamp(straight.z, -1.0, 1.0)) + rad_from_deg(settings.view.elevation_deg),
            -rad_from_deg(steepest_deg), rad_from_deg(steepest_deg));
    return {std::cos(up) * std::sin(heading), std::cos(up) * std::cos(heading), std::sin(up)};
}

} // namespace

RunSettings dragged(const RunSettings& settings, const glm::vec2& share_of_height) {
    RunSettings changed = settings;
    const double slower = is_orbiting(settings.view.kind) ? 1.0 : 1.0 / std::max(settings.view.zoom, 1.0);
    const double sense = is_orbiting(settings.view.kind) ? 1.0 : -1.0;
    changed.view.azimuth_deg =
        wrapped_deg(settings.view.azimuth_deg + sense * slower * drag_deg * static_cast<double>(share_of_height.x));
    changed.view.elevation_deg =
        std::clamp(settings.view.elevation_deg + slower * drag_deg * static_cast<double>(share_of_height.y),
            -steepest_deg, steepest_deg);
    return changed;
}

RunSettings zoomed(const RunSettings& settings, double clicks) {
    constexpr double least = 0.1;
    constexpr double most = 50.0;
    RunSettings changed = settings;
    changed.view.zoom = std::clamp(settings.view.zoom * std::pow(zoom_a_click, clicks), least, most);
    return changed;
}

RunSettings with_straight_look(const RunSettings& settings) {
    RunSettings changed = settings;
    changed.view.azimuth_deg = 0.0;
    changed.view.elevation_deg = 0.0;
    changed.view.zoom = 1.0;
    return changed;
}

RunSettings with_view(const RunSettings& settings, View view, const scene::Camera& camera) {
    constexpr double look_ahead_m = 1000.0;
    RunSettings changed = with_straight_look(settings);
    changed.view.kind = view;
    changed.view.eye_m.reset();
    changed.view.look_m.reset();
    if (view != View::Free && changed.view.inset == View::Free) { changed.view.inset.reset(); }
    if (view == View::Free) {
        changed.view.eye_m = camera.eye_m;
        changed.view.look_m = camera.eye_m + camera.view_to_world * glm::dvec3(0.0, 0.0, -look_ahead_m);
    }
    return changed;
}

RunSettings moved(const RunSettings& settings, const FreeMove& move, double wall_s) {
    const bool stands = move.right == 0 && move.up == 0 && move.ahead == 0;
    if (settings.view.kind != View::Free || stands) { return settings; }
    const glm::dvec3 ahead = ahead_of(settings);
    const glm::dvec3 right = glm::normalize(glm::dvec3(ahead.y, -ahead.x, 0.0));
    const glm::dvec3 way_m = wall_s * move_mps * (move.fast ? fast_factor : 1.0) *
                             (static_cast<double>(move.ahead) * ahead + static_cast<double>(move.right) * right +
                                 static_cast<double>(move.up) * glm::dvec3(0.0, 0.0, 1.0));
    RunSettings changed = settings;
    *changed.view.eye_m += way_m;
    *changed.view.look_m += way_m;
    return changed;
}

} // namespace octant::ui::window
