#pragma once

#include "ui/report/png_file.h"

#include <span>
#include <string>
#include <vector>

namespace octant::ui::report {

/// The file of a recording that shows its recorded track.
inline constexpr const char* track_picture_name = "track.png";

/// The track of an aircraft for a picture: as many of each; a height that is not finite is a gap.
struct TrackCurve {
    std::string name;
    std::vector<double> time_s;
    std::vector<double> east_m;
    std::vector<double> north_m;
    std::vector<double> height_m;
    /// Times at which nothing was recorded begin after these samples.
    std::vector<std::size_t> gap_after;
};

/// A map of tracks, at one scale in both directions, above the heights over time; the first track stands out, gaps are
/// left open and marked in the profile. Same tracks, same bytes where the same fonts are installed. Throws Error if
/// cairo is missing.
Picture track_picture(std::span<const TrackCurve> curves);

} // namespace octant::ui::report
