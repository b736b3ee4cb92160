#pragma once

#include "ui/flight/session.h"
#include "ui/report/html_text.h"
#include "ui/settings/settings.h"
#include "visuals/raster/renderer.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::studies::draw_order {

/// A hidden-surface method of the raster renderer.
struct RasterMode {
    const char* name;
    visuals::scene::HiddenSurface hidden_surface;
    visuals::raster::Renderer::PaintDirection paint_direction = visuals::raster::Renderer::PaintDirection::NearToFar;
    int samples = 1;
};

/// The methods compared; tables and arrays use this order.
inline constexpr std::array raster_modes{RasterMode{"octant, near to far", visuals::scene::HiddenSurface::Octant},
    RasterMode{"octant, far to near", visuals::scene::HiddenSurface::Octant,
        visuals::raster::Renderer::PaintDirection::FarToNear},
    RasterMode{"back faces only", visuals::scene::HiddenSurface::BackFace},
    RasterMode{"depth buffer", visuals::scene::HiddenSurface::DepthBuffer},
    RasterMode{"octant, 16 samples", visuals::scene::HiddenSurface::Octant,
        visuals::raster::Renderer::PaintDirection::NearToFar, 16}};
inline constexpr std::size_t raster_depth_buffer = 3; ///< index into raster_modes

/// A session that draws a run in such a way. Throws Error.
std::unique_ptr<flight::Session> raster_session(const settings::RunSettings& settings, const RasterMode& mode);

/// Times of one run in all ways.
struct RasterTimes {
    std::array<std::vector<double>, raster_modes.size()> draw_ms;
    std::array<std::vector<double>, raster_modes.size()> frame_ms;

    /// A frame of one way.
    void add(std::size_t mode, const report::FrameRecord& record);
};

/// A row for each run: `names` are the first cells of each, `name_header` what they are. Medians of drawing, from the
/// plan to pixels in memory, and how many times longer the depth buffer takes, for drawing and for the whole frame.
report::HtmlTable raster_table(const std::vector<std::string>& name_header,
    const std::vector<std::vector<std::string>>& names, const std::vector<RasterTimes>& times);

/// The three hidden-surface methods timed; tables and arrays use this order.
inline constexpr std::array raced_methods = {visuals::scene::HiddenSurface::Octant,
    visuals::scene::HiddenSurface::BackFace, visuals::scene::HiddenSurface::DepthBuffer};

/// Frame times of one way.
struct RaceTimes {
    double median_ms = 0.0;
    double p99_ms = 0.0;
    int draw_calls = 0; ///< median over the frames
};

/// Times of one scene. The three methods draw each frame in turn, so that load from other programs affects all of them.
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

/// Times the three methods over `frames` frames of a run after a warm-up. Throws Error.
Race race(const settings::RunSettings& settings, int frames, bool quiet);

} // namespace octant::ui::studies::draw_order
