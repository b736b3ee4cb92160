#pragma once

#include <optional>
#include <string>
#include <vector>

namespace octant::models::heights {

/// Stored numbers that mean "no data".
struct VoidValues {
    std::vector<double> values = {}; ///< in addition to the file's own and to common ones
    bool only = false;               ///< neither the file's own nor common ones mean "no data", only `values` do

    bool operator==(const VoidValues&) const = default;
};

/// Properties that files of heights may lack. Numbers are above zero and finite (asserted).
struct ImportOptions {
    double spacing_m = 30.0; ///< between samples of a file without georeference (PNG, PGM and the like)
    /// Metres per unit of height for a file that names no unit or an unknown one; 1 if nothing.
    std::optional<double> height_scale = {};
    /// The coordinate system of files that have a place but name none, as GDAL takes it: EPSG:4326, a PROJ string,
    /// well-known text, a .prj file; or "metres". Nothing: WGS 84 where their axes are in degrees, else metres.
    std::optional<std::string> system = {};
    VoidValues voids = {};
    /// The band of heights: its number from 1 on, its name, or "terrarium" or "mapbox" for heights that are coded in
    /// colours. Nothing: chosen by height_band_of.
    std::optional<std::string> band = {};

    bool operator==(const ImportOptions&) const = default;
};

/// Largest width and height of a map that is read as a whole, samples.
inline constexpr int max_import_samples = 20000;

/// Plausible heights on the earth, metres. A file with other heights is refused.
inline constexpr double lowest_import_m = -12000.0;
inline constexpr double highest_import_m = 9000.0;

/// Plausible heights on other bodies, up and down from the ellipsoid: Olympus Mons on Mars is 21.2 km high, the deepest
/// basin of Vesta is 22 km deep.
inline constexpr double max_height_other_body_m = 25000.0;

} // namespace octant::models::heights
