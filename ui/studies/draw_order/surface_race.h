#pragma once

#include "ui/settings/settings.h"
#include "ui/studies/draw_order/raster_modes.h"

#include <array>
#include <string>
#include <vector>

namespace octant::ui::studies::draw_order {

/// The three ways of removing hidden surfaces that are raced, in this order everywhere.
inline constexpr std::array raced_methods = {visuals::scene::HiddenSurface::Octant,
    visuals::scene::HiddenSurface::BackFace, visuals::scene::HiddenSurface::DepthBuffer};

/// Frame times of one way.
struct RaceTimes {
    double median_ms = 0.0;
    double p99_ms = 0.0;
    int draw_calls = 0; ///< median over the frames
};

/// One scene, drawn by the three ways in turn, frame by frame, so that they see the same machine.
struct Race {
    std::string scene;
    int aircraft = 0;
    int width_px = 0;
    int height_px = 0;
    int frames = 0;
    std::array<RaceTimes, raced_methods.size()> gl_times; ///< by OpenGL
    RasterTimes raster;

    /// Frames a second of octant order over those of another way, by medians; above 1: octant is faster.
    double against(std::size_t mode) const { return gl_times[mode].median_ms / gl_times[0].median_ms; }
};

/// Races the three ways over `frames` frames of a run after a warm-up. Throws Error.
Race race(const settings::RunSettings& settings, int frames, bool quiet);

} // namespace octant::ui::studies::draw_order
