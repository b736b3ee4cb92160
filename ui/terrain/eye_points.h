#pragma once

#include "ui/terrain/ground_view.h"
#include "visuals/scene/camera.h"
#include "visuals/terrain/ground_query.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::ui::terrain {

/// A place to look from, as written in a table of eye points.
struct EyePoint {
    int line = 0; ///< of the file
    double x_m = 0.0;
    double y_m = 0.0;
    double agl_m = 0.0;
    double heading_deg = 0.0; ///< clockwise from north
    double pitch_deg = 0.0;   ///< upward
};

/// Rows of a table with the columns map,x_m,y_m,agl_m,heading_deg,pitch_deg whose first field is `map`. Lines that
/// begin with # and the header line are passed over. Throws Error when a row is wrong or none is of that map.
std::vector<EyePoint> read_eye_points(const std::filesystem::path& file, const std::string& map);

/// The camera of a point over a ground. Throws Error when there is no ground below it.
visuals::scene::Camera camera_at(const EyePoint& point, const visuals::terrain::GroundSamples& ground, double fov_deg);

} // namespace octant::ui::terrain
