#pragma once

#include "ui/studies/study.h"

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace octant::ui::studies::draw_order {

/// The ways in which flights are timed: by OpenGL, whose depth buffer is a tuned one, and by the raster renderer.
inline constexpr auto timed_modes = [] {
    using enum settings::RendererKind;
    using enum visuals::scene::HiddenSurface;
    using enum visuals::raster::Renderer::PaintDirection;
    return std::array{DrawingMode{"octant order", Gl, Octant, 0}, DrawingMode{"back faces only", Gl, BackFace, 0},
        DrawingMode{"depth buffer", Gl, DepthBuffer, 0}, DrawingMode{"octant, near to far", Raster, Octant},
        DrawingMode{"octant, far to near", Raster, Octant, 1, FarToNear},
        DrawingMode{"back faces only", Raster, BackFace}, DrawingMode{"depth buffer", Raster, DepthBuffer},
        DrawingMode{"octant, 16 samples", Raster, Octant, 16}};
}();
inline constexpr std::size_t gl_octant = 0; ///< indices into timed_modes
inline constexpr std::size_t gl_back_faces = 1;
inline constexpr std::size_t gl_depth_buffer = 2;

/// Frame time of a way over that of octant order, by OpenGL; above 1 octant order is faster.
inline double over_octant(const TimedFlight& flight, std::size_t mode) {
    return flight.median(mode) / flight.median(gl_octant);
}

/// A session of the run for each of timed_modes. Throws Error.
Sessions timed_sessions(const settings::RunSettings& settings);

/// Draws `frames` frames of a run, after a warm-up, in all ways. Throws Error.
TimedFlight race(settings::RunSettings settings, int frames, bool quiet);

/// The first cells of a flight's row, and its times.
using NamedFlight = std::pair<std::vector<report::Cell>, TimedFlight>;

/// A row for each flight: the raster renderer's ways.
report::ResultTable raster_table(std::span<const NamedFlight> flights);

} // namespace octant::ui::studies::draw_order
