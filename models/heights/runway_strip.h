#pragma once

#include "models/heights/height_field.h"

#include <glm/vec2.hpp>

namespace octant::models::heights {

/// Where a runway lies and what its ground is levelled to: a plane that rises evenly along it and is level across.
struct RunwayStrip {
    /// The middle of its beginning, metres east and north of the map's centre.
    glm::dvec2 begin_m{0.0};
    /// The way along it, clockwise from north.
    double heading_rad = 0.0;
    double length_m = 1800.0;
    double width_m = 45.0;
    /// Height of its beginning above datum, and what it rises by in a metre.
    double height_m = 0.0;
    double rise = 0.0;

    bool operator==(const RunwayStrip&) const = default;

    /// Unit vectors along the runway and to its left.
    glm::dvec2 along() const;
    glm::dvec2 left() const;

    /// Metres along the runway from its beginning, and to the left of its middle line.
    glm::dvec2 strip_from_world(const glm::dvec2& place_m) const;

    /// The place of such metres.
    glm::dvec2 place(const glm::dvec2& along_left_m) const;

    /// How far a place lies from the runway; 0 on it.
    double distance_m(const glm::dvec2& place_m) const;

    /// Height of the levelled plane at a place.
    double plane_m(const glm::dvec2& place_m) const;
};

/// Ground up to here from the runway is levelled, too: with the runway's half width a little more than the 75 m from
/// the middle line that ICAO Annex 14 (volume I, 3.4) asks to be graded, and the 60 m beyond its ends.
inline constexpr double level_margin_m = 60.0;

/// Slope of cuttings and embankments beyond: that of the transitional surface (Annex 14, volume I, table 4-1), which no
/// ground beside a runway of this length may rise through.
inline constexpr double side_slope = 1.0 / 7.0;

/// They end so far from the levelled ground; over the second half of that they go over into the ground as it is, where
/// they have not met it before.
inline constexpr double side_slope_end_m = 400.0;

/// Annex 14 (volume I, chapter 3) allows no runway of this length a steeper mean slope.
inline constexpr double max_rise = 0.01;

/// Samples of a field: columns and rows from the first to the last.
struct SampleBox {
    glm::ivec2 first;
    glm::ivec2 last;
};

/// Those that may lie so near to a runway.
SampleBox samples_around(const RunwayStrip& strip, const HeightField& field, double reach_m);

/// What the ground at a place becomes whose own height is known.
double levelled_m(const RunwayStrip& strip, double spacing_m, const glm::dvec2& place_m, double own_m);

/// How far from a runway samples may be moved.
double reach_m(const HeightField& field);

/// The field levelled for a runway, which cuts into it and lies on what is heaped up. Each cell of the grid that the
/// levelled ground touches is level all over. Beyond reach_m() samples keep their heights.
HeightField levelled(const HeightField& field, const RunwayStrip& strip);

} // namespace octant::models::heights
