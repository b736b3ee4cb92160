#pragma once

#include "ui/settings/settings.h"
#include "ui/studies/study.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/picture.h"
#include "visuals/terrain/ground_query.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace octant::ui::studies::flicker {

/// From where one frame of a run is seen.
struct FlightCamera {
    visuals::scene::Camera camera;
    /// Where the first aircraft is.
    glm::dvec3 aircraft_m{0.0};
    /// The radius of a sphere around it.
    double aircraft_radius_m = 0.0;
};

/// A pixel of one frame, and the position of its ground point in the previous frame.
struct ReprojectedPixel {
    glm::ivec2 pixel{0};    ///< column and row from the upper left
    glm::dvec2 before{0.0}; ///< the same in the frame before, between pixels; whole = a centre
};

/// Every fourth pixel, both ways, of the later frame that shows ground which the earlier one shows too, at full
/// resolution; not those near the aircraft. `radius_m`: of the earth, 0 = flat.
std::vector<ReprojectedPixel> reprojected_pixels(const visuals::terrain::GroundSamples& ground,
    const FlightCamera& earlier, const FlightCamera& later, const glm::ivec2& size_px, double radius_m);

/// Mean absolute change of luminance (0 to 255) over the pixels; 0 if there are none.
double mean_change(const visuals::scene::Picture& earlier, const visuals::scene::Picture& later,
    const std::vector<ReprojectedPixel>& matches);

/// Terrain, size, triangles, error in pixels, rate, frames, ... are those of the settings.
struct PoppingStudyOptions : StudyOptions {
    bool shimmer = false;
    int every = 60; ///< shimmer: a pair of frames in so many
};

/// Measures, frame by frame along the four paths of the F-15, the largest jump of a vertex in pixels when its level of
/// detail changes: for the midpoint mesh with an exact budget, for the screen-error mesh without and with geomorphs,
/// and on request with near detail. With `shimmer`, also measures the change of ground pixels between consecutive
/// frames after motion compensation, for one and four samples per pixel, without and with geomorphs. Prints the tables
/// and writes them to `out` as CSV and as one Markdown page. Throws Error.
void study_popping(const PoppingStudyOptions& options);

} // namespace octant::ui::studies::flicker
