#pragma once

#include "models/heights/height_field.h"
#include "models/heights/height_grid.h"

#include <memory>
#include <optional>
#include <string>

namespace octant::models::heights {

struct CloseTransformation {
    void operator()(void* transformation) const;
};

/// Owner of an OGRCoordinateTransformationH.
using Transformation = std::unique_ptr<void, CloseTransformation>;

/// An OGRSpatialReferenceH, owned elsewhere.
using SystemHandle = void*;

/// A system as well-known text; empty when it cannot be written.
std::string wkt_of(SystemHandle system);

/// Where the samples of a grid lie in a coordinate system: sample (0, 0) and the steps, both above
/// zero, in the system's own units.
struct GridFrame {
    double west = 0.0;
    double south = 0.0;
    double step_east = 1.0;
    double step_north = 1.0;
};

/// A grid's system, which has a linear unit, about the grid's centre.
MapSystem map_system(SystemHandle system, const GridFrame& frame, int columns, int rows);

/// A grid on the ground around its centre.
struct LocalGrid {
    HeightGrid grid;
    double spacing_m = 0.0;
    GeoPlace place;
    MapSystem system; ///< that of the local frame
};

/// The ground about the centre of a grid in some coordinate system: a transverse Mercator
/// projection of scale 1 that touches WGS 84 at that centre, so x is east, y north, in metres.
class LocalFrame {
public:
    /// Nothing when the system cannot be brought to WGS 84.
    static std::optional<LocalFrame>
    around(SystemHandle system, const GridFrame& frame, int columns, int rows);

    GeoPlace place() const { return place_; }

    /// Length on the ground of one step of the grid at its centre.
    double step_east_m() const { return step_east_m_; }

    double step_north_m() const { return step_north_m_; }

    /// The grid resampled (bilinear) to square cells of sqrt(step_east_m * step_north_m), which
    /// keeps the number of samples about the same, over the upright rectangle that lies within all
    /// four of its edges. Nothing when fewer than 2 x 2 samples fit in or the ground is wider than
    /// 1,000 km.
    std::optional<LocalGrid> resampled(const HeightGrid& grid) const;

private:
    LocalFrame() = default;

    struct Rectangle {
        double west_m = 0.0;
        double east_m = 0.0;
        double south_m = 0.0;
        double north_m = 0.0;
    };

    std::optional<Rectangle> rectangle_within(const HeightGrid& grid) const;
    bool fill(LocalGrid& local, double west_m, double south_m, const HeightGrid& grid) const;

    GridFrame frame_;
    GeoPlace place_;
    std::string wkt_; ///< of the frame's projection
    double step_east_m_ = 0.0;
    double step_north_m_ = 0.0;
    Transformation to_local_;
    Transformation from_local_;
    Transformation local_to_wgs84_;
};

} // namespace octant::models::heights
