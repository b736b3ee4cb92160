#pragma once

#include "models/heights/height_field.h"

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace octant::models::heights {

/// A runway and the plane to which its ground is levelled: constant slope along the runway, level across it.
struct RunwayStrip {
    /// The middle of its threshold, metres east and north of the map's centre.
    glm::dvec2 begin_m{0.0};
    /// Its direction, clockwise from north.
    double heading_rad = 0.0;
    double length_m = 1800.0;
    double width_m = 45.0;
    /// Height of the threshold above datum, and slope (rise per metre).
    double height_m = 0.0;
    double rise = 0.0;

    bool operator==(const RunwayStrip&) const = default;

    /// Unit vectors along the runway and to its left.
    glm::dvec2 along() const;
    glm::dvec2 left() const;

    /// Converts a position to metres along the runway from its threshold and to the left of its centre line.
    glm::dvec2 strip_from_world(const glm::dvec2& place_m) const;

    /// Converts back from such coordinates.
    glm::dvec2 place(const glm::dvec2& along_left_m) const;

    /// The distance of a position from the runway; 0 on it.
    double distance_m(const glm::dvec2& place_m) const;

    /// The height of the levelled plane at a position.
    double plane_m(const glm::dvec2& place_m) const;
};

/// Ground within this distance of the runway is levelled, too. Together with half the runway's width this exceeds the
/// 75 m from the centre line, and the 60 m beyond the ends, that ICAO Annex 14 (volume I, 3.4) requires to be graded.
inline constexpr double level_margin_m = 60.0;

/// Slope of cuttings and embankments: that of the transitional surface (Annex 14, volume I, table 4-1), which ground
/// next to a runway of this length must not penetrate.
inline constexpr double side_slope = 1.0 / 7.0;

/// Cuttings and embankments end at this distance from the levelled ground. Over the second half of it they blend into
/// the original ground.
inline constexpr double side_slope_end_m = 400.0;

/// The largest mean slope that Annex 14 (volume I, chapter 3) allows for a runway of this length.
inline constexpr double max_rise = 0.01;

/// The largest distance from a runway at which levelling changes samples.
double reach_m(const HeightField& field);

/// The field with cuttings and embankments for a runway. Each grid cell that the levelled ground touches is level as a
/// whole. Samples farther away than reach_m() keep their heights.
HeightField levelled(const HeightField& field, const RunwayStrip& strip);

/// The requested position of a runway.
struct RunwayRequest {
    /// Positions along the flight path, at least one. The first one is the aiming point, 300 m from the threshold.
    std::vector<glm::dvec2> path_m;
    double heading_rad = 0.0;
    /// The runway must lie above this height.
    double water_m = 0.0;
};

/// A runway and the earthwork that it needs.
struct RunwaySite {
    RunwayStrip strip;
    /// The largest change of a height, metres.
    double earthwork_m = 0.0;
    bool matches_request = false;
};

/// The requested position is taken if its earthwork is at most this: cuttings and embankments 105 m wide.
inline constexpr double max_earthwork_m = 15.0;

/// The search radius around the path for another site.
inline constexpr double runway_search_radius_m = 6000.0;

/// The requested site if max_earthwork_m suffices; else the site near the path with the least sum of costs: a metre of
/// earthwork costs as much as 200 m between the path and the runway's middle, 500 m between that and the path's
/// beginning, or a turn by 15 degrees. Deterministic. Nothing if each site would leave the field or touch water. The
/// caller decides whether the earthwork is too large.
std::optional<RunwaySite> runway_site(const HeightField& field, const RunwayRequest& request);

} // namespace octant::models::heights
