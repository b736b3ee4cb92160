#pragma once

namespace octant::models::heights {

/// What a picture of heights (PNG, PGM and the like without a place on the earth) does not say
/// itself. Both above zero and finite (asserted).
struct ImportOptions {
    double spacing_m = 30.0;   ///< between samples
    double height_scale = 1.0; ///< metres a unit of the picture
};

/// Largest width and height that is read, samples.
inline constexpr int largest_import_samples = 20000;

/// Heights that are believed, metres. A file with others is refused.
inline constexpr double lowest_import_m = -12000.0;
inline constexpr double highest_import_m = 9000.0;

} // namespace octant::models::heights
