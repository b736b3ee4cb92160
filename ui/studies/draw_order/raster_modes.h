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

/// A way of the raster renderer to remove hidden surfaces.
struct RasterMode {
    const char* name;
    visuals::scene::HiddenSurface hidden_surface;
    visuals::raster::Renderer::PaintDirection paint_direction = visuals::raster::Renderer::PaintDirection::NearToFar;
    int samples = 1;
};

/// Those that are compared, in this order everywhere.
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

} // namespace octant::ui::studies::draw_order
