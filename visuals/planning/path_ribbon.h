#pragma once

#include "models/colour_vertex.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/drawn_path.h"
#include "visuals/planning/transparent_geometry.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// What a ribbon is made by.
struct RibbonView {
    glm::dvec3 eye_m{0.0};
    /// What is far sinks by this radius; 0 = the earth is flat.
    double earth_radius_m = 0.0;
    /// What has been flown by then is stronger.
    double time_s = 0.0;
    double half_width_m = 3.0;
    /// The way before and behind the aircraft that is not covered.
    double gap_m = 15.0;
};

/// A path as a ribbon along the wings, in dashes of about equal times with gaps between them, so
/// that each has a place of its own in the painting order. Legs have two colours in turn. Keeps its
/// memory.
class PathRibbon {
public:
    /// The path must outlive the ribbon.
    explicit PathRibbon(const DrawnPath& path);

    struct Dash {
        /// Holds the dash; the eye is at the origin.
        OrientedBox box;
        TransparentRange range;
    };

    /// The dashes of a frame, added to its veils. Valid until the next call.
    std::span<const Dash> dashes(const RibbonView& view, TransparentGeometry& transparents);

private:
    /// Where the aircraft is: past `point`, before the next one.
    struct AircraftPoint {
        /// The time as a number of points.
        double fractional_point;
        /// The last point that it has passed.
        std::size_t point;
        glm::dvec3 place_m;
    };

    AircraftPoint aircraft_point(double time_s) const;
    void add_dash(std::size_t first, std::size_t last, const RibbonView& view, TransparentGeometry& transparents);
    void add_ribbon_section(std::size_t first, std::size_t last, const RibbonView& view, TransparentGeometry& transparents);

    const DrawnPath& path_;
    std::size_t points_per_dash_ = 1;
    std::vector<Dash> dashes_;
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

} // namespace octant::visuals::planning
